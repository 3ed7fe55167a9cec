#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/vector.h"

namespace icome::cutout {

/// A line as in equation 3.2 of the thesis: rho = x cos(theta) + y sin(theta).
struct HoughLine {
  double rho;    ///< mm
  double theta;  ///< rad, from x towards y, in [0, pi) but for what the middle of a dark spot adds
  int votes;
};

/// The second stage of thesis 3.4.5: every mark votes for all lines through it, and dark spots of (rho,
/// theta) are lines.
class HoughLines {
 public:
  /// The lines of at least `least` votes, those of most votes first, `most` at the most. `pixel` is the size
  /// of a pixel on the table, mm.
  void find(std::span<const base::Vector2> marks, double pixel, int least, std::size_t most,
            std::vector<HoughLine>& lines);

 private:
  std::vector<std::uint16_t> votes_;
};

}  // namespace icome::cutout
