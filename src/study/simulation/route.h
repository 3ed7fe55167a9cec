#pragma once
#include <vector>

#include "base/vector.h"

namespace icome::study {

/// The way of a point from one place to another that keeps clear of boxes by `clearance` (m): corners of the
/// way, the goal last. The shortest over corners and edges of the boxes, which are few; straight if none is
/// free. Boxes that hold one of the ends, with the clearance, are passed through.
std::vector<base::Vector3> route(const base::Vector3& from, const base::Vector3& to,
                                 const std::vector<base::Bounds>& boxes, double clearance);

}  // namespace icome::study
