#include "cutout/tracker/thesis/hough_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cutout/tracker/edges/nearest_pixel.h"

namespace icome::cutout {
namespace {

constexpr int kHoughAngles = 180;
constexpr double kHoughAngle = std::numbers::pi / kHoughAngles;
constexpr int kSpotReach = 4;  // cells about a dark spot's darkest one within which no other spot begins
constexpr int kSpotCore = 2;   // cells about it whose mean is the spot's middle
constexpr int kMostHoughColumns = 2048;

}  // namespace

void HoughLines::find(std::span<const base::Vector2> marks, double pixel, int least, std::size_t most,
                      std::vector<HoughLine>& lines) {
  lines.clear();
  if (marks.empty()) return;
  base::Vector2 centre = base::Vector2::Zero();
  for (const base::Vector2& mark : marks) centre += mark;
  centre /= double(marks.size());
  double farthest = 0;
  for (const base::Vector2& mark : marks) farthest = std::max(farthest, (mark - centre).norm());
  const double step = std::max(pixel, 2 * farthest / (kMostHoughColumns - 2 * kSpotReach - 4));
  const int columns = int(2 * farthest / step) + 2 * kSpotReach + 4;
  const double shift = farthest / step + kSpotReach + 1;
  votes_.assign(std::size_t(kHoughAngles) * std::size_t(columns), 0);
  for (int angle = 0; angle < kHoughAngles; ++angle) {
    const double cosine = std::cos(angle * kHoughAngle) / step, sine = std::sin(angle * kHoughAngle) / step;
    std::uint16_t* row = &votes_[std::size_t(angle) * std::size_t(columns)];
    for (const base::Vector2& mark : marks)
      ++row[nearest_pixel((mark.x() - centre.x()) * cosine + (mark.y() - centre.y()) * sine + shift)];
  }
  // Half a turn on, a line has its rho the other way round.
  const auto votes_at = [&](int angle, int column) -> int {
    if (angle < 0 || angle >= kHoughAngles) {
      angle += angle < 0 ? kHoughAngles : -kHoughAngles;
      column = int(std::lround(2 * shift)) - column;
    }
    if (column < 0 || column >= columns) return 0;
    return votes_[std::size_t(angle) * std::size_t(columns) + std::size_t(column)];
  };
  for (int angle = 0; angle < kHoughAngles; ++angle)
    for (int column = kSpotReach; column < columns - kSpotReach; ++column) {
      const int own = votes_[std::size_t(angle) * std::size_t(columns) + std::size_t(column)];
      if (own < least) continue;
      bool darkest = true;
      for (int i = -kSpotReach; i <= kSpotReach && darkest; ++i)
        for (int j = -kSpotReach; j <= kSpotReach && darkest; ++j) {
          const int other = votes_at(angle + i, column + j);
          darkest = other < own || (other == own && (i > 0 || (i == 0 && j >= 0)));
        }
      if (!darkest) continue;
      double sum = 0, mean_angle = 0, mean_column = 0;
      for (int i = -kSpotCore; i <= kSpotCore; ++i)
        for (int j = -kSpotCore; j <= kSpotCore; ++j) {
          const int votes = votes_at(angle + i, column + j);
          if (2 * votes < own) continue;
          sum += votes;
          mean_angle += votes * i;
          mean_column += votes * j;
        }
      HoughLine line;
      line.theta = (angle + mean_angle / sum) * kHoughAngle;
      line.rho = (column + mean_column / sum - shift) * step + centre.x() * std::cos(line.theta) +
                 centre.y() * std::sin(line.theta);
      line.votes = own;
      lines.push_back(line);
    }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const HoughLine& a, const HoughLine& b) { return a.votes > b.votes; });
  if (lines.size() > most) lines.resize(most);
}

}  // namespace icome::cutout
