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

SurfacePoint crossing_of(const ImplicitSurface& surface, double time, const Vector3& a, const Vector3& b) {
  const bool a_inside = surface.inside(a, time);
  const Vector3& in = a_inside ? a : b;
  const Vector3& out = a_inside ? b : a;
  const Vector3 step = out - in;
  double first = 0.0, last = 1.0;
  // Halving needs no gradient, which formulas lack in places, and ends at neighbouring numbers.
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (first + last);
    if (middle <= first || middle >= last) break;
    (surface.inside(in + middle * step, time) ? first : last) = middle;
  }
  const Vector3 point = in + first * step;
  constexpr double kRounding = 1e-14;
  if (const auto side = side_between(surface.box(), in, out, first - kRounding, last + kRounding)) {
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
