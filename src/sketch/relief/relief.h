#pragma once
#include "base/result.h"
#include "drawing/shape/ridges.h"
#include "sketch/drawn.h"
#include "sketch/feel/paper.h"
#include "world/world.h"

namespace icome::sketch {

/// Heights and feel of a drawing that is to be touched.
struct ReliefSettings {
  drawing::RidgeHeights heights = {};
  double sheet = 0.001;  ///< m, thickness of the paper below; 0: none
  Paper paper = {};      ///< what the sheet feels like
};

/// The drawing as a design: the sheet of paper, and a group for each visible layer with a ridge for each
/// line, and a flatter one for each fill, in their colours. The paper lies in the plane z = 0 with its middle
/// at the origin and y up, ridges rise to +z. Fails for a drawing of which nothing can be seen.
base::Result<world::World> relief_of(const Drawing& drawing, const ReliefSettings& settings);

/// The drawing as a design of one object called `name`, a drawing::DrawingShape that feels as the paper: it
/// can be drawn on in the design, and extruded. Fails for settings out of range.
base::Result<world::World> drawing_design_of(const Drawing& drawing, const ReliefSettings& settings,
                                             const std::string& name);

}  // namespace icome::sketch
