#include "cutout/calibration/frame_quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace icome::cutout {
namespace {

constexpr int kEdgeDirections = 8;
constexpr int kEdgeReach = 12;         // pixels along a gradient
constexpr double kLeastContrast = 60;  // of red minus blue, 0 to 255
constexpr std::size_t kFewestEdges = 12;
constexpr std::size_t kMostLooked = 2'000'000;  // pixels

/// Red minus blue, which changes where a triangle ends.
class RedLessBlue {
 public:
  explicit RedLessBlue(const FrameView& frame) : frame_(frame) {}
  double at(int x, int y) const {
    const std::uint8_t* const bgr = frame_.row(y) + 3 * x;
    return double(bgr[2]) - double(bgr[0]);
  }
  double smooth(int x, int y) const {
    return 0.25 * at(x, y) + 0.1875 * (at(x - 1, y) + at(x + 1, y) + at(x, y - 1) + at(x, y + 1));
  }

 private:
  const FrameView& frame_;
};

/// Width of the edge at a pixel across its gradient, and its direction; 0 where there is none.
double edge_width(const RedLessBlue& picture, const FrameView& frame, int x, int y, int& direction) {
  const double across = (picture.at(x + 1, y) - picture.at(x - 1, y)) / 2;
  const double down = (picture.at(x, y + 1) - picture.at(x, y - 1)) / 2;
  const double steep = std::hypot(across, down);
  if (steep < 4) return 0;
  const double ux = across / steep, uy = down / steep;
  double least = 1e9, most = -1e9, steepest = 0, before = 0;
  for (int i = -kEdgeReach; i <= kEdgeReach; ++i) {
    const int column = int(std::lround(x + i * ux)), row = int(std::lround(y + i * uy));
    if (column < 1 || row < 1 || column > frame.width - 2 || row > frame.height - 2) return 0;
    const double value = picture.smooth(column, row);
    least = std::min(least, value);
    most = std::max(most, value);
    if (i > -kEdgeReach) {
      const double step = std::abs(value - before);
      if (step > steepest) steepest = step;
    }
    before = value;
  }
  if (most - least < kLeastContrast) return 0;
  const double middle = 0.5 * (least + most);
  if (std::abs(picture.smooth(x, y) - middle) > 0.15 * (most - least)) return 0;
  double angle = std::atan2(uy, ux);
  if (angle < 0) angle += std::numbers::pi;
  direction = int(std::lround(angle / std::numbers::pi * kEdgeDirections)) % kEdgeDirections;
  return (most - least) / std::max(1.0, steepest);
}

void measure_edges(const FrameView& frame, FrameQuality& quality) {
  if (frame.width < 2 * kEdgeReach || frame.height < 2 * kEdgeReach) return;
  const RedLessBlue picture(frame);
  std::array<std::vector<double>, kEdgeDirections> widths;
  const int step = std::max(1, int(std::sqrt(double(frame.width) * frame.height / double(kMostLooked))));
  for (int y = kEdgeReach; y < frame.height - kEdgeReach; y += step)
    for (int x = kEdgeReach; x < frame.width - kEdgeReach; x += step) {
      int direction = 0;
      const double width = edge_width(picture, frame, x, y, direction);
      if (width > 0) widths[std::size_t(direction)].push_back(width);
    }
  for (std::vector<double>& seen : widths) {
    if (seen.size() < kFewestEdges) continue;
    std::ranges::nth_element(seen, seen.begin() + std::ptrdiff_t(seen.size() / 2));
    const double median = seen[seen.size() / 2];
    quality.sharpest = quality.directions == 0 ? median : std::min(quality.sharpest, median);
    quality.most_blurred = std::max(quality.most_blurred, median);
    ++quality.directions;
  }
}

}  // namespace

FrameQuality quality_of(const FrameView& frame) {
  FrameQuality quality;
  std::array<std::size_t, 256> brightness{};
  std::size_t all = 0, saturated = 0, red = 0, blue = 0;
  const int step = std::max(1, int(std::sqrt(double(frame.width) * frame.height / 300'000.0)));
  for (int y = 0; y < frame.height; y += step)
    for (int x = 0; x < frame.width; x += step) {
      const std::uint8_t* const bgr = frame.row(y) + 3 * x;
      const int b = bgr[0], g = bgr[1], r = bgr[2];
      ++brightness[std::size_t(std::max({b, g, r}))];
      ++all;
      if (r >= 253) ++saturated;
      if (r > 1.7 * std::max(g, b) + 6) ++red;
      if (b > 1.5 * r + 6) ++blue;
    }
  if (all == 0) return quality;
  const auto level = [&](double share) {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < brightness.size(); ++i) {
      sum += brightness[i];
      if (double(sum) >= share * double(all)) return double(i);
    }
    return 255.0;
  };
  quality.median = level(0.5);
  quality.bright = level(0.99);
  quality.saturated = double(saturated) / double(all);
  quality.red = double(red) / double(all);
  quality.blue = double(blue) / double(all);
  measure_edges(frame, quality);
  return quality;
}

std::vector<std::string> complaints_of(const FrameQuality& quality) {
  constexpr double kDark = 70, kSaturated = 0.3, kLeastRed = 0.12, kUnsharp = 4.5, kStreaked = 1.9;
  std::vector<std::string> complaints;
  if (quality.bright < kDark) {
    complaints.push_back(fmt::format(
        "too dark: hardly a pixel is brighter than {:.0f} of 255; give more light or a longer exposure",
        quality.bright));
  } else if (quality.saturated > kSaturated) {
    complaints.push_back(fmt::format(
        "overexposed: red is at its limit in {:.0f} % of the frame; give less light or a shorter exposure",
        100 * quality.saturated));
  }
  if (quality.red < kLeastRed && quality.bright >= kDark)
    complaints.push_back(
        fmt::format("the table is not red: {:.0f} % of the frame are; put red cloth, card or paper "
                    "under the camera, and turn automatic white balance off",
                    100 * quality.red));
  const bool streaked = quality.directions >= 2 && quality.most_blurred > kStreaked * quality.sharpest &&
                        quality.most_blurred > kUnsharp;
  if (streaked) {
    complaints.push_back(
        fmt::format("blurred by motion: edges are {:.1f} pixels wide in one direction and {:.1f} in another; "
                    "shorten the exposure "
                    "and give more light",
                    quality.most_blurred, quality.sharpest));
  } else if (quality.sharpest > kUnsharp) {
    complaints.push_back(fmt::format(
        "out of focus: the sharpest edges are {:.1f} pixels wide; focus on the table, and turn autofocus off",
        quality.sharpest));
  }
  return complaints;
}

}  // namespace icome::cutout
