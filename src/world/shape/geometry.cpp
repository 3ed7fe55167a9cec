#include "world/shape/geometry.h"

#include <fmt/format.h>

#include "world/shape/flat_curves.h"

namespace icome::world {

base::Result<FlatCurves> Geometry::flat_curves(double /*tolerance*/) const {
  return base::fail(
      fmt::format("a {} shape has no curves to sweep: name a drawing, or a mesh that is flat", kind()));
}

base::Result<Amended> Geometry::amended(std::string_view /*change*/) const {
  return base::fail(fmt::format("Shapes of the kind \"{}\" have no changes of their own.", kind()));
}

}  // namespace icome::world
