#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

namespace icome::geometry {

/// All numbers from `lo` to `hi`, lo <= hi; an end may be infinite (`lo` is never +inf, `hi` never -inf).
/// Every function's result holds all values that the same function of double takes for arguments within,
/// and all true values: ends are rounded outwards. Where a function is undefined for a part of its
/// argument (the root of a negative number, a division by zero), the result holds its values on the other
/// part. All real-time safe.
struct Interval {
  double lo, hi;

  bool contains(double value) const { return lo <= value && value <= hi; }
};

/// Every number.
inline Interval entire() {
  return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
}

namespace rounding {

// One unit in the last place of a result is twice what the processor's arithmetic may be off. The smallest
// normal number stands for what is lost in underflow.
constexpr double kRelative = std::numeric_limits<double>::epsilon();
constexpr double kSmallest = std::numeric_limits<double>::min();
constexpr double kLargest = std::numeric_limits<double>::max();

inline double down(double value, double relative = kRelative) {
  const double finite = std::min(value, kLargest);
  return finite - (std::fabs(finite) * relative + kSmallest);
}
inline double up(double value, double relative = kRelative) { return -down(-value, relative); }

/// The product of two ends: where one is zero and the other infinite, the infinite one is never taken.
inline double product(double a, double b) {
  const double result = a * b;
  return result == result ? result : 0.0;
}

}  // namespace rounding

inline Interval operator-(const Interval& a) { return {-a.hi, -a.lo}; }

inline Interval operator+(const Interval& a, const Interval& b) {
  return {rounding::down(a.lo + b.lo), rounding::up(a.hi + b.hi)};
}

inline Interval operator-(const Interval& a, const Interval& b) { return a + -b; }

inline Interval operator*(const Interval& a, const Interval& b) {
  using rounding::product;
  if (a.lo >= 0.0 && b.lo >= 0.0) {  // squares and lengths: a product below zero would be misleading
    return {std::max(0.0, rounding::down(a.lo * b.lo)), rounding::up(product(a.hi, b.hi))};
  }
  const double p = product(a.lo, b.lo), q = product(a.lo, b.hi);
  const double r = product(a.hi, b.lo), s = product(a.hi, b.hi);
  return {rounding::down(std::min(std::min(p, q), std::min(r, s))),
          rounding::up(std::max(std::max(p, q), std::max(r, s)))};
}

inline Interval operator+(const Interval& a, double b) {
  return {rounding::down(a.lo + b), rounding::up(a.hi + b)};
}

inline Interval operator*(const Interval& a, double factor) {
  const double p = rounding::product(a.lo, factor), q = rounding::product(a.hi, factor);
  const double lo = rounding::down(std::min(p, q)), hi = rounding::up(std::max(p, q));
  return {a.lo >= 0.0 && factor >= 0.0 ? std::max(lo, 0.0) : lo,
          a.hi <= 0.0 && factor >= 0.0 ? std::min(hi, 0.0) : hi};
}

/// The intersection of both. Precondition: they overlap, as enclosures of the same values do.
inline Interval intersection(const Interval& a, const Interval& b) {
  return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
}

/// The smallest interval that holds both.
inline Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}

/// The largest absolute value.
inline double magnitude(const Interval& a) { return std::max(-a.lo, a.hi); }

Interval operator/(const Interval& a, const Interval& b);
Interval reciprocal(const Interval& a);
Interval abs(const Interval& a);
Interval sqrt(const Interval& a);
Interval exp(const Interval& a);
Interval log(const Interval& a);
Interval sin(const Interval& a);
Interval cos(const Interval& a);
Interval tan(const Interval& a);
Interval asin(const Interval& a);
Interval acos(const Interval& a);
Interval atan(const Interval& a);
Interval sinh(const Interval& a);
Interval cosh(const Interval& a);
Interval tanh(const Interval& a);
Interval atan2(const Interval& y, const Interval& x);
Interval hypot(const Interval& a, const Interval& b);
Interval min(const Interval& a, const Interval& b);
Interval max(const Interval& a, const Interval& b);
/// a^n, n a whole number.
Interval integer_power(const Interval& a, double n);
inline double integer_power(double a, double n) {
  if (n == 2.0) return a * a;
  if (n == 3.0) return a * a * a;
  if (n == 4.0) return (a * a) * (a * a);
  return n == 1.0 ? a : std::pow(a, n);
}
/// a^b for a >= 0.
Interval power(const Interval& a, const Interval& b);

/// The sign of a, times |a|^n.
Interval odd_power(const Interval& a, double n);
inline double odd_power(double a, double n) { return std::copysign(std::pow(std::fabs(a), n), a); }

/// a minus whole turns, so that the result is between -pi and pi.
Interval wrap(const Interval& a);
double wrap(double a);
/// May wrap jump there?
bool may_hold_half_turn(const Interval& a);

/// sin(a) / a, 1 where a is 0, and its first two derivatives.
Interval sinc(const Interval& a);
Interval sinc_slope(const Interval& a);
Interval sinc_bend(const Interval& a);
double sinc(double a);
double sinc_slope(double a);
double sinc_bend(double a);

/// sin(a) and cos(a), at little more than the cost of one.
void sine_and_cosine(const Interval& a, Interval& sine, Interval& cosine);

/// May tan have a pole there?
bool may_hold_tangent_pole(const Interval& a);

}  // namespace icome::geometry
