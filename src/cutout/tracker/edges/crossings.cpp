#include "cutout/tracker/edges/crossings.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

// The loop over all pixels is also compiled for processors that can shuffle bytes, which is chosen when the
// program starts.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define ICOME_CUTOUT_FAST_LOOP __attribute__((target_clones("avx2", "default")))
#else
#define ICOME_CUTOUT_FAST_LOOP
#endif

namespace icome::cutout {
namespace {

using base::Vector2;

constexpr double kSideDistance = 3;     // cells of the grid from an edge to where red and blue must be
constexpr int kLeastGradient = 16 * 5;  // of the signal for a cell, times the 16 of the sums below

ICOME_CUTOUT_FAST_LOOP void signal_of_row(const std::uint8_t* __restrict bgr, std::int8_t* __restrict signal,
                                          std::uint8_t* __restrict sides, int width, int threshold) {
  for (int x = 0; x < width; ++x) {
    int half = (int(bgr[3 * x]) - int(bgr[3 * x + 2]) - threshold) / 2;
    half = half > 127 ? 127 : half < -128 ? -128 : half;
    signal[x] = std::int8_t(half);
    sides[x] = half > 0;
  }
}

std::uint64_t eight_at(const std::uint8_t* bytes) {
  std::uint64_t eight;
  std::memcpy(&eight, bytes, 8);
  return eight;
}

}  // namespace

void Crossings::fill_planes(const FrameView& frame, const Grid& grid, int threshold) {
  const std::size_t size = std::size_t(grid.width) * std::size_t(grid.height);
  signal_.resize(size);
  sides_.resize(size);
  for (int y = 0; y < grid.height; ++y) {
    const std::uint8_t* row = frame.row(y * grid.step);
    std::int8_t* signal = &signal_[std::size_t(y) * std::size_t(grid.width)];
    std::uint8_t* sides = &sides_[std::size_t(y) * std::size_t(grid.width)];
    if (grid.step == 1) {
      signal_of_row(row, signal, sides, grid.width, threshold);
      continue;
    }
    const std::uint8_t* bgr = row;
    for (int x = 0; x < grid.width; ++x, bgr += 3 * grid.step) {
      const int half = std::clamp((int(bgr[0]) - int(bgr[2]) - threshold) / 2, -128, 127);
      signal[x] = std::int8_t(half);
      sides[x] = half > 0;
    }
  }
}

void Crossings::add(const FrameView& frame, const ColourClasses& colours, const Rectifier& rectifier,
                    const Claims& claims, const Grid& grid, int x, int y, bool along_row,
                    std::vector<EdgePoint>& points) {
  // Sums over four cells along the way and three across it: 16 times the signal's slope.
  const std::ptrdiff_t along = along_row ? 1 : grid.width, across = along_row ? grid.width : 1;
  const std::int8_t* s = &signal_[std::size_t(y) * std::size_t(grid.width) + std::size_t(x)];
  int slope = 0, side_slope = 0;
  for (int i = -1; i <= 1; ++i) {
    const std::int8_t* line = s + i * across;
    slope += (2 - std::abs(i)) * (line[along] + line[0] - line[-along] - line[-2 * along]);
  }
  if (std::abs(slope) < kLeastGradient) return;
  for (int i = -2; i <= 1; ++i) side_slope += 2 * (s[i * along + across] - s[i * along - across]);
  if (along_row ? std::abs(side_slope) > std::abs(slope) : std::abs(side_slope) >= std::abs(slope)) return;
  const double before = s[-along], after = s[0];
  const double part = before == after ? 0.5 : std::clamp(before / (before - after), 0.0, 1.0) - 1.0;
  const double size = std::hypot(double(slope), double(side_slope));
  const Vector2 way =
      along_row ? Vector2(slope / size, side_slope / size) : Vector2(side_slope / size, slope / size);
  const Vector2 cell = along_row ? Vector2(x + part, y) : Vector2(x, y + part);
  const Vector2 pixel = grid.step * cell;
  if (claims.taken(pixel.x(), pixel.y())) return;
  const double reach = kSideDistance * grid.step;
  const Vector2 red = pixel - reach * way, blue = pixel + reach * way;
  const auto class_at = [&](const Vector2& place) {
    const int px = int(std::lround(place.x())), py = int(std::lround(place.y()));
    if (px < 0 || py < 0 || px >= frame.width || py >= frame.height) return ColourClass::Other;
    return colours.of(frame.row(py) + 3 * px);
  };
  if (class_at(red) != ColourClass::Red || class_at(blue) != ColourClass::Blue) return;
  // The normal on the table is square to the edge there; the edge is what is taken over.
  const Vector2 ahead = rectifier.to_table(pixel.x() - 2 * way.y(), pixel.y() + 2 * way.x());
  const Vector2 behind = rectifier.to_table(pixel.x() + 2 * way.y(), pixel.y() - 2 * way.x());
  EdgePoint point;
  point.place = rectifier.to_table(pixel.x(), pixel.y());
  const Vector2 edge = ahead - behind;
  const double length = edge.norm();
  if (!(length > 0 && length < 1e6) || !rectifier.near_table(point.place)) return;
  point.normal = Vector2(edge.y(), -edge.x()) / length;
  const Vector2 inside = rectifier.to_table(pixel.x() + way.x(), pixel.y() + way.y()) - point.place;
  if (inside.dot(point.normal) < 0) point.normal = -point.normal;
  const double angle = std::atan2(point.normal.y(), point.normal.x());
  point.angle = angle < 0 ? angle + 2 * std::numbers::pi : angle;
  points.push_back(point);
}

void Crossings::find(const FrameView& frame, const ColourClasses& colours, const Rectifier& rectifier,
                     const Claims& claims, std::vector<EdgePoint>& points) {
  points.clear();
  Grid grid;
  grid.step = (std::max(frame.width, frame.height) + kFullSide - 1) / kFullSide;
  grid.step = std::max(grid.step, 1);
  grid.width = (frame.width + grid.step - 1) / grid.step;
  grid.height = (frame.height + grid.step - 1) / grid.step;
  if (grid.width < 8 || grid.height < 8) return;
  fill_planes(frame, grid, colours.threshold());
  for (int y = 2; y < grid.height - 2; ++y) {
    const std::uint8_t* row = &sides_[std::size_t(y) * std::size_t(grid.width)];
    const std::uint8_t* above = row - grid.width;
    for (int first = 2; first < grid.width - 2; first += 8) {
      // The last eight are looked at where they end with the row; what was seen already is left out.
      const int x = std::min(first, grid.width - 10 > 2 ? grid.width - 10 : 2);
      if (x + 8 > grid.width) break;
      const std::uint64_t own = eight_at(row + x);
      const std::uint64_t by_row = own ^ eight_at(row + x - 1), by_column = own ^ eight_at(above + x);
      if ((by_row | by_column) == 0) continue;
      for (int i = std::max(first - x, 0); i < 8 && x + i < grid.width - 2; ++i) {
        if (by_row >> (8 * i) & 1) add(frame, colours, rectifier, claims, grid, x + i, y, true, points);
        if (by_column >> (8 * i) & 1) add(frame, colours, rectifier, claims, grid, x + i, y, false, points);
      }
    }
  }
  if (points.size() <= kMost) return;
  const std::size_t every = (points.size() + kMost - 1) / kMost;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); i += every) points[kept++] = points[i];
  points.resize(kept);
}

}  // namespace icome::cutout
