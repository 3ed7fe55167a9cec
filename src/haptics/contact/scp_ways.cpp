// The ways that the contacts leave to the SCP: along them, and out of places where they say too little.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/implicit/formula_allowance.h"
#include "haptics/contact/contact_fan.h"
#include "haptics/contact/scp_solver.h"
#include "haptics/shapes/smooth_element.h"

namespace icome::haptics {
namespace {

constexpr double kOpenWay = 2e-3;  // of the size of the smallest near object: length of that way
constexpr int kOpenSides = 24;
constexpr double kSamePull = 0.05;     // of its length: a change that opens no way
constexpr double kRoundStep = 0.28;    // rad, along a rounded edge: no way over it is then too steep
constexpr double kShorter = 0.25;      // of a way along a rounded edge that is too long
constexpr double kEdgeWidth = 1024.0;  // gaps: what files round positions to
constexpr int kStepsBeyond = 3;  // of an edge: to the next face, along it, and along the seam with another

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

/// Is a place within a smooth solid that is touched, or was when the tick began?
bool ScpSolver::swallowed(const Vector3& position) const {
  return any_swallows(last_contacts_, position) || any_swallows(contacts_, position);
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
  const geometry::FormulaAllowance allowance{most_evaluations() / 2};
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
  const Vector3 whole = rest.place - position_;
  const bool onward = whole.dot(tangent) > 0.0;
  if (share >= 1.0 && onward && whole.norm() <= longest) return whole;
  exact = false;
  const auto leads_nearer = [&](const Vector3& part) {
    goal_ = position_ + part;
    rest = contacts_.rest(position_, goal_, tolerance());
    return (tip - rest.place).squaredNorm() < pull.squaredNorm();
  };
  // The nearest place may lie round the edge, where no way along the edge leads nearer: then a part of the
  // way, pressed on the edge. A tip near the middle of the rounding pulls round it by next to nothing,
  // however long the way is; then a part of the whole way, or shorter ones.
  const Vector3 pressed = tangent.normalized() + (pull - tangent).stableNormalized();
  const double length = std::min(longest, share * tangent.norm());
  if (share >= 1.0) {
    if (leads_nearer(longest * pressed)) return rest.place - position_;
    const bool part_of_whole = onward && contacts_.size() == 1;
    if (part_of_whole && leads_nearer((longest / whole.norm()) * whole)) return rest.place - position_;
    for (double shorter = kShorter * longest; shorter > length; shorter *= kShorter)
      if (leads_nearer(shorter * pressed)) return rest.place - position_;
  }
  leads_nearer(length * pressed);
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
  for (const double cosine : {0.5, 0.77, 0.27, 0.94, 0.12, 0.04}) {
    const double sine = std::sqrt(1.0 - cosine * cosine);
    for (int i = 0; i < kOpenSides && may_look() && length > tolerance().touching(); ++i) {
      const double turn = 2.0 * std::numbers::pi * i / kOpenSides;
      const Vector3 way =
          length * (cosine * onward + sine * (std::cos(turn) * side + std::sin(turn) * other));
      if (any_swallows(held, from + way)) continue;  // one evaluation tells that
      contacts_.clear();
      advance(way);
      if ((tip - position_).norm() < pull.norm() - std::min(0.05, 0.5 * cosine) * length) return true;
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

}  // namespace icome::haptics
