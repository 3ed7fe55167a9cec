#include "geometry/loop/loop_surface.h"

#include <algorithm>

#include "geometry/loop/loop_contact.h"
#include "geometry/loop/loop_projection.h"

namespace icome::geometry {

LoopSurface::LoopSurface(std::unique_ptr<const LoopPatches> patches) : patches_(std::move(patches)) {}
LoopSurface::~LoopSurface() = default;

base::Result<std::shared_ptr<const LoopSurface>> LoopSurface::create(const ControlMesh& control) {
  auto patches = LoopPatches::create(control);
  if (!patches) return tl::unexpected(patches.error());
  return std::shared_ptr<const LoopSurface>(new LoopSurface(std::move(*patches)));
}

LoopSurface::Sample LoopSurface::sample(std::uint32_t control_triangle, double u, double v) const {
  const LoopSpot spot = clamped({0, u, v});
  const LoopPlace place = place_of(patches_->slot(control_triangle), spot.u, spot.v);
  LoopCursor cursor(*patches_);
  const LoopPoint at = loop_point(cursor, *patches_, place.piece, place.u, place.v);
  const auto& [of_u, of_v] = place.change;
  return {at.point, of_u[0] * at.du + of_v[0] * at.dv, of_u[1] * at.du + of_v[1] * at.dv, at.normal};
}

bool LoopSurface::closed() const { return patches_->closed(); }
Bounds LoopSurface::bounds() const { return patches_->bounds(); }
std::size_t LoopSurface::bytes() const { return sizeof(LoopSurface) + patches_->bytes(); }

base::Result<TriangleMesh> LoopSurface::tessellate(int level) const {
  return loop_tessellate(*patches_, level);
}

void LoopSurface::near(const Vector3& a, const Vector3& b, double reach, double /*time*/,
                       PieceVisitor visit) const {
  patches_->tree().near(SegmentQuery(a, b, reach),
                        [&](std::uint32_t piece) { return visit(piece, loop_box(*patches_, piece)); });
}

bool LoopSurface::inside(const Vector3& point, double /*time*/) const {
  return loop_inside(*patches_, point);
}

std::optional<SurfacePlace> LoopSurface::way_out(const Vector3& point, double /*time*/) const {
  if (!loop_inside(*patches_, point)) return {};
  return loop_nearest(*patches_, point);
}

std::optional<SurfaceHit> LoopSurface::first_hit(std::uint32_t piece, const Vector3& start,
                                                 const Vector3& step, bool from_behind, double /*time*/,
                                                 double slack) const {
  return loop_hit(*patches_, piece, start, step, from_behind, slack);
}

SurfacePlace LoopSurface::nearest_local(const SurfacePlace& from, const Vector3& goal,
                                        double /*time*/) const {
  LoopCursor cursor(*patches_);
  const LoopSpot spot = loop_projection(*patches_, cursor, {from.piece, from.u, from.v}, goal);
  return loop_place(cursor, *patches_, spot);
}

bool LoopSurface::covers(const SurfacePlace& place, const Vector3& above, double /*time*/,
                         double slack) const {
  return loop_covers(*patches_, place, above, slack);
}

bool LoopSurface::same(std::uint32_t one, std::uint32_t other) const { return patches_->adjoin(one, other); }

}  // namespace icome::geometry
