#include "geometry/contour/contour_search.h"

#include <cmath>

namespace icome::geometry {
namespace {

/// Answers further beside the segment than this part of its length are wrong.
constexpr double kBeside = 1e-6;
constexpr int kHalvings = 50;
/// The parts of the reach that a quick search tries: most points lie near the surface.
constexpr double kSearchSteps[] = {1.0 / 128, 1.0 / 16, 1.0 / 4, 1.0};
/// A fine search makes its steps four times as long each time, from this part of the reach on.
constexpr double kFineStep = 0x1p-22;

Vector3 crossing_by_halving(const SampledSolid& solid, Vector3 inner, Vector3 outer) {
  for (int i = 0; i < kHalvings; ++i) {
    const Vector3 middle = (inner + outer) / 2;
    (solid.inside(middle) ? inner : outer) = middle;
  }
  return inner;
}

/// The nearer of the crossings between the point and the two that are one `step` from it; nothing if none.
std::optional<SurfacePoint> cross_within(const SampledSolid& solid, const Vector3& point, bool in,
                                         const Vector3& step) {
  std::optional<SurfacePoint> nearest;
  for (const double side : {1.0, -1.0}) {
    const Vector3 end = point + side * step;
    if (solid.inside(end) == in) continue;
    const SurfacePoint found = in ? find_crossing(solid, point, end) : find_crossing(solid, end, point);
    const bool nearer =
        !nearest || (found.point - point).squaredNorm() < (nearest->point - point).squaredNorm();
    if (nearer) nearest = found;
  }
  return nearest;
}

}  // namespace

SurfacePoint find_crossing(const SampledSolid& solid, const Vector3& inner, const Vector3& outer) {
  SurfacePoint found = solid.crossing(inner, outer);
  const Vector3 way = outer - inner;
  const double length = way.norm();
  const double along = way.dot(found.point - inner) / (length * length);
  const double beside = (found.point - inner - along * way).norm();
  if (!(along >= -kBeside && along <= 1 + kBeside && beside <= kBeside * length)) {
    found.point = crossing_by_halving(solid, inner, outer);
  }
  const double norm = found.normal.norm();
  found.normal = norm > 0 && std::isfinite(norm) ? Vector3(found.normal / norm) : Vector3(way / length);
  return found;
}

std::optional<SurfacePoint> search_along(const SampledSolid& solid, const Vector3& point,
                                         const Vector3& direction, double reach) {
  if (!(direction.squaredNorm() > 0)) return std::nullopt;
  const bool in = solid.inside(point);
  for (const double part : kSearchSteps) {
    if (const auto found = cross_within(solid, point, in, part * reach * direction)) return found;
  }
  return std::nullopt;
}

std::optional<SurfacePoint> search_finely_along(const SampledSolid& solid, const Vector3& point,
                                                const Vector3& direction, double reach) {
  if (!(direction.squaredNorm() > 0)) return std::nullopt;
  const bool in = solid.inside(point);
  for (double part = kFineStep; part <= 1.0; part *= 4) {
    if (const auto found = cross_within(solid, point, in, part * reach * direction)) return found;
  }
  return std::nullopt;
}

}  // namespace icome::geometry
