// Moving the SCP along a way as far as it is free, in a region of pieces that is gathered around it.
#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/implicit/formula_allowance.h"
#include "haptics/contact/scp_solver.h"

namespace icome::haptics {
namespace {

// A region should hold enough pieces to serve several ticks and few enough to sweep quickly.
constexpr std::size_t kFewPieces = 12;
constexpr std::size_t kManyPieces = 48;
constexpr std::size_t kManyForRest = 160;  // likewise, gathered between two ticks
constexpr std::size_t kMostAhead = 1024;   // with more the region looks less far ahead
constexpr double kWholeReach = 0.5;        // of a step: reach of a region that keeps meshes whole
constexpr double kTicksAhead = 4.0;
constexpr double kLeastShare = 1e-3;
constexpr double kLeastRoom = 0.25;    // of a region's reach: with less room the SCP needs another region
constexpr double kLeastOfTip = 1e-3;   // of its radius: least reach of a region
constexpr double kLargestReach = 0.1;  // of the scene's extent
constexpr int kMaxShrinks = 48;
constexpr int kMaxArches = 12;
constexpr double kMaxAheadGrowth = 2.0;  // of the way that a region looks ahead, after one that overflowed
constexpr double kSteepest = 0.1;        // rise of an arch for its length
constexpr double kStride = 8.0;          // longest slide of a sphere tip, in lengths of its last one
constexpr double kSwing = 0.5;           // of the last step, after one to and one fro
constexpr double kFarthest = 0.3;        // of its radius: a region's way ahead of a sphere tip in contact
constexpr double kBulge = 0.3;    // rise of a way over an edge, times its radius, for the squared chord
constexpr double kLeftOff = 0.5;  // of a step: height above contacts that are kept after it
constexpr int kMaxHalvings = 24;  // of such a chord, until a region holds it

}  // namespace

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
  const bool rounded = !smooth && contacts_.any_guarded();
  const SweepHit hit = smooth ? arch(step) : rounded ? hop(step) : sweep_on(step, contacts_.all());
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
    if (rounded) limit_swing(position_ - from, least_stride);
  }
  fallen_ = contacts_.empty() && !hit.met ? fallen_ + step.norm() : 0.0;
  met_ = hit.met;
  cut_ = !hit.met && step != wanted;
  const bool whole = !hit.met && !cut_ && (!smooth || contacts_.size() == held);
  // Off a rounded edge the way on may lead back to what the SCP has just left, which bounds it.
  const double left = rounded ? kLeftOff * (position_ - from).norm() : 0.0;
  const double near = std::max({tolerance.touching(), lifted_, left});
  contacts_.forget_if([&](const Element& contact) {
    const bool met_again = hit.met && same_surface(contact, hit.contact);
    return met_again || height(contact, position_) > near || !covers(contact, position_, tolerance);
  });
  if (hit.met) contacts_.add(hit.contact);
  return whole;
}

/// Halves the next steps of an SCP that goes to and fro without coming nearer to the tip: between two walls
/// of a groove each chord may lead past the place that both allow.
void ScpSolver::limit_swing(const Vector3& move, double least_stride) {
  const bool farther = !nearer(position_ - move, last_tip_);
  if ((farther || led_farther_) && move.dot(last_move_) < 0.0)
    stride_ = std::min(stride_, std::max(least_stride, kSwing * last_slide_));
  last_move_ = move;
  led_farther_ = farther;
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
    const bool on = !hit.met && !region_.overflowed();
    if (on && spent()) {
      step = position_ - from;
    } else if (on) {
      hit = sweep_past(end - position_, end, end);
    }
    if (hit.met || spent()) lifted_ = 2.0 * top->norm();
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
  const auto bulge = [&] { return bent ? kBulge * ahead.squaredNorm() / contacts_.smallest_radius() : 0.0; };
  bool may_be_whole = settings_.tip_radius > 0.0 && !contacts_.any_smooth();
  if (may_be_whole && crowded_ && gather_whole(step, ahead, std::max(reach_, bulge()))) return;
  for (int i = 0; i < kMaxShrinks; ++i) {
    const bool least = reach_ <= std::max(least_reach, bulge());
    const bool near = ahead.norm() <= reach_;
    const std::size_t few = may_be_whole && !in_tick_ ? kManyForRest : kManyPieces;
    const std::size_t many = near ? ContactRegion::kPieces : kMostAhead;
    gather(ahead, std::max(reach_, bulge()), may_be_whole || !least ? few : many);
    const double wide = std::max(least_reach, region_.smallest());
    if (region_.overflowed()) {
      if (spent()) break;
      if (std::exchange(may_be_whole, false)) {
        if (!gather_whole(step, ahead, std::max(reach_, bulge()))) continue;
        reach_ = std::max(least_reach, 0.5 * reach_);
        return;
      }
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

/// Gathers a region that keeps meshes whole, for the rest of the tick: a large tip is near so many pieces
/// that fetching them for each piece of its way costs more than finding in the mesh's tree what is on it.
bool ScpSolver::gather_whole(const Vector3& step, const Vector3& ahead, double reach) {
  const double wide = std::max(reach, kWholeReach * step.norm());
  region_.start(*scene_, frame(), position_, position_ + ahead, wide, kManyPieces);
  region_.keep_whole();
  scene_->gather(region_);
  crowded_ = !region_.overflowed();
  return crowded_;
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

}  // namespace icome::haptics
