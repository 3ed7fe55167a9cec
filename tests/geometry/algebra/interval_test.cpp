#include "geometry/algebra/interval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "base/random.h"

namespace icome::geometry {
namespace interval_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct UnaryCase {
  std::string name;
  std::function<Interval(const Interval&)> of_interval;
  std::function<double(double)> of_number;
};

const std::vector<UnaryCase>& unary_cases() {
  using Of = const Interval&;
  static const std::vector<UnaryCase> kCases{
      {"negate", [](Of a) { return -a; }, [](double a) { return -a; }},
      {"add", [](Of a) { return a + 0.7; }, [](double a) { return a + 0.7; }},
      {"scale", [](Of a) { return a * -3.1; }, [](double a) { return a * -3.1; }},
      {"reciprocal", [](Of a) { return reciprocal(a); }, [](double a) { return 1.0 / a; }},
      {"abs", [](Of a) { return abs(a); }, [](double a) { return std::abs(a); }},
      {"sqrt", [](Of a) { return sqrt(a); }, [](double a) { return std::sqrt(a); }},
      {"exp", [](Of a) { return exp(a); }, [](double a) { return std::exp(a); }},
      {"log", [](Of a) { return log(a); }, [](double a) { return std::log(a); }},
      {"sin", [](Of a) { return sin(a); }, [](double a) { return std::sin(a); }},
      {"cos", [](Of a) { return cos(a); }, [](double a) { return std::cos(a); }},
      {"tan", [](Of a) { return tan(a); }, [](double a) { return std::tan(a); }},
      {"asin", [](Of a) { return asin(a); }, [](double a) { return std::asin(a); }},
      {"acos", [](Of a) { return acos(a); }, [](double a) { return std::acos(a); }},
      {"atan", [](Of a) { return atan(a); }, [](double a) { return std::atan(a); }},
      {"sinh", [](Of a) { return sinh(a); }, [](double a) { return std::sinh(a); }},
      {"cosh", [](Of a) { return cosh(a); }, [](double a) { return std::cosh(a); }},
      {"tanh", [](Of a) { return tanh(a); }, [](double a) { return std::tanh(a); }},
      {"square", [](Of a) { return integer_power(a, 2); }, [](double a) { return std::pow(a, 2); }},
      {"cube", [](Of a) { return integer_power(a, 3); }, [](double a) { return std::pow(a, 3); }},
      {"fourth", [](Of a) { return integer_power(a, 4); }, [](double a) { return std::pow(a, 4); }},
      {"seventh", [](Of a) { return integer_power(a, 7); }, [](double a) { return std::pow(a, 7); }},
      {"minus third", [](Of a) { return integer_power(a, -3); }, [](double a) { return std::pow(a, -3); }},
      {"root",
       [](Of a) {
         return power(a, {0.3, 0.3});
       },
       [](double a) { return std::pow(a, 0.3); }},
  };
  return kCases;
}

struct BinaryCase {
  std::string name;
  std::function<Interval(const Interval&, const Interval&)> of_interval;
  std::function<double(double, double)> of_number;
};

const std::vector<BinaryCase>& binary_cases() {
  using Of = const Interval&;
  static const std::vector<BinaryCase> kCases{
      {"add", [](Of a, Of b) { return a + b; }, [](double a, double b) { return a + b; }},
      {"subtract", [](Of a, Of b) { return a - b; }, [](double a, double b) { return a - b; }},
      {"multiply", [](Of a, Of b) { return a * b; }, [](double a, double b) { return a * b; }},
      {"divide", [](Of a, Of b) { return a / b; }, [](double a, double b) { return a / b; }},
      {"atan2", [](Of a, Of b) { return atan2(a, b); }, [](double a, double b) { return std::atan2(a, b); }},
      {"hypot", [](Of a, Of b) { return hypot(a, b); }, [](double a, double b) { return std::hypot(a, b); }},
      {"min", [](Of a, Of b) { return min(a, b); }, [](double a, double b) { return std::min(a, b); }},
      {"max", [](Of a, Of b) { return max(a, b); }, [](double a, double b) { return std::max(a, b); }},
      {"power", [](Of a, Of b) { return power(a, b); },
       [](double a, double b) { return a < 0.0 ? std::nan("") : std::pow(a, b); }},
  };
  return kCases;
}

/// Narrow and wide ones, around zero, far from it, and those that begin or end at zero.
Interval random_interval(base::Random& random) {
  const double scale = std::pow(10.0, random.uniform(-6.0, 2.5));
  double a = random.uniform(-scale, scale);
  double b = random.index(3) == 0 ? random.uniform(-scale, scale)
                                  : a + scale * std::pow(10.0, random.uniform(-8.0, 0.0));
  if (random.index(20) == 0) a = 0.0;
  if (random.index(20) == 0) b = 0.0;
  return {std::min(a, b), std::max(a, b)};
}

double sample(const Interval& interval, base::Random& random) {
  const std::uint64_t kind = random.index(8);
  if (kind == 0) return interval.lo;
  if (kind == 1) return interval.hi;
  return std::clamp(random.uniform(interval.lo, interval.hi), interval.lo, interval.hi);
}

TEST(Interval, HoldsTheValuesOfFunctionsOfOne) {
  for (const UnaryCase& each : unary_cases()) {
    base::Random random(1);
    for (int i = 0; i < 10'000; ++i) {
      const Interval a = random_interval(random);
      const Interval image = each.of_interval(a);
      ASSERT_LE(image.lo, image.hi) << each.name << " of " << a.lo << " " << a.hi;
      for (int k = 0; k < 10; ++k) {
        const double x = sample(a, random), value = each.of_number(x);
        if (std::isnan(value) || (std::isinf(value) && each.name != "exp")) continue;
        ASSERT_TRUE(image.lo <= value && value <= image.hi)
            << each.name << "(" << x << ") = " << value << " not in " << image.lo << " " << image.hi;
      }
    }
  }
}

TEST(Interval, HoldsTheValuesOfFunctionsOfTwo) {
  for (const BinaryCase& each : binary_cases()) {
    base::Random random(2);
    for (int i = 0; i < 10'000; ++i) {
      const Interval a = random_interval(random), b = random_interval(random);
      const Interval image = each.of_interval(a, b);
      ASSERT_LE(image.lo, image.hi) << each.name;
      for (int k = 0; k < 10; ++k) {
        const double x = sample(a, random), y = sample(b, random), value = each.of_number(x, y);
        // At a pole itself, the sign of a double's zero decides.
        if (std::isnan(value) || (std::isinf(value) && each.name == "divide")) continue;
        ASSERT_TRUE(image.contains(value)) << each.name << "(" << x << ", " << y << ") = " << value
                                           << " not in " << image.lo << " " << image.hi;
      }
    }
  }
}

TEST(Interval, IsNoWiderThanTheFunctionsImageNeeds) {
  const Interval square = integer_power(Interval{-1.0, 2.0}, 2);
  EXPECT_EQ(square.lo, 0.0);
  EXPECT_NEAR(square.hi, 4.0, 1e-14);
  const Interval top = sin(Interval{1.0, 2.0});
  EXPECT_EQ(top.hi, 1.0);
  EXPECT_NEAR(top.lo, std::sin(1.0), 1e-14);
  const Interval slope = cos(Interval{0.5, 0.6});
  EXPECT_NEAR(slope.lo, std::cos(0.6), 1e-14);
  EXPECT_NEAR(slope.hi, std::cos(0.5), 1e-14);
  const Interval quotient = Interval{1.0, 2.0} / Interval{-4.0, -2.0};
  EXPECT_NEAR(quotient.lo, -1.0, 1e-14);
  EXPECT_NEAR(quotient.hi, -0.25, 1e-14);
  EXPECT_EQ(reciprocal(Interval{0.0, 2.0}).hi, kInfinity);
  EXPECT_NEAR(reciprocal(Interval{0.0, 2.0}).lo, 0.5, 1e-15);
}

TEST(Interval, KeepsTheSignOfProductsOfWhatIsNotNegative) {
  EXPECT_EQ((Interval{0.0, 1.0} * Interval{0.0, kInfinity}).lo, 0.0);
  EXPECT_EQ((Interval{1e-200, 1.0} * Interval{1e-200, 1.0}).lo, 0.0);
  EXPECT_GE(sqrt(Interval{0.0, 1.0}).lo, 0.0);
  EXPECT_GE(exp(Interval{-1e9, 1.0}).lo, 0.0);
}

TEST(Interval, SurvivesInfinityAndOverflow) {
  const Interval all = entire();
  for (const UnaryCase& each : unary_cases()) {
    for (const Interval& a : {all, Interval{1e300, kInfinity}, Interval{-kInfinity, -1e300}}) {
      const Interval image = each.of_interval(a);
      EXPECT_TRUE(image.lo <= image.hi) << each.name;
      EXPECT_LT(image.lo, kInfinity) << each.name;
      EXPECT_GT(image.hi, -kInfinity) << each.name;
    }
  }
  EXPECT_EQ(sin(all).lo, -1.0);
  EXPECT_EQ(sin(all).hi, 1.0);
  const Interval large = exp(Interval{800.0, 900.0});
  EXPECT_TRUE(large.contains(1e308) || large.hi == kInfinity);
  EXPECT_LT(large.lo, kInfinity);
  const Interval difference = large - large;
  EXPECT_EQ(difference.lo, -kInfinity);
  EXPECT_EQ(difference.hi, kInfinity);
}

TEST(Interval, FindsThePolesOfTheTangent) {
  constexpr double kHalfPi = std::numbers::pi / 2;
  EXPECT_TRUE(may_hold_tangent_pole({1.5, 1.6}));
  EXPECT_FALSE(may_hold_tangent_pole({1.58, 4.7}));
  for (int k = -1000; k <= 1000; ++k) {
    const double pole = kHalfPi + k * std::numbers::pi;
    EXPECT_TRUE(may_hold_tangent_pole({pole, pole})) << k;
    EXPECT_FALSE(may_hold_tangent_pole({pole + 1e-6, pole + 3.1})) << k;
  }
}

TEST(Interval, FindsTheTopsOfWavesFarFromZero) {
  for (int k = -1000; k <= 1000; ++k) {
    const double top = std::numbers::pi / 2 + 2 * k * std::numbers::pi;
    EXPECT_EQ(sin(Interval{top - 1e-9, top + 1e-9}).hi, 1.0);
    EXPECT_LT(sin(Interval{top + 0.1, top + 0.2}).hi, 0.999);
    EXPECT_GT(sin(Interval{top + 0.1, top + 0.2}).lo, 0.97);
  }
}

}  // namespace
}  // namespace interval_test
}  // namespace icome::geometry
