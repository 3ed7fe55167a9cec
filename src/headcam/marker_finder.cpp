#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "base/parse_number.h"
#include "headcam/head_finder.h"

namespace icome::headcam {
namespace {

using base::Vector2;
using base::Vector3;

constexpr std::pair<std::string_view, MarkerColour> kColourNames[] = {
    {"red", {220, 20, 20}},  {"orange", {250, 120, 0}}, {"yellow", {240, 220, 0}},  {"green", {20, 180, 40}},
    {"cyan", {0, 190, 210}}, {"blue", {20, 60, 220}},   {"magenta", {220, 20, 160}}};

constexpr double kLeastLight = 60.0;   // sum of the channels: darker pixels have no colour to speak of
constexpr double kLeastArea = 12.0;    // pixels, of a marker
constexpr double kLeastChroma = 0.12;  // of the marker's colour
constexpr double kLikeness = 0.5;      // along the marker's chroma, of it
constexpr double kUnlikeness = 0.35;   // across it

/// The colour without its brightness: shares of the channels, less those of grey.
Vector3 chroma(double red, double green, double blue) {
  const double sum = red + green + blue;
  return sum > 0.0 ? Vector3(Vector3(red, green, blue) / sum - Vector3::Constant(1.0 / 3.0))
                   : Vector3::Zero();
}

/// Pixels beside each other in a row, and what all that they touch has in sum.
struct Run {
  int begin, end;  // pixels
  std::size_t spot;
};

/// Pixels that touch.
struct Spot {
  std::size_t root;
  double area = 0.0;
  Vector2 sum = Vector2::Zero();  // of the places
};

class MarkerFinder final : public HeadFinder {
 public:
  explicit MarkerFinder(const MarkerColour& colour) : marker_(chroma(colour[0], colour[1], colour[2])) {
    length_ = marker_.norm();
    marker_ /= length_;
  }

  std::optional<HeadInPicture> find(const cutout::FrameView& frame) override {
    spots_.clear();
    above_.clear();
    for (int y = 0; y < frame.height; ++y) {
      take_row(frame, y);
      std::swap(above_, runs_);
    }
    const Spot* largest = nullptr;
    for (const Spot& it : spots_)
      if (it.area >= kLeastArea && (largest == nullptr || it.area > largest->area)) largest = &it;
    if (largest == nullptr) return std::nullopt;
    return HeadInPicture{largest->sum / largest->area, 2.0 * std::sqrt(largest->area / std::numbers::pi)};
  }

 private:
  bool is_marker(const std::uint8_t* bgr) const {
    if (bgr[0] + bgr[1] + bgr[2] < kLeastLight) return false;
    const Vector3 here = chroma(bgr[2], bgr[1], bgr[0]);
    const double along = here.dot(marker_);
    return along > kLikeness * length_ && (here - along * marker_).norm() < kUnlikeness * along;
  }

  std::size_t root(std::size_t spot) {
    while (spots_[spot].root != spot) spot = spots_[spot].root = spots_[spots_[spot].root].root;
    return spot;
  }

  void join(std::size_t one, std::size_t other) {
    one = root(one);
    other = root(other);
    if (one == other) return;
    spots_[one].area += spots_[other].area;
    spots_[one].sum += spots_[other].sum;
    spots_[other] = {one};
  }

  void take_row(const cutout::FrameView& frame, int y) {
    runs_.clear();
    const std::uint8_t* const row = frame.row(y);
    std::size_t above = 0;
    for (int x = 0; x < frame.width; ++x) {
      if (!is_marker(row + 3 * std::ptrdiff_t(x))) continue;
      const int begin = x;
      while (x < frame.width && is_marker(row + 3 * std::ptrdiff_t(x))) ++x;
      const double length = x - begin;
      spots_.push_back({spots_.size(), length, length * Vector2(0.5 * (begin + x), y + 0.5)});
      runs_.push_back({begin, x, spots_.size() - 1});
      while (above < above_.size() && above_[above].end <= begin) ++above;
      for (std::size_t i = above; i < above_.size() && above_[i].begin < x; ++i)
        join(above_[i].spot, spots_.size() - 1);
    }
  }

  Vector3 marker_;  // unit
  double length_;
  std::vector<Spot> spots_;
  std::vector<Run> runs_, above_;  // of a row, and of the one above it
};

}  // namespace

base::Result<MarkerColour> parse_marker_colour(std::string_view text) {
  std::optional<MarkerColour> colour;
  for (const auto& [name, value] : kColourNames)
    if (name == text) colour = value;
  if (text.size() == 7 && text.front() == '#') {
    const auto number = base::parse_number<unsigned>(text.substr(1), 16);
    if (number) colour = {int(*number >> 16U & 255U), int(*number >> 8U & 255U), int(*number & 255U)};
  }
  if (!colour)
    return base::fail(fmt::format(
        "\"{}\" is no colour: give #rrggbb, red, orange, yellow, green, cyan, blue or magenta", text));
  if (chroma((*colour)[0], (*colour)[1], (*colour)[2]).norm() < kLeastChroma)
    return base::fail(fmt::format("{} is nearly grey: a marker needs a strong colour", text));
  return *colour;
}

std::unique_ptr<HeadFinder> marker_finder(const MarkerColour& colour) {
  return std::make_unique<MarkerFinder>(colour);
}

}  // namespace icome::headcam
