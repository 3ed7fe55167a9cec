#include "geometry/implicit/plain_formula.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "geometry/implicit/formula.h"

namespace icome::geometry {
namespace {

TEST(PlainFormula, AgreesWithTheCompiledOne) {
  base::Random random(4);
  for (const char* text :
       {"x^2 + y^2 + z^2 - 0.05^2", "-x^2 + y^z^2", "z - 0.01*sin(50*x + t)*cos(pi*y)",
        "log(x) + log10(y) - ln(z)", "max(x, y, -z) - min(x, t)", "atan2(y, x) + hypot(x, z) - pow(2, x)",
        "1/x - sqrt(y)*e", "abs(x) - tanh(y) + exp(-z) / cosh(t) * sinh(x)",
        "asin(x) + acos(y) - atan(z) + tan(t)", "-(x - +y) * 1e-3", "if(x < y, z, -z)",
        "if(x <= 0.5 && !(y > z) || z >= 1, sqrt(x), x*y)", "if(log(x) > y, if(z < 0, 1, x), log(y))",
        "2 - 3 - if(x^2 + y^2 < z^2 || sqrt(y) > 1 && x < 0, atan2(y, x), 2^-x)"}) {
    const auto compiled = Formula::parse(text);
    const auto plain = plain_formula(text);
    ASSERT_TRUE(compiled && plain) << text;
    int defined = 0;
    for (int i = 0; i < 500; ++i) {
      const base::Vector3 place(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2));
      const double time = random.uniform(0, 5);
      const double expected = compiled->value(place, time), actual = (*plain)(place, time);
      if (std::isnan(expected) || std::isnan(actual)) {
        EXPECT_EQ(std::isnan(expected), std::isnan(actual)) << text << " at " << place.transpose();
      } else {
        EXPECT_NEAR(actual, expected, 1e-12 * (1.0 + std::abs(expected))) << text;
        ++defined;
      }
    }
    EXPECT_GT(defined, 20) << text;
  }
}

TEST(PlainFormula, RefusesWhatItCannotRead) {
  EXPECT_FALSE(plain_formula("x + * y"));
  EXPECT_FALSE(plain_formula("x + w"));
  EXPECT_FALSE(plain_formula(""));
}

}  // namespace
}  // namespace icome::geometry
