#include "interaction/techniques/world_targets.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "base/decompositions.h"
#include "geometry/mesh/mesh_repair.h"
#include "geometry/tree/triangle_tree.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"
#include "world/shape/usual_tolerance.h"
#include "world/shape/visit_geometry.h"

namespace icome::interaction {
namespace {

/// A target of triangles, searched in their own frame. Closed ones are solid.
class MeshTarget final : public TargetShape {
 public:
  explicit MeshTarget(geometry::TriangleMesh mesh)
      : closed_(geometry::repair(mesh).surface.closed), tree_(mesh) {}

  double distance(const base::Affine3& world_from_target, const Vector3& point, double limit) const override;
  std::optional<double> first_hit(const base::Affine3& world_from_target, const Ray& ray) const override;
  bool meets(const base::Affine3& world_from_target, const SelectionCone& cone) const override;

 private:
  geometry::Corners placed_corners(const base::Affine3& world_from_target, std::uint32_t slot) const {
    geometry::Corners corners = tree_.corners(slot);
    for (Vector3& corner : corners) corner = world_from_target * corner;
    return corners;
  }

  bool closed_;
  geometry::TriangleTree tree_;
};

/// The least stretch of a frame: lengths in the world are at least that times its own.
double least_stretch(const base::Affine3& frame) { return base::singular_values(frame.linear()).values[2]; }

double MeshTarget::distance(const base::Affine3& world_from_target, const Vector3& point,
                            double limit) const {
  const Vector3 own = world_from_target.inverse() * point;
  const auto guess = tree_.nearest(own);
  if (!guess) return limit;
  double least = (world_from_target * guess->point - point).norm();
  // A frame that stretches may bring another triangle nearer; none that is farther than this.
  tree_.near(own, own, least / least_stretch(world_from_target), [&](std::uint32_t slot) {
    const Vector3 nearest = geometry::nearest_point(placed_corners(world_from_target, slot), point);
    least = std::min(least, (nearest - point).norm());
    return true;
  });
  return closed_ && tree_.encloses(own) ? -least : least;
}

std::optional<double> MeshTarget::first_hit(const base::Affine3& world_from_target, const Ray& ray) const {
  const base::Bounds& box = tree_.bounds();
  const Vector3 middle = world_from_target * Vector3(box.center());
  const double around = (world_from_target.linear().cwiseAbs() * (0.5 * box.sizes())).norm();
  const double length = (middle - ray.origin).norm() + around;
  const base::Affine3 own = world_from_target.inverse();
  const auto hit = tree_.first_hit(own * ray.origin, own * Vector3(ray.origin + length * ray.direction));
  if (!hit) return std::nullopt;
  return length * hit->parameter;
}

bool MeshTarget::meets(const base::Affine3& world_from_target, const SelectionCone& cone) const {
  const base::Bounds& box = tree_.bounds();
  const Vector3 middle = world_from_target * Vector3(box.center());
  const double around = (world_from_target.linear().cwiseAbs() * (0.5 * box.sizes())).norm();
  const double depth = std::max(0.0, cone.direction.dot(middle - cone.apex) + around);
  const base::Affine3 own = world_from_target.inverse();
  const double radius = depth * std::tan(cone.half_angle) / least_stretch(world_from_target);
  bool met = false;
  tree_.near(own * cone.apex, own * Vector3(cone.apex + depth * cone.direction), radius,
             [&](std::uint32_t slot) {
               met = cone_meets_triangle(cone, placed_corners(world_from_target, slot));
               return !met;
             });
  return met;
}

bool takes_long(const world::Geometry& shape) {
  constexpr std::size_t kManyTriangles = 20'000;
  return world::visit_geometry(
      shape, [](const world::MeshGeometry& it) { return it.mesh.triangles.size() > kManyTriangles; },
      [](const world::PrimitiveGeometry&) { return false; }, [](const world::Geometry&) { return true; });
}

}  // namespace

std::shared_ptr<const TargetShape> target_shape(const world::Geometry& shape) {
  const base::Bounds box = shape.bounds();
  if (box.isEmpty() || !box.sizes().allFinite() || !(box.sizes().maxCoeff() > 0.0)) return nullptr;
  const auto triangles = shape.triangles(world::usual_tolerance(shape));
  if (!triangles || (*triangles)->mesh.triangles.empty()) return nullptr;
  return std::make_shared<const MeshTarget>((*triangles)->mesh);
}

TechniqueScene targets_of(const world::World& world) { return WorldTargets().of(world); }

const TechniqueScene& WorldTargets::of(const world::World& world) {
  if (is_stale_ || !follow(world)) read(world);
  is_stale_ = false;
  moved_.clear();
  return scene_;
}

void WorldTargets::changed(const world::Changes* changes) {
  constexpr std::size_t kMostMoved = 10'000;  // while nobody asks
  if (is_stale_) return;
  if (!changes || !changes->geometries.empty() || moved_.size() > kMostMoved) {
    is_stale_ = true;
    return;
  }
  for (const world::ObjectId id : changes->objects)
    if (moved_.empty() || moved_.back() != id) moved_.push_back(id);
}

std::vector<world::GeometryPointer> WorldTargets::slow_shapes(const world::World& world) const {
  std::vector<world::GeometryPointer> found;
  std::unordered_set<world::GeometryId> seen;
  const auto look_at = [&](const world::PhysicalObject& object) {
    if (!object.geometry || !seen.insert(object.geometry).second) return;
    const world::GeometryPointer& shape = world.find(object.geometry)->shape;
    if (takes_long(*shape) && !shapes_.contains(shape)) found.push_back(shape);
  };
  if (is_stale_) {
    for (const auto& [id, object] : world.objects()) look_at(object);
  } else {
    for (const world::ObjectId id : moved_)
      if (const world::PhysicalObject* const object = world.find(id)) look_at(*object);
  }
  return found;
}

void WorldTargets::keep(const world::GeometryPointer& shape, std::shared_ptr<const TargetShape> made) {
  shapes_.try_emplace(shape, std::move(made));
}

void WorldTargets::read(const world::World& world) {
  const auto known = std::exchange(shapes_, {});
  made_of_.clear();
  scene_ = {};
  std::vector<world::ObjectId> ids;
  for (const auto& [id, object] : world.objects())
    if (object.geometry) ids.push_back(id);
  std::sort(ids.begin(), ids.end());
  for (const world::ObjectId id : ids) {
    const world::GeometryId geometry = world.find(id)->geometry;
    const world::GeometryPointer& shape = world.find(geometry)->shape;
    made_of_.emplace(id, geometry);
    auto [made, is_new] = shapes_.try_emplace(shape);
    if (is_new) {
      const auto before = known.find(shape);
      made->second = before != known.end() ? before->second : target_shape(*shape);
    }
    if (!made->second) continue;
    const base::Bounds box = shape->bounds();
    SceneTarget target;
    target.id = id.value;
    target.world_from_target = world_from_object(world, id);
    target.centre = box.center();
    target.radius = 0.5 * box.sizes().norm();
    target.shape = made->second;
    // Objects that a parent has squeezed to nothing cannot be pointed at.
    if (const auto added = scene_.add(target); !added) continue;
  }
}

/// Follows moved objects; false where more than places has changed.
bool WorldTargets::follow(const world::World& world) {
  for (const world::ObjectId root : moved_) {
    if (!world.find(root)) return false;
    for (const world::ObjectId id : world::subtree(world, root))
      if (!follow(world, id)) return false;
  }
  return true;
}

bool WorldTargets::follow(const world::World& world, world::ObjectId id) {
  const world::GeometryId geometry = world.find(id)->geometry;
  const auto before = made_of_.find(id);
  if (!geometry) return before == made_of_.end();
  if (before == made_of_.end() || before->second != geometry) return false;
  if (!shapes_.at(world.find(geometry)->shape)) return true;
  return scene_.move(id.value, world_from_object(world, id));
}

base::Result<world::Edit> edit_of(const world::World& world, const MovedTarget& moved) {
  const world::ObjectId id{moved.id};
  const world::PhysicalObject* const object = world.find(id);
  if (!object) return base::fail("what was moved is not in the design any more; select something else.");
  base::Affine3 world_from_parent = base::Affine3::Identity();
  if (object->parent) world_from_parent = world_from_object(world, object->parent);
  const base::Affine3 place = world_from_parent.inverse() * moved.world_from_target;
  if (!place.matrix().allFinite())
    return base::fail("the object cannot be moved, as a group above it has no size; give the group one.");
  return world::Edit(world::PlaceObject{id, place});
}

}  // namespace icome::interaction
