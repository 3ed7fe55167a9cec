// Boxes and slabs around the pieces of a Loop surface.
#include <algorithm>
#include <cmath>

#include "geometry/loop/loop_builder.h"

namespace icome::geometry {
namespace {

// Rings around an extraordinary vertex that are looked at one by one, before the rest is bounded as a
// whole.
constexpr int kRings = 4;
// The rounding of the arithmetic of surfaces and bounds, relative to the coordinates.
constexpr double kBoundsRounding = 1e-14;

/// The Bernstein points of a piece and the flat pancake at its extraordinary vertex.
struct Hull {
  std::vector<Vector3> points;
  Vector3 apex, normal;
  double reach = 0.0, lift = 0.0;  // reach 0: no pancake

  void add(const LoopCell& cell) {
    for (const Vector4& point : cell.shape.points) points.emplace_back(cell.origin + vector3(point));
  }

  /// The range of axis * (x - origin), `axis` a unit vector.
  std::array<double, 2> range(const Vector3& axis, const Vector3& origin) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vector3& point : points) {
      const double at = axis.dot(point - origin);
      low = std::min(low, at);
      high = std::max(high, at);
    }
    if (reach > 0.0) {
      const double at = axis.dot(apex - origin);
      const double along = std::abs(axis.dot(normal));
      const double room = along * lift + std::sqrt(std::max(0.0, 1.0 - along * along)) * reach;
      low = std::min(low, at - room);
      high = std::max(high, at + room);
    }
    return {low, high};
  }
};

Hull hull_of(const LoopPatches& patches, std::uint32_t piece) {
  Hull hull;
  LoopCell cell;
  if (patches.regular(piece)) {
    patches.load(piece, cell);
    hull.add(cell);
    return hull;
  }
  LoopFanPoints fan;
  patches.load(piece, fan);
  const int rings = std::min(kRings, fan.levels);
  for (int level = 0; level < rings; ++level) {
    for (int part = 0; part < 3; ++part) {
      LoopPatches::load(fan, level, part, cell);
      hull.add(cell);
    }
  }
  hull.apex = fan.apex;
  hull.reach = fan.reach(rings);
  hull.normal = fan.normal;
  hull.lift = fan.normal.isZero(0.0) ? hull.reach : std::min(fan.lift(rings), hull.reach);
  return hull;
}

/// The direction of the piece's mean normal, unit.
Vector3 slab_axis(const LoopPatches& patches, std::uint32_t piece) {
  LoopCursor cursor(patches);
  Vector3 sum = Vector3::Zero();
  constexpr std::array<std::array<double, 2>, 4> kPlaces = {
      {{1.0 / 3.0, 1.0 / 3.0}, {0.05, 0.05}, {0.9, 0.05}, {0.05, 0.9}}};
  for (const auto& [u, v] : kPlaces) {
    if (!cursor.go(piece, u, v)) continue;
    const QuarticJet jet = evaluate(cursor.cell().shape, cursor.s(), cursor.t());
    sum += vector3(jet.ds).cross(vector3(jet.dt)).stableNormalized();
  }
  const Vector3 axis = sum.stableNormalized();
  return axis.allFinite() && !axis.isZero(0.0) ? axis : Vector3::UnitZ();
}

}  // namespace

Bounds LoopPatches::Builder::enclose(std::uint32_t piece, Slab& slab) const {
  const Hull hull = hull_of(result_, piece);
  Bounds box;
  const double rounding =
      kBoundsRounding * (result_.bounds_.min().cwiseAbs().cwiseMax(result_.bounds_.max().cwiseAbs())).norm();
  for (int i = 0; i < 3; ++i) {
    const auto [low, high] = hull.range(Vector3::Unit(i), Vector3::Zero());
    box.min()[i] = low - rounding;
    box.max()[i] = high + rounding;
  }
  const Eigen::Vector3f axis = slab_axis(result_, piece).cast<float>();
  // Single precision keeps the axis and turns it a little, so its range is measured as stored.
  const double length = axis.cast<double>().norm();
  const auto [low, high] = hull.range(axis.cast<double>() / length, result_.centre_);
  slab.axis = {axis.x(), axis.y(), axis.z()};
  slab.lo = detail::below(low * length - rounding);
  slab.hi = detail::above(high * length + rounding);
  return box;
}

base::Result<std::unique_ptr<const LoopPatches>> LoopPatches::create(const ControlMesh& control) {
  auto topology = loop_topology(control);
  if (!topology) return tl::unexpected(topology.error());
  const Bounds box = geometry::bounds(topology->mesh);
  if (!(box.diagonal().norm() > 0.0) || !std::isfinite(box.diagonal().squaredNorm())) {
    return base::fail("the control mesh has no extent, or one beyond all numbers");
  }
  auto refinement = loop_refine(topology->mesh, topology->creases, topology->corners);
  if (!refinement) return tl::unexpected(refinement.error());
  std::unique_ptr<LoopPatches> patches(new LoopPatches());
  Builder(std::move(*topology), std::move(*refinement), *patches).build();
  return std::unique_ptr<const LoopPatches>(std::move(patches));
}

}  // namespace icome::geometry
