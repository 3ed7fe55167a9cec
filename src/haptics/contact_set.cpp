#include "haptics/contact_set.h"

#include <algorithm>

namespace icome::haptics {
namespace {

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

}  // namespace icome::haptics
