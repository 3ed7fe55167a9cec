#pragma once
#include <string_view>

#include "interaction/operations/value.h"
#include "world/world.h"

namespace icome::interaction {

/// The value of an argument with which an operation would leave an object as it is: its colour for "colour",
/// its radius for "reshape", its stiffness for "feel", its material's name for "material". Of a group it is
/// that of the first shape below it. Null: the object has none.
Value present_value(const world::World& world, world::ObjectId object, std::string_view operation,
                    std::string_view argument);

}  // namespace icome::interaction
