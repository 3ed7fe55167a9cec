#include "stats/tests/assumptions.h"

#include "stats/test_samples.h"

namespace icome::stats {
namespace {

void expect_variances(const base::Result<VarianceTest>& test, double statistic, double df, double p) {
  ASSERT_TRUE(test.has_value()) << test.error().message;
  expect_near(test->statistic, statistic);
  EXPECT_EQ(test->df, df);
  expect_near(test->p, p);
}

void expect_shapiro(const std::vector<double>& values, double w, double p) {
  const auto test = shapiro_wilk(values);
  ASSERT_TRUE(test.has_value()) << test.error().message;
  expect_near(test->w, w);
  expect_near(test->p, p);
}

std::vector<double> squares_up_to(int last) {
  std::vector<double> values;
  for (int i = 1; i <= last; ++i) values.push_back(i * i);
  return values;
}

TEST(Assumptions, VariancesOfSharedData) {
  // R 4.2: anova(lm(abs(y - ave(y, g, FUN = mean)) ~ g)), with median, and bartlett.test(y ~ g).
  auto warps = shared_groups("r-datasets/warpbreaks.csv", "breaks", "tension");
  if (warps.empty()) GTEST_SKIP() << "the shared statistics data is not here";
  const Groups breaks = {warps["L"], warps["M"], warps["H"]};
  expect_variances(levene_test(breaks), 7.34405584874008, 2, 0.00157444198191207);
  expect_variances(brown_forsythe_test(breaks), 2.81804766589445, 2, 0.0690494519399047);
  expect_variances(bartlett_test(breaks), 9.65711813841333, 2, 0.00799803758549638);
  EXPECT_EQ(levene_test(breaks)->error_df, 51.0);
  auto plants = shared_groups("r-datasets/PlantGrowth.csv", "weight", "group");
  expect_variances(levene_test({plants["ctrl"], plants["trt1"], plants["trt2"]}), 1.23696295446978, 2,
                   0.306194922991448);
  auto cars = shared_groups("r-datasets/mtcars.csv", "mpg", "cyl");
  const Groups mpg = {cars["4"], cars["6"], cars["8"]};
  expect_variances(brown_forsythe_test(mpg), 5.50706486197765, 2, 0.0093902471051105);
  expect_variances(bartlett_test(mpg), 8.39339560196318, 2, 0.0150451770493762);
}

TEST(Assumptions, BartlettOfInsectSprays) {
  // R 4.2: bartlett.test(count ~ spray, InsectSprays) (Beall 1942): K squared = 25.96, p = 9.085e-05.
  expect_variances(bartlett_test({{10, 7, 20, 14, 14, 12, 10, 23, 17, 20, 14, 13},
                                  {11, 17, 21, 11, 16, 14, 17, 17, 19, 21, 7, 13},
                                  {0, 1, 7, 2, 3, 1, 2, 1, 3, 0, 1, 4},
                                  {3, 5, 12, 6, 4, 3, 5, 5, 5, 5, 2, 4},
                                  {3, 5, 3, 5, 3, 6, 1, 1, 3, 2, 6, 4},
                                  {11, 9, 15, 22, 15, 16, 13, 10, 26, 26, 24, 13}}),
                   25.9598253203687, 5, 9.08512233294531e-05);
}

TEST(Assumptions, ShapiroWilk) {
  // R 4.2: shapiro.test(x).
  expect_shapiro({1, 2, 4}, 0.964285714285714, 0.636886845028963);
  expect_shapiro({1, 2, 4, 9}, 0.894686270839335, 0.40514721117389);
  expect_shapiro({1, 2, 4, 9, 3}, 0.866960710872609, 0.254333839455088);
  expect_shapiro({1, 2, 4, 9, 3, 5}, 0.922385420746264, 0.522705238668903);
  expect_shapiro(squares_up_to(11), 0.918632044759252, 0.307410847493232);
  expect_shapiro(squares_up_to(12), 0.916292441474285, 0.256673467661626);
  expect_shapiro(kFirstDrug, 0.925806028936641, 0.407928796429989);
}

TEST(Assumptions, ShapiroWilkOfSharedData) {
  // R 4.2: shapiro.test(mtcars$mpg), mtcars$hp, morley$Speed.
  const auto mpg = shared_numbers("r-datasets/mtcars.csv", "mpg");
  if (mpg.empty()) GTEST_SKIP() << "the shared statistics data is not here";
  expect_shapiro(mpg, 0.947564726479274, 0.122881358539443);
  expect_shapiro(shared_numbers("r-datasets/mtcars.csv", "hp"), 0.93341934019855, 0.0488082381051741);
  expect_shapiro(shared_numbers("r-datasets/morley.csv", "Speed"), 0.988074329913191, 0.513703926147516);
}

TEST(Assumptions, ShapiroWilkOfMostValues) {
  // R 4.2: shapiro.test(qexp(ppoints(5000))^0.3), where ppoints are (i - 1/2) / 5000.
  std::vector<double> values;
  for (int i = 1; i <= 5000; ++i) values.push_back(std::pow(-std::log1p(-(i - 0.5) / 5000.0), 0.3));
  expect_shapiro(values, 0.998260356387306, 2.3690568286603e-05);
  values.push_back(1.0);
  expect_refused(shapiro_wilk(values), "5001");
}

TEST(Assumptions, RefuseWhatCannotBeTested) {
  expect_refused(levene_test({{1, 2, 3}}), "1 group");
  expect_refused(levene_test({{1, 2, 3}, {1}}), "group 2 has 1 value");
  expect_refused(levene_test({{1, 1}, {2, 2}}), "do not vary");
  expect_refused(levene_test({{0.1, 0.3}, {0.7, 5.2}}), "do not vary");  // two values: equal distances
  expect_refused(brown_forsythe_test({{1, 2, kEndless}, {1, 2, 3}}), "value 3 of group 1");
  expect_refused(bartlett_test({{1, 2, 3}, {4, 4, 4}}), "group 2 does not vary");
  expect_refused(bartlett_test({{1e200, -1e200}, {4, 5}}), "unit");
  expect_refused(shapiro_wilk(std::vector{1.0, 2.0}), "at least 3");
  expect_refused(shapiro_wilk(std::vector{2.0, 2.0, 2.0}), "equal");
  expect_refused(shapiro_wilk(std::vector{2.0, kNotANumber, 2.0}), "value 2");
  // One value apart from many: as far from normal as can be.
  EXPECT_LT(shapiro_wilk(std::vector{1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 9.0})->p, 1e-4);
  EXPECT_TRUE(shapiro_wilk(std::vector{-1.7e308, 0.0, 1.7e308})->p > 0.9);
}

TEST(Assumptions, FindNothingAsOftenAsTheyShould) {
  base::Random random(2);
  const auto draw = [&random] {
    return Groups{normal_sample(random, 30), normal_sample(random, 40), normal_sample(random, 30)};
  };
  expect_false_positives([&] { return bartlett_test(draw())->p; });
  expect_false_positives([&] { return brown_forsythe_test(draw())->p; }, 0.045);  // a little below, as known
  expect_false_positives([&] { return levene_test(draw())->p; }, 0.054);          // a little above
  expect_false_positives([&] { return shapiro_wilk(normal_sample(random, 9))->p; });
  expect_false_positives([&] { return shapiro_wilk(normal_sample(random, 40))->p; });
}

}  // namespace
}  // namespace icome::stats
