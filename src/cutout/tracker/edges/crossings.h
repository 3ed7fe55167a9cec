#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/vector.h"
#include "cutout/tracker/edges/claims.h"
#include "cutout/tracker/edges/colour_classes.h"
#include "cutout/tracker/edges/rectifier.h"
#include "cutout/tracker/frame.h"

namespace icome::cutout {

/// A place where red turns to blue, on the table.
struct EdgePoint {
  base::Vector2 place;   ///< mm
  base::Vector2 normal;  ///< unit vector towards blue
  double angle;          ///< rad, of the normal, from x towards y, in [0, 2 pi)
};

/// Finds the places of a frame where red turns to blue, along rows and columns. Rows and columns are looked
/// at more coarsely in frames above kFullSide, so that time is bounded.
class Crossings {
 public:
  static constexpr int kFullSide = 1000;  ///< pixels; the longer side, up to which every pixel is looked at
  static constexpr std::size_t kMost = 20'000;  ///< points kept; of more, every n-th

  /// Points that no triangle claims, in `points`. What was there is overwritten.
  void find(const FrameView& frame, const ColourClasses& colours, const Rectifier& rectifier,
            const Claims& claims, std::vector<EdgePoint>& points);

 private:
  struct Grid {
    int step, width, height;
  };
  void fill_planes(const FrameView& frame, const Grid& grid, int threshold);
  void add(const FrameView& frame, const ColourClasses& colours, const Rectifier& rectifier,
           const Claims& claims, const Grid& grid, int x, int y, bool along_row,
           std::vector<EdgePoint>& points);

  std::vector<std::int8_t> signal_;     // half of blue minus red, above the threshold
  std::vector<std::int8_t> whole_row_;  // the signal of a row of the frame
  std::vector<std::uint8_t> sides_;     // 1 where that is above 0
};

}  // namespace icome::cutout
