#include "haptics/contact_set.h"

#include <algorithm>
#include <cmath>

#include "haptics/smooth_element.h"

namespace icome::haptics {
namespace {

constexpr int kMaxRests = 16;          // steps towards a place of rest
constexpr int kMaxHalvings = 16;       // of a step on which contacts turn too much
constexpr double kOpposite = 0.1;      // cosine: walls so much against each other leave no way up
constexpr double kCloseEnough = 0.98;  // cosine between normals (0.2 rad)
constexpr double kGeometric = 0.8;     // largest ratio of steps that are taken to shrink geometrically
constexpr double kRoom = 1.1;          // how much further than need be a way is lifted

/// normal . step >= least
struct HalfSpace {
  Vector3 normal;
  double least;
};

/// The half-spaces of a contact set, and the search for the active ones among them.
class Polyhedron {
 public:
  Polyhedron(std::span<const Element> contacts, const Vector3& position, const Tolerance& tolerance)
      : slack_(0.25 * tolerance.gap) {
    for (const Element& contact : contacts) {
      planes_[count_++] = {normal(contact, position), tolerance.gap - height(contact, position)};
    }
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
  return Polyhedron(all(), position, tolerance).project(pull);
}

bool ContactSet::any_smooth() const {
  return std::any_of(elements_.begin(), elements_.begin() + size_,
                     [](const Element& e) { return e.smooth(); });
}

void ContactSet::follow(const Vector3& position) {
  for (Element& contact : all()) {
    if (contact.smooth()) follow_foot(contact, position);
  }
}

ContactSet::Rest ContactSet::rest_on_one(const Vector3& goal, const Tolerance& tolerance) {
  Element& contact = elements_.front();
  const Vector3 place = settle(contact, goal, tolerance);
  follow_foot(contact, place);
  const Vector3 pull = goal - place;
  const Vector3 out = normal(contact, place);
  const double along = (pull - out * out.dot(pull)).norm();
  return {place, along <= tolerance.gap};
}

ContactSet::Normals ContactSet::normals(const Vector3& position) const {
  Normals result;
  for (std::size_t i = 0; i < size_; ++i) result[i] = normal(elements_[i], position);
  return result;
}

/// Have smooth contacts turned so much from where they were that a straight way says little?
bool ContactSet::turned(const Normals& before, const Vector3& position) const {
  for (std::size_t i = 0; i < size_; ++i) {
    if (elements_[i].smooth() && normal(elements_[i], position).dot(before[i]) < kCloseEnough) return true;
  }
  return false;
}

ContactSet::Rest ContactSet::rest(const Vector3& position, const Vector3& goal, const Tolerance& tolerance) {
  if (size_ == 1) return rest_on_one(goal, tolerance);
  const Normals before = normals(position);
  Vector3 best = position;  // on the free side of all contacts
  Vector3 at = position;
  Vector3 last = Vector3::Zero();
  for (int i = 0; i < kMaxRests; ++i) {
    Vector3 step = constrained(at, goal - at, tolerance);
    const double length = step.norm();
    if (length <= tolerance.gap && free(at, tolerance)) return {at, true};
    // Along an edge curve, steps shrink (or swing) geometrically: their sum is known.
    const double ratio = last.isZero(0.0) ? 0.0 : step.dot(last) / last.squaredNorm();
    last = step;
    if (std::abs(ratio) < kGeometric && free(at + step / (1.0 - ratio), tolerance)) step /= 1.0 - ratio;
    for (int k = 0; k < kMaxHalvings && turned(before, at + step); ++k) step *= 0.5;
    at += step;
    follow(at);
    if (free(at, tolerance)) best = at;
  }
  follow(best);
  return {best, false};
}

bool ContactSet::free(const Vector3& place, const Tolerance& tolerance) const {
  return std::all_of(elements_.begin(), elements_.begin() + size_,
                     [&](const Element& contact) { return height(contact, place) >= 0.5 * tolerance.gap; });
}

std::optional<Vector3> ContactSet::lift(const Vector3& position, const Vector3& step,
                                        const Tolerance& tolerance) const {
  const Vector3 middle = position + 0.5 * step;
  double most = 0.0;
  Vector3 out = Vector3::Zero();
  for (const Element& contact : all()) {
    const Vector3 here = normal(contact, position);
    out += here;
    if (contact.flat()) continue;
    // Neither leg may begin, or end, below the tangent plane; nor may the middle lie in a bulge.
    const double down = -here.dot(step);
    const double up = normal(contact, position + step).dot(step);
    const bool ends_there = height(contact, position + step) <= tolerance.touching();
    most = std::max({most, 0.5 * down, ends_there ? 0.5 * up : 0.0, tolerance.gap - height(contact, middle)});
  }
  if (most <= tolerance.gap) return Vector3::Zero();
  const double length = out.norm();
  if (length <= 0.0) return std::nullopt;
  out /= length;
  double least = 1.0;
  for (const Element& contact : all()) least = std::min(least, out.dot(normal(contact, position)));
  if (least < kOpposite) return std::nullopt;
  return Vector3(out * (kRoom * most / least));
}

}  // namespace icome::haptics
