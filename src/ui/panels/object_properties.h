#pragma once
#include <memory>
#include <unordered_map>

#include "ui/panels/property.h"

namespace icome::ui {

/// Places and sizes of objects as people set them. Remembers angles as they were typed, since a rotation can
/// be written in more than one way. The properties must not be used longer than this object lives.
class PlaceProperties {
 public:
  /// Position, m, in the parent's frame.
  Property<double> position(int axis);
  /// Rotation, rad, about the parent's x, then y, then z.
  Property<double> turn(int axis);
  /// Size with all below, m, along the object's own axes; none without bounds or with very many parts.
  Property<double> size(int axis);

  /// Forgets the typed angles; to be called for another selection.
  void forget();

 private:
  base::Vector3 angles_of(world::ObjectId id, const base::Matrix3& turn) const;
  base::Vector3 extents(const world::World& world, world::ObjectId id) const;
  const base::Bounds& bounds_of(const world::GeometryPointer& shape) const;

  struct KnownBounds {
    std::weak_ptr<const world::Geometry> shape;
    base::Bounds bounds;
  };
  mutable std::unordered_map<const world::Geometry*, KnownBounds> bounds_;  // cached, as a mesh's take time
  std::unordered_map<world::ObjectId, base::Vector3> typed_;                // rad
};

Property<std::string> name_property();

}  // namespace icome::ui
