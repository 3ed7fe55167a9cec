#pragma once
#include "base/result.h"
#include "sketch/drawn.h"
#include "sketch/feel/paper.h"
#include "world/world.h"

namespace icome::sketch {

/// Heights and feel of a drawing that is to be touched.
struct ReliefSettings {
  double height = 0.0005;        ///< m, of every line; 0.00005 to 0.1
  double height_by_width = 0.0;  ///< m for a metre of the line's greatest width, beside it; 0 to 10
  double sheet = 0.001;          ///< m, thickness of the paper below; 0: none
  Paper paper = {};              ///< what the sheet feels like
};

/// The drawing as a design: the sheet of paper, and a group for each visible layer with a ridge for each
/// line, and a flatter one for each fill, in their colours. The paper lies in the plane z = 0 with its middle
/// at the origin and y up, ridges rise to +z. Fails for a drawing of which nothing can be seen.
base::Result<world::World> relief_of(const Drawing& drawing, const ReliefSettings& settings);

}  // namespace icome::sketch
