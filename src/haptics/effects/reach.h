#pragma once
#include <limits>

#include "base/vector.h"

namespace icome::haptics {

using base::Vector3;

/// The region in which an effect acts: no further than `radius` from a point, or from an endless line.
struct Reach {
  Vector3 centre = Vector3::Zero();                         // m
  Vector3 axis = Vector3::Zero();                           // unit, along the line; zero: a point
  double radius = std::numeric_limits<double>::infinity();  // m, >= 0; infinite: everywhere
};

/// The reach in another frame.
Reach transformed(const base::Pose& to_from_reach, const Reach& reach);

/// Is there a place within both?
bool meet(const Reach& a, const Reach& b);

}  // namespace icome::haptics
