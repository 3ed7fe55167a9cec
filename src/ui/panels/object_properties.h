#pragma once
#include <memory>
#include <unordered_map>

#include "ui/panels/property.h"

namespace icome::ui {

/// Where objects are and how large, in people's terms. Remembers angles as they were typed, as a turn has
/// more than one way to be written. Give the functions no longer than the object lives.
class PlaceProperties {
 public:
  /// m, with respect to the parent.
  Property<double> position(int axis);
  /// rad, about the parent's x, then y, then z.
  Property<double> turn(int axis);
  /// m, along the object's own axes, of all that is below it; not of what has no bounds or very many parts.
  Property<double> size(int axis);

  /// Another selection: nothing needs to be remembered any more.
  void forget();

 private:
  base::Vector3 angles_of(world::ObjectId id, const base::Matrix3& turn) const;
  base::Vector3 extents(const world::World& world, world::ObjectId id) const;
  const base::Bounds& bounds_of(const world::GeometryPointer& shape) const;

  struct KnownBounds {
    std::weak_ptr<const world::Geometry> shape;
    base::Bounds bounds;
  };
  mutable std::unordered_map<const world::Geometry*, KnownBounds> bounds_;  // those of a mesh take time
  std::unordered_map<world::ObjectId, base::Vector3> typed_;                // rad
};

Property<std::string> name_property();

}  // namespace icome::ui
