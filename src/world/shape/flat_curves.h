#pragma once
#include <vector>

#include "geometry/sweep/outline.h"

namespace icome::world {

/// Curves of a shape in the plane z = 0 of its frame, m.
struct FlatCurves {
  std::vector<geometry::Outline> areas;           ///< what closed curves enclose, none over another
  std::vector<std::vector<base::Vector2>> lines;  ///< points along open curves
};

}  // namespace icome::world
