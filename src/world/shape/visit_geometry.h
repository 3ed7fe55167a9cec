#pragma once
#include <utility>

#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::world {

/// Calls the one of `cases` that takes the shape's kind, such as [](const MeshGeometry& it) { ... }, and
/// returns its result; all return the same type. A case of `const Geometry&` takes all kinds without a case
/// of their own. The compiler checks that custom kinds are taken, too, which takes such a case.
template <typename... Cases>
decltype(auto) visit_geometry(const Geometry& shape, Cases&&... cases) {
  struct All : Cases... {
    using Cases::operator()...;
  };
  All all{std::forward<Cases>(cases)...};
  switch (shape.which()) {
    case Geometry::Kind::Mesh:
      return all(static_cast<const MeshGeometry&>(shape));
    case Geometry::Kind::Primitive:
      return all(static_cast<const PrimitiveGeometry&>(shape));
    case Geometry::Kind::Loop:
      return all(static_cast<const LoopGeometry&>(shape));
    case Geometry::Kind::Csg:
      return all(static_cast<const CsgGeometry&>(shape));
    case Geometry::Kind::Implicit:
      return all(static_cast<const ImplicitGeometry&>(shape));
    case Geometry::Kind::OnesOwn:
      break;
  }
  return all(shape);
}

}  // namespace icome::world
