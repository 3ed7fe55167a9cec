#include "stats/tests/binomial_test.h"

#include "stats/test_samples.h"

namespace icome::stats {
namespace {

void expect_binomial(const base::Result<BinomialTest>& test, double p, double low, double high) {
  ASSERT_TRUE(test.has_value()) << test.error().message;
  expect_near(test->p, p);
  expect_near(test->interval.low, low);
  expect_near(test->interval.high, high);
}

TEST(BinomialTest, AgreesWithR) {
  // R 4.2: binom.test(682, 925, p = 0.75) (Conover 1971, p. 97), binom.test(3, 17, p = 0.4, ...), (0, 9),
  // (12, 15, 0.3).
  expect_binomial(binomial_test(682, 925, {0.75}), 0.382491559574852, 0.707668264079039, 0.765406558241525);
  expect_binomial(binomial_test(3, 17, {0.4}), 0.0812356593791795, 0.037985068070626, 0.434317872844284);
  expect_binomial(binomial_test(3, 17, {0.4, Alternative::Less}), 0.0464229308104704, 0, 0.395641433444821);
  expect_binomial(binomial_test(3, 17, {0.4, Alternative::Greater}), 0.987681153404109, 0.049898154557423, 1);
  expect_binomial(binomial_test(0, 9), 0.00390625, 0, 0.336267116879943);
  expect_binomial(binomial_test(12, 15, {0.3}), 9.16586921519998e-05, 0.519108866193147, 0.956687994894163);
}

TEST(BinomialTest, CertainOutcomes) {
  EXPECT_EQ(binomial_test(0, 10, {0.0})->p, 1.0);
  EXPECT_EQ(binomial_test(1, 10, {0.0})->p, 0.0);
  EXPECT_EQ(binomial_test(10, 10, {1.0})->p, 1.0);
  EXPECT_EQ(binomial_test(5, 10)->p, 1.0);
  // Half a billion heads and 10,000 more: 0.63 standard deviations, so about 0.527.
  EXPECT_NEAR(binomial_test(500'010'000, 1e9)->p, 0.5271, 1e-4);
}

TEST(BinomialTest, RefusesWhatCannotBe) {
  expect_refused(binomial_test(1, 0), "0 trials");
  expect_refused(binomial_test(5, 4), "no more than trials");
  expect_refused(binomial_test(0.5, 4), "0.5");
  expect_refused(binomial_test(-1, 4), "-1");
  expect_refused(binomial_test(1, 4, {1.5}), "1.5");
  expect_refused(binomial_test(1, 4, {kNotANumber}), "nan");
  expect_refused(binomial_test(1, 2e9), "trials");
  expect_refused(sign_test(0, 0), "none is better");
  expect_refused(sign_test(3, kNotANumber), "nan");
}

}  // namespace
}  // namespace icome::stats
