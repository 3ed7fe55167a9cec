#include "devices/evdev/rumble_pacer.h"

#include <algorithm>
#include <cmath>

namespace icome::devices {
namespace {

constexpr double kLeastChange = 1.0 / 64.0;  // of strength, the least that can be felt

}  // namespace

std::optional<double> RumblePacer::next(double wanted, std::int64_t now) {
  const double strength = std::isfinite(wanted) ? std::clamp(wanted, 0.0, 1.0) : 0.0;
  if (any_ && now - time_ < kShortest) return std::nullopt;
  const bool ends = strength == 0.0 && told_ > 0.0;
  const bool changes = std::abs(strength - told_) >= kLeastChange;
  const bool lasts = told_ > 0.0 && now - time_ >= kAgain;
  if (!ends && !changes && !lasts) return std::nullopt;
  told_ = strength;
  time_ = now;
  any_ = true;
  return strength;
}

}  // namespace icome::devices
