#include "geometry/implicit/formula.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/random.h"

namespace icome::geometry {
namespace formula_test {
namespace {

using base::Vector3;

Formula formula_of(const std::string& text) {
  auto formula = Formula::parse(text);
  EXPECT_TRUE(formula) << text << ": " << (formula ? "" : formula.error().message);
  return formula ? *formula : *Formula::parse("x");
}

std::string error_of(const std::string& text) {
  const auto formula = Formula::parse(text);
  return formula ? "" : formula.error().message;
}

struct ValueCase {
  std::string text;
  std::function<double(double x, double y, double z, double t)> value;
};

/// Every function, operator and simplification at least once; all are smooth for coordinates in (0.1, 0.9).
const std::vector<ValueCase>& value_cases() {
  using std::pow;
  static const std::vector<ValueCase> kCases{
      {"x", [](double x, double, double, double) { return x; }},
      {"-x^2", [](double x, double, double, double) { return -(x * x); }},
      {"x^-2", [](double x, double, double, double) { return 1 / (x * x); }},
      {"2^3^2*x", [](double x, double, double, double) { return 512 * x; }},
      {"x-y-z", [](double x, double y, double z, double) { return x - y - z; }},
      {"x/y/z", [](double x, double y, double z, double) { return x / y / z; }},
      {"x-(y-z)", [](double x, double y, double z, double) { return x - (y - z); }},
      {"2*-x+y", [](double x, double y, double, double) { return -2 * x + y; }},
      {"x*x*x*y", [](double x, double y, double, double) { return x * x * x * y; }},
      {"x+x-3*x*y", [](double x, double y, double, double) { return x + x - 3 * x * y; }},
      {"(x+1)+2-3", [](double x, double, double, double) { return x; }},
      {"3-x", [](double x, double, double, double) { return 3 - x; }},
      {"3/x", [](double x, double, double, double) { return 3 / x; }},
      {"x*y/(z+t)", [](double x, double y, double z, double t) { return x * y / (z + t); }},
      {"sin(x*y)", [](double x, double y, double, double) { return std::sin(x * y); }},
      {"cos(x+y*t)", [](double x, double y, double, double t) { return std::cos(x + y * t); }},
      {"tan(x*z)", [](double x, double, double z, double) { return std::tan(x * z); }},
      {"asin(x*y)", [](double x, double y, double, double) { return std::asin(x * y); }},
      {"acos(x*t)", [](double x, double, double, double t) { return std::acos(x * t); }},
      {"atan(x/y)", [](double x, double y, double, double) { return std::atan(x / y); }},
      {"atan2(y-0.5*t, x)", [](double x, double y, double, double t) { return std::atan2(y - 0.5 * t, x); }},
      {"if(x < y, x*y, z)", [](double x, double y, double z, double) { return x < y ? x * y : z; }},
      {"if(x > 2*y || !(z > t), 1 - x, if(x <= y && z >= x, y, z^2))",
       [](double x, double y, double z, double t) {
         if (x > 2 * y || !(z > t)) return 1 - x;
         return x <= y && z >= x ? y : z * z;
       }},
      {"if(x < y, 1, 1 + sqrt(x-y))",  // of what is not taken nothing counts
       [](double x, double y, double, double) { return x < y ? 1 : 1 + std::sqrt(x - y); }},
      {"sinh(x*y)", [](double x, double y, double, double) { return std::sinh(x * y); }},
      {"cosh(x-y)", [](double x, double y, double, double) { return std::cosh(x - y); }},
      {"tanh(x*y-z)", [](double x, double y, double z, double) { return std::tanh(x * y - z); }},
      {"exp(x*y)", [](double x, double y, double, double) { return std::exp(x * y); }},
      {"log(x*y)", [](double x, double y, double, double) { return std::log(x * y); }},
      {"ln(x)", [](double x, double, double, double) { return std::log(x); }},
      {"log10(x*t)", [](double x, double, double, double t) { return std::log10(x * t); }},
      {"sqrt(x^2+y^2)", [](double x, double y, double, double) { return std::sqrt(x * x + y * y); }},
      {"abs(x-2*y*z-1)", [](double x, double y, double z, double) { return std::abs(x - 2 * y * z - 1); }},
      {"hypot(x, y*z)", [](double x, double y, double z, double) { return std::hypot(x, y * z); }},
      {"pow(x*y, 3)", [](double x, double y, double, double) { return pow(x * y, 3); }},
      {"x^4", [](double x, double, double, double) { return pow(x, 4); }},
      {"(x*y)^7", [](double x, double y, double, double) { return pow(x * y, 7); }},
      {"x^1.5", [](double x, double, double, double) { return pow(x, 1.5); }},
      {"abs(x - y)^3.5", [](double x, double y, double, double) { return pow(std::abs(x - y), 3.5); }},
      {"((x - y)^2)^1.75", [](double x, double y, double, double) { return pow(std::abs(x - y), 3.5); }},
      {"abs(x)^0.7", [](double x, double, double, double) { return pow(x, 0.7); }},
      {"sqrt(x^4)", [](double x, double, double, double) { return x * x; }},
      {"sin(3*x)/x", [](double x, double, double, double) { return std::sin(3 * x) / x; }},
      {"2*sin(x*y)/(-y*x)",
       [](double x, double y, double, double) { return -2 * std::sin(x * y) / (x * y); }},
      {"sin(9*hypot(x,y))/hypot(x,y)",
       [](double x, double y, double, double) { return std::sin(9 * std::hypot(x, y)) / std::hypot(x, y); }},
      {"x^0.5", [](double x, double, double, double) { return std::sqrt(x); }},
      {"x^-0.5", [](double x, double, double, double) { return 1 / std::sqrt(x); }},
      {"x^y", [](double x, double y, double, double) { return pow(x, y); }},
      {"(x+y)^(z*t)", [](double x, double y, double z, double t) { return pow(x + y, z * t); }},
      {"2^(x*y)", [](double x, double y, double, double) { return pow(2, x * y); }},
      {"e^x", [](double x, double, double, double) { return std::exp(x); }},
      {"min(x, y+1, z+2)", [](double x, double, double, double) { return x; }},
      {"max(x-1, y, z-2)", [](double, double y, double, double) { return y; }},
      {"pi*x+e", [](double x, double, double, double) { return std::numbers::pi * x + std::numbers::e; }},
      {"1.5e-1*x+.5*y+2.*z", [](double x, double y, double z, double) { return 0.15 * x + 0.5 * y + 2 * z; }},
      {"(x*y+z)/(x*y+z+1)",
       [](double x, double y, double z, double) { return (x * y + z) / (x * y + z + 1); }},
      {"+x - -y", [](double x, double y, double, double) { return x + y; }},
      {"-(-(x*2))", [](double x, double, double, double) { return 2 * x; }},
      {"z - 0.005*sin(60*x + 3*t)*cos(60*y)",
       [](double x, double y, double z, double t) {
         return z - 0.005 * std::sin(60 * x + 3 * t) * std::cos(60 * y);
       }},
      {"x\t+\n y", [](double x, double y, double, double) { return x + y; }},
      {"1/(x+y)^2", [](double x, double y, double, double) { return 1 / ((x + y) * (x + y)); }},
      {"x^2*x^3", [](double x, double, double, double) { return pow(x, 5); }},
      {"0*x+y*1", [](double, double y, double, double) { return y; }},
  };
  return kCases;
}

Vector3 random_place(base::Random& random) {
  return {random.uniform(0.1, 0.9), random.uniform(0.1, 0.9), random.uniform(0.1, 0.9)};
}

TEST(Formula, HasTheValuesOfTheSameExpressionInCpp) {
  for (const ValueCase& each : value_cases()) {
    const Formula formula = formula_of(each.text);
    base::Random random(1);
    for (int i = 0; i < 100; ++i) {
      const Vector3 p = random_place(random);
      const double t = random.uniform(0.1, 0.9), expected = each.value(p.x(), p.y(), p.z(), t);
      ASSERT_NEAR(formula.value(p, t), expected, 1e-13 * (1.0 + std::abs(expected))) << each.text;
    }
  }
}

TEST(Formula, HasTheDerivativesOfCentralDifferences) {
  constexpr double kStep = 1e-5;
  for (const ValueCase& each : value_cases()) {
    const Formula formula = formula_of(each.text);
    base::Random random(2);
    for (int i = 0; i < 50; ++i) {
      const Vector3 p = random_place(random);
      const double t = random.uniform(0.1, 0.9);
      const Formula::Slope slope = formula.slope(p, t);
      const Formula::Bend bend = formula.bend(p, t);
      EXPECT_EQ(slope.value, formula.value(p, t)) << each.text;
      EXPECT_EQ(bend.value, slope.value) << each.text;
      ASSERT_LT((bend.gradient - slope.gradient).norm(), 1e-12 * (1.0 + slope.gradient.norm())) << each.text;
      const double rate = (formula.value(p, t + kStep) - formula.value(p, t - kStep)) / (2 * kStep);
      ASSERT_NEAR(slope.rate, rate, 1e-6 * (1.0 + std::abs(rate))) << each.text;
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3 h = kStep * Vector3::Unit(axis);
        const double d = (formula.value(p + h, t) - formula.value(p - h, t)) / (2 * kStep);
        ASSERT_NEAR(slope.gradient[axis], d, 1e-6 * (1.0 + std::abs(d))) << each.text << " axis " << axis;
        const Vector3 dd =
            (formula.slope(p + h, t).gradient - formula.slope(p - h, t).gradient) / (2 * kStep);
        ASSERT_LT((bend.hessian.col(axis) - dd).norm(), 1e-5 * (1.0 + dd.norm())) << each.text;
      }
      const Vector3 step(0.3, -0.2, 0.1);
      const Formula::LineSlope along = formula.on_line(p - 0.5 * step, step, 0.5, t);
      ASSERT_NEAR(along.slope, slope.gradient.dot(step), 1e-9 * (1.0 + slope.gradient.norm())) << each.text;
    }
  }
}

TEST(Formula, HasTheGradientOfClosedForms) {
  const Formula waves = formula_of("z - 0.005*sin(60*x + 3*t)*cos(60*y)");
  const Vector3 p(0.013, -0.02, 0.004);
  const double t = 1.7, phase = 60 * p.x() + 3 * t;
  const Formula::Slope slope = waves.slope(p, t);
  EXPECT_NEAR(slope.gradient.x(), -0.3 * std::cos(phase) * std::cos(60 * p.y()), 1e-15);
  EXPECT_NEAR(slope.gradient.y(), 0.3 * std::sin(phase) * std::sin(60 * p.y()), 1e-15);
  EXPECT_NEAR(slope.gradient.z(), 1.0, 0.0);
  EXPECT_NEAR(slope.rate, -0.015 * std::cos(phase) * std::cos(60 * p.y()), 1e-15);
}

TEST(Formula, RangesHoldValuesAndDerivatives) {
  std::vector<std::string> texts;
  for (const ValueCase& each : value_cases()) texts.push_back(each.text);
  for (const char* text :
       {"sqrt(x)+y", "log(x-y)", "x/y", "tan(x*5)", "asin(x+y)", "x^y", "x^1.5", "1/x+1/y", "atan2(y,x)",
        "abs(x)*z", "abs(x)^1.5", "sqrt((x - y)^2)", "sin(9*x)/x", "sin(hypot(x,y))/hypot(x,y)", "min(x,y,z)",
        "max(x*y,z)-t", "hypot(x,y)", "exp(x*99)"}) {
    texts.emplace_back(text);
  }
  for (const std::string& text : texts) {
    const Formula formula = formula_of(text);
    base::Random random(3);
    int slopes = 0;
    for (int i = 0; i < 200; ++i) {
      const double size = std::pow(10.0, random.uniform(-7.0, 0.5));
      Formula::Box4 box;
      for (Interval& side : box) {
        const double a = random.uniform(-1.0, 1.0);
        side = {a, a + size * random.uniform()};
      }
      const auto at = formula.slope_range(box);
      const Formula::Range plain = formula.range(box);
      EXPECT_EQ(at.range.value.lo, plain.value.lo) << text;
      EXPECT_EQ(at.range.value.hi, plain.value.hi) << text;
      for (int k = 0; k < 20; ++k) {
        Vector3 p;
        for (int axis = 0; axis < 3; ++axis) {
          p[axis] =
              random.uniform(box[static_cast<std::size_t>(axis)].lo, box[static_cast<std::size_t>(axis)].hi);
        }
        const double t = random.uniform(box[3].lo, box[3].hi);
        const Formula::Slope slope = formula.slope(p, t);
        if (std::isnan(slope.value)) {
          ASSERT_FALSE(at.range.total) << text;
          continue;
        }
        ASSERT_FALSE(at.range.never) << text;
        if (std::isinf(slope.value)) continue;
        ASSERT_TRUE(at.range.value.contains(slope.value)) << text << " at " << p.transpose() << " " << t;
        if (!at.range.total) continue;
        ++slopes;
        for (int axis = 0; axis < 3; ++axis) {
          ASSERT_TRUE(at.slope[static_cast<std::size_t>(axis)].contains(slope.gradient[axis]))
              << text << " axis " << axis;
        }
      }
    }
    EXPECT_GT(slopes, 200) << text;
  }
}

TEST(Formula, RangesAlongLinesAndPatchesHoldThoseOfTheirPoints) {
  for (const ValueCase& each : value_cases()) {
    const Formula formula = formula_of(each.text);
    base::Random random(4);
    int on_lines = 0, on_patches = 0;
    for (int i = 0; i < 50; ++i) {
      const Vector3 p = random_place(random), u = random.direction(), v = random.direction();
      const double t = random.uniform(0.1, 0.9), size = std::pow(10.0, random.uniform(-6.0, -0.5));
      const auto line = formula.line_range(p, u, {0.0, size}, t);
      const auto patch = formula.patch_range(p, u, v, {0.0, size}, {-size, size}, t);
      for (int k = 0; k < 10; ++k) {
        const double s = random.uniform(0.0, size), h = random.uniform(-size, size);
        const Formula::LineSlope on_line = formula.on_line(p, u, s, t);
        if (line.range.total) {
          ++on_lines;
          ASSERT_TRUE(line.range.value.contains(on_line.value)) << each.text;
          ASSERT_TRUE(line.slope[0].contains(on_line.slope)) << each.text;
          ASSERT_TRUE(formula.point_range(p, u, s, t).value.contains(on_line.value)) << each.text;
        }
        if (!patch.range.total) continue;
        ++on_patches;
        const Formula::Slope at = formula.slope(p + s * u + h * v, t);
        const double rounding = 1e-13 * (1.0 + at.gradient.norm());
        ASSERT_TRUE(patch.range.value.contains(at.value)) << each.text;
        ASSERT_LE(patch.slope[0].lo, at.gradient.dot(u) + rounding) << each.text;
        ASSERT_GE(patch.slope[0].hi, at.gradient.dot(u) - rounding) << each.text;
        ASSERT_LE(patch.slope[1].lo, at.gradient.dot(v) + rounding) << each.text;
        ASSERT_GE(patch.slope[1].hi, at.gradient.dot(v) - rounding) << each.text;
      }
    }
    EXPECT_GT(on_lines, 100) << each.text;
    EXPECT_GT(on_patches, 100) << each.text;
  }
}

TEST(Formula, SharesAndFoldsWhatItCan) {
  EXPECT_EQ(formula_of("x").steps(), 0U);
  EXPECT_EQ(formula_of("x + 2*3 - 6").steps(), 0U);
  EXPECT_EQ(formula_of("sin(2*x)*sin(x*2)").steps(), 3U);  // scale, sin, square
  EXPECT_EQ(formula_of("(x+y)*(x+y)*(y+x)").steps(), 2U);  // add, cube
  EXPECT_EQ(formula_of("sqrt(x*x+y*y)-sqrt(y*y+x*x)+z").steps(), 0U);
  EXPECT_FALSE(formula_of("x - t + t*1").uses_time() && formula_of("x + 0*t").uses_time());
  EXPECT_FALSE(formula_of("x + 0*t").uses_time());
  EXPECT_TRUE(formula_of("x + t").uses_time());
  EXPECT_FALSE(formula_of("t + 1").uses_place());
}

TEST(Formula, GivesNanWhereItIsUndefined) {
  for (const char* text : {"sqrt(x)", "log(x)", "x^0.3", "asin(x - 5)", "min(sqrt(x), y)", "max(y, sqrt(x))",
                           "x^y", "0*y + sqrt(x)", "hypot(sqrt(x), 1)"}) {
    EXPECT_TRUE(std::isnan(formula_of(text).value({-1.0, 0.5, 0.0}, 0.0))) << text;
  }
}

TEST(Formula, NamesTheColumnOfWhatIsWrong) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"x +", "column 4"},
      {"foo(x)", "column 1: \"foo\" is unknown; known are x, y, z, t, pi, e"},
      {"x + w", "column 5"},
      {"x y", "column 3"},
      {"2x", "column 2"},
      {"sin()", "column 5"},
      {"sin(x,y)", "column 8"},
      {"atan2(x)", "column 8"},
      {"x < y", "a comparison makes sense"},
      {"(x < y) + 1", "a comparison makes sense"},
      {"if(x, 1, 2)", "take comparisons"},
      {"if(x < y && z, 1, 2)", "take comparisons"},
      {"if(x < y, 1)", "takes more values"},
      {"if(x = y, 1, 2)", "column 6"},
      {"(x", "column 3"},
      {"x)", "column 2"},
      {"x*/y", "column 3"},
      {"x == y", "column 3"},
      {"x?y:z", "column 2"},
      {"\"x\"", "column 1"},
      {"x, y", "column 2"},
      {"3.5.2*x", "column 4"},
      {"x + 1e999", "column 5"},
      {"sin x", "parentheses"},
      {"x + \xc3\xa9", "column 5"},
      {"x # y", "column 3"},
      {std::string("x\0y", 3), "column 2"},
      {"*x", "column 1: a value is missing"}};
  for (const auto& [text, part] : cases) {
    EXPECT_NE(error_of(text).find(part), std::string::npos) << text << ": " << error_of(text);
  }
}

TEST(Formula, RefusesWhatHasNoValue) {
  for (const char* text : {"", "   ", "1/0", "x/0", "x + sqrt(-1)", "log(0) + x", "x + (-8)^(1/3)",
                           "asin(2)*x", "min()", "()", "-", "^", ",", "x^", "sin", "sin(", "e e", "x=1"}) {
    EXPECT_NE(error_of(text), "") << text;
  }
}

TEST(Formula, SurvivesHostileText) {
  const auto repeat = [](const std::string& part, int times) {
    std::string text;
    for (int i = 0; i < times; ++i) text += part;
    return text;
  };
  EXPECT_NE(error_of(repeat("(", 10'000) + std::string("x") + repeat(")", 10'000)), "");
  EXPECT_EQ(error_of(repeat("(", 8'000) + std::string("x") + repeat(")", 8'000)), "");
  EXPECT_NE(error_of(repeat("(", 16'000)), "");
  EXPECT_NE(error_of(repeat(")", 16'000)), "");
  EXPECT_NE(error_of(std::string(1'000'000, 'x')), "");
  EXPECT_LT(error_of(std::string(16'000, 'x')).size(), 400U);
  EXPECT_NE(error_of(std::string("x") + repeat("^x", 8'000)), "");
  EXPECT_EQ(error_of(std::string("x") + repeat("^x", 50)), "");
  EXPECT_EQ(error_of(std::string("x") + repeat("+sin(x)*2", 1'500)), "");
  EXPECT_NE(error_of(repeat("-", 16'000) + "x"), "");
  EXPECT_EQ(error_of(repeat("sin(", 3'000) + std::string("x") + repeat(")", 3'000)), "");
  EXPECT_NE(error_of(repeat("sin(x)+(cos(y)*", 500) + std::string("x") + repeat(")", 500)).size(), 1U);
}

TEST(Formula, SurvivesRandomText) {
  const std::string letters = "xyzt0123456789.+-*/^(),  esinqrtpow";
  base::Random random(5);
  int readable = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string text;
    for (std::uint64_t length = random.index(12); length > 0; --length) {
      text += letters[random.index(letters.size())];
    }
    const auto formula = Formula::parse(text);
    if (formula) {
      ++readable;
      (void)formula->bend({0.1, 0.2, 0.3}, 0.4);
    } else {
      ASSERT_FALSE(formula.error().message.empty()) << text;
    }
  }
  EXPECT_GT(readable, 100);
}

TEST(Formula, CanBeReadBySeveralThreadsAtOnce) {
  std::array<double, 4> values{};
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < values.size(); ++i) {
    threads.emplace_back([i, &values] {
      for (int k = 0; k < 50; ++k) {
        values[i] +=
            Formula::parse(std::string("x*") + std::to_string(i) + " + sin(y)")->value({1.0, 0.0, 0.0}, 0.0);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(values[i], 50.0 * static_cast<double>(i));
}

}  // namespace
}  // namespace formula_test
}  // namespace icome::geometry
