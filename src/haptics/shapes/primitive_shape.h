#pragma once
#include "geometry/primitive/primitive.h"
#include "haptics/shapes/shape.h"

namespace icome::haptics {

/// A primitive that is touched exactly: no mesh, exact curvature.
class PrimitiveShape final : public Shape {
 public:
  explicit PrimitiveShape(const geometry::Primitive& primitive) : primitive_(primitive) {}

  Bounds bounds() const override { return geometry::bounds(primitive_); }
  void gather(const GatherRequest& request, ElementSink& sink) const override;
  std::optional<geometry::SurfacePoint> way_out(const Vector3& position, double /*time*/) const override;
  std::optional<geometry::SurfacePoint> nearest(const Vector3& position, double limit,
                                                TouchableSides sides) const override;
  std::optional<ShapeHit> cast(const Vector3& start, const Vector3& step, double /*time*/) const override;
  std::size_t bytes() const override { return sizeof(*this); }

 private:
  geometry::Primitive primitive_;
};

}  // namespace icome::haptics
