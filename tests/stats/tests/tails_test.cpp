#include "stats/tests/tails.h"

#include "stats/test_samples.h"

namespace icome::stats {
namespace {

TEST(Tails, NoncentralT) {
  // R 4.2: pt(2, 5, 1), pt(-1, 3.5, 0.5), pt(10, 30, 8), pt(0.3, 1, -2), which are right to about 1e-12.
  EXPECT_NEAR(noncentral_t_below(2, 5, 1), 0.778074662615947, 2e-12);
  EXPECT_NEAR(noncentral_t_below(-1, 3.5, 0.5), 0.0887405682562596, 2e-12);
  EXPECT_NEAR(noncentral_t_below(10, 30, 8), 0.881213492377486, 2e-12);
  EXPECT_NEAR(noncentral_t_below(0.3, 1, -2), 0.986346346653218, 2e-12);
  for (const double df : {1.0, 7.0, 1e4, 1e9})
    EXPECT_NEAR(noncentral_t_below(1.3, df, 0.0), 1.0 - t_above(1.3, df), 1e-14) << df;
}

TEST(Tails, BothWaysToTheNoncentralTMeet) {
  // Around the borders between the two integrals (t = sqrt(2 df), delta = 12) nothing jumps.
  for (const double df : {3.0, 50.0}) {
    const double border = std::sqrt(2.0 * df);
    for (const double delta : {11.9999999, 12.0000001, 14.0}) {
      const double below = noncentral_t_below(border * (1.0 - 1e-10), df, delta);
      const double above = noncentral_t_below(border * (1.0 + 1e-10), df, delta);
      EXPECT_NEAR(below, above, 1e-8 * std::max(below, 1e-4)) << df << " " << delta;
    }
    EXPECT_NEAR(noncentral_t_below(15.0, df, 11.9999999999), noncentral_t_below(15.0, df, 12.0000000001),
                1e-9);
  }
}

TEST(Tails, NoncentralityCoversItsShare) {
  for (const double t : {-3.0, 0.0, 0.4, 25.0, 1e5}) {
    for (const double df : {1.0, 9.0, 300.0}) {
      const ConfidenceInterval interval = t_noncentrality_interval(t, df, 0.9);
      EXPECT_NEAR(noncentral_t_below(t, df, interval.low), 0.95, 1e-11) << t << " " << df;
      EXPECT_NEAR(noncentral_t_below(t, df, interval.high), 0.05, 1e-11) << t << " " << df;
    }
  }
}

TEST(Tails, AreNotANumberWhereNothingIsDefined) {
  EXPECT_TRUE(std::isnan(noncentral_t_below(1, 0, 1)));
  EXPECT_TRUE(std::isnan(noncentral_t_below(kNotANumber, 2, 1)));
  EXPECT_TRUE(std::isnan(t_above(1.0, -1.0)));
  EXPECT_TRUE(std::isnan(f_above(1.0, 0.0, 3.0)));
  EXPECT_EQ(f_above(kEndless, 2.0, 3.0), 0.0);
  EXPECT_EQ(t_above(kEndless, 3.0), 0.0);
  EXPECT_EQ(chi_squared_above(kEndless, 3.0), 0.0);
}

}  // namespace
}  // namespace icome::stats
