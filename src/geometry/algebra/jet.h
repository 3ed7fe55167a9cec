#pragma once
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "geometry/algebra/interval.h"
#include "geometry/implicit/expression.h"

namespace icome::geometry {

// Functions of double under the names of those of Interval, for the templates below.
inline double reciprocal(double a) { return 1.0 / a; }
inline void sine_and_cosine(double a, double& sine, double& cosine) {
  sine = std::sin(a);
  cosine = std::cos(a);
}
inline double power(double a, double b) {
  return a >= 0.0 ? std::pow(a, b) : std::numeric_limits<double>::quiet_NaN();
}

/// A value with its first derivatives with respect to `Variables` variables (Order 1 and 2) and its second
/// ones (Order 2; the upper triangle by rows). `Scalar` is double or Interval: with intervals, the
/// derivatives hold those at every point of the argument. At the kinks of abs, min and max a double takes
/// the derivative of one side, an interval holds those of both.
template <typename Scalar, int Variables, int Order>
struct Jet {
  static constexpr std::size_t kFirst = Order >= 1 ? Variables : 0;
  static constexpr std::size_t kSecond = Order >= 2 ? Variables * (Variables + 1) / 2 : 0;
  Scalar value;
  std::array<Scalar, kFirst> first;
  std::array<Scalar, kSecond> second;
};

namespace jets {

/// `value` as a double or as an interval.
template <typename S>
S exactly(double value) {
  if constexpr (std::is_same_v<S, double>) {
    return value;
  } else {
    return {value, value};
  }
}

inline double choose_smaller(double a, double b, double if_a, double if_b) { return a <= b ? if_a : if_b; }
inline Interval choose_smaller(const Interval& a, const Interval& b, const Interval& if_a,
                               const Interval& if_b) {
  if (a.hi < b.lo) return if_a;
  if (b.hi < a.lo) return if_b;
  return hull(if_a, if_b);
}

inline double smaller(double a, double b) { return a <= b ? a : (b < a ? b : a + b); }  // NaN stays
inline double larger(double a, double b) { return -smaller(-a, -b); }
inline Interval smaller(const Interval& a, const Interval& b) { return min(a, b); }
inline Interval larger(const Interval& a, const Interval& b) { return max(a, b); }

/// f(a), with f's value and derivatives d1 and d2 at a.
template <typename S, int V, int O>
Jet<S, V, O> chain(const Jet<S, V, O>& a, const S& value, const S& d1, const S& d2) {
  Jet<S, V, O> result;
  result.value = value;
  if constexpr (O >= 1) {
    for (int i = 0; i < V; ++i) result.first[i] = d1 * a.first[i];
  }
  if constexpr (O >= 2) {
    for (int i = 0, k = 0; i < V; ++i) {
      for (int j = i; j < V; ++j, ++k) result.second[k] = d1 * a.second[k] + d2 * a.first[i] * a.first[j];
    }
  }
  return result;
}

/// f's value and derivatives at (a, b).
template <typename S>
struct Partials {
  S value, a, b, aa, ab, bb;
};

template <typename S, int V, int O>
Jet<S, V, O> chain(const Jet<S, V, O>& a, const Jet<S, V, O>& b, const Partials<S>& f) {
  Jet<S, V, O> result;
  result.value = f.value;
  if constexpr (O >= 1) {
    for (int i = 0; i < V; ++i) result.first[i] = f.a * a.first[i] + f.b * b.first[i];
  }
  if constexpr (O >= 2) {
    for (int i = 0, k = 0; i < V; ++i) {
      for (int j = i; j < V; ++j, ++k) {
        result.second[k] = f.a * a.second[k] + f.b * b.second[k] + f.aa * a.first[i] * a.first[j] +
                           f.bb * b.first[i] * b.first[j] +
                           f.ab * (a.first[i] * b.first[j] + a.first[j] * b.first[i]);
      }
    }
  }
  return result;
}

/// Applies `function` to every pair of parts.
template <typename S, int V, int O, typename Function>
Jet<S, V, O> each(const Jet<S, V, O>& a, const Jet<S, V, O>& b, Function function) {
  Jet<S, V, O> result;
  result.value = function(a.value, b.value);
  for (std::size_t i = 0; i < result.first.size(); ++i) result.first[i] = function(a.first[i], b.first[i]);
  for (std::size_t i = 0; i < result.second.size(); ++i) {
    result.second[i] = function(a.second[i], b.second[i]);
  }
  return result;
}

template <typename S, int V, int O>
Jet<S, V, O> scale(const Jet<S, V, O>& a, double factor) {
  return each(a, a, [factor](const S& part, const S&) { return part * factor; });
}

template <typename S, int V, int O>
Jet<S, V, O> multiply(const Jet<S, V, O>& a, const Jet<S, V, O>& b) {
  Jet<S, V, O> result;
  result.value = a.value * b.value;
  if constexpr (O >= 1) {
    for (int i = 0; i < V; ++i) result.first[i] = a.value * b.first[i] + a.first[i] * b.value;
  }
  if constexpr (O >= 2) {
    for (int i = 0, k = 0; i < V; ++i) {
      for (int j = i; j < V; ++j, ++k) {
        result.second[k] =
            a.value * b.second[k] + a.second[k] * b.value + a.first[i] * b.first[j] + a.first[j] * b.first[i];
      }
    }
  }
  return result;
}

template <typename S, int V, int O>
Jet<S, V, O> divide(const Jet<S, V, O>& a, const Jet<S, V, O>& b) {
  const S quotient = a.value / b.value;
  const S by_b = reciprocal(b.value);
  const S zero = exactly<S>(0.0);
  return chain(a, b,
               {quotient, by_b, -(quotient * by_b), zero, -(by_b * by_b), quotient * by_b * by_b * 2.0});
}

template <typename S, int V, int O>
Jet<S, V, O> raise(const Jet<S, V, O>& a, double exponent, bool whole) {
  const auto to = [whole](const S& base, double n) {
    return whole ? integer_power(base, n) : power(base, exactly<S>(n));
  };
  Jet<S, V, O> result = a;
  const S value = to(a.value, exponent);
  S d1 = value, d2 = value;
  if constexpr (O >= 1) d1 = to(a.value, exponent - 1.0) * exponent;
  if constexpr (O >= 2)
    d2 = exponent == 2.0 ? exactly<S>(2.0) : to(a.value, exponent - 2.0) * (exponent * (exponent - 1.0));
  result = chain(a, value, d1, d2);
  return result;
}

/// |a|^exponent, exponent > 1.
template <typename S, int V, int O>
Jet<S, V, O> raise_size(const Jet<S, V, O>& a, double exponent) {
  using std::abs;
  const S size = abs(a.value);
  const S value = power(size, exactly<S>(exponent));
  S d1 = value, d2 = value;
  if constexpr (O >= 1) d1 = odd_power(a.value, exponent - 1.0) * exponent;
  if constexpr (O >= 2) {
    d2 = power(size, exactly<S>(exponent - 2.0)) * (exponent * (exponent - 1.0));
    if constexpr (std::is_same_v<S, double>) {
      if (!std::isfinite(d2)) d2 = 0.0;  // infinite at 0, which says nothing about the places around
    }
  }
  return chain(a, value, d1, d2);
}

/// The sign of a, times |a|^exponent, exponent > 1.
template <typename S, int V, int O>
Jet<S, V, O> raise_oddly(const Jet<S, V, O>& a, double exponent) {
  using std::abs;
  const S value = odd_power(a.value, exponent);
  S d1 = value, d2 = value;
  if constexpr (O >= 1) d1 = power(S(abs(a.value)), exactly<S>(exponent - 1.0)) * exponent;
  if constexpr (O >= 2) {
    d2 = odd_power(a.value, exponent - 2.0) * (exponent * (exponent - 1.0));
    if constexpr (std::is_same_v<S, double>) {
      if (!std::isfinite(d2)) d2 = 0.0;
    }
  }
  return chain(a, value, d1, d2);
}

template <typename S, int V, int O>
Jet<S, V, O> raise(const Jet<S, V, O>& a, const Jet<S, V, O>& b) {
  const S value = power(a.value, b.value);
  if constexpr (O == 0) return {value, {}, {}};
  using std::log;
  const S ln = log(a.value), by_a = reciprocal(a.value);
  const S da = value * b.value * by_a, db = value * ln;
  return chain(a, b,
               {value, da, db, da * (b.value + exactly<S>(-1.0)) * by_a, value * by_a + da * ln, db * ln});
}

template <typename S, int V, int O>
Jet<S, V, O> angle(const Jet<S, V, O>& y, const Jet<S, V, O>& x) {
  using std::atan2;
  const S value = atan2(y.value, x.value);
  if constexpr (O == 0) return {value, {}, {}};
  const S r2 = integer_power(x.value, 2.0) + integer_power(y.value, 2.0);
  const S dy = x.value / r2, dx = -(y.value / r2);
  const S mixed = dy * dx * 2.0;
  return chain(y, x, {value, dy, dx, mixed, dx * dx - dy * dy, -mixed});
}

// A length rises no faster than its arguments: shares are in [-1, 1]. At 0, the tip of a cone, doubles take
// the derivatives along the cone's axis, which are 0.
inline double share_of(double a, double length) { return length > 0.0 ? a / length : 0.0 * a; }
inline double inverse_length(double length) { return length > 0.0 ? 1.0 / length : 0.0 * length; }
inline Interval share_of(const Interval& a, const Interval& length) {
  const Interval share = a / length;
  return {std::clamp(share.lo, -1.0, 1.0), std::clamp(share.hi, -1.0, 1.0)};
}
inline Interval inverse_length(const Interval& length) { return reciprocal(length); }

template <typename S, int V, int O>
Jet<S, V, O> length(const Jet<S, V, O>& a, const Jet<S, V, O>& b) {
  using std::hypot;
  const S value = hypot(a.value, b.value);
  if constexpr (O == 0) return {value, {}, {}};
  const S da = share_of(a.value, value), db = share_of(b.value, value);
  const S by_value = inverse_length(value);
  return chain(a, b,
               {value, da, db, integer_power(db, 2.0) * by_value, -(da * db * by_value),
                integer_power(da, 2.0) * by_value});
}

template <typename S, int V, int O>
Jet<S, V, O> smaller_of(const Jet<S, V, O>& a, const Jet<S, V, O>& b) {
  Jet<S, V, O> result =
      each(a, b, [&](const S& p, const S& q) { return choose_smaller(a.value, b.value, p, q); });
  result.value = smaller(a.value, b.value);
  return result;
}

template <typename S, int V, int O>
Jet<S, V, O> larger_of(const Jet<S, V, O>& a, const Jet<S, V, O>& b) {
  Jet<S, V, O> result =
      each(a, b, [&](const S& p, const S& q) { return choose_smaller(b.value, a.value, p, q); });
  result.value = larger(a.value, b.value);
  return result;
}

}  // namespace jets

/// The unary `operation` applied to `a`. `constant` is the step's.
template <typename S, int V, int O>
Jet<S, V, O> compute_unary(Operation operation, double constant, const Jet<S, V, O>& a) {
  using jets::chain, jets::exactly;
  using std::abs, std::sqrt, std::exp, std::log, std::tan, std::asin, std::acos, std::atan, std::sinh,
      std::cosh, std::tanh, std::sin, std::cos;
  const S& u = a.value;
  const S one = exactly<S>(1.0), zero = exactly<S>(0.0);
  switch (operation) {
    case Operation::Negate:
      return jets::each(a, a, [](const S& part, const S&) { return -part; });
    case Operation::AddConstant: {
      Jet<S, V, O> result = a;
      result.value = u + constant;
      return result;
    }
    case Operation::Scale:
      return jets::scale(a, constant);
    case Operation::IntegerPower:
      return jets::raise(a, constant, true);
    case Operation::ConstantPower:
      return jets::raise(a, constant, false);
    case Operation::SizePower:
      return jets::raise_size(a, constant);
    case Operation::OddPower:
      return jets::raise_oddly(a, constant);
    case Operation::Reciprocal: {
      const S r = reciprocal(u), r2 = r * r;
      return chain(a, r, -r2, r2 * r * 2.0);
    }
    case Operation::Abs:
      return chain(a, abs(u), jets::choose_smaller(zero, u, one, -one), zero);
    case Operation::Sqrt: {
      const S root = sqrt(u), d1 = reciprocal(root) * 0.5;
      return chain(a, root, d1, -(d1 * reciprocal(u) * 0.5));
    }
    case Operation::Exp: {
      const S e = exp(u);
      return chain(a, e, e, e);
    }
    case Operation::Log: {
      const S r = reciprocal(u);
      return chain(a, S(log(u)), r, -(r * r));
    }
    case Operation::Sin:
    case Operation::Cos: {
      const bool is_sine = operation == Operation::Sin;
      if constexpr (O == 0) return {is_sine ? S(sin(u)) : S(cos(u)), {}, {}};
      S s, c;
      sine_and_cosine(u, s, c);
      return is_sine ? chain(a, s, c, -s) : chain(a, c, -s, -c);
    }
    case Operation::Tan: {
      const S v = tan(u), d1 = integer_power(v, 2.0) + 1.0;
      return chain(a, v, d1, v * d1 * 2.0);
    }
    case Operation::Asin:
    case Operation::Acos: {
      const S d1 = reciprocal(S(sqrt(-integer_power(u, 2.0) + 1.0)));
      const S d2 = u * d1 * d1 * d1;
      return operation == Operation::Asin ? chain(a, S(asin(u)), d1, d2) : chain(a, S(acos(u)), -d1, -d2);
    }
    case Operation::Atan: {
      const S d1 = reciprocal(integer_power(u, 2.0) + 1.0);
      return chain(a, S(atan(u)), d1, -(u * d1 * d1 * 2.0));
    }
    case Operation::Sinh: {
      const S s = sinh(u), c = cosh(u);
      return chain(a, s, c, s);
    }
    case Operation::Cosh: {
      const S s = sinh(u), c = cosh(u);
      return chain(a, c, s, c);
    }
    case Operation::Tanh: {
      const S v = tanh(u), d1 = -integer_power(v, 2.0) + 1.0;
      return chain(a, v, d1, -(v * d1 * 2.0));
    }
    case Operation::Wrap:
      return chain(a, wrap(u), one, zero);
    case Operation::Sinc:
      if constexpr (O == 0) return {sinc(u), {}, {}};
      return chain(a, sinc(u), sinc_slope(u), sinc_bend(u));
    default:
      return a;
  }
}

/// The result of a step's operation on its operands; leaves have been computed before.
template <typename S, int V, int O>
Jet<S, V, O> compute(Operation operation, double constant, const Jet<S, V, O>& a, const Jet<S, V, O>& b) {
  switch (operation) {
    case Operation::Add:
      return jets::each(a, b, [](const S& p, const S& q) { return p + q; });
    case Operation::Subtract:
      return jets::each(a, b, [](const S& p, const S& q) { return p - q; });
    case Operation::Multiply:
      return jets::multiply(a, b);
    case Operation::Divide:
      return jets::divide(a, b);
    case Operation::Power:
      return jets::raise(a, b);
    case Operation::Atan2:
      return jets::angle(a, b);
    case Operation::Hypot:
      return jets::length(a, b);
    case Operation::Min:
      return jets::smaller_of(a, b);
    case Operation::Max:
      return jets::larger_of(a, b);
    default:
      return compute_unary(operation, constant, a);
  }
}

}  // namespace icome::geometry
