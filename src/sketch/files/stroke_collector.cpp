#include "sketch/files/stroke_collector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace icome::sketch {
namespace {

constexpr std::size_t kMostPenSamples = 20'000'000;
constexpr double kFarthestPen = 1e3;  // m from the corner of the paper
constexpr double kLatestPen = 1e15;   // s

}  // namespace

base::Result<void> StrokeCollector::add(const PenSample& sample) {
  if (!(std::abs(sample.time) <= kLatestPen))
    return base::fail(fmt::format("the time {:g} s is none that a pen can have", sample.time));
  if (!(sample.place.cwiseAbs().maxCoeff() <= kFarthestPen))
    return base::fail(fmt::format(
        "a pen is at most {:g} mm from the corner of its paper, not at {:g},{:g} mm",
        kFarthestPen / kMetresOfMm, sample.place.x() / kMetresOfMm, sample.place.y() / kMetresOfMm));
  if (!(sample.pressure >= 0.0) || !std::isfinite(sample.pressure))
    return base::fail(fmt::format("the pressure {:g} is not 0 or more", sample.pressure));
  if (samples_ >= kMostPenSamples)
    return base::fail(fmt::format("more than {} samples; cut the recording into parts", kMostPenSamples));
  if (!is_down_) read_.strokes.emplace_back();
  is_down_ = true;
  PenStroke& stroke = read_.strokes.back();
  if (!stroke.empty() && sample.time < stroke.back().time)
    return base::fail(
        fmt::format("time goes back within a stroke, from {} s to {} s", stroke.back().time, sample.time));
  greatest_pressure_ = std::max(greatest_pressure_, sample.pressure);
  pressed_samples_ += sample.pressure > 0.0 ? 1 : 0;
  stroke.push_back(sample);
  ++samples_;
  return {};
}

void StrokeCollector::scale_pressure(double full_pressure) {
  if (2 * pressed_samples_ < samples_) {
    read_.has_pressure = false;
    for (PenStroke& stroke : read_.strokes)
      for (PenSample& sample : stroke) sample.pressure = 1.0;
    return note("there is no pressure in most of it: every sample has 1");
  }
  double full = full_pressure;
  if (full == 0.0) {
    full = std::max(1.0, greatest_pressure_);
    if (full > 1.0) note(fmt::format("the greatest pressure, {:g}, is taken as 1", full));
  } else if (greatest_pressure_ > full) {
    note(fmt::format("pressures up to {:g} are above {:g}, the greatest that it names: taken as 1",
                     greatest_pressure_, full));
  }
  if (full == 1.0 && greatest_pressure_ <= 1.0) return;
  for (PenStroke& stroke : read_.strokes)
    for (PenSample& sample : stroke) sample.pressure = std::min(1.0, sample.pressure / full);
}

base::Result<StrokesRead> StrokeCollector::finish(double full_pressure) {
  if (read_.strokes.empty())
    return base::fail(name_ + ": there is no stroke in it: the pen never touches the paper");
  scale_pressure(full_pressure);
  return std::move(read_);
}

}  // namespace icome::sketch
