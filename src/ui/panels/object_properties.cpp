#include "ui/panels/object_properties.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "session/felt/rigid_part.h"

namespace icome::ui {

using base::Affine3;
using base::Bounds;
using base::Matrix3;
using base::Result;
using base::Vector3;
using world::ObjectId;
using world::World;

namespace {

Matrix3 turn_of(const Vector3& angles) {
  return (Eigen::AngleAxisd(angles.z(), Vector3::UnitZ()) * Eigen::AngleAxisd(angles.y(), Vector3::UnitY()) *
          Eigen::AngleAxisd(angles.x(), Vector3::UnitX()))
      .toRotationMatrix();
}

Vector3 angles_from(const Matrix3& turn) {
  const double y = std::asin(std::clamp(-turn(2, 0), -1.0, 1.0));
  // Straight up or down, x and z turn about the same line: z takes all of the turn.
  if (std::abs(turn(2, 0)) > 1.0 - 1e-12) return {0.0, y, std::atan2(-turn(0, 1), turn(1, 1))};
  return {std::atan2(turn(2, 1), turn(2, 2)), y, std::atan2(turn(1, 0), turn(0, 0))};
}

Result<world::Edit> place(ObjectId id, const Affine3& parent_from_object) {
  return world::Edit(world::PlaceObject{id, parent_from_object});
}

}  // namespace

Subjects subjects_of(const World& world, const std::vector<ObjectId>& selection) {
  Subjects subjects;
  std::unordered_set<world::GeometryId> shapes;
  std::unordered_set<world::MaterialId> materials;
  subjects.all_have_materials = !selection.empty();
  for (const ObjectId id : selection) {
    const world::PhysicalObject* object = world.find(id);
    if (!object) continue;
    subjects.objects.push_back(id);
    if (object->geometry && shapes.insert(object->geometry).second) subjects.shapes.push_back(id);
    if (object->material && materials.insert(object->material).second) subjects.materials.push_back(id);
    if (object->geometry || object->material) subjects.dressed.push_back(id);
    if (object->geometry && !object->material) subjects.all_have_materials = false;
    if (!object->fixture) continue;
    if (std::holds_alternative<world::Light>(*object->fixture)) subjects.lights.push_back(id);
    if (std::holds_alternative<world::Viewpoint>(*object->fixture)) subjects.viewpoints.push_back(id);
    if (std::holds_alternative<world::ForceEffect>(*object->fixture)) subjects.effects.push_back(id);
  }
  return subjects;
}

Property<std::string> name_property() {
  return {[](const World& world, ObjectId id) { return std::optional(world.find(id)->name); },
          [](const World&, ObjectId id, const std::string& name) -> Result<world::Edit> {
            return world::Edit(world::RenameObject{id, name});
          }};
}

Property<double> PlaceProperties::position(int axis) {
  return {[axis](const World& world, ObjectId id) {
            return std::optional(world.find(id)->parent_from_object.translation()[axis]);
          },
          [axis](const World& world, ObjectId id, double value) {
            Affine3 frame = world.find(id)->parent_from_object;
            frame.translation()[axis] = value;
            return place(id, frame);
          }};
}

Vector3 PlaceProperties::angles_of(ObjectId id, const Matrix3& turn) const {
  const auto typed = typed_.find(id);
  if (typed != typed_.end() && turn_of(typed->second).isApprox(turn, 1e-9)) return typed->second;
  return angles_from(turn);
}

Property<double> PlaceProperties::turn(int axis) {
  return {[this, axis](const World& world, ObjectId id) {
            const session::RigidPart part = session::rigid_part(world.find(id)->parent_from_object);
            return std::optional(angles_of(id, part.world_from_felt.linear())[axis]);
          },
          [this, axis](const World& world, ObjectId id, double value) {
            Affine3 frame = world.find(id)->parent_from_object;
            const session::RigidPart part = session::rigid_part(frame);
            Vector3 angles = angles_of(id, part.world_from_felt.linear());
            angles[axis] = value;
            typed_[id] = angles;
            frame.linear() = turn_of(angles) * part.felt_from_shape;
            return place(id, frame);
          }};
}

Property<double> PlaceProperties::size(int axis) {
  return {[this, axis](const World& world, ObjectId id) -> std::optional<double> {
            const double size = extents(world, id)[axis];
            if (!std::isfinite(size) || size <= 0.0) return std::nullopt;
            return size * world.find(id)->parent_from_object.linear().col(axis).norm();
          },
          [this, axis](const World& world, ObjectId id, double value) -> Result<world::Edit> {
            if (!(value > 0.0)) return base::fail("A size must be more than 0.");
            Affine3 frame = world.find(id)->parent_from_object;
            const double now = extents(world, id)[axis] * frame.linear().col(axis).norm();
            frame.linear().col(axis) *= value / now;
            return place(id, frame);
          }};
}

void PlaceProperties::forget() {
  typed_.clear();
  std::erase_if(bounds_, [](const auto& it) { return it.second.shape.expired(); });
}

const Bounds& PlaceProperties::bounds_of(const world::GeometryPointer& shape) const {
  KnownBounds& known = bounds_[shape.get()];
  if (known.shape.lock() != shape) known = {shape, shape->bounds()};
  return known.bounds;
}

/// Extents of the object with all below it, in its own frame; zero without bounds or with too many parts.
Vector3 PlaceProperties::extents(const World& world, ObjectId id) const {
  constexpr std::size_t kMostParts = 2000;
  struct Due {
    ObjectId id;
    Affine3 root_from_object;
  };
  Bounds around;
  std::vector<Due> due{{id, Affine3::Identity()}};
  for (std::size_t i = 0; i < due.size(); ++i) {
    const Due now = due[i];
    const world::PhysicalObject& object = *world.find(now.id);
    if (due.size() + object.children.size() > kMostParts) return Vector3::Zero();
    for (const ObjectId child : object.children)
      due.push_back({child, now.root_from_object * world.find(child)->parent_from_object});
    const world::GeometryObject* shape = world.find(object.geometry);
    if (!shape) continue;
    const Bounds& own = bounds_of(shape->shape);
    const bool ends = !own.isEmpty() && own.sizes().allFinite();
    if (ends) around.extend(own.transformed(now.root_from_object));
  }
  return around.isEmpty() ? Vector3(Vector3::Zero()) : Vector3(around.sizes());
}

}  // namespace icome::ui
