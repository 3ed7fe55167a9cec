#pragma once
#include <memory>
#include <utility>

#include "geometry/smooth_surface.h"
#include "haptics/shapes/shape.h"

namespace icome::haptics {

/// A surface that is touched exactly, without a mesh: a CSG solid, a subdivision surface's limit, an
/// implicit surface. For a point tip; for a sphere tip it is the surface on which the tip's centre moves
/// (geometry::CsgOffset).
class SmoothShape final : public Shape {
 public:
  /// The surface is shared, never null. `tip` (m): the distance of the surface from the touched solid; the
  /// shape is for a tip of this radius.
  explicit SmoothShape(std::shared_ptr<const geometry::SmoothSurface> surface, double tip = 0.0)
      : surface_(std::move(surface)), tip_(tip) {}

  Bounds bounds() const override;
  void gather(const GatherRequest& request, ElementSink& sink) const override;
  void expand(std::uint32_t piece, double tip, TouchableSides sides, PieceElements& elements) const override;
  std::optional<geometry::SurfacePoint> way_out(const Vector3& position, double time) const override;
  std::optional<ShapeHit> cast(const Vector3& start, const Vector3& step, double time) const override;
  bool changes() const override { return surface_->changes(); }
  std::size_t bytes() const override { return sizeof(*this) + surface_->bytes(); }

 private:
  std::shared_ptr<const geometry::SmoothSurface> surface_;
  double tip_;  // m
};

}  // namespace icome::haptics
