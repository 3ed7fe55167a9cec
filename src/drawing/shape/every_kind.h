#pragma once
#include "world/shape/geometry_factory.h"

namespace icome::drawing {

/// A factory that knows drawings beside the kinds of the world, which are all kinds that the project has.
world::GeometryFactory every_kind_of_shape();

}  // namespace icome::drawing
