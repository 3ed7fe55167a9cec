#include "interaction/head/head_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "base/random.h"
#include "interaction/head/head_comparison.h"
#include "repeats.h"

namespace icome::interaction {
namespace {

using base::Pose;
using base::Quaternion;
using base::Vector3;
using devices::HeadSample;

constexpr double kGap = 0.01;  // s, between samples

/// A number of the normal distribution with variance 1 (Box and Muller).
double normal(base::Random& random) {
  return std::sqrt(-2.0 * std::log(random.uniform(1e-300, 1.0))) *
         std::cos(2.0 * std::numbers::pi * random.uniform());
}

const Vector3 kSpeed(0.1, -0.05, 0.2);
const Vector3 kTurning = Vector3(0.2, 1.0, -0.4);  // rad/s

Pose moving(double time) {
  return Eigen::Translation3d(Vector3(0.3, 1.2, -0.4) + time * kSpeed) *
         (base::rotation_of_turn(time * kTurning) * Quaternion(0.5, 0.5, -0.5, 0.5));
}

double turn_off(const HeadPose& pose, const Pose& expected) {
  return pose.rotation.angularDistance(Quaternion(expected.linear()));
}

/// The filter after two seconds of even motion.
HeadFilter after_moving(const HeadFilterSettings& settings) {
  HeadFilter filter(settings);
  for (int i = 0; i <= 200; ++i) filter.take(moving(kGap * i), kGap * i);
  return filter;
}

TEST(HeadFilter, NoneGivesTheSamplesAndTheMeanLagsTwoOfThem) {
  const HeadFilter none = after_moving({HeadFilterKind::None, 0.0});
  EXPECT_LT((none.ahead().place - moving(2.0).translation()).norm(), 1e-12);
  EXPECT_LT(turn_off(none.ahead(), moving(2.0)), 1e-7);
  const HeadFilter mean = after_moving({HeadFilterKind::Mean, 0.0});
  EXPECT_LT((mean.ahead().place - moving(1.98).translation()).norm(), 1e-12);
  EXPECT_LT(turn_off(mean.ahead(), moving(1.98)), 1e-7);
}

// A first-order low-pass whose share of the new sample is a lags (1 - a) / a samples at an even speed, which
// is 1 / (2 pi cutoff) by a = 1 / (1 + 1 / (2 pi cutoff gap)).
TEST(HeadFilter, OneEuroLagsByItsCutoffAtThatSpeed) {
  const HeadFilter filter = after_moving({HeadFilterKind::OneEuro, 0.0});
  const auto lag = [](const base::OneEuroSettings& settings, double speed) {
    return 1.0 / (2.0 * std::numbers::pi * (settings.least_cutoff + settings.speed_gain * speed));
  };
  const double place = lag(HeadFilterSettings::kPlaces, kSpeed.norm());
  const double turn = lag(HeadFilterSettings::kTurns, kTurning.norm());
  EXPECT_LT((filter.ahead().place - moving(2.0 - place).translation()).norm(), 1e-6);
  EXPECT_LT(turn_off(filter.ahead(), moving(2.0 - turn)), 1e-6);
}

TEST(HeadFilter, PredictsAnEvenMotionExactly) {
  for (const double ahead : {0.02, 0.1, 0.2}) {
    const HeadFilter none = after_moving({HeadFilterKind::None, ahead});
    EXPECT_LT((none.ahead().place - moving(2.0 + ahead).translation()).norm(), 1e-12) << ahead;
    EXPECT_LT(turn_off(none.ahead(), moving(2.0 + ahead)), 1e-7) << ahead;
  }
  const HeadFilter mean = after_moving({HeadFilterKind::Mean, 0.02});
  EXPECT_LT((mean.ahead().place - moving(2.0).translation()).norm(), 1e-12)
      << "two samples make up for its lag";
}

TEST(HeadFilter, PredictionIsBoundedAndNeedsThreeSamples) {
  HeadFilter filter({HeadFilterKind::None, 0.3});
  const auto at = [](int i) { return Pose(Eigen::Translation3d(0.05 * i, 0.0, 0.0)); };
  filter.take(at(0), 0.0);
  filter.take(at(1), kGap);
  EXPECT_DOUBLE_EQ(filter.ahead().place.x(), 0.05);
  for (int i = 2; i < 20; ++i) filter.take(at(i), kGap * i);  // 5 m/s
  EXPECT_NEAR(filter.ahead().place.x(), 0.05 * 19 + HeadPredictor::kMostMove, 1e-12);
  filter.forget();
  EXPECT_TRUE(filter.is_empty());
  filter.take(at(0), 10.0);
  EXPECT_DOUBLE_EQ(filter.ahead().place.x(), 0.0);
}

TEST(HeadFilter, SamplesOfTheSameMomentGiveNoSpeed) {
  HeadFilter filter({HeadFilterKind::OneEuro, 0.1});
  base::Random random(3);
  for (int i = 0; i < 50; ++i) {
    filter.take(Pose(Eigen::Translation3d(0.01 * normal(random), 0.0, 0.0)), 1.0);
    EXPECT_TRUE(filter.ahead().pose().matrix().allFinite());
    EXPECT_LT(filter.ahead().place.norm(), 0.1);
  }
}

/// Variance, for a variance of 1 of the samples, of a filter's output for a head that is still.
double variance_at_rest(const HeadFilterSettings& settings) {
  constexpr double kNoise = 1e-4;  // m
  base::Random random(5);
  HeadFilter filter(settings);
  double sum = 0.0;
  const int count = repeats(100'000);
  for (int i = 0; i < count + 100; ++i) {
    filter.take(Pose(Eigen::Translation3d(kNoise * normal(random), 0.0, 0.0)), kGap * i);
    if (i >= 100) sum += std::pow(filter.ahead().place.x() / kNoise, 2.0) / count;
  }
  return sum;
}

TEST(HeadFilter, TheMeanOfFiveHasAFifthOfTheVariance) {
  const double slack = kSanitizerShare > 1 ? 0.2 : 0.04;
  EXPECT_NEAR(variance_at_rest({HeadFilterKind::None, 0.0}), 1.0, slack);
  EXPECT_NEAR(variance_at_rest({HeadFilterKind::Mean, 0.0}), 0.2, 0.2 * slack);
  EXPECT_LT(variance_at_rest({HeadFilterKind::OneEuro, 0.0}), 0.2);
}

// Least squares over n samples, gap apart: the slope's weights are t_i / S with S = gap^2 n (n^2 - 1) / 12,
// so the prediction has the variance 1 + a^2 / S + 2 a t_n / S, t_n = gap (n - 1) / 2 being the newest one's.
TEST(HeadFilter, PredictionAddsAsMuchNoiseAsLeastSquaresSay) {
  constexpr double kAhead = 0.05, kSamples = 11.0;  // of a window of 0.1 s, both ends counted
  const double spread = kGap * kGap * kSamples * (kSamples * kSamples - 1.0) / 12.0;
  const double expected =
      1.0 + kAhead * kAhead / spread + 2.0 * kAhead * 0.5 * kGap * (kSamples - 1.0) / spread;
  const double slack = kSanitizerShare > 1 ? 0.2 : 0.06;
  const double found = variance_at_rest({HeadFilterKind::None, kAhead});
  // The window's end may or may not take a sample in, by rounding.
  EXPECT_NEAR(found, expected, expected * (slack + 0.15));
}

std::vector<HeadSample> recorded(int count, const std::function<Pose(double)>& motion) {
  std::vector<HeadSample> samples;
  for (int i = 0; i < count; ++i) samples.push_back({100.0 + kGap * i, motion(kGap * i)});
  return samples;
}

HeadFilterScore score_of(const std::vector<HeadSample>& samples, const HeadFilterSettings& way) {
  return compare_head_filters(samples, std::span(&way, 1)).front();
}

TEST(HeadComparison, FindsTheLagOfASine) {
  const auto swings = [](double time) {
    const double angle = 2.0 * std::numbers::pi * 0.8 * time;
    return Pose(Eigen::Translation3d(0.1 * std::sin(angle), 0.02 * std::cos(angle), 0.0) *
                Eigen::AngleAxisd(0.3 * std::sin(angle), Vector3::UnitY()));
  };
  const auto samples = recorded(1000, swings);
  const HeadFilterScore none = score_of(samples, {HeadFilterKind::None, 0.0});
  EXPECT_NEAR(*none.lag_place, 0.0, 1e-4);
  EXPECT_NEAR(*none.lag_turn, 0.0, 1e-4);
  EXPECT_EQ(none.behind_place, 0.0);
  const HeadFilterScore mean = score_of(samples, {HeadFilterKind::Mean, 0.0});
  EXPECT_NEAR(*mean.lag_place, 2.0 * kGap, 5e-4) << "a mean of five has an even delay of two samples";
  EXPECT_NEAR(*mean.lag_turn, 2.0 * kGap, 5e-4);
}

TEST(HeadComparison, FindsThatAPredictionIsAhead) {
  const auto samples = recorded(400, moving);
  const HeadFilterScore score = score_of(samples, {HeadFilterKind::Mean, 0.07});
  EXPECT_NEAR(*score.lag_place, 2.0 * kGap - 0.07, 1e-4);
  EXPECT_NEAR(*score.lag_turn, 2.0 * kGap - 0.07, 1e-4);
}

TEST(HeadComparison, TellsTheJitterOfAStillHead) {
  base::Random random(8);
  constexpr double kNoise = 2e-4;  // m, along each axis
  const auto samples = recorded(6000, [&](double time) {
    const Vector3 noise(normal(random), normal(random), normal(random));
    const double way = time < 30.0 ? 0.0 : 0.2 * (time - 30.0);  // still, then under way
    return Pose(Eigen::Translation3d(Vector3(way, 0.0, 0.0) + kNoise * noise));
  });
  const HeadFilterScore none = score_of(samples, {HeadFilterKind::None, 0.0});
  EXPECT_NEAR(*none.jitter_place, std::sqrt(3.0) * kNoise, 0.12 * kNoise);
  EXPECT_NEAR(*none.jitter_turn, 0.0, 1e-9);
  EXPECT_FALSE(none.lag_turn) << "nothing turns";
  const HeadFilterScore mean = score_of(samples, {HeadFilterKind::Mean, 0.0});
  // The line through a second takes some of the slow part away.
  EXPECT_NEAR(*mean.jitter_place, std::sqrt(3.0 / 5.0) * kNoise, 0.15 * kNoise);
}

TEST(HeadComparison, SaysNothingOfAMotionThatIsTooShort) {
  const HeadFilterScore one = score_of(recorded(1, moving), {HeadFilterKind::Mean, 0.0});
  EXPECT_FALSE(one.jitter_place);
  EXPECT_FALSE(one.lag_place);
  EXPECT_FALSE(score_of(recorded(120, moving), {HeadFilterKind::Mean, 0.0}).lag_turn);
}

TEST(HeadFilter, IsKnownByItsNames) {
  for (const auto kind : {HeadFilterKind::None, HeadFilterKind::Mean, HeadFilterKind::OneEuro})
    EXPECT_EQ(head_filter_of(name_of(kind)), kind);
  EXPECT_FALSE(head_filter_of("median"));
}

}  // namespace
}  // namespace icome::interaction
