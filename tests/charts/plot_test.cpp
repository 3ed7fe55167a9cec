#include "charts/plot.h"

#include <gtest/gtest.h>

#include <limits>

#include "charts/length_text.h"

namespace icome::charts {
namespace {

using base::Vector2;

TEST(NiceTicks, CountsInOnesTwosAndFives) {
  const Ticks ticks = nice_ticks(0.0, 3.7, 5);
  EXPECT_DOUBLE_EQ(ticks.step, 0.5);
  EXPECT_EQ(ticks.at.size(), 8U);
  EXPECT_DOUBLE_EQ(nice_ticks(0.0, 90.0, 5).step, 20.0);
  EXPECT_EQ(nice_ticks(0.0, 90.0, 5).step, 20.0);
}

TEST(NiceTicks, StartsAtTheFirstMultipleInRange) {
  const Ticks ticks = nice_ticks(-0.3, 1.0, 5);
  EXPECT_NEAR(ticks.at.front(), -0.2, 1e-12);
  EXPECT_NEAR(ticks.at.back(), 1.0, 1e-12);
}

TEST(NiceTicks, GivesOneTickForARangeWithoutLength) {
  EXPECT_EQ(nice_ticks(2.0, 2.0, 5).at, std::vector<double>{2.0});
  EXPECT_EQ(nice_ticks(0.0, std::numeric_limits<double>::infinity(), 5).at.size(), 1U);
}

TEST(TickLabel, WritesARealMinusAndNoNegativeZero) {
  EXPECT_EQ(tick_label(-1.5, 0.5), "\u22121.5");
  EXPECT_EQ(tick_label(-1e-17, 0.5), "0.0");
}

TEST(TickLabel, TellsNeighboursApart) {
  EXPECT_EQ(tick_label(1e9 + 5.0, 5.0), "1000000005");
  EXPECT_EQ(tick_label(9e6, 1e6), "9e+06");
  EXPECT_EQ(tick_label(1.1e7, 1e6), "1.1e+07");
  EXPECT_EQ(tick_label(3.1e-7, 1e-8), "3.1e-07");
  EXPECT_EQ(tick_label(123456e6, 1e6), "1.23456e+11");
}

TEST(LengthText, ChoosesTheUnit) {
  EXPECT_EQ(length_text(0.02), "20 mm");
  EXPECT_EQ(length_text(2.0), "2 m");
  EXPECT_EQ(length_text(5e-7), "500 nm");
  EXPECT_EQ(length_text(2e5), "200 km");
}

TEST(NiceLengthBelow, RoundsDown) {
  EXPECT_DOUBLE_EQ(nice_length_below(0.0499), 0.02);
  EXPECT_DOUBLE_EQ(nice_length_below(0.05), 0.05);
  EXPECT_DOUBLE_EQ(nice_length_below(9.99), 5.0);
}

TEST(Grouped, PutsCommasBetweenThousands) {
  EXPECT_EQ(grouped(7), "7");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(69666), "69,666");
  EXPECT_EQ(grouped(1000000), "1,000,000");
}

/// Pixels of that colour, exactly.
int count(const Image& image, const Colour& colour) {
  int found = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    const std::uint8_t* p = image.rgba.data() + i;
    found += p[0] == std::lround(255 * colour.red) && p[1] == std::lround(255 * colour.green) &&
             p[2] == std::lround(255 * colour.blue);
  }
  return found;
}

TEST(DrawTimePlot, KeepsAPeakOfOneSampleAmongAMillion) {
  std::vector<Vector2> points;
  for (int i = 0; i < 1'000'000; ++i) points.emplace_back(1e-6 * i, i == 654'321 ? 1.0 : 0.0);
  TimePlot plot;
  plot.points = points;
  plot.line = {1.0, 0.0, 0.0};
  Canvas canvas(600, 300, 1.0);
  draw_time_plot(canvas, {0, 0, 600, 300}, plot);
  const Image image = canvas.snapshot();
  // The frame is 516 wide from x = 78 and its middle lies about y = 126: the spike must cross it.
  const int expected = 78 + static_cast<int>(0.654321 * 516);
  bool red = false;
  for (int x = expected - 3; x <= expected + 3; ++x) {
    const std::uint8_t* p = image.pixel(x, 126);
    red = red || (p[0] > 200 && p[1] < 120 && p[2] < 120);
  }
  EXPECT_TRUE(red);
}

TEST(DrawTimePlot, FillsUnderTheLineOnly) {
  const std::vector<Vector2> points = {{0.0, 0.5}, {1.0, 0.5}};
  TimePlot plot;
  plot.points = points;
  plot.fill = {Colour{0.0, 1.0, 0.0}};
  Canvas canvas(600, 300, 1.0);
  draw_time_plot(canvas, {0, 0, 600, 300}, plot);
  // The frame is 516 x 228 units; half of it lies under the line.
  EXPECT_NEAR(count(canvas.snapshot(), {0.0, 1.0, 0.0}), 0.5 * 516 * 228, 0.03 * 516 * 228);
}

}  // namespace
}  // namespace icome::charts
