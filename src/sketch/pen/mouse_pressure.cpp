#include "sketch/pen/mouse_pressure.h"

#include <algorithm>
#include <cmath>

namespace icome::sketch {
namespace {

constexpr double kFastHand = 0.35;       // m/s, from which on the line is as thin as it becomes
constexpr double kSlowPressure = 0.85;   // of a hand that nearly rests
constexpr double kFastPressure = 0.15;   // of a fast one
constexpr double kPressureDelay = 0.07;  // s, in which it follows by 63 %

}  // namespace

double MousePressure::at(double time, const base::Vector2& place) {
  if (before_ && time > before_->time) {
    const double passed = time - before_->time;
    const double speed = (place - before_->place).norm() / passed;
    const double wanted = kSlowPressure + (kFastPressure - kSlowPressure) * std::min(1.0, speed / kFastHand);
    pressure_ += (wanted - pressure_) * (1.0 - std::exp(-passed / kPressureDelay));
  }
  if (!before_ || time > before_->time) before_ = Before{time, place};
  return pressure_;
}

}  // namespace icome::sketch
