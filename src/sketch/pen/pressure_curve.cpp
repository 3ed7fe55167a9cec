#include "sketch/pen/pressure_curve.h"

#include <algorithm>
#include <cmath>

namespace icome::sketch {
namespace {

constexpr double kSteepest = 0.02;  // how near the middle may come to its neighbours, as a share between them

}  // namespace

double PressureCurve::operator()(double pressure) const {
  const double span = hardest - lightest;
  const double at = std::clamp(pressure, 0.0, 1.0);
  if (!(span > 0.0)) return lightest;
  // The power that takes a half to the middle: smooth, and it never goes back.
  const double share = std::clamp((middle - lightest) / span, kSteepest, 1.0 - kSteepest);
  return lightest + span * std::pow(at, std::log(share) / std::log(0.5));
}

}  // namespace icome::sketch
