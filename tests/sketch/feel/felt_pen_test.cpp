#include "sketch/feel/felt_pen.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "devices/device_profiles.h"
#include "devices/simulated/simulated_device.h"

namespace icome::sketch {
namespace {

const Vector2 kA4(0.297, 0.210);

class FeltPenTest : public ::testing::Test {
 protected:
  explicit FeltPenTest(const char* device = "Touch") {
    devices::SimulatedSettings settings;
    settings.info = devices::find_device_profile(device).value();
    auto simulated = std::make_unique<devices::SimulatedDevice>(settings);
    device_ = simulated.get();
    pen_ = std::make_unique<FeltPen>(std::move(simulated), find_paper("glass").value(), kA4);
  }

  /// Aims there for some seconds; the readings.
  std::vector<PenReading> go(const Vector2& place, double pressure, double seconds) {
    pen_->aim(place, pressure);
    for (int i = 0; i < int(1000.0 * seconds); ++i) pen_->step(0.001);
    return pen_->take();
  }
  /// Along a straight line.
  std::vector<PenReading> draw(const Vector2& from, const Vector2& to, double pressure, double seconds) {
    std::vector<PenReading> all;
    const int steps = int(1000.0 * seconds);
    for (int i = 0; i < steps; ++i) {
      const auto some = go(from + double(i + 1) / steps * (to - from), pressure, 0.001);
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }

  std::unique_ptr<FeltPen> pen_;
  devices::SimulatedDevice* device_ = nullptr;
};

TEST_F(FeltPenTest, DrawsWhereItIsPressed) {
  const Vector2 from(0.10, 0.08), to(0.16, 0.13);
  for (const PenReading& reading : go(from, 0.0, 1.0)) EXPECT_EQ(reading.pressure, 0.0) << "it is lifted";
  go(from, 0.5, 0.5);
  const auto drawn = draw(from, to, 0.5, 1.0);
  ASSERT_EQ(drawn.size(), 1000U);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const Vector2 aimed = from + double(i + 1) / 1000.0 * (to - from);
    EXPECT_NEAR(drawn[i].pressure, 0.5, 0.05) << i;
    // A hand of 300 N/m is some way behind, by friction and its own damper.
    EXPECT_LT((drawn[i].place - aimed).norm(), 0.003 * pen_->scale()) << i;
    EXPECT_LT(drawn[i].height, 1e-6);
  }
  const auto lifted = go(to, 0.0, 1.0);
  EXPECT_EQ(lifted.back().pressure, 0.0);
  EXPECT_GT(lifted.back().height, 0.003);
}

TEST_F(FeltPenTest, ReachesAllOfThePaper) {
  EXPECT_GT(pen_->scale(), 1.5) << "A4 is larger than what a Touch reaches";
  for (const Vector2& corner : {Vector2(0.0, 0.0), Vector2(kA4.x(), 0.0), kA4}) {
    const auto readings = go(corner, 0.3, 2.0);
    EXPECT_LT((readings.back().place - corner).norm(), 0.002);
    EXPECT_GT(readings.back().pressure, 0.2);
  }
  pen_->resize({0.05, 0.05});
  EXPECT_EQ(pen_->scale(), 1.0);
}

TEST_F(FeltPenTest, DrawsADotWhereItIsPressedAfterAJump) {
  go({0.02, 0.02}, 0.0, 1.0);
  pen_->aim({0.25, 0.15}, 0.0);  // as a mouse that jumps
  for (const PenReading& reading : go({0.25, 0.15}, 0.5, 0.5)) {
    if (reading.pressure > 0.0) {
      EXPECT_LT((reading.place - Vector2(0.25, 0.15)).norm(), 0.001);
    }
  }
}

TEST_F(FeltPenTest, EnlargesVerySmallPaper) {
  pen_->resize({0.002, 0.002});
  EXPECT_LT(pen_->scale(), 0.1);
  const Vector2 from(0.0005, 0.001), to(0.0015, 0.001);
  go(from, 0.5, 1.0);
  const auto drawn = draw(from, to, 0.5, 1.0);
  EXPECT_LT((drawn.back().place - to).norm(), 0.0001);
}

TEST_F(FeltPenTest, FeelsWhatItHolds) {
  const Vector2 start(0.15, 0.10), aimed(0.17, 0.10);
  go(start, 0.3, 1.0);
  const double free = draw(start, aimed, 0.3, 0.5).back().place.x();
  draw(aimed, start, 0.3, 0.5);
  go(start, 0.3, 0.5);
  ToolGrip grip;
  grip.start = start;
  grip.holding = 4.0;
  pen_->hold(grip);
  const double held = draw(start, aimed, 0.3, 0.5).back().place.x();
  // 0.22 N and more of resistance, by the hand's 300 N/m, on paper that is scaled.
  EXPECT_LT(held, free - 0.22 / 300.0 * pen_->scale());
  pen_->hold({});
  EXPECT_GT(go(aimed, 0.3, 1.0).back().place.x(), held + 0.0005) << "let go of, it comes";
}

TEST_F(FeltPenTest, PressesNoHarderThanItsMotorsHold) {
  EXPECT_EQ(pen_->full_pressure(), 0.88) << "of a Touch, for long";
  go({0.15, 0.1}, 1.0, 20.0);
  const auto late = go({0.15, 0.1}, 1.0, 0.1);
  EXPECT_GT(late.back().pressure, 0.9);
}

TEST_F(FeltPenTest, TellsThatItsDeviceIsLost) {
  go({0.15, 0.1}, 0.3, 1.0);
  EXPECT_EQ(pen_->condition(), "");
  device_->inject(devices::SimulatedFailure::Unplugged);
  go({0.15, 0.1}, 0.3, 0.1);
  EXPECT_NE(pen_->condition(), "");
  device_->inject(devices::SimulatedFailure::None);
  EXPECT_GT(go({0.15, 0.1}, 0.3, 2.0).back().pressure, 0.2) << "and goes on when it is there again";
  EXPECT_EQ(pen_->condition(), "");
}

TEST_F(FeltPenTest, RunsByItself) {
  ASSERT_TRUE(pen_->start());
  pen_->aim({0.15, 0.1}, 0.5);
  std::vector<PenReading> readings;
  for (int i = 0; i < 600 && (readings.empty() || readings.back().pressure == 0.0); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const auto some = pen_->take();
    readings.insert(readings.end(), some.begin(), some.end());
  }
  ASSERT_FALSE(readings.empty());
  EXPECT_GT(readings.back().pressure, 0.0);
}

}  // namespace
}  // namespace icome::sketch
