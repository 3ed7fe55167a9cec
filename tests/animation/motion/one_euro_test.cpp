#include "animation/motion/one_euro.h"

#include <gtest/gtest.h>

#include <vector>

#include "base/random.h"

namespace icome::animation {
namespace {

constexpr double kFrame = 1.0 / 60;

/// The filter as the paper gives it, for a speed of both coordinates together.
class PaperFilter {
 public:
  explicit PaperFilter(const OneEuroSettings& settings) : settings_(settings) {}

  Vector2 next(const Vector2& x, double gap) {
    if (!begun_) {
      begun_ = true;
      raw_ = shown_ = x;
      return x;
    }
    const Vector2 speed = (x - raw_) * (1 / gap);
    raw_ = x;
    const double a = alpha(settings_.speed_cutoff, gap);
    speed_ = a * speed + (1 - a) * speed_;
    const double b = alpha(settings_.least_cutoff + settings_.speed_gain * speed_.norm(), gap);
    shown_ = b * x + (1 - b) * shown_;
    return shown_;
  }

 private:
  static double alpha(double cutoff, double gap) {
    const double tau = 1 / (2 * M_PI * cutoff);
    return 1 / (1 + tau / gap);
  }

  OneEuroSettings settings_;
  bool begun_ = false;
  Vector2 raw_ = Vector2::Zero(), shown_ = Vector2::Zero(), speed_ = Vector2::Zero();
};

TEST(OneEuro, IsThePapersFilterAtUnevenSteps) {
  base::Random random(1);
  SteadyPlace filter;
  PaperFilter paper(kSteadyPlace);
  double time = 5, last = 5;
  for (int k = 0; k < 1000; ++k) {
    const Vector2 place(100 * std::sin(3 * time) + random.uniform(-1, 1), 50 * std::cos(time));
    EXPECT_LT((filter.next(place, time) - paper.next(place, time - last)).norm(), 1e-9);
    last = time;
    time += random.uniform(0.002, 0.06);
  }
}

TEST(OneEuro, SteadiesATriangleAtRest) {
  base::Random random(2);
  SteadyPlace filter;
  double raw = 0, steady = 0;
  for (int k = 0; k < 3000; ++k) {
    const Vector2 noise(random.uniform(-0.35, 0.35), random.uniform(-0.35, 0.35));  // 0.2 mm
    const Vector2 shown = filter.next(Vector2(100, 50) + noise, k * kFrame);
    if (k < 100) continue;
    raw += noise.squaredNorm();
    steady += (shown - Vector2(100, 50)).squaredNorm();
  }
  EXPECT_LT(std::sqrt(steady / raw), 0.4);
}

TEST(OneEuro, HardlyLagsAtSpeed) {
  SteadyPlace place;
  SteadyAngle angle;
  double behind = 0, angle_behind = 0;
  for (int k = 0; k < 120; ++k) {
    const double time = k * kFrame;
    behind = 300 * time - place.next({300 * time, 0}, time).x();
    angle_behind = 3 * time - angle.next(3 * time, time);
  }
  EXPECT_GT(behind, 0.5);
  EXPECT_LT(behind, 2) << "mm, at 300 mm/s";
  EXPECT_LT(angle_behind, 0.02) << "rad, at 3 rad/s";
}

TEST(OneEuro, BeginsAnewAfterAGap) {
  SteadyPlace filter;
  filter.next({0, 0}, 0);
  EXPECT_LT(filter.next({100, 0}, 0.29).x(), 100);
  EXPECT_EQ(filter.next({50, 0}, 0.6), Vector2(50, 0));
  EXPECT_EQ(filter.next({70, 0}, 0.6), Vector2(50, 0)) << "no time has passed";
}

TEST(OneEuro, DoesNotNoticeWhereAnglesBeginAgain) {
  SteadyAngle filter, unwrapped_filter;
  for (int k = 0; k < 600; ++k) {
    const double turn = 0.05 * k, time = k * kFrame;
    const double shown = filter.next(std::remainder(turn, 2 * M_PI), time);
    EXPECT_NEAR(shown, unwrapped_filter.next(turn, time), 1e-9);
    EXPECT_NEAR(shown, turn, 0.05);
  }
}

}  // namespace
}  // namespace icome::animation
