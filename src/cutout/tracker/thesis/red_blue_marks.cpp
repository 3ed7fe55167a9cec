#include "cutout/tracker/thesis/red_blue_marks.h"

#include <algorithm>

namespace icome::cutout {
namespace {

constexpr int kRedThreshold = 50;  // percent of the sum of the channels; skin has some 40, the table above 60
constexpr int kCrossingReach = 3;  // pixels to both sides of a crossing, where both colours are pure
constexpr int kDarkestSum = 60;

/// Red (1) or blue (-1) by which is greater.
int side_of(const std::uint8_t* bgr) { return bgr[2] > bgr[0] ? 1 : -1; }

bool is_red_enough(const std::uint8_t* bgr) {
  const int sum = bgr[0] + bgr[1] + bgr[2];
  return sum > kDarkestSum && 100 * bgr[2] >= kRedThreshold * sum;
}

bool is_blue_enough(const std::uint8_t* bgr) {
  const int sum = bgr[0] + bgr[1] + bgr[2];
  return sum > kDarkestSum && bgr[0] > bgr[2] && bgr[0] >= bgr[1];
}

/// Is there a crossing before the pixel, on a line whose pixels are `step` bytes apart?
bool crosses(const std::uint8_t* bgr, std::ptrdiff_t step) {
  const int own = side_of(bgr);
  if (own == side_of(bgr - step)) return false;
  const std::uint8_t *after = bgr + (kCrossingReach - 1) * step, *before = bgr - kCrossingReach * step;
  return own > 0 ? is_red_enough(after) && is_blue_enough(before)
                 : is_red_enough(before) && is_blue_enough(after);
}

}  // namespace

void red_blue_marks(const FrameView& frame, const Rectifier& rectifier, std::size_t most,
                    std::vector<base::Vector2>& marks) {
  marks.clear();
  const std::ptrdiff_t down = std::ptrdiff_t(frame.row_bytes);
  for (int y = kCrossingReach; y < frame.height - kCrossingReach; ++y) {
    const std::uint8_t* row = frame.row(y);
    for (int x = kCrossingReach; x < frame.width - kCrossingReach; ++x) {
      const std::uint8_t* bgr = row + 3 * x;
      if (crosses(bgr, 3)) {
        const base::Vector2 mm = rectifier.to_table(x - 0.5, y);
        if (rectifier.near_table(mm)) marks.push_back(mm);
      }
      if (crosses(bgr, down)) {
        const base::Vector2 mm = rectifier.to_table(x, y - 0.5);
        if (rectifier.near_table(mm)) marks.push_back(mm);
      }
    }
  }
  if (marks.size() <= most) return;
  const std::size_t every = (marks.size() + most - 1) / most;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < marks.size(); i += every) marks[kept++] = marks[i];
  marks.resize(kept);
}

}  // namespace icome::cutout
