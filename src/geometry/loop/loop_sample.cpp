#include "geometry/loop/loop_sample.h"

#include <algorithm>
#include <cmath>

namespace icome::geometry {
namespace {

LoopPoint point_of(const QuarticJet& jet, const LoopCell& cell) {
  LoopPoint point;
  point.point = cell.origin + vector3(jet.value);
  point.du = cell.scale * vector3(jet.ds);
  point.dv = cell.scale * vector3(jet.dt);
  point.normal = vector3(jet.ds).cross(vector3(jet.dt)).stableNormalized();
  return point;
}

// The normal where the derivatives are parallel (or vanish): by a place further inside, or the whole piece.
Vector3 normal_nearby(LoopCursor& cursor, const LoopPatches& patches, std::uint32_t piece, double u,
                      double v) {
  for (double share = 0x1p-20; share < 0.6; share *= 4.0) {
    const double third = 1.0 / 3.0;
    if (!cursor.go(piece, u + share * (third - u), v + share * (third - v))) continue;
    const QuarticJet jet = evaluate(cursor.cell().shape, cursor.s(), cursor.t());
    const Vector3 normal = vector3(jet.ds).cross(vector3(jet.dt));
    const double length = normal.norm();
    if (length > 1e-9 * jet.ds.norm() * jet.dt.norm() && length > 0.0) return normal / length;
  }
  const auto& axis = patches.slab(piece).axis;
  return Vector3(axis[0], axis[1], axis[2]).normalized();
}

// Directions along both edges, taken where rounding and curvature disturb least.
void set_apex_derivatives(LoopCursor& cursor, std::uint32_t piece, LoopPoint& point) {
  const int level = cursor.fan().levels / 2;
  const double near = std::ldexp(1.0, -level);
  const double unit = cursor.fan().reach(0) / std::max(cursor.fan().reach(level), 1e-300) * near;
  if (cursor.go(piece, near, 0.0)) {
    const QuarticJet jet = evaluate(cursor.cell().shape, cursor.s(), cursor.t());
    point.du = unit * cursor.cell().scale * vector3(jet.ds);
  }
  if (cursor.go(piece, 0.0, near)) {
    const QuarticJet jet = evaluate(cursor.cell().shape, cursor.s(), cursor.t());
    point.dv = unit * cursor.cell().scale * vector3(jet.dt);
  }
  if (const FanTable* table = cursor.fan().table; table && table->type.rule == FanRule::Smooth) {
    const auto& tangents = table->masks.tangents;
    std::array<Vector3, 2> sums = {Vector3::Zero(), Vector3::Zero()};
    for (int k = 0; k < 2; ++k) {
      for (std::size_t i = 1; i < tangents[k].size(); ++i) {
        sums[k] += tangents[k][i] * vector3(cursor.fan().points[i]);
      }
    }
    const double share = 2.0 / table->type.faces;  // as long as the true one among six
    point.du = share * sums[0];
    point.dv = share * (tangents[0][2] * sums[0] + tangents[1][2] * sums[1]);
  }
}

}  // namespace

LoopPoint loop_point(LoopCursor& cursor, const LoopPatches& patches, std::uint32_t piece, double u,
                     double v) {
  LoopPoint point;
  if (cursor.go(piece, u, v)) {
    point = point_of(evaluate(cursor.cell().shape, cursor.s(), cursor.t()), cursor.cell());
  } else {
    point.point = cursor.fan().apex;
    point.normal = cursor.fan().normal;
    point.du.setZero();
    point.dv.setZero();
    set_apex_derivatives(cursor, piece, point);
  }
  if (!(point.normal.squaredNorm() > 0.5)) point.normal = normal_nearby(cursor, patches, piece, u, v);
  return point;
}

LoopPlace place_of(std::uint32_t slot, double u, double v) {
  const double a = 1.0 - u - v;
  if (a >= 0.5) return {4 * slot, 2.0 * u, 2.0 * v, {{{2.0, 0.0}, {0.0, 2.0}}}};
  if (u >= 0.5) return {4 * slot + 1, 2.0 * v, std::max(0.0, 2.0 * a), {{{0.0, 2.0}, {-2.0, -2.0}}}};
  if (v >= 0.5) return {4 * slot + 2, std::max(0.0, 2.0 * a), 2.0 * u, {{{-2.0, -2.0}, {2.0, 0.0}}}};
  return {4 * slot + 3, 1.0 - 2.0 * u, 1.0 - 2.0 * v, {{{-2.0, 0.0}, {0.0, -2.0}}}};
}

}  // namespace icome::geometry
