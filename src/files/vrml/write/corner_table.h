#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace icome::files {

/// Finds corners of a mesh with the same `kParts` numbers, so that a file names each value once. In the
/// order of first appearance.
template <std::size_t kParts>
class CornerTable {
 public:
  using Value = std::array<float, kParts>;

  explicit CornerTable(std::size_t corners) { slots_.resize(std::bit_ceil(2 * corners + 1), kFree); }

  /// The number of the value, from 0.
  std::uint32_t add(Value value) {
    for (float& part : value) part += 0.0F;  // -0 is 0
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t at = hash(value) & mask;; at = (at + 1) & mask) {
      if (slots_[at] == kFree) {
        slots_[at] = std::uint32_t(values_.size());
        values_.push_back(value);
      }
      if (values_[slots_[at]] == value) return slots_[at];
    }
  }

  /// The values by their numbers. Must be the last call.
  std::vector<Value> take() { return std::move(values_); }

 private:
  static constexpr std::uint32_t kFree = 0xffffffff;

  static std::size_t hash(const Value& value) {
    std::uint64_t all = 0;
    for (const float part : value) {
      all = (all ^ std::bit_cast<std::uint32_t>(part)) * 0x9e3779b97f4a7c15ULL;
      all ^= all >> 32U;
    }
    return std::size_t(all);
  }

  std::vector<std::uint32_t> slots_;
  std::vector<Value> values_;
};

}  // namespace icome::files
