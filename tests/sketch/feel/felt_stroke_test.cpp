#include "sketch/feel/felt_stroke.h"

#include <gtest/gtest.h>

#include "devices/device_profiles.h"
#include "places.h"
#include "sketch/files/stroke_files.h"

namespace icome::sketch {
namespace {

constexpr double kStrokeLength = 0.05;  // m

/// A straight stroke of one second with an even pressure.
PenStroke straight_stroke(double pressure) {
  PenStroke stroke;
  for (int i = 0; i <= 100; ++i)
    stroke.push_back({0.01 * i, {0.1 + kStrokeLength * 0.01 * i, 0.1}, pressure});
  return stroke;
}

Paper paper_named(const char* name) { return find_paper(name).value(); }

TEST(FeltStroke, DrawsWhereTheHandAims) {
  const FeltStroke felt = felt_stroke(straight_stroke(0.5), paper_named("glass"), {});
  ASSERT_GT(felt.drawn.size(), 900U);
  for (const PenSample& sample : felt.drawn) {
    // Friction holds a pen back that a hand of 300 N/m pulls: 0.1 N of it by a third of a millimetre.
    EXPECT_NEAR(sample.place.y(), 0.1, 1e-4);
    EXPECT_GT(sample.place.x(), 0.1 - 5e-4);
    EXPECT_LT(sample.place.x(), 0.1 + kStrokeLength + 5e-4);
  }
}

TEST(FeltStroke, PressesAsHardAsTheRecordingSays) {
  for (const char* const device : {"simulated", "Touch", "omega.x"}) {
    SimulatedPen pen;
    if (device != pen.device.name) pen.device = devices::find_device_profile(device).value();
    for (const double pressure : {0.1, 0.4}) {
      const FeltStroke felt = felt_stroke(straight_stroke(pressure), paper_named("glass"), pen);
      const PenSample& middle = felt.drawn[felt.drawn.size() / 2];
      EXPECT_NEAR(middle.pressure, pressure, 0.02 * pressure) << device;
    }
  }
}

TEST(FeltStroke, LandsWithoutAStep) {
  for (const Paper& paper : papers()) {
    for (const double rate : {1000.0, 10000.0}) {
      SimulatedPen pen;
      pen.rate_hz = rate;
      const FeltStroke felt = felt_stroke(straight_stroke(0.5), paper, pen);
      double greatest = 0.0;
      for (std::size_t i = 1; felt.ticks[i].time < 0.6; ++i)  // until the hand has come down
        greatest = std::max(greatest, (felt.ticks[i].force - felt.ticks[i - 1].force).norm());
      // It comes down with 24 mm/s, and damper and spring grow from nothing.
      EXPECT_LT(greatest, 60.0 / rate) << paper.name << rate;
    }
  }
}

TEST(FeltStroke, BeginsToSlideWithoutAStep) {
  for (const Paper& paper : papers()) {
    const FeltStroke felt = felt_stroke(straight_stroke(0.5), paper, {});
    double greatest = 0.0;
    for (std::size_t i = 1; i < felt.ticks.size() && felt.ticks[i].time < 1.5; ++i)
      if (felt.ticks[i].time > 0.6)
        greatest = std::max(greatest, (felt.ticks[i].force - felt.ticks[i - 1].force).norm());
    // The pen goes 50 um a tick over grains of 0.6 to 1.2 mm.
    EXPECT_LT(greatest, 0.15) << paper.name;
  }
}

TEST(FeltStroke, RubsAsCoulombSays) {
  for (const Paper& paper : papers()) {
    const FeltStroke felt = felt_stroke(straight_stroke(0.5), paper, {});
    const PenTick& middle = felt.ticks[felt.ticks.size() / 2];
    const double ratio = middle.force.head<2>().norm() / middle.force.z();
    // The grain tilts the force by as much as it is steep.
    EXPECT_NEAR(ratio, paper.friction, paper.texture.empty() ? 0.01 : 0.5) << paper.name;
  }
}

TEST(FeltStroke, AnEraserRubsHarder) {
  SimulatedPen eraser;
  eraser.eraser = true;
  for (const Paper& paper : papers()) {
    const double pen_rubs = felt_stroke(straight_stroke(0.5), paper, {}).rubbing;
    EXPECT_GT(felt_stroke(straight_stroke(0.5), paper, eraser).rubbing, 1.4 * pen_rubs) << paper.name;
  }
}

TEST(FeltStroke, GivesNoEnergyAndKeepsTheLimitsOnRecordedStrokes) {
  const auto file = places::shared_data() / "strokes" / "handwriting_signal.svc";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const auto read = read_strokes(file);
  ASSERT_TRUE(read) << read.error().message;
  for (const Paper& paper : papers()) {
    for (const PenStroke& stroke : read->strokes) {
      const SimulatedPen pen;
      const FeltStroke felt = felt_stroke(stroke, paper, pen);
      EXPECT_LE(felt.work, 0.0) << paper.name;
      EXPECT_LE(felt.greatest, pen.device.max_force) << paper.name;
      // The limiter brings a force from nothing to its most in 2 ms.
      EXPECT_LE(felt.greatest_step, 0.5 * pen.device.max_force + 1e-9) << paper.name;
    }
  }
}

TEST(FeltStroke, IsTheSameEachTime) {
  const FeltStroke first = felt_stroke(straight_stroke(0.7), paper_named("canvas"), {});
  const FeltStroke again = felt_stroke(straight_stroke(0.7), paper_named("canvas"), {});
  ASSERT_EQ(first.ticks.size(), again.ticks.size());
  for (std::size_t i = 0; i < first.ticks.size(); ++i) EXPECT_EQ(first.ticks[i].force, again.ticks[i].force);
}

TEST(Papers, AreFoundByName) {
  EXPECT_EQ(find_paper("canvas")->stiffness, 400.0);
  const auto none = find_paper("canvass");
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("did you mean 'canvas'"), std::string::npos);
}

}  // namespace
}  // namespace icome::sketch
