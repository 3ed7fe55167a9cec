#pragma once
#include <array>
#include <optional>
#include <span>

#include "haptics/shapes/element.h"

namespace icome::haptics {

/// The few elements that hold the SCP now. A fixed array: real-time safe.
class ContactSet {
 public:
  static constexpr std::size_t kCapacity = 8;

  std::span<const Element> all() const { return {elements_.data(), size_}; }
  std::span<Element> all() { return {elements_.data(), size_}; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  void clear() { size_ = 0; }

  /// Adds an element; a full set forgets its oldest.
  void add(const Element& element);

  /// Forgets the elements for which `gone(element)` holds.
  template <typename Gone>
  void forget_if(Gone&& gone) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      if (gone(elements_[i])) continue;
      if (kept != i) elements_[kept] = elements_[i];
      ++kept;
    }
    size_ = kept;
  }

  /// The shortest-remaining-way step: of all steps that end on the free side of every contact's
  /// tangent plane (lifted to the resting gap), the one that ends nearest to `position + pull`: a
  /// projection onto a polyhedral cone, by its active set of at most three planes.
  Vector3 constrained(const Vector3& position, const Vector3& pull, const Tolerance& tolerance) const;

  /// Does any contact belong to a smooth surface?
  bool any_smooth() const;

  /// Is every tangent plane of every contact free of it?
  bool all_convex() const;

  /// Is any contact a rounded edge or corner of a mesh?
  bool any_guarded() const;

  /// The least radius (m) of a curved contact; infinite where all are flat.
  double smallest_radius() const;

  /// The place nearest to `goal` that all contacts allow, from `position`, where they hold, as they curve
  /// (not as their tangent planes say), and whether it was found exactly; else it lies on the way there.
  /// `sure`: no walk along a contact had to stop short. Smooth contacts are followed from their last
  /// `follow`, so far and no farther.
  struct Rest {
    Vector3 place;
    bool exact;
    bool sure = true;
  };
  Rest rest(const Vector3& position, const Vector3& goal, const Tolerance& tolerance);

  /// Makes the feet of `position` those from which smooth contacts are found.
  void follow(const Vector3& position);

  /// The lift that the middle of a straight way from `position` by `step`, with both ends on the contacts,
  /// needs to pass above them where they bulge. Zero where they don't; nothing between walls that leave no
  /// way up.
  std::optional<Vector3> lift(const Vector3& position, const Vector3& step, const Tolerance& tolerance) const;

 private:
  using Footings = std::array<Footing, kCapacity>;
  Footings footings(const Vector3& position) const;
  Rest rest_on_one(const Vector3& goal, const Tolerance& tolerance);
  Vector3 along(Footings at, const Vector3& pull, const Tolerance& tolerance) const;
  Vector3 fallen(const Vector3& place, const Footings& at, const Vector3& goal,
                 const Tolerance& tolerance) const;
  Vector3 settled(Vector3 at, Vector3 best, const Vector3& goal, const Tolerance& tolerance) const;
  bool turned(const Footings& before, const Footings& now) const;
  bool free(const Footings& now, const Tolerance& tolerance) const;
  bool all_sure(const Footings& now) const;

  std::array<Element, kCapacity> elements_;
  std::size_t size_ = 0;
};

}  // namespace icome::haptics
