#include "geometry/csg/csg_solid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/csg/csg_faces.h"

namespace icome::geometry {

CsgSolid::CsgSolid(const CsgTree& tree) : faces_(std::make_unique<const CsgFaces>(tree, 0.0)) {}
CsgSolid::~CsgSolid() = default;

Bounds CsgSolid::bounds() const { return faces_->program().bounds(); }

void CsgSolid::near(const Vector3& a, const Vector3& b, double reach, double /*time*/,
                    PieceVisitor visit) const {
  faces_->near(a, b, reach, visit);
}

bool CsgSolid::inside(const Vector3& point, double /*time*/) const { return program().inside(point); }

std::optional<SurfaceHit> CsgSolid::first_hit(std::uint32_t piece, const Vector3& start, const Vector3& step,
                                              bool from_behind, double /*time*/, double slack) const {
  return faces_->first_hit(piece, start, step, from_behind, slack);
}

SurfacePlace CsgSolid::nearest_local(const SurfacePlace& from, const Vector3& goal, double /*time*/) const {
  return faces_->nearest_local(from, goal);
}

bool CsgSolid::covers(const SurfacePlace& place, const Vector3& /*above*/, double /*time*/,
                      double slack) const {
  return faces_->covers(place, slack);
}

std::optional<SurfacePlace> CsgSolid::way_out(const Vector3& point, double time) const {
  if (!inside(point, time)) return std::nullopt;
  const double slack = 1e-12 * point.cwiseAbs().maxCoeff();
  std::optional<SurfacePlace> best;
  // The nearest place of a solid's surface, seen from within, lies on a face.
  faces_->tree().nearest(point, std::numeric_limits<double>::infinity(), [&](std::uint32_t face) {
    const double limit = best ? (best->point - point).squaredNorm() : std::numeric_limits<double>::infinity();
    const SurfacePlace place = faces_->nearest(face, point);
    const double squared = (place.point - point).squaredNorm();
    if (squared >= limit || !faces_->covers(place, slack)) return limit;
    best = place;
    return squared;
  });
  return best ? best : straight_out(point);
}

/// The nearest way out along some straight lines.
std::optional<SurfacePlace> CsgSolid::straight_out(const Vector3& point) const {
  const Bounds box = bounds();
  const double far = 2.0 * (box.min().allFinite() && box.max().allFinite() ? box.sizes().norm() : 1.0);
  std::optional<SurfacePlace> best;
  for (int i = 0; i < 27; ++i) {
    const Vector3 direction(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (direction.isZero(0.0)) continue;
    const Vector3 step = direction.normalized() * far;
    near(point, point + step, 0.0, 0.0, [&](std::uint32_t face, const Bounds&) {
      const auto exit = first_hit(face, point, step, true, 0.0, 0.0);
      if (exit && (!best || (exit->place.point - point).norm() < (best->point - point).norm()))
        best = exit->place;
      return true;
    });
  }
  return best;
}

std::optional<SurfacePoint> CsgSolid::crossing(const Vector3& a, const Vector3& b) const {
  std::optional<SurfaceHit> first;
  const Vector3 step = b - a;
  const double slack = 1e-12 * std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
  near(a, b, slack, 0.0, [&](std::uint32_t face, const Bounds&) {
    for (const bool from_behind : {false, true}) {
      const auto there = first_hit(face, a, step, from_behind, 0.0, slack);
      if (there && (!first || there->t < first->t)) first = there;
    }
    return true;
  });
  if (!first) return std::nullopt;
  return SurfacePoint{first->place.point, first->place.normal};
}

const CsgProgram& CsgSolid::program() const { return faces_->program(); }

std::size_t CsgSolid::bytes() const { return sizeof(*this) + faces_->bytes(); }

}  // namespace icome::geometry
