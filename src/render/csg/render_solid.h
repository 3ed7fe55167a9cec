#pragma once
#include <memory>

#include "base/result.h"
#include "render/csg/csg_geometry.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::render {

/// A CSG solid prepared to be drawn from images of its operands. Immutable once made.
struct RenderSolid {
  /// The use of the solid's triangles. Making fine ones takes longer than anything else, so they are made
  /// only of solids whose images take long to draw without a graphics card.
  enum class Triangles {
    Fine,    ///< to be seen
    Coarse,  ///< for shadows, and to be seen where a driver takes no images
    Partial  ///< as those, but thin parts are missing
  };

  CsgGeometry images;
  Triangles triangles = Triangles::Coarse;
};

/// A CSG solid in all ways in which it can be drawn.
struct DrawnSolid {
  std::shared_ptr<const RenderSolid> solid;            ///< null: has no images
  std::shared_ptr<const world::MeshGeometry> surface;  ///< never null; coloured as the operands are
  bool lacks_parts = false;                            ///< there are no images, and thin parts are missing
};

/// Makes the images, unless the solid has too many operands, and as many triangles as are needed beside them.
/// Fails, saying why, when neither can be made.
base::Result<DrawnSolid> make_drawn_solid(const world::CsgGeometry& shape);

}  // namespace icome::render
