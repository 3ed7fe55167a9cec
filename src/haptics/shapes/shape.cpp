#include "haptics/shapes/shape.h"

#include <limits>

namespace icome::haptics {

ElementSink::ElementSink(ContactRegion& region, std::uint32_t object, const Pose& world_from_object)
    : region_(region),
      object_(object),
      world_from_object_(world_from_object),
      in_place_(world_from_object.matrix().isIdentity(0.0)) {}

bool ElementSink::add(Element element, const Bounds& bounds) {
  element.object = object_;
  return region_.add(in_place_ ? element : transformed(world_from_object_, element), in_world(bounds));
}

bool ElementSink::defer(std::uint32_t piece, const Bounds& bounds) {
  return region_.defer(object_, piece, in_world(bounds));
}

bool ElementSink::defer_whole() { return region_.defer_whole(object_); }

/// The axis-parallel box in the world around a box in the shape's frame.
Bounds ElementSink::in_world(const Bounds& bounds) const {
  if (in_place_) return bounds;
  const Vector3 half = 0.5 * bounds.sizes();
  if (!half.allFinite()) {  // infinity times zero is no number
    const Vector3 far = Vector3::Constant(std::numeric_limits<double>::infinity());
    return {-far, far};
  }
  const Vector3 centre = world_from_object_ * Vector3(bounds.center());
  const Vector3 reach = world_from_object_.linear().cwiseAbs() * half;
  return {centre - reach, centre + reach};
}

}  // namespace icome::haptics
