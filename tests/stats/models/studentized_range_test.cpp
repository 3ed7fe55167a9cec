#include "stats/models/studentized_range.h"

#include "stats/test_samples.h"
#include "stats/tests/tails.h"

namespace icome::stats {
namespace {

TEST(StudentizedRange, AgreesWithR) {
  // R 4.2: ptukey(q, k, df), then lower.tail = FALSE. R is right to about ten digits for such df, not for df
  // < 5.
  EXPECT_NEAR(studentized_range_below(3.5, 3, 20), 0.944108150917941, 1e-9);
  EXPECT_NEAR(studentized_range_below(2, 5, 12), 0.369193132641907, 1e-9);
  EXPECT_NEAR(studentized_range_below(5, 10, 60), 0.974715780191744, 1e-9);
  EXPECT_NEAR(studentized_range_below(1, 4, 30), 0.10651686872921, 1e-9);
  EXPECT_NEAR(studentized_range_above(6, 3, 20), 0.00111168276887141, 1e-9);
  EXPECT_NEAR(studentized_range_above(9, 5, 40), 1.41162545075346e-06, 1e-10);
}

TEST(StudentizedRange, OfTwoGroupsIsStudentsT) {
  for (const double df : {1.0, 3.0, 12.0, 200.0}) {
    for (const double q : {0.5, 3.5, 8.0}) {
      const double p = 2.0 * t_above(q / std::sqrt(2.0), df);
      EXPECT_NEAR(studentized_range_above(q, 2, df) / p, 1.0, 1e-13) << q << " " << df;
      EXPECT_NEAR(studentized_range_below(q, 2, df), 1.0 - p, 1e-13) << q << " " << df;
    }
  }
}

TEST(StudentizedRange, OfFewDegreesOfFreedom) {
  // R 4.2: the double integral by integrate(rel.tol = 1e-12), where ptukey itself is off by 1e-4.
  EXPECT_NEAR(studentized_range_below(3.5, 3, 2), 0.770528479306017, 1e-11);
  EXPECT_NEAR(studentized_range_below(8, 5, 4), 0.977980586672355, 1e-11);
}

TEST(StudentizedRange, OfManyGroups) {
  // R 4.2: k * integrate(function(z) dnorm(z) * (pnorm(z) - pnorm(z - 4.5))^(k - 1), -8.5, 9, rel.tol =
  // 1e-13), where ptukey(4.5, k, Inf) is off by 2e-9 and 3e-6.
  EXPECT_NEAR(studentized_range_below(4.5, 20, kEndless), 0.8533913941553595, 1e-12);
  EXPECT_NEAR(studentized_range_below(4.5, 200, kEndless), 0.02259251041088463, 1e-12);
}

TEST(StudentizedRange, TailsAddUp) {
  for (const double groups : {2.0, 7.0, 50.0, 1000.0})
    for (const double df : {1.0, 2.5, 40.0, 1e6, kEndless})
      for (const double q : {0.1, 2.0, 6.0, 30.0})
        EXPECT_NEAR(studentized_range_below(q, groups, df) + studentized_range_above(q, groups, df), 1.0,
                    1e-12)
            << q << " " << groups << " " << df;
}

TEST(StudentizedRange, Quantiles) {
  // R 4.2: uniroot(function(q) ptukey(q, k, df) - p, tol = 1e-13), as qtukey has four digits only.
  EXPECT_NEAR(studentized_range_quantile(0.95, 3, 20), 3.57793472522597, 1e-8);
  EXPECT_NEAR(studentized_range_quantile(0.99, 5, 12), 5.83630836611482, 1e-8);
  EXPECT_NEAR(studentized_range_quantile(0.5, 10, 60), 3.04313660289516, 1e-8);
  EXPECT_NEAR(studentized_range_quantile(0.95, 4, kEndless), 3.63315957491235, 1e-8);
  for (const double p : {1e-6, 0.3, 0.95, 0.9999})
    EXPECT_NEAR(studentized_range_below(studentized_range_quantile(p, 6, 9), 6, 9), p, 1e-12);
}

TEST(StudentizedRange, IsNotANumberOutsideItsRange) {
  EXPECT_TRUE(std::isnan(studentized_range_below(1, 1, 10)));
  EXPECT_TRUE(std::isnan(studentized_range_below(1, 3, 0.5)));
  EXPECT_TRUE(std::isnan(studentized_range_below(kNotANumber, 3, 5)));
  EXPECT_TRUE(std::isnan(studentized_range_quantile(1.0, 3, 5)));
  EXPECT_TRUE(std::isnan(studentized_range_quantile(0.5, 3, kNotANumber)));
  EXPECT_EQ(studentized_range_below(-1, 3, 5), 0.0);
  EXPECT_EQ(studentized_range_above(kEndless, 3, 5), 0.0);
  EXPECT_EQ(studentized_range_quantile(0.0, 3, 5), 0.0);
}

}  // namespace
}  // namespace icome::stats
