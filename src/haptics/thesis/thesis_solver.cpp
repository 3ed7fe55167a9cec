#include "haptics/thesis/thesis_solver.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace icome::haptics {

ThesisSolver::ThesisSolver() : space_(std::make_unique<DirectWorkspace>()) {
  known_.reserve(kMostObjects);
  asked_.reserve(kMostObjects);
  found_.reserve(kMostObjects);
}

void ThesisSolver::reset() {
  started_ = false;
  known_.clear();
  state_ = {};
}

const DirectShape* ThesisSolver::direct_shape(std::uint32_t object) const {
  return dynamic_cast<const DirectShape*>(scene_->objects()[object].shape.get());
}

const ThesisSolver::Known* ThesisSolver::find_known(ObjectId id) const {
  const auto place = std::find_if(known_.begin(), known_.end(), [&](const Known& it) { return it.id == id; });
  return place == known_.end() ? nullptr : &*place;
}

void ThesisSolver::adopt(const HapticScene& scene, std::span<const SceneChange> changes) {
  const HapticScene* old = std::exchange(scene_, &scene);
  const double old_elapsed = std::exchange(elapsed_, 0.0);
  if (old == nullptr || !started_) return;
  if (state_.touching) {  // the last report names an object by its place in the old scene
    const std::optional<std::uint32_t> now = scene.find(old->objects()[state_.object].id);
    state_.touching = now.has_value();
    state_.object = now.value_or(kNoObject);
  }
  const geometry::FloatBox here = geometry::float_box(Bounds(last_tip_, last_tip_));
  geometry::FourBoxes swept;
  for (const SceneChange& change : changes) {
    swept.set(0, change.swept);
    if (swept.overlap_mask(here) != 0) meet(*old, old_elapsed, change);
  }
}

/// Remembers the tip's place in the old scene, in the frame of an object that came or changed.
void ThesisSolver::meet(const HapticScene& old, double old_elapsed, const SceneChange& change) {
  const std::optional<std::uint32_t> now = scene_->find(change.id);
  const std::optional<std::uint32_t> before = old.find(change.id);
  if (!now) return;
  const bool same = before && old.objects()[*before].shape == scene_->objects()[*now].shape;
  const auto known =
      std::find_if(known_.begin(), known_.end(), [&](const Known& it) { return it.id == change.id; });
  if (known != known_.end()) {
    // A solid edited while it is felt carries on from its previous SCP.
    known->appeared = known->appeared || (!same && !known->memory.touching);
    return;
  }
  if (known_.size() == known_.capacity()) return;
  const Pose world_from_object = before ? old.pose(*before, old_elapsed) : scene_->pose(*now, 0.0);
  known_.push_back({change.id, DirectMemory::free_at(world_from_object.inverse() * last_tip_), !same});
}

const ScpState& ThesisSolver::step(const Vector3& tip, double elapsed) {
  if (scene_ == nullptr) {
    state_ = {};
    state_.scp = tip;
    return state_;
  }
  const double before = std::exchange(elapsed_, elapsed);
  const Vector3 previous = started_ ? carried_scp(elapsed) : tip;
  asked_.clear();
  found_.clear();
  crowded_ = false;
  scene_->near(tip, tip, 0.0, [&](std::uint32_t object) { return ask(object, tip, before, elapsed); });
  std::swap(known_, asked_);
  report(choose(previous), tip);
  started_ = true;
  last_tip_ = tip;
  return state_;
}

/// The last SCP, moved along with the object that holds it.
Vector3 ThesisSolver::carried_scp(double elapsed) const {
  if (!state_.touching) return last_tip_;
  const Known* known = find_known(scene_->objects()[state_.object].id);
  return known == nullptr ? state_.scp
                          : Vector3(scene_->pose(state_.object, elapsed) * known->memory.scp.point);
}

/// Asks an object whose box may hold the tip. `before` and `now`: s, of the last step and of this one.
bool ThesisSolver::ask(std::uint32_t object, const Vector3& tip, double before, double now) {
  const DirectShape* shape = direct_shape(object);
  if (shape == nullptr) return true;
  if (asked_.size() == asked_.capacity()) {
    crowded_ = true;
    return false;
  }
  const Pose world_from_object = scene_->pose(object, now);
  const Vector3 local = world_from_object.inverse() * tip;
  const ObjectId id = scene_->objects()[object].id;
  Known next{id, DirectMemory::free_at(local), !started_};
  if (const Known* known = find_known(id)) {
    next = *known;
  } else if (started_) {
    next.memory = DirectMemory::free_at(scene_->pose(object, before).inverse() * last_tip_);
  }
  const auto answer = shape->direct_scp(local, next.memory, *space_);
  if (answer) {
    found_.push_back(
        {object,
         {world_from_object * answer->place.point, world_from_object.linear() * answer->place.normal},
         answer->converged,
         next.appeared});
  }
  next.appeared = false;
  asked_.push_back(next);
  return true;
}

const ThesisSolver::Found* ThesisSolver::choose(const Vector3& previous) {
  const Found* best = nullptr;
  bool best_buried = false;
  double best_way = std::numeric_limits<double>::infinity();
  for (const Found& found : found_) {
    const bool is_buried = known_.size() > 1 && buried(found, elapsed_);
    const double way = (found.place.point - previous).squaredNorm();
    if (best != nullptr && std::pair(is_buried, way) >= std::pair(best_buried, best_way)) continue;
    best = &found;
    best_buried = is_buried;
    best_way = way;
  }
  return best;
}

/// Does the SCP lie in another object that is near the tip?
bool ThesisSolver::buried(const Found& found, double elapsed) {
  const Vector3 outside = found.place.point + scene_->tolerance().touching() * found.place.normal;
  const ObjectId own = scene_->objects()[found.object].id;
  return std::any_of(known_.begin(), known_.end(), [&](const Known& other) {
    const std::optional<std::uint32_t> object = scene_->find(other.id);
    return other.id != own && object &&
           direct_shape(*object)->inside(scene_->pose(*object, elapsed).inverse() * outside, *space_);
  });
}

void ThesisSolver::report(const Found* found, const Vector3& tip) {
  state_ = {};
  state_.scp = tip;
  state_.converged = !crowded_;
  state_.iterations = 1;
  if (found == nullptr) return;
  state_.converged = state_.converged && found->converged;
  state_.started_inside = found->appeared;
  state_.scp = found->place.point;
  state_.normal = found->place.normal;
  if ((state_.scp - tip).norm() <= scene_->tolerance().touching()) return;
  state_.touching = true;
  state_.object = found->object;
  state_.surface_velocity = scene_->velocity(found->object, elapsed_, state_.scp);
}

}  // namespace icome::haptics
