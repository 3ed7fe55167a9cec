#include "tracker_score.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace icome::benchmarks {
namespace {

double ranked(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const std::size_t at = std::min(values.size() - 1, std::size_t(share * double(values.size())));
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(at), values.end());
  return values[at];
}

}  // namespace

TrackerScore::TrackerScore(double symmetry) : symmetry_(symmetry) {}

void TrackerScore::add(std::span<const cutout::Sighting> seen, std::span<const cutout::TrianglePose> truth,
                       const cutout::TableView& view, double milliseconds) {
  milliseconds_.push_back(milliseconds);
  wanted_ += truth.size();
  for (const cutout::Sighting& sighting : seen) {
    const cutout::TrianglePose& pose = truth[sighting.triangle];
    const double pixels = (view.to_pixel(sighting.pose.centroid) - view.to_pixel(pose.centroid)).norm();
    const double turn = std::abs(std::remainder(sighting.pose.angle - pose.angle, symmetry_));
    if (!(pixels <= kMostPixels && turn <= kMostTurn)) {
      ++ghosts_;
      continue;
    }
    ++found_;
    squares_ += pixels * pixels;
    turn_squares_ += turn * turn;
  }
}

double TrackerScore::median_ms() const { return ranked(milliseconds_, 0.5); }
double TrackerScore::p99_ms() const { return ranked(milliseconds_, 0.99); }
double TrackerScore::found_percent() const { return wanted_ ? 100.0 * double(found_) / double(wanted_) : 0; }
double TrackerScore::ghosts_per_thousand() const {
  return milliseconds_.empty() ? 0 : 1000.0 * double(ghosts_) / double(milliseconds_.size());
}
double TrackerScore::rms_pixels() const { return found_ ? std::sqrt(squares_ / double(found_)) : 0; }
double TrackerScore::rms_degrees() const {
  return found_ ? std::sqrt(turn_squares_ / double(found_)) * 180 / std::numbers::pi : 0;
}

void print_score_heading(const std::string& title) {
  fmt::print("-- {}\n{:<26} {:>8} {:>8} {:>8} {:>14} {:>8} {:>8}\n", title, "", "ms", "p99 ms", "found %",
             "ghosts / 1000", "px", "degrees");
}

void print_score(const std::string& tracker, const TrackerScore& score) {
  fmt::print("{:<26} {:>8.2f} {:>8.2f} {:>8.2f} {:>14.1f} {:>8.3f} {:>8.3f}\n", tracker, score.median_ms(),
             score.p99_ms(), score.found_percent(), score.ghosts_per_thousand(), score.rms_pixels(),
             score.rms_degrees());
}

}  // namespace icome::benchmarks
