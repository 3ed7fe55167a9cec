#include "stats/models/effect_sizes.h"

#include <gtest/gtest.h>

#include "stats/anova_test_data.h"
#include "stats/models/anova.h"
#include "stats/tests/tails.h"

namespace icome::stats {
namespace {

using anova_data::expect_digits;

// R 4.2, the distribution as a Poisson mixture (pf's ncp is good for 8 digits only):
// P <- function(f, a, b, l) { k <- 0:3000; x <- a*f/(a*f + b); sum(dpois(k, l/2) * pbeta(x, a/2 + k, b/2)) }
// uniroot(function(l) P(f, a, b, l) - c(.95, .05), c(0, 2000), tol = 1e-13)
TEST(EffectSizes, IntervalOfNoncentrality) {
  expect_digits(noncentral_f_below(4.0, 3.0, 20.0, 10.0), 0.4806192091948, 12);
  const auto small = noncentrality_interval(4.0, 3.0, 10.0);
  ASSERT_TRUE(small);
  expect_digits(small->low, 0.2394470069615, 9);
  expect_digits(small->high, 27.58424082156, 10);
  const auto large = noncentrality_interval(50.0, 3.0, 1000.0);
  expect_digits(large->low, 109.2071454632, 10);
  expect_digits(large->high, 192.4744203973, 10);
}

TEST(EffectSizes, IntervalOfPlantGrowth) {
  const auto share = partial_eta_sq_interval(4.84608786238014, 2.0, 27.0);
  ASSERT_TRUE(share);
  // r / (r + 30) of what R gives as above.
  expect_digits(share->low, 0.03188824824671, 10);
  expect_digits(share->high, 0.4287989902896, 10);
  // In a one-way analysis eta squared is the partial one.
  const auto same = eta_sq_interval(3.76634 / 14.25843, 2.0, 27.0);
  expect_digits(same->low, share->low, 9);
  expect_digits(same->high, share->high, 9);
}

TEST(EffectSizes, ZeroIsInTheIntervalUnlessSignificant) {
  for (const double f : {0.0, 0.3, 2.0, 3.3, 3.4, 10.0}) {
    const auto interval = partial_eta_sq_interval(f, 2.0, 27.0);
    ASSERT_TRUE(interval);
    EXPECT_EQ(interval->low > 0.0, f_above(f, 2.0, 27.0) < 0.05) << f;
    EXPECT_LE(interval->low, interval->high);
  }
  EXPECT_EQ(partial_eta_sq_interval(0.0, 2.0, 27.0)->high, 0.0);
}

TEST(EffectSizes, LargeSamplesAndEffects) {
  const auto many = partial_eta_sq_interval(1000.0, 3.0, 1e6);
  ASSERT_TRUE(many);
  // The population's share is near F df / (F df + n); its interval is narrow.
  EXPECT_NEAR(many->low, 0.00281, 1e-5);
  EXPECT_NEAR(many->high, 0.00317, 1e-5);
  const auto strong = partial_eta_sq_interval(1e6, 3.0, 1e6);
  ASSERT_TRUE(strong);
  EXPECT_LT(strong->low, 0.75);
  EXPECT_GT(strong->high, 0.75);
}

TEST(EffectSizes, WhatHasNoIntervalIsSaid) {
  EXPECT_EQ(partial_eta_sq_interval(NAN, 2.0, 3.0).error().message,
            "there is no interval around an F of nan: see the table's warnings");
  EXPECT_FALSE(partial_eta_sq_interval(INFINITY, 2.0, 3.0));
  EXPECT_FALSE(partial_eta_sq_interval(-1.0, 2.0, 3.0));
  EXPECT_FALSE(partial_eta_sq_interval(1.0, 0.0, 3.0));
  EXPECT_FALSE(partial_eta_sq_interval(1.0, 2.0, 0.0));
  EXPECT_FALSE(partial_eta_sq_interval(1.0, 2.0, 3.0, 1.0));
  EXPECT_FALSE(eta_sq_interval(1.0, 2.0, 3.0));
  EXPECT_FALSE(eta_sq_interval(NAN, 2.0, 3.0));
}

TEST(EffectSizes, TheIntervalHoldsTheShareAsOftenAsItSays) {
  base::Random random(20266);
  // Three groups of 8 at -1, 0, 1: noncentrality 8 (1 + 0 + 1) = 16, share 16 / (16 + 24).
  std::vector<int> of;
  for (int i = 0; i < 24; ++i) of.push_back(i / 8);
  const Factor group = anova_data::numbered("x", of);
  int outside = 0;
  for (int i = 0; i < 500; ++i) {
    std::vector<double> values;
    for (const int level : of) values.push_back(level + anova_data::normal_value(random));
    const auto interval = partial_eta_sq_interval(one_way_anova(values, group)->terms[0].f, 2.0, 21.0);
    outside += interval->low > 0.4 || interval->high < 0.4 ? 1 : 0;
  }
  anova_data::expect_level(outside, 0.10, 500);
}

TEST(EffectSizes, AShareOfMoreHasTheNoncentralityOfItsF) {
  // R 4.2.2, of seven people in three conditions: F(2, 12) = 29.04; noncentralities L by uniroot() over
  // pf(F, 2, 12, L) - c(.95, .05); generalised eta squared L * MSe / (L * MSe + SSe + SSs), partial omega
  // squared L * MSe / (L * MSe + 2 * MSe + SSe + SSs + MSs).
  const auto eta = share_interval(29.0373134328358, 2.0, 12.0, 0.0372222222222222, 4.6028571428571432);
  ASSERT_TRUE(eta) << eta.error().message;
  EXPECT_NEAR(eta->low, 0.135876617423442, 1e-7);
  EXPECT_NEAR(eta->high, 0.471256605149769, 1e-7);
  const auto omega = share_interval(29.0373134328358, 2.0, 12.0, 0.0372222222222222, 5.37);
  EXPECT_NEAR(omega->low, 0.118771132029773, 1e-7);
  EXPECT_NEAR(omega->high, 0.433090942604504, 1e-7);
  EXPECT_EQ(share_interval(0.5, 2.0, 12.0, 0.04, 4.6)->low, 0.0);
  EXPECT_FALSE(share_interval(2.0, 2.0, 12.0, 0.0, 4.6));
  EXPECT_FALSE(share_interval(INFINITY, 2.0, 12.0, 0.04, 4.6));
}

TEST(FDistribution, FarTailsAndWhatIsNotThere) {
  // R 4.2: pf(1e4, 3, 20, lower.tail = FALSE), pf(5.2, 2, 1e6, lower.tail = FALSE)
  expect_digits(f_above(1e4, 3.0, 20.0), 6.37205408584167e-32, 10);
  expect_digits(f_above(5.2, 2.0, 1e6), 0.00551671358964523, 10);
  EXPECT_EQ(f_above(0.0, 3.0, 20.0), 1.0);
  EXPECT_EQ(f_above(INFINITY, 3.0, 20.0), 0.0);
  EXPECT_TRUE(std::isnan(f_above(NAN, 3.0, 20.0)));
  EXPECT_TRUE(std::isnan(f_above(2.0, 0.0, 20.0)));
}

}  // namespace
}  // namespace icome::stats
