#include "animation/motion/one_euro.h"

#include "animation/motion/cell_point.h"

namespace icome::animation {

double SteadyAngle::next(double angle, double time) {
  last_ = last_ ? unwrapped(angle, *last_) : angle;
  return filter_.next({*last_, 0}, time).x();
}

void SteadyAngle::forget() {
  last_.reset();
  filter_.forget();
}

}  // namespace icome::animation
