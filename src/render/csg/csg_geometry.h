#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "base/result.h"
#include "base/vector.h"
#include "charts/colour.h"
#include "geometry/csg/csg_tree.h"
#include "render/model/camera.h"
#include "render/model/shading_mesh.h"

namespace icome::render {

/// One operand of a product, as a graphics card takes it.
struct CsgOperand {
  ShadingMesh mesh;     ///< closed, facing out, in the buffers' frame, which all operands share
  base::Bounds bounds;  ///< of the mesh, buffers' frame
  bool subtracted = false;
  /// Most of its fronts that can lie one behind the other: 1 when convex; nothing when it must be counted.
  std::optional<unsigned> layers;
  std::optional<charts::Colour> colour;
};

/// The operands of one product: the solid in all of the intersected ones, of which there is at least one,
/// and in no subtracted one.
using CsgOperands = std::vector<CsgOperand>;

/// A CSG tree prepared for pictures: a union of products of meshes. Owns its arrays.
struct CsgGeometry {
  std::vector<CsgOperands> products;
  base::Vector3 centre{0.0, 0.0, 0.0};  ///< m, tree's frame: origin of the buffers' frame
  double radius = 1.0;                  ///< m, > 0: the unit there
  std::vector<base::Vector3> surface;   ///< m, tree's frame: points all over the solid, to frame a view

  Matrix4 tree_from_buffer() const;
  std::size_t operand_count() const;
  std::size_t triangle_count() const;
};

struct CsgGeometryOptions {
  /// Share of the solid's radius that its curved faces may be off; 1e-5 ... 1e-2.
  double tolerance = 4e-4;
  double crease_angle = 0.6;         ///< rad, sharper bends of an operand are drawn as edges; 0 ... pi
  std::size_t max_operands = 1'000;  ///< of all products together
  std::size_t max_triangles = 5'000'000;
};

/// Brings the tree to normal form (thesis section 5.5.5) and makes a mesh of each operand. So that faces
/// which coincide are told apart although pictures only compare rounded depths, the operands of a product
/// grow by some hundred thousandths of the solid's radius, the subtracted ones most: a hole that ends flush
/// with a face is open. Where faces of two products coincide, the colour of the first wins.
/// Fails when the solid is unbounded, or when it has too many operands or triangles to be drawn this way.
base::Result<CsgGeometry> make_csg_geometry(const geometry::CsgTree& tree,
                                            const CsgGeometryOptions& options = {});

}  // namespace icome::render
