#pragma once
#include <array>
#include <span>

#include "haptics/element.h"

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

  /// The shortest-remaining-way step: of all steps that leave no contact's tangent plane (lifted to
  /// the resting gap) at the wrong side, the one that ends nearest to `position + pull`: a projection
  /// onto a polyhedral cone, by its active set of at most three planes.
  Vector3 constrained(const Vector3& position, const Vector3& pull, const Tolerance& tolerance) const;

 private:
  std::array<Element, kCapacity> elements_;
  std::size_t size_ = 0;
};

}  // namespace icome::haptics
