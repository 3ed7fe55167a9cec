#include "haptics/haptic_scene.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "geometry/hilbert.h"

namespace icome::haptics {
namespace {

/// A turn by the vector's length about its direction.
base::Quaternion turn(const Vector3& rotation) {
  const double angle = rotation.norm();
  if (angle <= 0.0) return base::Quaternion::Identity();
  return base::Quaternion(Eigen::AngleAxisd(angle, rotation / angle));
}

/// Where the tree should sort an unlimited box: anywhere, but at a number.
Eigen::Vector3f sorting_point(const Bounds& bounds) {
  const Vector3 centre = bounds.center();
  return centre.allFinite() ? Eigen::Vector3f(centre.cast<float>()) : Eigen::Vector3f::Zero();
}

}  // namespace

std::shared_ptr<const HapticScene> HapticScene::compile(std::vector<HapticObject> objects) {
  std::shared_ptr<HapticScene> scene(new HapticScene());
  scene->objects_ = std::move(objects);
  const auto count = std::uint32_t(scene->objects_.size());
  std::vector<Eigen::Vector3f> places(count);
  for (std::uint32_t i = 0; i < count; ++i) places[i] = sorting_point(scene->object_bounds(i));
  scene->order_ = geometry::hilbert_order(places);
  scene->tree_ = geometry::BoxTree(scene->slot_boxes());
  scene->by_id_.resize(count);
  std::iota(scene->by_id_.begin(), scene->by_id_.end(), 0u);
  std::sort(scene->by_id_.begin(), scene->by_id_.end(),
            [&](std::uint32_t a, std::uint32_t b) { return scene->objects_[a].id < scene->objects_[b].id; });
  scene->measure();
  return scene;
}

std::shared_ptr<const HapticScene> HapticScene::moved(std::span<const Move> moves) const {
  std::shared_ptr<HapticScene> scene(new HapticScene(*this));
  for (const Move& move : moves) {
    const std::optional<std::uint32_t> object = find(move.id);
    if (!object) continue;
    scene->objects_[*object].world_from_object = move.world_from_object;
    scene->objects_[*object].motion = move.motion;
  }
  scene->tree_.refit(scene->slot_boxes());
  scene->measure();
  return scene;
}

void HapticScene::measure() {
  bounds_.setEmpty();
  moves_ = false;
  for (std::uint32_t i = 0; i < objects_.size(); ++i) {
    const Bounds box = object_bounds(i);
    if (box.min().allFinite() && box.max().allFinite()) bounds_.extend(box);
    moves_ = moves_ || restless(i);
  }
  const double extent =
      bounds_.isEmpty() ? 1.0
                        : std::max(bounds_.min().cwiseAbs().maxCoeff(), bounds_.max().cwiseAbs().maxCoeff());
  tolerance_ = Tolerance::for_extent(extent);
}

// The box sweeps over everything the object can reach within the horizon, so that the tree stays
// right between two scenes.
Bounds HapticScene::object_bounds(std::uint32_t object) const {
  const HapticObject& it = objects_[object];
  const Bounds local = it.shape->bounds();
  if (local.isEmpty()) return local;
  if (!local.min().allFinite() || !local.max().allFinite()) {
    const Vector3 far = Vector3::Constant(std::numeric_limits<double>::infinity());
    return {-far, far};
  }
  const Vector3 centre = it.world_from_object * Vector3(local.center());
  Vector3 reach = it.world_from_object.linear().cwiseAbs() * (0.5 * local.sizes());
  if (!it.motion.still()) {
    const double turn_radius = local.center().norm() + 0.5 * local.sizes().norm();
    const double chord = std::min(2.0, it.motion.angular.norm() * kMotionHorizon) * turn_radius;
    reach += it.motion.linear.cwiseAbs() * kMotionHorizon + Vector3::Constant(chord);
  }
  return {centre - reach, centre + reach};
}

std::vector<geometry::FloatBox> HapticScene::slot_boxes() const {
  std::vector<geometry::FloatBox> boxes(objects_.size());
  for (std::size_t slot = 0; slot < boxes.size(); ++slot) {
    boxes[slot] = geometry::float_box(object_bounds(order_[slot]));
  }
  return boxes;
}

void HapticScene::gather(ContactRegion& region) const {
  near(region.a(), region.b(), region.reach() + region.tip() + edge_dip(region.tip()),
       [&](std::uint32_t object) {
         gather_object(region, object);
         return !region.overflowed();
       });
}

void HapticScene::gather_object(ContactRegion& region, std::uint32_t object) const {
  const HapticObject& it = objects_[object];
  const Pose world_from_object = pose(object, region.elapsed());
  const Pose object_from_world = world_from_object.inverse();
  ElementSink sink(region, object, world_from_object);
  const double reach = region.reach() + edge_dip(region.tip());
  it.shape->gather({object_from_world * region.a(), object_from_world * region.b(), reach, region.tip(),
                    it.surface.sides, time(object, region.elapsed())},
                   sink);
}

void HapticScene::expand(std::uint32_t object, std::uint32_t piece, double tip, double elapsed,
                         PieceElements& elements) const {
  const HapticObject& it = objects_[object];
  it.shape->expand(piece, tip, it.surface.sides, elements);
  const Pose world_from_object = pose(object, elapsed);
  const bool in_place = world_from_object.matrix().isIdentity(0.0);
  for (Element& element : elements.all()) {
    element.object = object;
    element.time = this->time(object, elapsed);
    if (!in_place) element = transformed(world_from_object, element);
  }
}

Pose HapticScene::pose(std::uint32_t object, double elapsed) const {
  const HapticObject& it = objects_[object];
  if (it.motion.still()) return it.world_from_object;
  const double time = std::clamp(elapsed, 0.0, kMotionHorizon);
  Pose result = it.world_from_object;
  result.linear() = turn(it.motion.angular * time) * result.linear();
  result.translation() += it.motion.linear * time;
  return result;
}

std::optional<std::uint32_t> HapticScene::find(ObjectId id) const {
  const auto place =
      std::lower_bound(by_id_.begin(), by_id_.end(), id,
                       [&](std::uint32_t object, ObjectId key) { return objects_[object].id < key; });
  if (place == by_id_.end() || objects_[*place].id != id) return std::nullopt;
  return *place;
}

std::size_t HapticScene::bytes() const {
  return sizeof(*this) + objects_.capacity() * sizeof(HapticObject) + tree_.bytes() +
         (order_.capacity() + by_id_.capacity()) * sizeof(std::uint32_t);
}

}  // namespace icome::haptics
