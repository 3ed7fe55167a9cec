#include "stats/tests/t_tests.h"

#include <numeric>

#include "stats/test_samples.h"

namespace icome::stats {
namespace {

void expect_t(const base::Result<TTest>& test, double t, double df, double p, double low, double high) {
  ASSERT_TRUE(test.has_value()) << test.error().message;
  expect_near(test->t, t);
  expect_near(test->df, df);
  expect_near(test->p, p);
  expect_near(test->interval.low, low);
  expect_near(test->interval.high, high);
}

// The interval of d from R: uniroot(function(delta) pt(t, df, delta) - share, ...) times the scale.
void expect_d(const base::Result<TTest>& test, double d, double low, double high) {
  ASSERT_TRUE(test.has_value());
  expect_near(test->d, d);
  expect_near(test->d_interval.low, low);
  expect_near(test->d_interval.high, high);
}

std::vector<double> whole_numbers(int first, int last) {
  std::vector<double> values(static_cast<std::size_t>(last - first + 1));
  std::iota(values.begin(), values.end(), first);
  return values;
}

TEST(TTests, OneSample) {
  // R 4.2: t.test(sleep$extra); shared r-reference-output/t.test.Rout.txt has t = 3.413, df = 19, p =
  // 0.002918.
  std::vector<double> extra = kFirstDrug;
  extra.insert(extra.end(), kSecondDrug.begin(), kSecondDrug.end());
  const auto test = one_sample_t_test(extra);
  expect_t(test, 3.41296499527011, 19, 0.00291762040415412, 0.595584499619604, 2.4844155003804);
  expect_d(test, 0.763162173425121, 0.255315658070093, 1.25560465201385);
  EXPECT_EQ(test->standardiser, Standardiser::SampleSd);
  expect_near(test->difference, 1.54);
  expect_near(test->standard_error, 0.451220566907139);
}

TEST(TTests, Paired) {
  // R 4.2: t.test(extra[group == 1], extra[group == 2], paired = TRUE); sleep.Rout.txt: t = -4.0621, p =
  // 0.002833.
  const auto test = paired_t_test(kFirstDrug, kSecondDrug);
  expect_t(test, -4.06212768338204, 9, 0.00283289019738427, -2.45988576327698, -0.700114236723018);
  expect_d(test, -1.28455756259105, -2.11801651397707, -0.414627756380144);
  EXPECT_EQ(test->standardiser, Standardiser::DifferenceSd);
  // The same with alternative = "less", mu = 0.5, conf.level = 0.9.
  expect_t(paired_t_test(kFirstDrug, kSecondDrug, {0.5, Alternative::Less, 0.9}), -5.34761112749028, 9,
           0.000231902704481593, -kEndless, -1.04205890681227);
}

TEST(TTests, Welch) {
  // R 4.2: t.test(1:10, c(7:20)), and with a 200 behind; t.test.Rout.txt: p = 1.855e-05 and 0.1245.
  std::vector<double> second = whole_numbers(7, 20);
  expect_t(welch_t_test(whole_numbers(1, 10), second), -5.43492976389406, 21.982212340189,
           1.85528183251181e-05, -11.0528017251582, -4.94719827484184);
  second.push_back(200.0);
  expect_t(welch_t_test(whole_numbers(1, 10), second), -1.63290263320121, 14.1645989530125, 0.124513498089745,
           -47.2428998871019, 6.37623322043525);
}

TEST(TTests, WelchOfSharedCars) {
  // R 4.2: t.test(mpg ~ am, mtcars); t.test.Rout.txt: t = -3.7671, df = 18.332, p = 0.001374. d as of the
  // pooled test.
  auto cars = shared_groups("r-datasets/mtcars.csv", "mpg", "am");
  if (cars.empty()) GTEST_SKIP() << "the shared statistics data is not here";
  const auto test = welch_t_test(cars["0"], cars["1"]);
  expect_t(test, -3.76712314514493, 18.3322516384005, 0.00137363833307103, -11.2801943550402,
           -3.20968418746996);
  expect_d(test, -1.47794709580159, -2.2659732804461, -0.670568385745411);
  EXPECT_EQ(test->standardiser, Standardiser::PooledSd);
}

TEST(TTests, Pooled) {
  // R 4.2: t.test(a, b, var.equal = TRUE) of the sleep groups; then alternative = "greater".
  const auto test = pooled_t_test(kFirstDrug, kSecondDrug);
  expect_t(test, -1.86081346748685, 18, 0.0791867142159382, -3.3638740322876, 0.203874032287599);
  expect_d(test, -0.832181081349539, -1.73881689910343, 0.0954503982114222);
  expect_t(pooled_t_test(kFirstDrug, kSecondDrug, {0.0, Alternative::Greater, 0.95}), -1.86081346748685, 18,
           0.960406642892031, -3.0523778316996, kEndless);
  EXPECT_TRUE(pooled_t_test(std::vector{1.0}, std::vector{2.0, 4.0}).has_value());
}

TEST(TTests, KeepDigitsOfLargeNumbers) {
  // Shifting the sleep data by 2^30 changes nothing but the means: t as above.
  std::vector<double> first = kFirstDrug, second = kSecondDrug;
  for (double& value : first) value = std::round(value * 1024.0) + 0x1p50;
  for (double& value : second) value = std::round(value * 1024.0) + 0x1p50;
  EXPECT_NEAR(paired_t_test(first, second)->t, -4.062, 2e-3);
  EXPECT_NEAR(pooled_t_test(first, second)->t, -1.861, 2e-3);
}

TEST(TTests, SizeOfHugeEffects) {
  // Far from 0 d is likely where sqrt(chi-squared / df) times it is: qchisq(c(0.025, 0.975), 2) in R 4.2.
  const auto test = one_sample_t_test(std::vector{1e9 - 1.0, 1e9, 1e9 + 1.0});
  ASSERT_TRUE(test.has_value());
  expect_near(test->d, 1e9);
  expect_near(test->d_interval.low, 1e9 * std::sqrt(0.0506356159685798 / 2.0), 1e-6);
  expect_near(test->d_interval.high, 1e9 * std::sqrt(7.37775890822787 / 2.0), 1e-6);
}

TEST(TTests, RefuseWhatCannotBeTested) {
  const std::vector<double> none, one = {1.0}, same = {2.0, 2.0, 2.0}, hole = {1.0, kNotANumber, 2.0};
  expect_refused(one_sample_t_test(none), "0 values");
  expect_refused(one_sample_t_test(one), "1 value,");
  expect_refused(one_sample_t_test(same), "do not vary");
  expect_refused(one_sample_t_test(hole), "value 2");
  expect_refused(one_sample_t_test(std::vector{0.1 + 0.2, 0.3, 0.3}), "do not vary");
  expect_refused(one_sample_t_test(std::vector{1e200, -1e200, 3e200}), "too large");
  expect_refused(welch_t_test(same, same), "do not vary");
  expect_refused(welch_t_test(one, kFirstDrug), "first group");
  expect_refused(pooled_t_test(one, one), "at least three");
  expect_refused(paired_t_test(one, same), "pairs");
  expect_refused(paired_t_test(hole, same), "value 2");
  expect_refused(paired_t_test(kFirstDrug, kFirstDrug), "do not vary");
  expect_refused(one_sample_t_test(kFirstDrug, {0.0, Alternative::TwoSided, 1.0}), "confidence");
  expect_refused(one_sample_t_test(kFirstDrug, {0.0, Alternative::TwoSided, 1.0 - 1e-15}), "confidence");
  EXPECT_TRUE(one_sample_t_test(kFirstDrug, {0.0, Alternative::TwoSided, 1.0 - 1e-9}).has_value());
  expect_refused(one_sample_t_test(std::vector{-1e-300, 1e-300}), "unit");
  expect_refused(one_sample_t_test(kFirstDrug, {kNotANumber}), "test against");
  // One group that does not vary is no obstacle.
  EXPECT_TRUE(welch_t_test(same, kFirstDrug).has_value());
}

TEST(TTests, FindNothingAsOftenAsTheyShould) {
  base::Random random(5);
  expect_false_positives([&] { return one_sample_t_test(normal_sample(random, 8))->p; });
  expect_false_positives(
      [&] { return welch_t_test(normal_sample(random, 20), normal_sample(random, 12, 3.0))->p; });
  expect_false_positives([&] {
    return pooled_t_test(normal_sample(random, 5), normal_sample(random, 9), {0.0, Alternative::Less, 0.95})
        ->p;
  });
}

}  // namespace
}  // namespace icome::stats
