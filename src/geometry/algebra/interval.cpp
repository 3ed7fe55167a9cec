#include "geometry/algebra/interval.h"

#include <cstdlib>
#include <numbers>

namespace icome::geometry {
namespace {

using rounding::down;
using rounding::kLargest;
using rounding::up;
using std::numbers::pi;

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
// glibc's functions are off by a few units in the last place at most (its manual, "Errors in Math
// Functions"); this is more than that.
constexpr double kLibrary = 8 * rounding::kRelative;

Interval monotone(double at_lo, double at_hi) { return {down(at_lo, kLibrary), up(at_hi, kLibrary)}; }

Interval within_range(const Interval& a, double lo, double hi) {
  return {std::clamp(a.lo, lo, hi), std::clamp(a.hi, lo, hi)};
}

/// May [a.lo, a.hi] hold a number `phase` + k * `period`, k whole? Never "no" where it does: the quotients
/// are widened by more than they are rounded.
bool may_hold_phase(const Interval& a, double phase, double period) {
  const double first = (a.lo - phase) / period, last = (a.hi - phase) / period;
  const double doubt = 4 * rounding::kRelative * (1.0 + std::max(std::fabs(first), std::fabs(last)));
  return !(std::floor(last + doubt) < std::ceil(first - doubt));
}

/// The image under sin or cos, whose values at the ends are given and which is 1 at `top` + 2 pi k.
Interval wave(const Interval& a, double at_lo, double at_hi, double top) {
  Interval image = monotone(std::min(at_lo, at_hi), std::max(at_lo, at_hi));
  if (may_hold_phase(a, top, 2 * pi)) image.hi = 1.0;
  if (may_hold_phase(a, top + pi, 2 * pi)) image.lo = -1.0;
  return within_range(image, -1.0, 1.0);
}

/// Is the interval so wide, so far out or infinite that its image counts as all of [-1, 1]?
bool all_around(const Interval& a) { return !(a.hi - a.lo < 2 * pi) || magnitude(a) > 0x1p40; }

}  // namespace

Interval reciprocal(const Interval& a) {
  if (a.lo > 0.0) return {std::max(0.0, down(1.0 / a.hi)), up(1.0 / a.lo)};
  if (a.hi < 0.0) return -reciprocal(-a);
  if (a.lo == 0.0 && a.hi > 0.0) return {std::max(0.0, down(1.0 / a.hi)), kUnbounded};
  if (a.hi == 0.0 && a.lo < 0.0) return {-kUnbounded, std::min(0.0, up(1.0 / a.lo))};
  return entire();
}

Interval operator/(const Interval& a, const Interval& b) {
  if (b.hi < 0.0) return -a / -b;
  if (b.lo > 0.0) {
    // Rounding the quotients themselves is tighter than multiplying by the reciprocal.
    const double lo = down(a.lo / (a.lo >= 0.0 ? b.hi : b.lo));
    const double hi = up(a.hi / (a.hi >= 0.0 ? b.lo : b.hi));
    if (!(lo <= hi)) return entire();  // infinity by infinity
    return {a.lo >= 0.0 ? std::max(lo, 0.0) : lo, a.hi <= 0.0 ? std::min(hi, 0.0) : hi};
  }
  return a * reciprocal(b);
}

Interval abs(const Interval& a) {
  if (a.lo >= 0.0) return a;
  if (a.hi <= 0.0) return -a;
  return {0.0, magnitude(a)};
}

Interval sqrt(const Interval& a) {
  const Interval domain = within_range(a, 0.0, kUnbounded);
  return {std::max(0.0, down(std::sqrt(domain.lo))), up(std::sqrt(domain.hi))};
}

Interval exp(const Interval& a) {
  const Interval image = monotone(std::exp(a.lo), std::exp(a.hi));
  return {std::max(0.0, image.lo), image.hi};
}

Interval log(const Interval& a) {
  const Interval domain = within_range(a, 0.0, kUnbounded);
  return {domain.lo > 0.0 ? down(std::log(domain.lo), kLibrary) : -kUnbounded,
          domain.hi > 0.0 ? up(std::log(domain.hi), kLibrary) : -kLargest};
}

Interval sin(const Interval& a) {
  if (all_around(a)) return {-1.0, 1.0};
  return wave(a, std::sin(a.lo), std::sin(a.hi), pi / 2);
}

Interval cos(const Interval& a) {
  if (all_around(a)) return {-1.0, 1.0};
  return wave(a, std::cos(a.lo), std::cos(a.hi), 0.0);
}

void sine_and_cosine(const Interval& a, Interval& sine, Interval& cosine) {
  sine = cosine = {-1.0, 1.0};
  if (all_around(a)) return;
  const double sin_lo = std::sin(a.lo), cos_lo = std::cos(a.lo);  // one sincos() call each
  const double sin_hi = std::sin(a.hi), cos_hi = std::cos(a.hi);
  sine = wave(a, sin_lo, sin_hi, pi / 2);
  cosine = wave(a, cos_lo, cos_hi, 0.0);
}

bool may_hold_tangent_pole(const Interval& a) {
  return !(a.hi - a.lo < pi) || magnitude(a) > 0x1p40 || may_hold_phase(a, pi / 2, pi);
}

Interval tan(const Interval& a) {
  return may_hold_tangent_pole(a) ? entire() : monotone(std::tan(a.lo), std::tan(a.hi));
}

Interval asin(const Interval& a) {
  const Interval domain = within_range(a, -1.0, 1.0);
  return monotone(std::asin(domain.lo), std::asin(domain.hi));
}

Interval acos(const Interval& a) {
  const Interval domain = within_range(a, -1.0, 1.0);
  const Interval image = monotone(std::acos(domain.hi), std::acos(domain.lo));
  return {std::max(0.0, image.lo), image.hi};
}

Interval atan(const Interval& a) { return monotone(std::atan(a.lo), std::atan(a.hi)); }

Interval sinh(const Interval& a) { return monotone(std::sinh(a.lo), std::sinh(a.hi)); }

Interval cosh(const Interval& a) {
  const Interval size = abs(a);
  const Interval image = monotone(std::cosh(size.lo), std::cosh(size.hi));
  return {std::max(1.0, image.lo), image.hi};
}

Interval tanh(const Interval& a) {
  return within_range(monotone(std::tanh(a.lo), std::tanh(a.hi)), -1.0, 1.0);
}

Interval atan2(const Interval& y, const Interval& x) {
  const bool over_cut = x.lo <= 0.0 && y.lo <= 0.0 && y.hi >= 0.0;  // or over the origin
  if (over_cut) return monotone(-pi, pi);
  // Without the origin the angle is monotone along every edge of the rectangle.
  const double p = std::atan2(y.lo, x.lo), q = std::atan2(y.lo, x.hi);
  const double r = std::atan2(y.hi, x.lo), s = std::atan2(y.hi, x.hi);
  return monotone(std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s)));
}

Interval hypot(const Interval& a, const Interval& b) {
  const Interval p = abs(a), q = abs(b);
  const Interval image = monotone(std::hypot(p.lo, q.lo), std::hypot(p.hi, q.hi));
  return {std::max(0.0, image.lo), image.hi};
}

Interval min(const Interval& a, const Interval& b) { return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)}; }

Interval max(const Interval& a, const Interval& b) { return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)}; }

Interval integer_power(const Interval& a, double n) {
  if (n == 0.0) return {1.0, 1.0};
  if (n < 0.0) return reciprocal(integer_power(a, -n));
  if (n == 1.0) return a;
  const bool even = std::fmod(n, 2.0) == 0.0;
  const Interval base = even ? abs(a) : a;
  const Interval image = n == 2.0 ? Interval{down(base.lo * base.lo), up(base.hi * base.hi)}
                                  : monotone(integer_power(base.lo, n), integer_power(base.hi, n));
  return {base.lo >= 0.0 ? std::max(0.0, image.lo) : image.lo, image.hi};
}

Interval odd_power(const Interval& a, double n) {
  if (n < 0.0) {
    if (a.contains(0.0)) return entire();
    return a.lo > 0.0 ? power(a, {n, n}) : -power(-a, {n, n});
  }
  const Interval image = monotone(odd_power(a.lo, n), odd_power(a.hi, n));
  return {a.lo >= 0.0 ? std::max(0.0, image.lo) : image.lo, a.hi <= 0.0 ? std::min(0.0, image.hi) : image.hi};
}

double wrap(double a) { return std::remainder(a, 2 * pi); }

bool may_hold_half_turn(const Interval& a) { return all_around(a) || may_hold_phase(a, pi, 2 * pi); }

Interval wrap(const Interval& a) {
  if (may_hold_half_turn(a)) return monotone(-pi, pi);
  // The rounded turn that double has is off by some units in the last place of all turns together.
  const double doubt = 4 * rounding::kRelative * magnitude(a);
  return {down(wrap(a.lo) - doubt), up(wrap(a.hi) + doubt)};
}

namespace {

constexpr double kShortAngle = 0.1;  // up to here four terms of the series have all digits

/// Encloses the values of a function whose derivative is nowhere more than `steepest`, from the middle one.
template <typename Function>
Interval around_middle(const Interval& a, double steepest, Function&& function) {
  if (!std::isfinite(a.lo) || !std::isfinite(a.hi)) return {-1.0, 1.0};
  const double middle = a.lo + 0.5 * (a.hi - a.lo);
  constexpr double kDoubt = 1e-12;  // beyond the series, differences leave 13 digits
  const double away = steepest * (up(0.5 * (a.hi - a.lo)) + kDoubt);
  const double value = function(middle);
  return {down(value - away, kLibrary), up(value + away, kLibrary)};
}

}  // namespace

double sinc(double a) {
  const double square = a * a;
  if (std::fabs(a) < kShortAngle)
    return 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0 * (1.0 - square / 72.0)));
  return std::sin(a) / a;
}

double sinc_slope(double a) {
  const double square = a * a;
  if (std::fabs(a) < kShortAngle)
    return -a / 3.0 * (1.0 - square / 10.0 * (1.0 - square / 28.0 * (1.0 - square / 54.0)));
  return (std::cos(a) - sinc(a)) / a;
}

double sinc_bend(double a) {
  const double square = a * a;
  if (std::fabs(a) < kShortAngle)
    return -(1.0 - 0.3 * square * (1.0 - 5.0 / 84.0 * square * (1.0 - 7.0 / 270.0 * square))) / 3.0;
  return -sinc(a) - 2.0 * sinc_slope(a) / a;
}

// sin(a) / a is the mean of cos(s * a) over s from 0 to 1, and so no derivative of it is more than the mean
// of a power of s: 1/2, 1/3, 1/4. The first is no more than a third of a either.
Interval sinc(const Interval& a) {
  const double steepest = std::min(0.5, magnitude(a) / 3.0);
  return within_range(around_middle(a, steepest, [](double u) { return sinc(u); }), -0.2173, 1.0);
}

Interval sinc_slope(const Interval& a) {
  return within_range(around_middle(a, 1.0 / 3.0, [](double u) { return sinc_slope(u); }), -0.5, 0.5);
}

Interval sinc_bend(const Interval& a) {
  return within_range(around_middle(a, 0.25, [](double u) { return sinc_bend(u); }), -0.3334, 0.3334);
}

Interval power(const Interval& a, const Interval& b) {
  const Interval base = within_range(a, 0.0, kUnbounded);
  // Monotone in each of the two: the extremes are at the corners.
  const double p = std::pow(base.lo, b.lo), q = std::pow(base.lo, b.hi);
  const double r = std::pow(base.hi, b.lo), s = std::pow(base.hi, b.hi);
  const Interval image =
      monotone(std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s)));
  return {std::max(0.0, image.lo), image.hi};
}

}  // namespace icome::geometry
