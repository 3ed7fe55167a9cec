#pragma once
#include <cmath>
#include <cstdint>

#include "base/vector.h"

namespace icome::base {

/// A small seeded generator (splitmix64) that gives the same numbers on every machine,
/// which the distributions of <random> do not promise.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  /// Uniform in [low, high).
  double uniform(double low = 0.0, double high = 1.0) {
    return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1.0p-53);
  }

  /// Uniform in [0, count), count > 0.
  std::uint64_t index(std::uint64_t count) { return bits() % count; }

  /// Uniform on the unit sphere.
  Vector3 direction() {
    const double z = uniform(-1.0, 1.0);
    const double angle = uniform(0.0, 6.283185307179586);
    const double rho = std::sqrt(1.0 - z * z);
    return {rho * std::cos(angle), rho * std::sin(angle), z};
  }

 private:
  std::uint64_t state_;
};

}  // namespace icome::base
