#include "haptics/smooth_shape.h"

namespace icome::haptics {

void SmoothShape::gather(const GatherRequest& request, ElementSink& sink) const {
  surface_->near(request.a, request.b, request.reach, request.time,
                 [&](std::uint32_t piece, const Bounds& box) { return sink.defer(piece, box); });
}

void SmoothShape::expand(std::uint32_t piece, double /*tip*/, TouchableSides sides,
                         PieceElements& elements) const {
  Element element;
  element.kind = Element::Kind::Smooth;
  element.surface = surface_.get();
  element.two_sided = sides == TouchableSides::Both;
  element.feature = piece;
  // The element's frame, which the scene turns with the object.
  element.u = Vector3::UnitX();
  element.v = Vector3::UnitY();
  element.axis = Vector3::UnitZ();
  elements.add(element);
}

std::optional<geometry::SurfacePoint> SmoothShape::way_out(const Vector3& position, double time) const {
  const auto place = surface_->way_out(position, time);
  if (!place) return std::nullopt;
  return geometry::SurfacePoint{place->point, place->normal};
}

}  // namespace icome::haptics
