#include "stats/models/power.h"

#include "stats/test_samples.h"
#include "stats/tests/t_tests.h"

namespace icome::stats {
namespace {

constexpr PowerSettings kOneSided = {0.05, Alternative::Greater};

TEST(Power, OfTTests) {
  // R 4.2: power.t.test(n = 20, delta = 1), which leaves out the other tail (1e-12 here);
  // (n = 20, delta = 0.5, strict = TRUE); (n = 20, delta = 0.5, type = "paired", alternative = "one.sided");
  // (n = 8, delta = 0.1, strict = TRUE, type = "one.sample").
  EXPECT_NEAR(*t_test_power(TDesign::TwoSample, 20, 1.0), 0.868952801692498, 1e-6);
  expect_near(*t_test_power(TDesign::TwoSample, 20, 0.5), 0.33793902892509);
  expect_near(*t_test_power(TDesign::Paired, 20, 0.5, kOneSided), 0.695149338244658);
  expect_near(*t_test_power(TDesign::OneSample, 8, 0.1), 0.0569815715899764);
  // Groups of 12 and 30, d = 0.6: pt(qt(0.975, 40), 40, l, lower = FALSE) + pt(-qt(0.975, 40), 40, l).
  expect_near(*t_test_power(12.0, 30.0, 0.6), 0.403145781705709);
  expect_near(*t_test_power(20.0, 20.0, 0.5), 0.33793902892509);
}

TEST(Power, CountsForTTests) {
  // R 4.2: power.t.test(power = 0.9, delta = 1)$n = 22.02; (0.8, 0.5, strict) 63.77; paired 0.2 198.15;
  // one-sided (0.9, 1) 17.85. The next whole number.
  EXPECT_EQ(*t_test_count(TDesign::TwoSample, 1.0, 0.9), 23u);
  EXPECT_EQ(*t_test_count(TDesign::TwoSample, 0.5, 0.8), 64u);
  EXPECT_EQ(*t_test_count(TDesign::Paired, 0.2, 0.8), 199u);
  EXPECT_EQ(*t_test_count(TDesign::TwoSample, 1.0, 0.9, kOneSided), 18u);
  EXPECT_EQ(*t_test_count(TDesign::OneSample, 1000.0, 0.8), 2u);
}

TEST(Power, OfAnova) {
  // R 4.2: power.anova.test(groups = 4, between.var = 1, within.var = 3, n = 5), where f^2 = 3 / 4 * 1 / 3;
  // with power = 0.8: n = 11.93; groups = 3, f = 0.25: 52.4.
  expect_near(*anova_power(4, 5, 0.5), 0.353559423815302);
  EXPECT_EQ(*anova_count(4, 0.5, 0.8), 12u);
  EXPECT_EQ(*anova_count(3, 0.25, 0.8), 53u);
  // Two groups: the two-sided t-test with d = 2 f.
  expect_near(*anova_power(2, 20, 0.25), *t_test_power(TDesign::TwoSample, 20, 0.5));
  EXPECT_NEAR(*anova_power(3, 10, 0.0), 0.05, 1e-12);
}

TEST(Power, OfChiSquared) {
  // R 4.2: pchisq(qchisq(0.95, 1), 1, 100 * 0.3^2, lower = FALSE), pchisq(qchisq(0.99, 4), 4, 200 * 0.2^2,
  // ...); Cohen (1988), table 7.4: 87 or 88 for w = 0.3, df = 1, power 0.8 (87.2).
  expect_near(*chi_squared_power(1, 100, 0.3), 0.850838768327056);
  expect_near(*chi_squared_power(4, 200, 0.2, 0.01), 0.365968748533892);
  EXPECT_EQ(*chi_squared_count(1, 0.3, 0.8), 88u);
  EXPECT_EQ(*chi_squared_count(4, 0.1, 0.9), 1541u);
}

TEST(Power, OfHugeEffectsIsOne) {
  EXPECT_NEAR(*t_test_power(TDesign::TwoSample, 1e6, 1e3), 1.0, 1e-12);
  EXPECT_NEAR(*anova_power(3, 1e6, 1e3), 1.0, 1e-12);
  EXPECT_NEAR(*chi_squared_power(3, 1e9, 1e3), 1.0, 1e-12);
}

TEST(Power, IsHowOftenTheTestFindsIt) {
  base::Random random(6);
  int found = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<double> first = normal_sample(random, 20);
    for (double& value : first) value += 1.0;
    found += pooled_t_test(first, normal_sample(random, 20))->p < 0.05 ? 1 : 0;
  }
  EXPECT_NEAR(found / 2000.0, 0.868952801692498, 4.0 * std::sqrt(0.87 * 0.13 / 2000.0));
}

TEST(Power, RefusesWhatCannotBe) {
  expect_refused(t_test_power(TDesign::Paired, 1, 0.5), "a count of 1");
  expect_refused(t_test_power(TDesign::Paired, 10, kNotANumber), "effect size");
  expect_refused(t_test_power(TDesign::Paired, 10, 0.5, {0.0}), "alpha");
  expect_refused(anova_power(3, 10, 0.5, 1e-300), "alpha");
  expect_refused(t_test_power(1.0, 1.0, 0.5), "a count of 2");
  expect_refused(t_test_count(TDesign::Paired, 0.5, 1.0), "power of 1");
  expect_refused(t_test_count(TDesign::Paired, 0.5, 0.01), "above alpha");
  expect_refused(t_test_count(TDesign::Paired, 0.0, 0.8), "1e7");
  expect_refused(t_test_count(TDesign::Paired, -0.5, 0.8, kOneSided), "turn its sign");
  expect_refused(anova_power(1, 10, 0.5), "1 groups");
  expect_refused(anova_power(3, 1, 0.5), "a count of 1");
  expect_refused(anova_count(3, 0.0, 0.8), "1e7");
  expect_refused(chi_squared_power(0.5, 10, 0.5), "0.5 degrees");
  expect_refused(chi_squared_count(2, 1e-9, 0.8), "1e7");
}

}  // namespace
}  // namespace icome::stats
