#pragma once
#include <memory>
#include <utility>

#include "geometry/smooth_surface.h"

namespace icome::session {

/// A surface that changes with time, as it is at t = 0.
class StillSurface final : public geometry::SmoothSurface {
 public:
  /// `moving` is shared, and never null.
  explicit StillSurface(std::shared_ptr<const geometry::SmoothSurface> moving) : moving_(std::move(moving)) {}

  geometry::Bounds bounds() const override { return moving_->bounds(); }
  void near(const geometry::Vector3& a, const geometry::Vector3& b, double reach, double /*time*/,
            PieceVisitor visit) const override {
    moving_->near(a, b, reach, 0.0, visit);
  }
  bool inside(const geometry::Vector3& point, double /*time*/) const override {
    return moving_->inside(point, 0.0);
  }
  std::optional<geometry::SurfacePlace> way_out(const geometry::Vector3& point,
                                                double /*time*/) const override {
    return moving_->way_out(point, 0.0);
  }
  std::optional<geometry::SurfaceHit> first_hit(std::uint32_t piece, const geometry::Vector3& start,
                                                const geometry::Vector3& step, bool from_behind,
                                                double /*time*/, double slack) const override {
    return moving_->first_hit(piece, start, step, from_behind, 0.0, slack);
  }
  geometry::SurfacePlace nearest_local(const geometry::SurfacePlace& from, const geometry::Vector3& goal,
                                       double /*time*/) const override {
    return moving_->nearest_local(from, goal, 0.0);
  }
  bool covers(const geometry::SurfacePlace& place, const geometry::Vector3& above, double /*time*/,
              double slack) const override {
    return moving_->covers(place, above, 0.0, slack);
  }
  bool same(std::uint32_t one, std::uint32_t other) const override { return moving_->same(one, other); }
  std::size_t bytes() const override { return sizeof(*this) + moving_->bytes(); }

 private:
  std::shared_ptr<const geometry::SmoothSurface> moving_;
};

}  // namespace icome::session
