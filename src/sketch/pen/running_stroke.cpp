#include "sketch/pen/running_stroke.h"

#include <algorithm>

#include "sketch/fit/width_fit.h"

namespace icome::sketch {
namespace {

constexpr double kLately = 0.03;         // s, over which the pen's speed is taken
constexpr double kFarthestAhead = 0.01;  // m: a jerk must not throw the line across the paper

}  // namespace

RunningStroke::RunningStroke(const PenSample& first, const FitSettings& settings)
    : settings_(settings), fit_(Vector2::Zero()), samples_{first}, along_{0.0} {}

void RunningStroke::add(const PenSample& sample) {
  fit_.add((sample.place - samples_.front().place) / settings_.error);
  samples_.push_back(sample);
  along_.push_back(fit_.current().to);
}

Vector2 RunningStroke::predicted(double ahead) const {
  const PenSample& last = samples_.back();
  const PenSample* since = &last;
  for (auto it = samples_.rbegin(); it != samples_.rend() && last.time - it->time <= kLately; ++it)
    since = &*it;
  const double passed = last.time - since->time;
  if (!(passed > 0.0)) return last.place;
  const Vector2 way = (last.place - since->place) * (ahead / passed);
  const double length = way.norm();
  return length > kFarthestAhead ? Vector2(last.place + way * (kFarthestAhead / length))
                                 : Vector2(last.place + way);
}

double RunningStroke::width_at(double along) const {
  const auto after = std::upper_bound(along_.begin(), along_.end(), along);
  const auto width = [&](std::size_t i) { return settings_.tip.width(samples_[i].pressure); };
  if (after == along_.end()) return width(along_.size() - 1);
  const auto i = std::size_t(after - along_.begin());  // not 0: the first sample is at 0
  const double share = (along - along_[i - 1]) / (along_[i] - along_[i - 1]);
  return width(i - 1) + share * (width(i) - width(i - 1));
}

Curve RunningStroke::with_width(const RunningFit::Finished& part) const {
  Curve curve;
  CubicBezier segment = part.curve;
  for (Vector2& point : segment.points) point = samples_.front().place + settings_.error * point;
  curve.segments.push_back(segment);
  const double length = part.to - part.from;
  if (!(length > 0.0)) {
    const double width = width_at(part.to);
    curve.widths.push_back({0.0, width, 1.0, width});
    return curve;
  }
  WidthFit widths(settings_.width_error);
  widths.add(0.0, width_at(part.from));
  for (auto it = std::upper_bound(along_.begin(), along_.end(), part.from);
       it != along_.end() && *it < part.to; ++it)
    widths.add((*it - part.from) / length, width_at(*it));
  widths.add(1.0, width_at(part.to));
  curve.widths = widths.widths(1.0);
  return curve;
}

}  // namespace icome::sketch
