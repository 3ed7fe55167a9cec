#include "haptics/contact_set.h"

#include <algorithm>
#include <cmath>

#include "haptics/smooth_element.h"

namespace icome::haptics {
namespace {

constexpr int kMaxRests = 24;          // steps towards a place of rest
constexpr double kOpposite = 0.1;      // cosine: walls so much against each other leave no way up
constexpr double kCloseEnough = 0.98;  // cosine between normals (0.2 rad)
constexpr double kLessPull = 0.2;      // share of the pull that is kept when contacts turn too much
constexpr int kMaxTurns = 4;           // times that it may be cut so
constexpr double kMaxGrowth = 8.0;     // of the share from one step to the next, either way
constexpr double kNudge = 1e-3;        // share of the pull that presses on contacts without sliding far
constexpr double kRounding = 1e-14;    // of squared distances
constexpr int kMaxSettles = 3;
constexpr double kRoom = 1.1;  // how much further than need be a way is lifted

/// normal . step >= least
struct HalfSpace {
  Vector3 normal;
  double least;
};

/// The half-spaces of a contact set, and the search for the active ones among them.
class Polyhedron {
 public:
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
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        for (std::size_t k = 0; k < j; ++k) {
          if (const auto step = on_three(planes_[i], planes_[j], planes_[k]); step && allows(*step))
            return *step;
        }
      }
    }
    return Vector3::Zero();
  }

 private:
  static constexpr double kParallel = 1e-12;

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

  /// Both multipliers of the projection onto the line where two planes meet must push outwards.
  static std::optional<Vector3> on_two(const Vector3& pull, const HalfSpace& one, const HalfSpace& other) {
    const double cosine = one.normal.dot(other.normal);
    const double determinant = 1.0 - cosine * cosine;
    if (determinant < kParallel) return std::nullopt;
    const double a = one.least - one.normal.dot(pull);
    const double b = other.least - other.normal.dot(pull);
    const double push_one = (a - cosine * b) / determinant;
    const double push_other = (b - cosine * a) / determinant;
    if (push_one < 0.0 || push_other < 0.0) return std::nullopt;
    return pull + push_one * one.normal + push_other * other.normal;
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
  std::array<HalfSpace, ContactSet::kCapacity> planes_;
};

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

ContactSet::Footings ContactSet::footings(const Vector3& position) const {
  Footings result;
  for (std::size_t i = 0; i < size_; ++i) result[i] = footing(elements_[i], position);
  return result;
}

ContactSet::Footings ContactSet::follow(const Vector3& position) {
  Footings result;
  for (std::size_t i = 0; i < size_; ++i) {
    Element& contact = elements_[i];
    result[i] = contact.smooth() ? follow_foot(contact, position) : footing(contact, position);
  }
  return result;
}

ContactSet::Rest ContactSet::rest_on_one(const Vector3& goal, const Tolerance& tolerance) {
  Element& contact = elements_.front();
  const Vector3 place = settle(contact, goal, tolerance);
  const Vector3 out = follow_foot(contact, place).normal;
  const Vector3 pull = goal - place;
  const double along = (pull - out * out.dot(pull)).norm();
  return {place, along <= tolerance.gap};
}

/// Have smooth contacts turned so much that a straight way says little?
bool ContactSet::turned(const Footings& before, const Footings& now) const {
  for (std::size_t i = 0; i < size_; ++i) {
    if (elements_[i].smooth() && now[i].normal.dot(before[i].normal) < kCloseEnough) return true;
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
  const Footings before = follow(position);
  Footings now = before;
  Vector3 best = position;  // on the free side of all contacts
  Vector3 at = position;
  Vector3 last = Vector3::Zero();  // step of the whole pull
  double share = 1.0;              // of the pull
  int turns = 0;
  for (int i = 0; i < kMaxRests && turns < kMaxTurns; ++i) {
    const Vector3 step = Polyhedron(std::span(now).first(size_), tolerance).project(share * (goal - at));
    if (step.norm() <= tolerance.gap && free(now, tolerance)) return {at, true};
    const Footings there = follow(at + step);
    if (turned(before, there)) {
      share *= kLessPull;
      now = follow(at);
      ++turns;
      continue;
    }
    const bool nearer = (goal - at - step).squaredNorm() <= (1.0 + kRounding) * (goal - best).squaredNorm();
    if (free(there, tolerance) && !nearer) {
      share *= kLessPull;
      at = best;
      now = follow(at);
      last.setZero();
      continue;
    }
    at += step;
    now = there;
    if (free(now, tolerance)) best = at;
    const Vector3 whole = step / share;
    if (!last.isZero(0.0)) {
      const double shrunk = 1.0 - whole.dot(last) / last.squaredNorm();
      share = shrunk * kMaxGrowth > 1.0 ? std::max(share / shrunk, share / kMaxGrowth) : share * kMaxGrowth;
    }
    last = whole;
  }
  return {settled(best, goal, tolerance), false};
}

/// Down to the contacts from a place little above them, hardly sideways.
Vector3 ContactSet::settled(const Vector3& place, const Vector3& goal, const Tolerance& tolerance) {
  Vector3 best = place;
  Vector3 at = place;
  Footings now = follow(at);
  for (int i = 0; i < kMaxSettles; ++i) {
    at += Polyhedron(std::span(now).first(size_), tolerance).project(kNudge * (goal - at));
    now = follow(at);
    if (free(now, tolerance)) best = at;
  }
  if (best != at) follow(best);
  return best;
}

std::optional<Vector3> ContactSet::lift(const Vector3& position, const Vector3& step,
                                        const Tolerance& tolerance) const {
  const Footings here = footings(position);
  double most = 0.0;
  Vector3 out = Vector3::Zero();
  for (std::size_t i = 0; i < size_; ++i) {
    out += here[i].normal;
    if (elements_[i].flat()) continue;
    // Where it touches, neither leg may begin, or end, below the tangent plane; nor may the middle dip.
    const Footing there = footing(elements_[i], position + step);
    const double down = here[i].height <= tolerance.touching() ? -here[i].normal.dot(step) : 0.0;
    const double up = there.height <= tolerance.touching() ? there.normal.dot(step) : 0.0;
    const double dip = tolerance.gap - height(elements_[i], position + 0.5 * step);
    most = std::max({most, 0.5 * down, 0.5 * up, dip});
  }
  if (most <= tolerance.gap) return Vector3::Zero();
  const double length = out.norm();
  if (length <= 0.0) return std::nullopt;
  out /= length;
  double least = 1.0;
  for (std::size_t i = 0; i < size_; ++i) least = std::min(least, out.dot(here[i].normal));
  if (least < kOpposite) return std::nullopt;
  return Vector3(out * (kRoom * most / least));
}

}  // namespace icome::haptics
