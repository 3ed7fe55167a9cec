#include "animation/motion/one_euro.h"

#include <cmath>

#include "animation/motion/cell_point.h"

namespace icome::animation {
namespace {

/// The share of a new sample `gap` s after the last one in a low-pass filter, by its cutoff, Hz.
double share_of(double cutoff, double gap) {
  const double turn = 2 * M_PI * cutoff * gap;
  return turn / (turn + 1);
}

}  // namespace

Vector2 SteadyPlace::next(const Vector2& place, double time) {
  const double gap = last_ ? time - last_->time : 0;
  if (!last_ || gap > settings_.longest_gap) {
    speed_ = Vector2::Zero();
    steady_ = place;
    last_ = Sample{time, place};
    return place;
  }
  if (gap <= 0) return steady_;
  const Vector2 speed = (place - last_->place) / gap;
  speed_ += share_of(settings_.speed_cutoff, gap) * (speed - speed_);
  const double cutoff = settings_.least_cutoff + settings_.speed_gain * speed_.norm();
  steady_ += share_of(cutoff, gap) * (place - steady_);
  last_ = Sample{time, place};
  return steady_;
}

double SteadyAngle::next(double angle, double time) {
  last_ = last_ ? unwrapped(angle, *last_) : angle;
  return filter_.next({*last_, 0}, time).x();
}

void SteadyAngle::forget() {
  last_.reset();
  filter_.forget();
}

}  // namespace icome::animation
