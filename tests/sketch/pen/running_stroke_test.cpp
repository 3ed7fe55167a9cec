#include "sketch/pen/running_stroke.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sketch/pen/mouse_pressure.h"
#include "sketch/pen/pressure_curve.h"

namespace icome::sketch {
namespace {

TEST(RunningStrokeTest, EndsAtTheLastSampleAndStaysWhereItIsFinished) {
  FitSettings settings;
  const auto sample = [](double t) {
    return PenSample{t, Vector2(0.05 + 0.1 * t, 0.05 + 0.02 * std::sin(20.0 * t)), 0.2 + 0.6 * t};
  };
  RunningStroke running(sample(0.0), settings);
  for (int i = 1; i <= 200; ++i) running.add(sample(0.005 * i));
  ASSERT_GE(running.finished(), 2U);
  const Curve first = running.segment(0);
  const Curve current = running.current();
  EXPECT_LT((current.segments[0].points[3] - sample(1.0).place).norm(), settings.error);
  EXPECT_NEAR(current.width_at(1.0), settings.tip.width(0.8), settings.width_error);
  EXPECT_NEAR(first.width_at(0.0), settings.tip.width(0.2), settings.width_error);
  EXPECT_EQ(first.segments[0].points[3], running.segment(1).segments[0].points[0]);
  for (int i = 201; i <= 300; ++i) running.add(sample(0.005 * i));
  EXPECT_EQ(running.segment(0), first);
}

TEST(RunningStrokeTest, PredictsByTheSpeedOfTheLastSamples) {
  RunningStroke running({0.0, Vector2(0.0, 0.0), 1.0}, {});
  EXPECT_EQ(running.predicted(0.016), Vector2(0.0, 0.0));
  for (int i = 1; i <= 10; ++i) running.add({0.01 * i, Vector2(0.001 * i, 0.0), 1.0});
  EXPECT_NEAR(running.predicted(0.016).x(), 0.0116, 1e-9);  // 0.1 m/s
}

TEST(PressureCurveTest, GoesThroughItsPointsAndNeverBack) {
  const PressureCurve curve = {0.1, 0.7, 0.9};
  EXPECT_NEAR(curve(0.0), 0.1, 1e-12);
  EXPECT_NEAR(curve(0.5), 0.7, 1e-12);
  EXPECT_NEAR(curve(2.0), 0.9, 1e-12);
  for (double p = 0.0; p < 1.0; p += 0.01) EXPECT_LE(curve(p), curve(p + 0.01));
  EXPECT_EQ((PressureCurve{0.4, 0.4, 0.4}(0.8)), 0.4);
}

TEST(MousePressureTest, SlowIsWideAndFastIsThin) {
  MousePressure slow;
  MousePressure fast;
  double slow_pressure = slow.at(0.0, Vector2(0.0, 0.0));
  double fast_pressure = fast.at(0.0, Vector2(0.0, 0.0));
  EXPECT_EQ(slow_pressure, fast_pressure);
  for (int i = 1; i <= 100; ++i) {
    const double next = slow.at(0.01 * i, Vector2(0.0001 * i, 0.0));
    EXPECT_LT(std::abs(next - slow_pressure), 0.1);
    slow_pressure = next;
    fast_pressure = fast.at(0.01 * i, Vector2(0.01 * i, 0.0));
  }
  EXPECT_GT(slow_pressure, 0.8);
  EXPECT_LT(fast_pressure, 0.2);
  EXPECT_EQ(slow.at(0.5, Vector2(1.0, 0.0)), slow_pressure);  // time went back
}

}  // namespace
}  // namespace icome::sketch
