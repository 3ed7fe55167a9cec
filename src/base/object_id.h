#pragma once
#include <compare>
#include <cstdint>

namespace icome::base {

/// Names an object: a place in a table and how often that place was given away. An id whose object
/// is gone never names its successor.
struct ObjectId {
  std::uint32_t index = 0;
  std::uint32_t generation = 0;

  auto operator<=>(const ObjectId&) const = default;
};

}  // namespace icome::base
