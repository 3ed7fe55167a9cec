#pragma once
#include <string>
#include <vector>

#include "cutout/tracker/frame.h"

namespace icome::cutout {

/// Figures of a frame by which it is judged.
struct FrameQuality {
  double median = 0;        ///< brightness, 0 to 255
  double bright = 0;        ///< of which 1 % is brighter, 0 to 255
  double saturated = 0;     ///< share of pixels whose red is at its limit
  double red = 0;           ///< share of pixels that are red
  double blue = 0;          ///< share of pixels that are blue
  double sharpest = 0;      ///< width of edges in the direction where they are sharpest, pixels; 0: no edges
  double most_blurred = 0;  ///< and where they are most blurred
  int directions = 0;       ///< of edges, of eight, that were seen
};
FrameQuality quality_of(const FrameView& frame);

/// Sentences on what is wrong: too dark, overexposed, no red table, out of focus, blurred by motion. None: it
/// is good to track.
std::vector<std::string> complaints_of(const FrameQuality& quality);

}  // namespace icome::cutout
