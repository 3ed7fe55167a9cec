#include "haptics/contact/scp_solver.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/implicit/formula_allowance.h"
#include "haptics/contact/contact_fan.h"
#include "haptics/contact/place_outside.h"
#include "haptics/contact/tip_room.h"
#include "haptics/shapes/smooth_element.h"

namespace icome::haptics {
namespace {

// A region should hold enough pieces to serve several ticks and few enough to sweep quickly.
constexpr std::size_t kFewPieces = 12;
constexpr std::size_t kManyPieces = 48;
constexpr std::size_t kMostAhead = 1024;  // with more the region looks less far ahead
constexpr double kTicksAhead = 4.0;
constexpr double kLeastShare = 1e-3;
constexpr double kLeastRoom = 0.25;    // of a region's reach: with less room the SCP needs another region
constexpr double kLeastOfTip = 1e-3;   // of its radius: least reach of a region
constexpr double kLargestReach = 0.1;  // of the scene's extent
constexpr double kFarOff = 256.0;      // sizes of the smallest near object, from the origin: then it is moved

constexpr int kMaxShrinks = 48;
constexpr int kMaxArches = 12;
constexpr int kMaxIdle = 4;              // iterations that bring the SCP no nearer: contacts that take turns
constexpr double kMaxAheadGrowth = 2.0;  // of the way that a region looks ahead, after one that overflowed
constexpr int kMaxReturns = 6;           // in a tick, to a place where a way out was found before
constexpr double kCrawl = 1e-4;          // of the remaining way: a shorter piece of way leads nowhere
constexpr int kMaxCrawl = 16;            // such pieces in a tick
constexpr int kFewCrawls = 3;            // after which a way in the open is looked for
constexpr double kOpenWay = 2e-3;        // of the size of the smallest near object: length of that way
constexpr int kOpenSides = 24;
constexpr double kSamePull = 0.05;     // of its length: a change that opens no way
constexpr double kRounding = 1e-14;    // of squared distances
constexpr double kSteepest = 0.1;      // rise of an arch for its length
constexpr double kStride = 8.0;        // longest slide of a sphere tip, in lengths of its last one
constexpr double kRoundStep = 0.28;    // rad, along a rounded edge: no way over it is then too steep
constexpr double kFarthest = 0.3;      // of its radius: a region's way ahead of a sphere tip in contact
constexpr double kBulge = 0.3;         // rise of a way over an edge, times its radius, for the squared chord
constexpr int kMaxHalvings = 24;       // of such a chord, until a region holds it
constexpr double kEdgeWidth = 1024.0;  // gaps: what files round positions to
constexpr int kStepsBeyond = 3;  // of an edge: to the next face, along it, and along the seam with another

/// Evaluations of formulas in a tick. A point tip's sweeps begin on surfaces, where they cost most.
std::uint64_t evaluations_of(const ScpSettings& settings) {
  return std::uint64_t(settings.max_evaluations) * (settings.tip_radius > 0.0 ? 1 : 2);
}

/// Are all of these contacts with formulas' solids, which tell at once whether a place is in them?
bool all_know_inside(const ContactSet& contacts) {
  const std::span<const Element> all = contacts.all();
  return std::all_of(all.begin(), all.end(), [](const Element& it) {
    return it.smooth() && !it.two_sided && it.surface->knows_inside_quickly();
  });
}

/// Is a place within a smooth solid that one of these contacts is with, as far as that is known quickly?
bool any_swallows(const ContactSet& contacts, const Vector3& position) {
  const std::span<const Element> all = contacts.all();
  return std::any_of(all.begin(), all.end(),
                     [&](const Element& it) { return it.smooth() && has_swallowed(it, position); });
}

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
  const geometry::FormulaAllowance allowance{evaluations_of(settings_)};
  if (scene_->moves()) carry(elapsed_, elapsed);
  elapsed_ = elapsed;
  tip_motion_ = (tip - last_tip_).norm();
  last_slide_ = 0.0;
  fallen_ = 0.0;
  last_tip_ = tip;
  tick_start_ = position_;
  if (contacts_.any_smooth()) {
    last_contacts_ = contacts_;
  } else {
    last_contacts_.clear();
  }
  converge(tip);
  stay_out(tick_start_);
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
  Vector3 nearest = position_;
  ContactSet nearest_contacts = contacts_;
  bool nearest_is_free = on_mesh();
  while (state_.iterations < settings_.max_iterations && !spent()) {
    ++state_.iterations;
    bool exact = false;
    const Vector3 step = next_step(tip, exact);
    const bool turns = idle == kMaxIdle;
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

/// Is a place within a smooth solid that is touched, or was when the tick began?
bool ScpSolver::swallowed(const Vector3& position) const {
  return any_swallows(last_contacts_, position) || any_swallows(contacts_, position);
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

/// The piece of way that the contacts allow. `exact`: if nothing is met, its end needs no second look.
Vector3 ScpSolver::next_step(const Vector3& tip, bool& exact) {
  const Vector3 pull = tip - position_;
  const Tolerance& tolerance = region_.tolerance();
  in_doubt_ = false;
  exact = true;
  for (const Element& contact : contacts_.all()) exact = exact && contact.flat();
  if (contacts_.any_smooth()) return next_smooth_step(tip, exact);
  if (contacts_.size() > 1 && contacts_.any_guarded()) return next_round_step(tip, exact);
  if (contacts_.size() > 1) {
    const Vector3 step = contacts_.constrained(position_, pull, tolerance);
    const double share = slip(step.norm(), (pull - step).norm());
    let_go(step);
    return share * step;
  }
  if (contacts_.size() == 1) {
    const Element& contact = contacts_.all().front();
    const Vector3 out = normal(contact, position_);
    const double press = -out.dot(pull);
    if (press > 0.0) {
      if (contact.guarded) return next_round_step(tip, exact);
      const Vector3 way = slide(contact, position_, tip, tolerance) - position_;
      const double share = slip((pull + press * out).norm(), press);
      const Vector3 end = position_ + share * way;
      // Friction may end the way half-way along a chord: on the surface, not under it.
      if (share > 0.0 && share < 1.0 && height(contact, end) < 0.0)
        return settle(contact, end, tolerance) - position_;
      return share * way;
    }
    contacts_.clear();
  }
  return pull;
}

/// Does the tip pull off the contact? At an apex the normal at the SCP says little: then the side of the
/// surface on which the tip lies decides, if it is near enough to tell.
bool ScpSolver::lets_go(const Element& contact, const Vector3& tip) const {
  if (normal(contact, position_).dot(tip - position_) < 0.0) return false;
  const Footing under_tip = footing(contact, tip);
  return !under_tip.sure || under_tip.height >= 0.0;
}

/// The piece of way with smooth surfaces among the contacts, which are followed as they curve.
Vector3 ScpSolver::next_smooth_step(const Vector3& tip, bool& exact) {
  const Tolerance& tolerance = region_.tolerance();
  const Vector3 pull = tip - position_;
  // Half of what the tick may cost is left for the sweep of this step.
  const geometry::FormulaAllowance allowance{evaluations_of(settings_) / 2};
  contacts_.follow(position_);
  if (contacts_.size() == 1 && lets_go(contacts_.all().front(), tip)) {
    contacts_.clear();
    return pull;
  }
  ContactSet::Rest rest = contacts_.rest(position_, tip, tolerance);
  exact = rest.exact;
  in_doubt_ = !rest.sure && settings_.tip_radius <= 0.0 && all_know_inside(contacts_);
  const Vector3 step = rest.place - position_;
  // The spring's share along the surface: for the friction cone, the spring presses at the resting place.
  const double share = slip(step.norm(), (tip - rest.place).norm());
  if (share <= 0.0) return Vector3::Zero();
  goal_ = share < 1.0 ? Vector3(position_ + share * step) : tip;
  if (share < 1.0) rest = contacts_.rest(position_, goal_, tolerance);
  return rest.place - position_;
}

/// The piece of way along rounded edges and corners of a mesh, which bend: a step along their tangents
/// would rise off them, and where the tip is near their centres it would lead a small part of the way only.
Vector3 ScpSolver::next_round_step(const Vector3& tip, bool& exact) {
  const Vector3 pull = tip - position_;
  const Vector3 tangent = contacts_.constrained(position_, pull, tolerance());
  const double share = slip(tangent.norm(), (pull - tangent).norm());
  if (share <= 0.0 || tangent.norm() <= tolerance().touching()) return share * tangent;
  const double longest = std::min(kRoundStep * contacts_.smallest_radius(), stride_);
  goal_ = tip;
  ContactSet::Rest rest = contacts_.rest(position_, goal_, tolerance());
  exact = rest.exact && contacts_.size() == 1;
  // The nearest place may lie round the edge, where no way along the edge leads nearer: then a part of the
  // way, pressed on the edge.
  const Vector3 whole = rest.place - position_;
  if (share < 1.0 || whole.norm() > longest || whole.dot(tangent) <= 0.0) {
    exact = false;
    const Vector3 pressed = tangent.normalized() + (pull - tangent).stableNormalized();
    for (const double length : {longest, share * tangent.norm()}) {
      if (length > longest || (share < 1.0 && length == longest)) continue;
      goal_ = position_ + length * pressed;
      rest = contacts_.rest(position_, goal_, tolerance());
      if ((tip - rest.place).squaredNorm() < pull.squaredNorm()) break;
    }
  }
  return rest.place - position_;
}

/// Do the contacts say all about the free space around? Around convex elements that a sphere tip rounds no
/// face ends at an edge: the next contact takes over with the same normal.
bool ScpSolver::rounded() const { return settings_.tip_radius > 0.0 && contacts_.all_convex(); }

/// Leaves a saddle, where the half-spaces of all faces together hold a tip that could still move: a
/// face does not reach beyond its edges. True when there was a way and the SCP moved.
bool ScpSolver::escape(const Vector3& tip) {
  if (contacts_.empty()) return false;
  if (at_edge() && escape_over_edge(tip)) return true;
  const double near = ContactFan::kNeighbourhood * ContactFan::kLength * tolerance().gap;
  if (contacts_.any_smooth() || region_.clearance(position_) < near)
    return in_doubt_ && contacts_.size() == 1
               ? escape_in_the_open(tip)
               : escape_without_one(tip) || (in_doubt_ && escape_in_the_open(tip));
  const std::size_t count = region_.around(position_, near, around_);
  if (region_.overflowed()) return false;
  const std::span<const Element> elements = std::span(around_).first(std::min(count, around_.size()));
  if (count > around_.size() || !ContactFan::knows(elements)) return escape_without_one(tip);
  ContactFan fan(elements, position_, tip - position_, tolerance());
  const std::optional<FanWay> way = fan.steepest(held_gain());
  if (!way) return false;
  position_ = way->end;
  contacts_.clear();
  if (way->on != FanWay::kNone) contacts_.add(elements[way->on]);
  return true;
}

/// Escapes by leaving out one contact at a time; the sweep, which sees surfaces as they are, tells whether
/// that opens a way.
bool ScpSolver::escape_without_one(const Vector3& tip) {
  if (sliding_ || surface().static_friction > 0.0) return false;
  const Vector3 pull = tip - position_;
  const ContactSet all = contacts_;
  for (std::size_t left_out = 0; left_out < all.size() && !spent(); ++left_out) {
    contacts_ = all;
    contacts_.forget_if([&](const Element& contact) { return &contact == &contacts_.all()[left_out]; });
    const Vector3 from = position_;
    goal_ = tip;
    const Vector3 step = contacts_.any_smooth() ? Vector3(contacts_.rest(from, tip, tolerance()).place - from)
                                                : contacts_.constrained(from, pull, tolerance());
    advance(step);
    if ((tip - position_).norm() < pull.norm() - tolerance().touching()) return true;
    position_ = from;
  }
  contacts_ = all;
  return false;
}

/// Looks for a short straight way that is free and leads nearer to the tip. For places where walks along
/// surfaces stop short and contacts say too little, as at nodes, and at the axis of a spiral stair.
bool ScpSolver::escape_in_the_open(const Vector3& tip) {
  if (contacts_.empty() || sliding_ || surface().static_friction > 0.0) return false;
  const Vector3 from = position_;
  const ContactSet held = contacts_;
  const Vector3 pull = tip - from;
  const bool as_before = (from - shut_in_at_).norm() <= tolerance().touching() &&
                         (tip - shut_in_tip_).norm() <= kSamePull * pull.norm();
  if (as_before && !scene_->moves()) return false;
  const double length = std::min(kOpenWay * region_.smallest(), 0.25 * pull.norm());
  const Vector3 onward = pull.stableNormalized(), side = onward.unitOrthogonal(), other = onward.cross(side);
  const auto may_look = [&] { return !spent() && !region_.overflowed(); };
  for (const double cosine : {0.5, 0.77, 0.27, 0.94, 0.12}) {
    const double sine = std::sqrt(1.0 - cosine * cosine);
    for (int i = 0; i < kOpenSides && may_look() && length > tolerance().touching(); ++i) {
      const double turn = 2.0 * std::numbers::pi * i / kOpenSides;
      const Vector3 way =
          length * (cosine * onward + sine * (std::cos(turn) * side + std::sin(turn) * other));
      if (any_swallows(held, from + way)) continue;  // one evaluation tells that
      contacts_.clear();
      advance(way);
      if ((tip - position_).norm() < pull.norm() - 0.05 * length) return true;
      position_ = from;
    }
  }
  contacts_ = held;
  if (may_look()) {
    shut_in_at_ = from;
    shut_in_tip_ = tip;
  }
  return false;
}

/// Is a point tip's SCP held by one flat face only, so near to its edge that rounding decides on which side?
bool ScpSolver::at_edge() const {
  if (contacts_.size() != 1 || held_gain() > 0.0) return false;
  const Element& contact = contacts_.all().front();
  return contact.flat() && contact.tip <= 0.0 &&
         nearest_rim(contact, position_).inside < kEdgeWidth * tolerance().gap;
}

/// Tries the side beyond an edge: a tip that glides along below the edge is held by a face that ends there,
/// and beyond it the way on may be free.
bool ScpSolver::escape_over_edge(const Vector3& tip) {
  const Vector3 from = position_;
  const ContactSet held = contacts_;
  const Rim rim = nearest_rim(held.all().front(), from);
  goal_ = tip;
  advance((std::max(0.0, rim.inside) + tolerance().touching()) * rim.outward);
  if (!met_ && !region_.overflowed()) {
    contacts_.clear();
    for (int i = 0; i < kStepsBeyond && !region_.overflowed(); ++i) {
      bool exact = false;
      advance(next_step(tip, exact));
    }
    if ((tip - position_).norm() < (tip - from).norm() - tolerance().touching()) return true;
  }
  position_ = from;
  contacts_ = held;
  in_doubt_ = false;  // of the flat face that holds it
  return false;
}

/// Forgets contacts that a step leaves and could run into again, as the two sides of a ring's hole.
void ScpSolver::let_go(const Vector3& step) {
  contacts_.forget_if([&](const Element& contact) {
    return !contact.convex() && normal(contact, position_).dot(step) > tolerance().touching();
  });
}

/// The share of a step that friction lets through, where the spring pulls `along` metres sideways and
/// presses by `press` metres: Coulomb's cone in terms of the spring (Harwin and Melder 2002).
double ScpSolver::slip(double along, double press) {
  const Surface& touched = surface();
  if (touched.static_friction <= 0.0 && touched.dynamic_friction <= 0.0) return 1.0;
  const double coefficient = sliding_ ? touched.dynamic_friction : touched.static_friction;
  sliding_ = along > coefficient * press;
  return sliding_ ? 1.0 - touched.dynamic_friction * press / along : 0.0;
}

/// The cosine of the angle between pull and surface up to which friction holds: Coulomb's cone.
double ScpSolver::held_gain() const {
  if (contacts_.empty()) return 0.0;
  const double coefficient = sliding_ ? surface().dynamic_friction : surface().static_friction;
  return coefficient / std::hypot(1.0, coefficient);
}

const Surface& ScpSolver::surface() const { return scene_->objects()[contacts_.all().back().object].surface; }

/// Sweeps the SCP along `wanted`, or as far as the region goes; false when something was in the way.
bool ScpSolver::advance(const Vector3& wanted) {
  const Tolerance& tolerance = region_.tolerance();
  const std::size_t held = contacts_.size();
  if (region_.overflowed()) region_.invalidate();
  const double room = region_.clearance(position_);
  const bool leaves = room < 0.0 || region_.clearance(position_ + wanted) < 0.0;
  const bool long_way = !falling() && (contacts_.empty() || wanted.norm() > region_.reach());
  if (leaves && (long_way || room < least_room())) surround(wanted);
  Vector3 step = within_stride(within_region(wanted));
  const Vector3 from = position_;
  lifted_ = 0.0;
  const bool smooth = contacts_.any_smooth();
  const SweepHit hit = smooth                    ? arch(step)
                       : contacts_.any_guarded() ? hop(step)
                                                 : sweep_on(step, contacts_.all());
  if (region_.overflowed()) {  // too much geometry in too little space: hold still, never pop
    if (!spent()) {
      reach_ *= 0.5;
      ahead_ = std::min(ahead_, 0.5 * (region_.b() - region_.a()).norm());
    }
    return false;
  }
  if (!contacts_.empty()) {  // the length of a fall says nothing about the next slide
    last_slide_ = (position_ - from).norm();
    const double least_stride = kLeastShare * settings_.tip_radius;
    stride_ = kStride * (hit.met ? std::max(last_slide_, least_stride) : stride_);
  }
  fallen_ = contacts_.empty() && !hit.met ? fallen_ + step.norm() : 0.0;
  met_ = hit.met;
  cut_ = !hit.met && step != wanted;
  const bool whole = !hit.met && !cut_ && (!smooth || contacts_.size() == held);
  const double near = std::max(tolerance.touching(), lifted_);
  contacts_.forget_if([&](const Element& contact) {
    return height(contact, position_) > near || !covers(contact, position_, tolerance);
  });
  if (hit.met) contacts_.add(hit.contact);
  return whole;
}

/// Moves the SCP by `step` or to the first hit, which is none of `ignored`.
SweepHit ScpSolver::sweep_on(const Vector3& step, std::span<const Element> ignored) {
  SweepHit hit = region_.sweep(position_, step, ignored);
  if (!region_.overflowed()) position_ += hit.t * step;
  return hit;
}

/// Sweeps as sweep_on() does, but ignores only those contacts that hold the SCP at one of two places:
/// one that is merely near could be gone through.
SweepHit ScpSolver::sweep_past(const Vector3& step, const Vector3& one, const Vector3& other) {
  const double touching = tolerance().touching();
  const auto off = [&](const Element& contact) {
    return height(contact, one) > touching && height(contact, other) > touching;
  };
  if (contacts_.size() == 1 || std::none_of(contacts_.all().begin(), contacts_.all().end(), off))
    return sweep_on(step, contacts_.all());
  ContactSet held = contacts_;
  held.forget_if(off);
  return sweep_on(step, held.all());
}

/// Moves the SCP along contacts that may bulge: in two legs over the bulge. An element that is met up
/// there need not be in the way, but bounds it: it joins the contacts, and the way that all of them allow
/// is tried. `step` becomes the last one that was tried.
SweepHit ScpSolver::arch(Vector3& step) {
  const Vector3 from = position_;
  const Tolerance& tolerance = region_.tolerance();
  double longest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMaxArches && (i == 0 || !spent()); ++i) {
    if (step.norm() > longest) step = rest_within(longest, step);
    const std::optional<Vector3> top = contacts_.lift(from, step, tolerance);
    if (!top || top->norm() > kSteepest * step.norm()) {
      longest = 0.5 * step.norm();
      contacts_.follow(from);
      continue;
    }
    if (region_.clearance(from + step) < 0.0 || region_.clearance(from + 0.5 * step + *top) < 0.0) {
      const double reach = 2.0 * top->norm() + tolerance.behind();
      region_.start(*scene_, frame(), from, from + step, reach);
      scene_->gather(region_);
    }
    const Vector3 end = from + step;
    SweepHit hit;
    if (top->isZero(0.0)) {
      hit = sweep_past(step, from, end);
      if (!hit.met || !holds(hit.contact)) return hit;
    } else {
      hit = sweep_past(0.5 * step + *top, from, from);
      if (!hit.met && !region_.overflowed()) hit = sweep_past(end - position_, end, end);
      if (!hit.met && !region_.overflowed()) return hit;
      // No time is left to tell what is in the way: the part of the step that is surely free counts.
      if (spent() && settings_.tip_radius <= 0.0 && !region_.overflowed() && nearer(from, goal_)) {
        step = position_ - from;
        lifted_ = 2.0 * top->norm();
        return {};
      }
    }
    position_ = from;
    if (region_.overflowed()) return hit;
    if (holds(hit.contact)) {
      longest = 0.5 * step.norm();
      continue;
    }
    contacts_.add(hit.contact);
    contacts_.follow(from);  // the met element may have its foot farther on
    step = contacts_.rest(from, goal_, tolerance).place - from;
  }
  step.setZero();
  return {};
}

/// Moves the SCP along rounded edges and corners of a mesh: in two legs over the bulge, or as far as
/// these are free. An SCP that is stopped above a contact keeps it, as it bounds the way back down.
SweepHit ScpSolver::hop(Vector3& step) {
  const Vector3 from = position_;
  for (int i = 0; i < kMaxArches; ++i) {
    const std::optional<Vector3> top = contacts_.lift(from, step, tolerance());
    if (!top || top->norm() > kSteepest * step.norm()) {
      step = rest_within(0.5 * step.norm(), step);
      continue;
    }
    if (top->isZero(0.0)) return sweep_past(step, from, from + step);
    if (region_.overflowed() || region_.clearance(from + 0.5 * step + *top) < 0.0) {
      gather(step, std::max(reach_, 2.0 * top->norm()), kMostAhead);
      if (region_.overflowed()) {
        if (spent()) return {};
        step = rest_within(0.5 * step.norm(), step);
        continue;
      }
    }
    const Vector3 end = from + step;
    SweepHit hit = sweep_past(0.5 * step + *top, from, from);
    if (!hit.met && !region_.overflowed()) hit = sweep_past(end - position_, end, end);
    if (hit.met) lifted_ = 2.0 * top->norm();
    return hit;
  }
  step.setZero();
  return {};
}

bool ScpSolver::holds(const Element& element) const {
  return std::any_of(contacts_.all().begin(), contacts_.all().end(),
                     [&](const Element& contact) { return same_surface(contact, element); });
}

/// A step along the contacts about `length` long, in the direction of a longer one; zero if that is zero.
Vector3 ScpSolver::rest_within(double length, const Vector3& step) {
  if (step.isZero(0.0)) return step;
  const Vector3 part = (length / step.norm()) * step;
  return contacts_.rest(position_, position_ + part, tolerance()).place - position_;
}

/// A step of a sphere tip along faces, no longer than a few times the progress of the last one: the way to a
/// tip far off leads deep into solids that will stop it soon.
Vector3 ScpSolver::within_stride(const Vector3& step) const {
  const auto flat = [](const Element& contact) { return contact.flat(); };
  const bool straight = std::all_of(contacts_.all().begin(), contacts_.all().end(), flat);
  const double length = step.norm();
  return settings_.tip_radius > 0.0 && straight && length > stride_ ? Vector3(step * (stride_ / length))
                                                                    : step;
}

/// The beginning of a step that would leave the region.
Vector3 ScpSolver::within_region(const Vector3& step) {
  if (region_.clearance(position_ + step) >= 0.0) return step;
  if (on_chords()) return chord_within_region(step);
  const double part = region_.share_within(position_, step);
  if (contacts_.size() > 1 && contacts_.any_smooth()) {
    return rest_within(0.5 * part * step.norm(), step);
  }
  if (contacts_.size() != 1 || contacts_.all().front().flat()) return part * step;
  if (height(contacts_.all().front(), position_ + step) > tolerance().touching()) return part * step;
  // Half-way along a chord the SCP would lie in the solid: end on the surface, which the region covers
  // if the chord is short enough.
  const Element& contact = contacts_.all().front();
  for (double share = part; share > kLeastShare * part; share *= 0.5) {
    const Vector3 end = settle(contact, position_ + share * step, tolerance());
    if (region_.clearance(end) >= 0.0) return end - position_;
  }
  return Vector3::Zero();
}

/// Is a sphere tip held by elements of meshes only? Then the end of any step is free; on a primitive it
/// may lie half-way along a chord.
bool ScpSolver::on_mesh() const {
  const auto of_mesh = [](const Element& contact) { return contact.flat() || contact.guarded; };
  return settings_.tip_radius > 0.0 && !contacts_.empty() &&
         std::all_of(contacts_.all().begin(), contacts_.all().end(), of_mesh);
}

/// Do steps lead along chords round edges and corners of a mesh?
bool ScpSolver::on_chords() const { return contacts_.any_guarded() && !contacts_.any_smooth(); }

/// A chord round an edge that the region holds: half as long until it does, as surround() shortens its way
/// ahead. A beginning of the whole chord would lie in the edge.
Vector3 ScpSolver::chord_within_region(Vector3 chord) {
  for (int i = 0; i < kMaxHalvings; ++i) {
    chord = rest_within(0.5 * chord.norm(), chord);
    if (region_.clearance(position_ + chord) >= 0.0) return chord;
  }
  return Vector3::Zero();
}

double ScpSolver::largest_reach() const { return kLargestReach * scene_->extent(); }

/// Gathers the region anew: around the SCP and ahead of it. Too many pieces are slow to sweep, so the
/// region shrinks until few are left or it is as small as the motion allows. It also looks no farther than
/// the objects near by are large, or objects far off would decide which lengths are small here.
void ScpSolver::surround(const Vector3& step) {
  Vector3 ahead = way_ahead(step);
  const bool bent = on_chords();
  const auto shorten = [&] { ahead = bent ? rest_within(0.5 * ahead.norm(), ahead) : Vector3(0.5 * ahead); };
  for (int i = 0; i < kMaxHalvings && ahead.norm() > kMaxAheadGrowth * ahead_; ++i) shorten();
  bool all_ahead = ahead.norm() <= ahead_;
  const double least_reach = std::max(0.25 * tip_motion_, kLeastOfTip * settings_.tip_radius);
  reach_ = std::max(reach_, kLeastShare * least_reach);
  for (int i = 0; i < kMaxShrinks; ++i) {
    const double bulge = bent ? kBulge * ahead.squaredNorm() / contacts_.smallest_radius() : 0.0;
    const bool least = reach_ <= std::max(least_reach, bulge);
    const bool near = ahead.norm() <= reach_;
    gather(ahead, std::max(reach_, bulge), !least ? kManyPieces : near ? ContactRegion::kPieces : kMostAhead);
    const double wide = std::max(least_reach, region_.smallest());
    if (region_.overflowed()) {
      if (spent()) break;
      if (least && !near) {
        shorten();
        all_ahead = false;
      } else {
        reach_ *= 0.5;
      }
    } else if (reach_ > wide) {
      reach_ = wide;
    } else {
      break;
    }
  }
  ahead_ = all_ahead ? std::numeric_limits<double>::infinity() : ahead.norm();
  if (region_.size() < kFewPieces)
    reach_ = std::min({1.4 * reach_, largest_reach(), std::max(least_reach, region_.smallest())});
}

/// Gathers around the SCP and the way `ahead`, as much as this tick's budget still allows.
void ScpSolver::gather(const Vector3& ahead, double reach, std::size_t most_pieces) {
  const std::uint64_t left =
      ContactRegion::kPiecesForAnElement * (budget_ - std::min(budget_, region_.work()));
  region_.start(*scene_, frame(), position_, position_ + ahead, reach,
                std::size_t(std::min<std::uint64_t>(most_pieces, left)));
  scene_->gather(region_);
}

/// Is this tick's budget spent?
bool ScpSolver::spent() const { return region_.work() >= budget_ || geometry::FormulaAllowance::spent(); }

/// The room (m) in its region with less of which the SCP had better have another region.
double ScpSolver::least_room() const { return kLeastRoom * std::max(reach_, region_.reach()); }

/// Is the SCP in the air between two places of a surface? Then its step points at the tip, which says
/// little about how far it will go.
bool ScpSolver::falling() const { return contacts_.empty() && state_.touching; }

/// The probable way of the SCP: as a rule on, as in the last tick, for a few ticks.
Vector3 ScpSolver::way_ahead(const Vector3& step) {
  const double length = step.norm();
  const Vector3 on = kTicksAhead * drift_;
  if (falling()) {
    const double likely = std::min(length, std::max(tip_motion_, last_slide_));
    // Looking ahead twice as far as it fell, a long fall takes few regions.
    if (fallen_ > 0.0) return step * std::min(1.0, std::max(likely, 2.0 * fallen_) / length);
    return on.norm() >= likely ? on : Vector3(step * (likely / length));
  }
  // A chord round an edge is short as it is; a beginning of it would lie in the edge.
  if (on_chords()) return step;
  // The step of a sphere tip that is pulled far along a surface leads into much that it will not reach. One
  // that has gone far in this tick will go on: looking ahead as far again, a long way takes few regions.
  const double farthest =
      std::max({tip_motion_, kFarthest * settings_.tip_radius, (position_ - tick_start_).norm()});
  if (!contacts_.empty() && settings_.tip_radius > 0.0 && length > farthest)
    return step * (farthest / length);
  const double beside = on.cross(step).norm();
  return on.dot(step) >= step.squaredNorm() && beside <= 0.5 * reach_ * on.norm() ? on : step;
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
    if (contacts_.empty() && state_.converged) state_.scp = origin_ + tip;
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
