#include <cmath>
#include <limits>

#include "base/random.h"
#include "geometry/implicit/implicit_surface.h"

namespace icome::geometry {
namespace {

/// The side of the box through which the way from `in` to `out` leaves it within [first, last]; nothing if
/// it does not.
std::optional<Vector3> side_between(const Bounds& box, const Vector3& in, const Vector3& out, double first,
                                    double last) {
  for (int axis = 0; axis < 3; ++axis) {
    const double step = out[axis] - in[axis];
    if (step == 0.0) continue;
    const double level = (step > 0.0 ? box.max() : box.min())[axis];
    const double s = (level - in[axis]) / step;
    if (s < first || s > last) continue;
    Vector3 normal = Vector3::Zero();
    normal[axis] = step > 0.0 ? 1.0 : -1.0;
    return normal;
  }
  return std::nullopt;
}

/// Narrows a stretch of a way from `inside` to `outside`, as shares of it, down to rounding: `f` is < 0 at
/// its begin only. Interpolates where that is quick and halves where it is not (the ITP method, Oliveira and
/// Takahashi 2020), so that it needs no gradient, which formulas lack in places.
template <typename Function>
double end_of_inside(const Function& f) {
  constexpr double kRounding = 1e-15;
  constexpr int kMostHalvings = 51;  // bring 1 below kRounding, with one to spare
  double first = 0.0, last = 1.0, below = f(first), above = f(last);
  for (int i = 0; last - first > kRounding; ++i) {
    const double width = last - first, middle = first + 0.5 * width;
    double next = (above * first - below * last) / (above - below);
    const double shift = 0.2 * width * width;
    next = std::abs(next - middle) > shift ? next + std::copysign(shift, middle - next) : middle;
    // As far from the middle as leaves enough halvings to the end.
    const double spare = std::max(0.5 * kRounding * std::exp2(kMostHalvings - i) - 0.5 * width, 0.0);
    if (!(std::abs(next - middle) <= spare) || next <= first || next >= last) next = middle;
    if (next <= first || next >= last) break;
    const double value = f(next);
    (value < 0.0 ? first : last) = next;
    (value < 0.0 ? below : above) = value;
  }
  return first;
}

SurfacePoint crossing_of(const ImplicitSurface& surface, double time, const Vector3& a, const Vector3& b) {
  const bool a_inside = surface.inside(a, time);
  const Vector3& in = a_inside ? a : b;
  const Vector3& out = a_inside ? b : a;
  const Vector3 step = out - in;
  // Beyond the box nothing is inside.
  const double first = end_of_inside([&](double share) {
    const Vector3 point = in + share * step;
    return surface.box().contains(point) ? surface.value_at(point, time)
                                         : std::numeric_limits<double>::infinity();
  });
  const Vector3 point = in + first * step;
  constexpr double kRounding = 1e-14;
  if (const auto side = side_between(surface.box(), in, out, first - kRounding, first + 2.0 * kRounding)) {
    return {point, *side};
  }
  const Vector3 gradient = surface.value(point, time).gradient;
  const bool usable = gradient.allFinite() && gradient.squaredNorm() > 0.0;
  return {point, usable ? gradient.normalized() : step.stableNormalized()};
}

}  // namespace

bool shows_solid(const ImplicitSurface& surface, double time) {
  constexpr int kMostSolidLooks = 4096;
  const Bounds box = surface.bounds();
  base::Random random(1);
  for (int i = 0; i < kMostSolidLooks; ++i) {
    const Vector3 share(random.uniform(0.0, 1.0), random.uniform(0.0, 1.0), random.uniform(0.0, 1.0));
    if (surface.inside(box.min() + share.cwiseProduct(box.sizes()), time)) return true;
  }
  return false;
}

SampledSolid sampled(const ImplicitSurface& surface, double time) {
  return {surface.bounds(), [&surface, time](const Vector3& point) { return surface.inside(point, time); },
          [&surface, time](const Vector3& a, const Vector3& b) { return crossing_of(surface, time, a, b); }};
}

}  // namespace icome::geometry
