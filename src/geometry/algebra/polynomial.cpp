#include "geometry/algebra/polynomial.h"

#include <algorithm>
#include <cmath>

namespace icome::geometry {
namespace {

constexpr unsigned kMaxDegree = 4;
constexpr int kMaxRefinements = 100;

double value(std::span<const double> c, double t) {
  double sum = 0.0;
  for (std::size_t i = c.size(); i-- > 0;) sum = sum * t + c[i];
  return sum;
}

double slope(std::span<const double> c, double t) {
  double sum = 0.0;
  for (std::size_t i = c.size(); i-- > 1;) sum = sum * t + double(i) * c[i];
  return sum;
}

/// The root between `low` and `high`, where the values have different signs: Newton's method kept in the
/// bracket by bisection.
double refined(std::span<const double> c, double low, double high, bool rising) {
  double t = 0.5 * (low + high);
  for (int i = 0; i < kMaxRefinements; ++i) {
    const double at = value(c, t);
    if (at == 0.0) return t;
    ((at > 0.0) == rising ? high : low) = t;
    const double along = slope(c, t);
    double next = along != 0.0 ? t - at / along : low;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == t || next == low || next == high) return next;
    t = next;
  }
  return t;
}

/// The roots of a polynomial from those of its derivative, `turns`.
RealRoots between_turns(std::span<const double> c, const RealRoots& turns, double from, double to) {
  RealRoots roots;
  double low = from;
  double at_low = value(c, low);
  if (at_low == 0.0) roots.add(low);
  for (unsigned i = 0; i <= turns.count && roots.count < kMaxDegree; ++i) {
    const double high = i < turns.count ? turns.t[i] : to;
    const double at_high = value(c, high);
    if (at_high == 0.0) {
      if (high > low) roots.add(high);
    } else if ((at_low < 0.0 && at_high > 0.0) || (at_low > 0.0 && at_high < 0.0)) {
      roots.add(refined(c, low, high, at_high > 0.0));
    }
    low = high;
    at_low = at_high;
  }
  return roots;
}

}  // namespace

RealRoots real_roots(std::span<const double> coefficients, double from, double to) {
  // From the linear derivative upwards.
  RealRoots roots;
  const auto degree = unsigned(coefficients.size() - 1);
  for (unsigned order = degree; order-- > 0;) {
    std::array<double, kMaxDegree + 1> derived{};
    const unsigned size = degree - order + 1;
    for (unsigned i = 0; i < size; ++i) {
      double factor = 1.0;
      for (unsigned k = 0; k < order; ++k) factor *= double(i + order - k);
      derived[i] = factor * coefficients[i + order];
    }
    roots = between_turns(std::span(derived).first(size), roots, from, to);
  }
  return roots;
}

}  // namespace icome::geometry
