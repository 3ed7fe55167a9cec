#include "haptics/contact/scp_solver.h"

#include <algorithm>
#include <cmath>

#include "geometry/implicit/formula_allowance.h"
#include "haptics/contact/contact_fan.h"
#include "haptics/contact/place_outside.h"
#include "haptics/contact/tip_room.h"
#include "haptics/shapes/smooth_element.h"

namespace icome::haptics {
namespace {

constexpr double kFarOff = 256.0;    // sizes of the smallest near object, from the origin: then it is moved
constexpr int kMaxIdle = 4;          // iterations that bring the SCP no nearer: contacts that take turns
constexpr int kMaxReturns = 6;       // in a tick, to a place where a way out was found before
constexpr double kCrawl = 1e-4;      // of the remaining way: a shorter piece of way leads nowhere
constexpr int kMaxCrawl = 16;        // such pieces in a tick
constexpr int kFewCrawls = 3;        // after which a way in the open is looked for
constexpr double kRounding = 1e-14;  // of squared distances

}  // namespace

ScpSolver::ScpSolver(const ScpSettings& settings) : settings_(settings), around_(ContactFan::kCapacity) {}

void ScpSolver::reset() {
  no_room_ = false;
  restart();
}

/// Starts afresh in the next step, from the place of the tip.
void ScpSolver::restart() {
  started_ = false;
  sliding_ = false;
  contacts_.clear();
}

void ScpSolver::adopt(const HapticScene& scene, std::span<const SceneChange> changes) {
  const HapticScene* old = scene_;
  const double old_elapsed = elapsed_;
  scene_ = &scene;
  elapsed_ = 0.0;
  region_.invalidate();
  shut_in_at_.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (reach_ <= 0.0) reach_ = 0.1 * largest_reach();
  if (old == nullptr || !started_) return;
  follow_reported_object(*old);
  carry_contacts(*old, old_elapsed);
  const Vector3 margin = Vector3::Constant(settings_.tip_radius + scene.tolerance().behind());
  const Vector3 at = origin_ + position_;
  const geometry::FloatBox here = geometry::float_box(Bounds(at - margin, at + margin));
  geometry::FourBoxes swept;
  bool appeared = false;
  for (const SceneChange& change : changes) {
    swept.set(0, change.swept);
    if (swept.overlap_mask(here) == 0) continue;
    const std::optional<std::uint32_t> now = scene.find(change.id);
    if (!now) continue;
    const std::optional<std::uint32_t> before = old->find(change.id);
    if (before && old->objects()[*before].shape == scene.objects()[*now].shape) {
      sweep_relative(*now, old->pose_in(origin_, *before, old_elapsed), pose(*now, 0.0));
    } else {
      appeared = true;
    }
  }
  if (!appeared) return;
  leave_solids();
  if (!find_room()) restart();
}

// The last report names an object by its place in the old scene.
void ScpSolver::follow_reported_object(const HapticScene& old) {
  if (!state_.touching) return;
  const std::optional<std::uint32_t> now = scene_->find(old.objects()[state_.object].id);
  state_.touching = now.has_value();
  state_.object = now.value_or(kNoObject);
}

// Contacts stay with their objects: the SCP goes where its first contact's object takes it.
void ScpSolver::carry_contacts(const HapticScene& old, double old_elapsed) {
  bool carried = false;
  Vector3 to = position_;
  std::uint32_t pusher = kNoObject;
  contacts_.forget_if([&](Element& contact) {
    const HapticObject& before = old.objects()[contact.object];
    const std::optional<std::uint32_t> now = scene_->find(before.id);
    if (!now || scene_->objects()[*now].shape != before.shape) return true;
    const Pose now_from_before =
        pose(*now, 0.0) * old.pose_in(origin_, contact.object, old_elapsed).inverse();
    contact = transformed(now_from_before, contact);
    contact.object = *now;
    if (!carried) {
      to = now_from_before * position_;
      pusher = *now;
      carried = true;
    }
    return false;
  });
  if (carried) push_scp(to, pusher);
}

const ScpState& ScpSolver::step(const Vector3& in_world, double elapsed) {
  if (scene_ == nullptr) {
    state_ = {};
    state_.scp = in_world;
    return state_;
  }
  if (!started_ && !start(in_world)) {
    state_ = {};
    state_.scp = in_world;
    return state_;
  }
  if (position_.cwiseAbs().maxCoeff() > kFarOff * region_.smallest()) move_origin();
  const Vector3 tip = in_world - origin_;
  const geometry::FormulaAllowance allowance{most_evaluations()};
  if (scene_->moves()) carry(elapsed_, elapsed);
  elapsed_ = elapsed;
  tip_motion_ = (tip - last_tip_).norm();
  last_slide_ = 0.0;
  fallen_ = 0.0;
  last_tip_ = tip;
  tick_start_ = position_;
  crowded_ = false;
  in_tick_ = true;
  if (contacts_.any_smooth()) {
    last_contacts_ = contacts_;
  } else {
    last_contacts_.clear();
  }
  converge(tip);
  stay_out(tick_start_);
  in_tick_ = false;
  drift_ = position_ - tick_start_;
  report(tip);
  return state_;
}

/// Gathers the region of the next tick now if the SCP, going on as in this one, would need another. Near
/// moving objects a region serves no longer than a tick.
void ScpSolver::look_ahead() {
  if (!started_ || scene_->moves()) return;
  const geometry::FormulaAllowance allowance{std::uint64_t(settings_.max_evaluations)};
  grant_budget();
  crowded_ = false;
  if (region_.clearance(position_ + drift_) < least_room()) surround(drift_);
  region_.make_ready(position_, drift_);
}

/// Moves the origin to the SCP. Contacts are found again by the next sweep, and have all their digits then.
void ScpSolver::move_origin() {
  origin_ += position_;
  last_tip_ -= position_;
  goal_ -= position_;
  shut_in_at_ -= position_;
  shut_in_tip_ -= position_;
  position_.setZero();
  contacts_.clear();
  region_.invalidate();
}

/// False where the tip is larger than the room for it: it then has no SCP until it is somewhere free.
bool ScpSolver::start(const Vector3& in_world) {
  origin_.setZero();
  position_ = last_tip_ = in_world;
  region_.invalidate();
  leave_solids();
  started_ = find_room();
  return started_;
}

/// Puts an SCP that is inside solids outside of all of them.
void ScpSolver::leave_solids() {
  const std::optional<Vector3> free = place_outside(*scene_, frame(), position_);
  if (!free) return;
  position_ = *free;
  left_solid_ = true;
}

/// Moves a sphere tip's SCP out of all that it overlaps, if there is room near by. After a search in vain,
/// only the tip's own place is tested.
bool ScpSolver::find_room() {
  if (settings_.tip_radius <= 0.0) return true;
  const TipRoom room(*scene_, frame());
  if (room.fits(position_)) {
    no_room_ = false;
    return true;
  }
  const std::optional<Vector3> place = no_room_ ? std::nullopt : room.near(position_);
  no_room_ = !place;
  if (no_room_) return false;
  position_ = *place;
  left_solid_ = true;
  return true;
}

/// Height, m, above a place on an object (in its frame) at which the SCP is put.
double ScpSolver::gap_on(std::uint32_t object, const Vector3& place) const {
  return std::max(scene_->tolerance_near(object, place).gap,
                  Tolerance::for_coordinates(position_.cwiseAbs().maxCoeff()).gap);
}

void ScpSolver::carry(double from, double to) {
  // An SCP that rests on a moving object moves with it.
  Vector3 target = position_;
  std::uint32_t pusher = kNoObject;
  for (Element& contact : contacts_.all()) {
    if (!scene_->is_dynamic(contact.object, from)) continue;
    const Pose now_from_before = pose(contact.object, to) * pose(contact.object, from).inverse();
    contact = transformed(now_from_before, contact);
    contact.time = scene_->time(contact.object, to);
    if (pusher == kNoObject) {
      target = now_from_before * position_;
      pusher = contact.object;
    }
    if (contact.smooth() && height(contact, target) < tolerance().gap)
      target = settle(contact, target, tolerance());
  }
  elapsed_ = to;
  bool near_moving = false;
  const Vector3 at = origin_ + position_;
  scene_->near(at, at, std::max(0.0, region_.reach()) + settings_.tip_radius, [&](std::uint32_t object) {
    near_moving = scene_->is_dynamic(object, from);
    return !near_moving;
  });
  if (near_moving) region_.invalidate();
  if (pusher != kNoObject) push_scp(target, pusher);
  if (!near_moving) return;
  // A moving object takes along an SCP that it runs into.
  const Vector3 there = origin_ + position_;
  scene_->near(there, there, settings_.tip_radius, [&](std::uint32_t object) {
    if (!scene_->objects()[object].motion.still())
      sweep_relative(object, pose(object, from), pose(object, to));
    if (scene_->objects()[object].shape->changes()) surface_through(object);
    return true;
  });
}

// A changing surface may have swallowed the SCP, which then comes to the top.
void ScpSolver::surface_through(std::uint32_t object) {
  const Pose from_object = pose(object, elapsed_);
  const auto place = scene_->objects()[object].shape->way_out(from_object.inverse() * position_,
                                                              scene_->time(object, elapsed_));
  if (!place) return;
  const Vector3 out = from_object.linear() * place->normal;
  const double above = settings_.tip_radius + gap_on(object, place->point);
  push_scp(from_object * place->point + out * above, object);
}

// Seen from the object, the SCP moved to its present place from where it would be had it gone along.
void ScpSolver::sweep_relative(std::uint32_t object, const Pose& before, const Pose& now) {
  const auto held_by = [&](const Element& contact) { return contact.object == object; };
  if (std::any_of(contacts_.all().begin(), contacts_.all().end(), held_by)) return;
  const Vector3 along = now * (before.inverse() * position_);
  const Tolerance& tolerance = region_.tolerance();
  if ((along - position_).norm() <= tolerance.gap) return;
  ride_region_.start(*scene_, frame(), along, position_, tolerance.behind());
  scene_->gather_object(ride_region_, object);
  const SweepHit hit = ride_region_.sweep(along, position_ - along, {});
  if (!hit.met) return;
  push_scp(along + hit.t * (position_ - along), object);
  contacts_.add(hit.contact);
}

// Moves the SCP because an object pushes it; others may stop it on the way.
void ScpSolver::push_scp(const Vector3& to, std::uint32_t pusher) {
  const Vector3 way = to - position_;
  ride_region_.start(*scene_, frame(), position_, to, tolerance().behind());
  scene_->gather(ride_region_);
  const SweepHit hit = ride_region_.sweep(position_, way, {}, pusher);
  position_ += hit.t * way;
  if (hit.met) contacts_.add(hit.contact);
}

void ScpSolver::converge(const Vector3& tip) {
  const Tolerance& tolerance = region_.tolerance();
  state_.converged = false;
  state_.iterations = 0;
  grant_budget();
  int idle = 0;
  int returns = 0;
  int crawled = 0;
  double escaped_from = std::numeric_limits<double>::infinity();  // m, from the tip
  stride_ = std::numeric_limits<double>::infinity();
  last_move_.setZero();
  Vector3 nearest = position_;
  ContactSet nearest_contacts = contacts_;
  bool nearest_is_free = on_mesh();
  while (state_.iterations < settings_.max_iterations && !spent()) {
    ++state_.iterations;
    bool exact = false;
    const Vector3 step = next_step(tip, exact);
    const bool turns = idle == kMaxIdle;
    // Two faces that are all but level may take turns: each hands the SCP to the other and is forgotten. It
    // is held all the same, by the one that it meets.
    if (turns && contacts_.empty()) {
      advance(step);
      if (region_.overflowed()) return;
      idle = 0;
      if (contacts_.empty()) continue;
    }
    if (step.norm() <= tolerance.touching() || turns) {
      idle = 0;
      const bool on_a_face = contacts_.size() < 2 && held_gain() <= 0.0 && !at_edge() && !in_doubt_;
      const bool at_rest = !turns && (on_a_face || rounded());
      const bool circle = turns && nearest_is_free && on_mesh();
      if (circle) {
        position_ = nearest;
        contacts_ = nearest_contacts;
      }
      const double left = (tip - position_).norm();
      if (!at_rest && left >= escaped_from - tolerance.touching()) returns += circle ? kMaxReturns + 1 : 1;
      if (!at_rest && returns <= kMaxReturns && escape(tip)) {
        escaped_from = std::min(escaped_from, left);
        continue;
      }
      state_.converged = true;
      return;
    }
    const std::size_t held = contacts_.size();
    const Vector3 from = position_;
    const bool whole = advance(step);
    if (region_.overflowed()) return;
    if (nearer(nearest, tip)) {
      nearest = position_;
      nearest_is_free = on_mesh();
      if (nearest_is_free) nearest_contacts = contacts_;
      idle = 0;
    } else if (!cut_ || position_ == from) {  // a part of a way may lead off at first
      ++idle;
    }
    // Near a place such as the axis of a spiral stair, where the SCP crawls, the next tick goes on.
    const bool crawls = contacts_.any_smooth() && (contacts_.size() > 1 || in_doubt_) &&
                        (position_ - from).norm() < kCrawl * (tip - position_).norm();
    if (crawls && in_doubt_ && ++crawled % kFewCrawls == 0) {
      if (crawled <= kMaxCrawl && escape_in_the_open(tip)) continue;
      state_.converged = !spent();
      return;
    }
    if (crawls && !in_doubt_ && ++crawled > kMaxCrawl) return;
    if (met_ || contacts_.size() != held) continue;
    const bool between_walls = position_ == from && contacts_.any_smooth() && !in_doubt_;
    const bool fast = between_walls && !spent();
    const bool there = whole && exact && held < 2 && !at_edge();  // else there may be an escape
    if (fast || there) {
      state_.converged = true;
      return;
    }
  }
}

/// A step may end in the solid where its surface has no tangent plane, as at the axis of a spiral stair:
/// then the SCP stays where it was.
void ScpSolver::stay_out(const Vector3& before) {
  if (!swallowed(position_) || swallowed(before)) return;
  position_ = before;
  contacts_ = last_contacts_;
  state_.converged = false;
}

/// Sets the budget of a tick, or of the preparations for the next one.
void ScpSolver::grant_budget() { budget_ = region_.work() + std::uint64_t(settings_.max_elements); }

/// Is the SCP nearer to the tip than `from` is, by more than rounding?
bool ScpSolver::nearer(const Vector3& from, const Vector3& tip) const {
  return (tip - position_).squaredNorm() < (1.0 - kRounding) * (tip - from).squaredNorm();
}

void ScpSolver::report(const Vector3& tip) {
  const Tolerance& tolerance = region_.tolerance();
  const Vector3 pull = tip - position_;
  const bool apart = pull.squaredNorm() > std::pow(tolerance.touching(), 2);
  state_.scp = origin_ + position_;
  state_.started_inside = left_solid_;
  left_solid_ = false;
  if (contacts_.empty() && state_.touching && apart) return;  // out of budget on its way: still held
  state_.touching = !contacts_.empty() && apart;
  state_.surface_velocity.setZero();
  if (!state_.touching) {
    state_.object = kNoObject;
    // The SCP itself may stay behind by a step too short to sweep: such steps add up until they are swept.
    if (contacts_.empty() && state_.converged && !apart) state_.scp = origin_ + tip;
    return;
  }
  report_contact(pull);
}

/// Reports the contact that holds the SCP most against `pull`.
void ScpSolver::report_contact(const Vector3& pull) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Element& contact : contacts_.all()) {
    const double load = -normal(contact, position_).dot(pull);
    if (load <= most) continue;
    most = load;
    state_.object = contact.object;
    state_.feature = contact.feature;
    state_.normal = normal(contact, position_);
  }
  if (contacts_.size() > 1) {
    const Vector3 press = pull - contacts_.constrained(position_, pull, tolerance());
    if (press.squaredNorm() > 0.0) state_.normal = -press.normalized();
  }
  state_.surface_velocity = scene_->velocity(state_.object, elapsed_, origin_ + position_);
  if (scene_->objects()[state_.object].shape->changes()) state_.surface_velocity += deformation_velocity();
}

/// Velocity, m/s, of a changing surface itself under the SCP.
Vector3 ScpSolver::deformation_velocity() const {
  for (const Element& contact : contacts_.all()) {
    if (contact.smooth() && contact.object == state_.object) return smooth_velocity(contact, position_);
  }
  return Vector3::Zero();
}

}  // namespace icome::haptics
