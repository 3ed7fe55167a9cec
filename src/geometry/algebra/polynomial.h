#pragma once
#include <array>
#include <span>

namespace icome::geometry {

/// The real roots of a polynomial in an interval, in rising order.
struct RealRoots {
  std::array<double, 4> t;
  unsigned count = 0;

  std::span<const double> all() const& { return {t.data(), count}; }
  std::span<const double> all() const&& = delete;  // a temporary is gone before a loop over it begins
  void add(double root) { t[count++] = root; }
};

/// The real roots in [from, to] of c[0] + c[1] t + ... of degree 1 to 4: between two neighbouring roots
/// of its derivative a polynomial is monotone and has one root at most, which bisection cannot miss.
/// Double roots may be found twice, once or (when rounding lifts them off zero) not at all; none are found
/// where the polynomial is zero throughout. Real-time safe.
RealRoots real_roots(std::span<const double> coefficients, double from, double to);

}  // namespace icome::geometry
