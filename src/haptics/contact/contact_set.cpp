#include "haptics/contact/contact_set.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "haptics/shapes/smooth_element.h"

namespace icome::haptics {
namespace {

constexpr int kMaxRests = 24;          // steps towards a place of rest
constexpr double kCloseEnough = 0.98;  // cosine between normals (0.2 rad)
constexpr double kLessPull = 0.2;      // share of the pull that is kept when contacts turn too much
constexpr int kMaxTurns = 4;           // times that it may be cut so
constexpr double kMaxGrowth = 8.0;     // of the share from one step to the next, either way
constexpr double kNudge = 1e-3;        // share of the pull that presses on contacts, less each time
constexpr int kMaxSettles = 4;
constexpr double kFall = 2.0;  // heights above contacts: the length of the pull that lets a place fall
constexpr double kRoom = 1.1;  // lift of a way, relative to the least that it needs

/// normal . step >= least
struct HalfSpace {
  Vector3 normal;
  double least;
};

/// The half-spaces of a contact set, and the search for the active ones among them.
class Polyhedron {
 public:
  static constexpr std::size_t kCapacity = 4 * ContactSet::kCapacity;

  Polyhedron(std::span<const Footing> footings, const Tolerance& tolerance) : slack_(0.25 * tolerance.gap) {
    for (const Footing& it : footings) planes_[count_++] = {it.normal, tolerance.gap - it.height};
  }

  /// The projection of `pull`; zero where rounding leaves no candidate, which keeps the SCP where it is.
  Vector3 project(const Vector3& pull) const {
    if (allows(pull)) return pull;
    for (std::size_t i = 0; i < count_; ++i) {
      if (const auto step = on_one(pull, planes_[i]); step && allows(*step)) return *step;
    }
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (const auto step = on_two(pull, planes_[i], planes_[j]); step && allows(*step)) return *step;
      }
    }
    return nearest_corner(pull);
  }

 private:
  static constexpr double kParallel = 1e-12;

  Vector3 nearest_corner(const Vector3& pull) const {
    Vector3 nearest = Vector3::Zero();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        for (std::size_t k = 0; k < j; ++k) {
          const auto step = on_three(planes_[i], planes_[j], planes_[k]);
          if (!step || (*step - pull).squaredNorm() >= least || !allows(*step)) continue;
          nearest = *step;
          least = (*step - pull).squaredNorm();
        }
      }
    }
    return nearest;
  }

  bool allows(const Vector3& step) const {
    return std::all_of(planes_.begin(), planes_.begin() + count_, [&](const HalfSpace& plane) {
      return plane.normal.dot(step) >= plane.least - slack_;
    });
  }

  static std::optional<Vector3> on_one(const Vector3& pull, const HalfSpace& plane) {
    const double push = plane.least - plane.normal.dot(pull);
    if (push < 0.0) return std::nullopt;
    return pull + push * plane.normal;
  }

  /// Both multipliers of the projection onto the line where two planes meet must push outwards. By the sum
  /// and the difference of the normals, which are at right angles: nearly parallel planes lose no digits.
  static std::optional<Vector3> on_two(const Vector3& pull, const HalfSpace& one, const HalfSpace& other) {
    const Vector3 sum = one.normal + other.normal, difference = one.normal - other.normal;
    if (sum.squaredNorm() * difference.squaredNorm() < 4.0 * kParallel) return std::nullopt;
    const double a = one.least - one.normal.dot(pull);
    const double b = other.least - other.normal.dot(pull);
    const double by_sum = (a + b) / sum.squaredNorm();
    const double by_difference = (a - b) / difference.squaredNorm();
    if (by_sum < std::abs(by_difference)) return std::nullopt;
    return pull + by_sum * sum + by_difference * difference;
  }

  /// Three planes meet in a point: the corner of the gap, next to where the SCP is.
  static std::optional<Vector3> on_three(const HalfSpace& i, const HalfSpace& j, const HalfSpace& k) {
    const Vector3 across = j.normal.cross(k.normal);
    const double volume = i.normal.dot(across);
    if (volume * volume < kParallel) return std::nullopt;
    return (i.least * across + j.least * k.normal.cross(i.normal) + k.least * i.normal.cross(j.normal)) /
           volume;
  }

  double slack_;
  std::size_t count_ = 0;
  std::array<HalfSpace, kCapacity> planes_;
};

/// The share of the pull at which the slope, which shrank by `shrunk` over the way `moved`, vanishes.
double secant(double share, const Vector3& moved, const Vector3& shrunk) {
  const double bend = moved.dot(shrunk);
  const double most = kMaxGrowth * share;
  return bend * most > moved.squaredNorm() ? std::max(moved.squaredNorm() / bend, share / kMaxGrowth) : most;
}

}  // namespace

void ContactSet::add(const Element& element) {
  if (size_ == kCapacity) {
    std::move(elements_.begin() + 1, elements_.end(), elements_.begin());
    --size_;
  }
  elements_[size_++] = element;
}

Vector3 ContactSet::constrained(const Vector3& position, const Vector3& pull,
                                const Tolerance& tolerance) const {
  const Footings at = footings(position);
  return Polyhedron(std::span(at).first(size_), tolerance).project(pull);
}

bool ContactSet::any_smooth() const {
  return std::any_of(elements_.begin(), elements_.begin() + size_,
                     [](const Element& e) { return e.smooth(); });
}

bool ContactSet::all_convex() const {
  return std::all_of(elements_.begin(), elements_.begin() + size_,
                     [](const Element& e) { return e.convex(); });
}

bool ContactSet::any_guarded() const {
  return std::any_of(elements_.begin(), elements_.begin() + size_,
                     [](const Element& e) { return e.guarded; });
}

double ContactSet::smallest_radius() const {
  double least = std::numeric_limits<double>::infinity();
  for (const Element& e : all()) {
    if (!e.flat()) least = std::min(least, e.radius);
  }
  return least;
}

ContactSet::Footings ContactSet::footings(const Vector3& position) const {
  Footings result;
  for (std::size_t i = 0; i < size_; ++i) result[i] = footing(elements_[i], position);
  return result;
}

void ContactSet::follow(const Vector3& position) {
  for (Element& contact : all()) {
    if (contact.smooth()) follow_projection(contact, position);
  }
}

ContactSet::Rest ContactSet::rest_on_one(const Vector3& goal, const Tolerance& tolerance) {
  Element& contact = elements_.front();
  const auto [place, sure] = contact.smooth() ? settle_ahead(contact, goal, tolerance)
                                              : SettledAhead{settle(contact, goal, tolerance), true};
  const Vector3 out = footing(contact, place).normal;
  const Vector3 pull = goal - place;
  const double press = -out.dot(pull);
  const double along = (pull + press * out).norm();
  return {place, press >= 0.0 && along <= tolerance.gap, sure};
}

bool ContactSet::all_sure(const Footings& now) const {
  return std::all_of(now.begin(), now.begin() + size_, [](const Footing& it) { return it.sure; });
}

/// Have smooth contacts turned so much that a straight way says little?
bool ContactSet::turned(const Footings& before, const Footings& now) const {
  for (std::size_t i = 0; i < size_; ++i) {
    if (!now[i].sure || (elements_[i].smooth() && now[i].normal.dot(before[i].normal) < kCloseEnough))
      return true;
  }
  return false;
}

bool ContactSet::free(const Footings& now, const Tolerance& tolerance) const {
  return std::all_of(now.begin(), now.begin() + size_,
                     [&](const Footing& it) { return it.height >= 0.5 * tolerance.gap; });
}

// Projected gradient steps with the step lengths of Barzilai and Borwein (1988): along an edge curve that
// is the secant method, and the curves' radii need not be known.
ContactSet::Rest ContactSet::rest(const Vector3& position, const Vector3& goal, const Tolerance& tolerance) {
  if (size_ == 1) return rest_on_one(goal, tolerance);
  const Footings before = footings(position);
  Footings now = before;
  Vector3 best = position;  // on the free side of all contacts
  Vector3 at = position;
  Vector3 last_at = position;
  Vector3 last_slope = Vector3::Zero();
  // Of the pull. A longer one than roundings are wide would lead beyond what their tangent planes tell.
  double share = any_smooth() ? 1.0 : std::min(1.0, smallest_radius() / (goal - position).norm());
  double most = std::numeric_limits<double>::infinity();
  int turns = 0;
  bool sure = all_sure(before);
  for (int i = 0; i < kMaxRests && turns < kMaxTurns; ++i) {
    const Vector3 slope = along(now, goal - at, tolerance);
    if (at != last_at) share = std::min(most, secant(share, at - last_at, last_slope - slope));
    const Vector3 step = Polyhedron(std::span(now).first(size_), tolerance).project(share * (goal - at));
    if (step.norm() <= tolerance.gap && free(now, tolerance)) return {at, true, sure};
    Footings there = footings(at + step);
    sure = sure && all_sure(there);
    last_at = at;
    last_slope = slope;
    if (turned(before, there)) {
      share = most = kLessPull * share;
      ++turns;
      continue;
    }
    const auto is_nearer = [&](const Vector3& place) {
      return (goal - place).norm() <= (goal - best).norm() + tolerance.gap;
    };
    Vector3 next = at + step;
    if (free(there, tolerance) && !is_nearer(next)) {
      // Where contacts bulge, the end of a straight step lies above them.
      next = fallen(next, there, goal, tolerance);
      there = footings(next);
      if (!free(there, tolerance) || !is_nearer(next)) {
        share = most = kLessPull * share;
        at = last_at = best;
        now = footings(at);
        continue;
      }
    }
    at = next;
    now = there;
    if (free(now, tolerance)) best = at;
  }
  return {settled(at, best, goal, tolerance), false, sure};
}

/// The part of a pull that the contacts do not hold, were the tip on them.
Vector3 ContactSet::along(Footings at, const Vector3& pull, const Tolerance& tolerance) const {
  for (Footing& it : at) it.height = tolerance.gap;
  return Polyhedron(std::span(at).first(size_), tolerance).project(pull);
}

/// A place above the contacts, fallen towards `goal` as far as they let it, hardly sideways.
Vector3 ContactSet::fallen(const Vector3& place, const Footings& at, const Vector3& goal,
                           const Tolerance& tolerance) const {
  double highest = 0.0;
  for (std::size_t i = 0; i < size_; ++i) highest = std::max(highest, at[i].height);
  const Vector3 pull = goal - place;
  const double share = std::min(1.0, kFall * highest / std::max(pull.norm(), tolerance.gap));
  return place + Polyhedron(std::span(at).first(size_), tolerance).project(share * pull);
}

/// Lets a place near the contacts fall onto them, hardly sideways, if that is nearer to `goal` than `best`.
Vector3 ContactSet::settled(Vector3 at, Vector3 best, const Vector3& goal, const Tolerance& tolerance) const {
  Footings now = footings(at);
  double nudge = 1.0;
  for (int i = 0; i < kMaxSettles; ++i) {
    nudge *= kNudge;
    at += Polyhedron(std::span(now).first(size_), tolerance).project(nudge * (goal - at));
    now = footings(at);
    if (free(now, tolerance) && (goal - at).squaredNorm() < (goal - best).squaredNorm()) best = at;
  }
  return best;
}

namespace {

/// The conditions on the lift that is added to the middle of a straight way.
class Clearance {
 public:
  Clearance(const Vector3& position, const Vector3& step, const Tolerance& tolerance)
      : position_(position), step_(step), tolerance_(tolerance) {}

  /// Adds the conditions of a contact: where it touches, neither leg may begin, or end, below the
  /// tangent plane; elsewhere neither may dip in its middle.
  void pass(const Element& contact) {
    const Footing middle = look(contact, position_ + 0.5 * step_);
    need(middle.normal, tolerance_.gap - middle.height);
    if (contact.flat()) return;
    bulges_ = bulges_ || tolerance_.gap - middle.height > tolerance_.gap;
    pass_end(contact, position_, -step_, 0.25);
    pass_end(contact, position_ + step_, step_, 0.75);
  }

  /// Adds the condition of a contact at the lifted middle: sideways the surface may have risen.
  void pass_top(const Element& contact, const Vector3& added) {
    const Footing top = look(contact, position_ + 0.5 * step_ + added);
    if (top.height < tolerance_.gap) need(top.normal, top.normal.dot(added) + tolerance_.gap - top.height);
  }

  /// The least lift that meets the conditions: zero where nothing bulges, nothing where there is no way or
  /// the end is too far to tell.
  std::optional<Vector3> least() const {
    if (!sure_) return std::nullopt;
    if (!bulges_) return Vector3::Zero();
    const Vector3 result = Polyhedron(std::span(needs_).first(count_), tolerance_).project(Vector3::Zero());
    return result.isZero(0.0) ? std::nullopt : std::optional(result);
  }

 private:
  Footing look(const Element& contact, const Vector3& at) {
    const Footing result = footing(contact, at);
    sure_ = sure_ && result.sure;
    return result;
  }

  void pass_end(const Element& contact, const Vector3& end, const Vector3& onwards, double quarter) {
    const Footing there = look(contact, end);
    if (there.height <= tolerance_.touching()) {
      need_to_clear(there.normal, 0.5 * there.normal.dot(onwards));
    } else {
      const Footing middle = look(contact, position_ + quarter * step_);
      need_to_clear(middle.normal, 2.0 * (tolerance_.gap - middle.height));
    }
  }

  void need_to_clear(const Vector3& normal, double least) {
    bulges_ = bulges_ || least > tolerance_.gap;
    need(normal, least);
  }

  void need(const Vector3& normal, double least) {
    needs_[count_++] = {tolerance_.gap - (least > 0.0 ? kRoom * least : least), normal};
  }

  const Vector3 position_, step_;
  const Tolerance& tolerance_;
  std::array<Footing, Polyhedron::kCapacity> needs_;
  std::size_t count_ = 0;
  bool bulges_ = false;
  bool sure_ = true;
};

}  // namespace

std::optional<Vector3> ContactSet::lift(const Vector3& position, const Vector3& step,
                                        const Tolerance& tolerance) const {
  Clearance clearance(position, step, tolerance);
  for (const Element& contact : all()) clearance.pass(contact);
  const std::optional<Vector3> least = clearance.least();
  if (!least || least->isZero(0.0) || size_ == 1) return least;
  for (const Element& contact : all()) clearance.pass_top(contact, *least);
  return clearance.least();
}

}  // namespace icome::haptics
