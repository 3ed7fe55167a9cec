#pragma once
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "files/csg/csg_document.h"
#include "geometry/csg/csg_leaf.h"

namespace icome::files {

/// The part made by cube, sphere, cylinder or polyhedron.
struct CsgPart {
  std::optional<geometry::CsgShape> shape;               // nothing: it has no volume
  geometry::Vector3 centre = geometry::Vector3::Zero();  // m, the origin of the shape's frame
  std::vector<std::string> notes;                        // repairs made to it
};

/// Makes the shapes of one file. Faceted shapes of the same size are made once and shared.
class CsgShapes {
 public:
  // Each reads the arguments of a statement of its name; the error says what is wrong with them.
  // Lengths are millimetres in the document and metres in the shape.
  base::Result<CsgPart> cube(const CsgDocument& document, CsgDocument::Index statement);
  base::Result<CsgPart> sphere(const CsgDocument& document, CsgDocument::Index statement);
  base::Result<CsgPart> cylinder(const CsgDocument& document, CsgDocument::Index statement);

 private:
  using Facets = std::shared_ptr<const geometry::MeshSolid>;
  std::map<std::array<double, 4>, Facets> faceted_;  // by bottom and top radius, height (0: ball) and sides
};

/// The solid of a polyhedron statement (csg_polyhedron.cpp). Fails also when the time budget ends.
base::Result<CsgPart> read_polyhedron(const CsgDocument& document, CsgDocument::Index statement,
                                      io::TimeBudget& time_budget);

/// The unit of a .csg file: millimetres to a metre.
constexpr double kMillimetresPerMetre = 1000.0;
// Sizes and coordinates that can be touched, mm: those of geometry::parse_primitive.
constexpr double kSmallestSize = 1e-6;
constexpr double kLargestSize = 1e9;

}  // namespace icome::files
