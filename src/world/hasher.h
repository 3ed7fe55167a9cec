#pragma once
#include <bit>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "base/vector.h"

namespace icome::world {

/// Mixes values into a number (64 bits, the finaliser of splitmix64 after each word): the same on every
/// machine. For comparing worlds, no protection against forgery.
class Hasher {
 public:
  template <typename Number>
  requires std::is_integral_v<Number> || std::is_enum_v<Number>
  void add(Number value) { mix(static_cast<std::uint64_t>(value)); }
  void add(double value) { mix(std::bit_cast<std::uint64_t>(value)); }
  void add(std::string_view text) {
    mix(text.size());
    for (const char letter : text) mix(static_cast<unsigned char>(letter));
  }
  template <typename Derived>
  void add(const Eigen::DenseBase<Derived>& matrix) {
    for (const double value : matrix.derived().reshaped()) add(value);
  }

  std::uint64_t value() const { return state_; }

 private:
  void mix(std::uint64_t word) {
    std::uint64_t z = (state_ ^ word) + 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    state_ = z ^ (z >> 31);
  }

  std::uint64_t state_ = 0;
};

}  // namespace icome::world
