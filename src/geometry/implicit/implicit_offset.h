#pragma once
#include <memory>
#include <string>

#include "base/result.h"
#include "geometry/implicit/implicit_part.h"
#include "geometry/implicit/implicit_surface.h"

namespace icome::geometry {

/// The places of a ball's centre while it touches the solid of a formula: the solid's surface at the ball's
/// radius. The solid is the union of simple parts (ImplicitParts), so that this surface bounds the union of
/// the spaces around each of them. The pieces are the parts; a place on one also tells on which of the part's
/// faces, edges and corners the ball rests. Along a face the place below the centre is the same as a point
/// tip's (ImplicitWalk), along an edge the centre goes round a tube, at a corner round a ball. A place where
/// no ball can be, as beyond a groove, lies too near to another part and does no harm. The distance to a part
/// follows from bounds on the second derivatives: nothing is sampled, so nothing is missed; only in hollows
/// narrower than the ball, where it cannot rest, is the nearest place the nearest of those found.
/// Immutable; its points are places of the centre.
class ImplicitOffset final : public SmoothSurface {
 public:
  /// For a ball of this radius (m, > 0) and a formula and box that make an ImplicitSurface. Fails, with the
  /// reason as a clause, where the surface cannot be taken apart: where it comes to a point, at poles, and
  /// where its hollows are too many and too narrow for the ball.
  static base::Result<std::shared_ptr<const ImplicitOffset>> create(const std::string& formula,
                                                                    const Bounds& box, double radius);

  double radius() const { return radius_; }
  std::size_t part_count() const { return parts_.size(); }

  Bounds bounds() const override;
  void near(const Vector3& a, const Vector3& b, double reach, double time, PieceVisitor visit) const override;
  bool inside(const Vector3& point, double time = 0.0) const override;
  std::optional<SurfacePlace> way_out(const Vector3& point, double time) const override;
  std::optional<SurfaceHit> first_hit(std::uint32_t piece, const Vector3& start, const Vector3& step,
                                      bool from_behind, double time, double slack) const override;
  SurfacePlace nearest_local(const SurfacePlace& from, const Vector3& goal, double time) const override;
  bool covers(const SurfacePlace& place, const Vector3& above, double time, double slack) const override;
  bool same(std::uint32_t one, std::uint32_t other) const override;
  bool changes() const override { return walls_->changes(); }
  double normal_speed(const SurfacePlace& place, double time) const override;
  std::size_t bytes() const override;

 private:
  ImplicitOffset(std::shared_ptr<const ImplicitSurface> walls, ImplicitParts parts, double radius);

  ImplicitPart part(std::uint32_t piece, double time) const;
  SurfacePlace rest_on(std::uint32_t piece, const Vector3& place, const Vector3& normal) const;
  SurfacePlace face_projection(const SurfacePlace& from, const Vector3& place, const Vector3& goal,
                               double time) const;
  std::uint32_t moved_to(std::uint32_t piece, const Vector3& place) const;
  template <typename Visit>
  void overlapped(const Vector3& point, double time, Visit&& visit) const;
  double in_touch() const;

  std::shared_ptr<const ImplicitSurface> walls_;  // tells which points are in the solid itself
  ImplicitParts parts_;
  double radius_;
};

}  // namespace icome::geometry
