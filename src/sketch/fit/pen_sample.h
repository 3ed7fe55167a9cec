#pragma once
#include <vector>

#include "base/vector.h"

namespace icome::sketch {

/// One report of a pen that touches the paper.
struct PenSample {
  double time = 0.0;      ///< s, from any start
  base::Vector2 place;    ///< m on the paper, x to the right and y down
  double pressure = 1.0;  ///< 0 (none) to 1
};

/// The reports of a pen between touching the paper and leaving it: one sample or more.
using PenStroke = std::vector<PenSample>;

}  // namespace icome::sketch
