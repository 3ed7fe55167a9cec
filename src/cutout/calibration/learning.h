#pragma once
#include "base/result.h"
#include "cutout/tracker/frame.h"
#include "cutout/tracker/known_triangles.h"
#include "cutout/tracker/table_view.h"

namespace icome::cutout {

/// A triangle that was measured.
struct LearntTriangle {
  double base_angle = 0;  ///< rad
  double height = 0;      ///< mm
  double uneven = 0;      ///< how far the two base angles differ, rad
};

/// Measures the largest blue triangle of a frame. Fails, saying why, where none is seen whole, or it is not
/// isosceles.
base::Result<LearntTriangle> learn_triangle(const FrameView& frame, const TableView& view);
/// The middle of several measurements. At least one.
LearntTriangle middle_of(std::vector<LearntTriangle> measured);

}  // namespace icome::cutout
