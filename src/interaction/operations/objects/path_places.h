#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "base/result.h"
#include "base/vector.h"

namespace icome::interaction {

/// A place on a path.
struct PathPlace {
  base::Vector3 at;    // m
  base::Matrix3 turn;  // turn of the path's direction since its beginning, never about itself
};

/// `count` (> 0) places at equal distances along a polyline, both ends among them; a closed one, which ends
/// where it begins, has its end left out. One place is the beginning. Fails for a path without a length.
base::Result<std::vector<PathPlace>> places_along(std::span<const base::Vector3> path, std::size_t count);

/// The least turn that takes one unit vector to another; between opposite ones about the most upright (y)
/// axis across them.
base::Matrix3 turn_between(const base::Vector3& from, const base::Vector3& to);

}  // namespace icome::interaction
