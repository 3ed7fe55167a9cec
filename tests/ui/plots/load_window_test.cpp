#include "ui/plots/load_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "base/random.h"

namespace icome::ui {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

TEST(LoadWindow, CountsOnlyTheLastSeconds) {
  LoadWindow window(10.0);
  LoadCounts counts{};
  for (int i = 0; i <= 60; ++i) {  // half a minute, 100 ticks at each look
    counts[i < 30 ? 80 : 5] += 100;
    window.add(i * kSecond / 2, counts);
  }
  EXPECT_EQ(window.recent()[80], 0U);
  EXPECT_EQ(window.recent()[5], 2000U);
  EXPECT_EQ(window.ticks(), 2000U);
  EXPECT_DOUBLE_EQ(*window.quantile(0.5), 5.5);
}

TEST(LoadWindow, HasNoQuantilesWithoutTicks) {
  LoadWindow window;
  EXPECT_FALSE(window.quantile(0.5));
  window.add(0, {});
  window.add(kSecond, {});
  EXPECT_FALSE(window.quantile(0.999));
}

TEST(LoadWindow, StartsAnewWithAnotherServo) {
  LoadWindow window;
  LoadCounts counts{};
  window.add(0, counts);
  counts[3] = 500;
  window.add(kSecond, counts);
  EXPECT_EQ(window.ticks(), 500U);
  counts[3] = 20;  // less than before
  window.add(2 * kSecond, counts);
  EXPECT_EQ(window.ticks(), 0U);
  counts[3] = 30;
  window.add(3 * kSecond, counts);
  EXPECT_EQ(window.ticks(), 10U);
}

TEST(LoadWindow, QuantilesAreThoseOfTheTicksThemselves) {
  base::Random random(5);
  LoadWindow window;
  LoadCounts counts{};
  window.add(0, counts);
  std::vector<std::size_t> loads;
  for (int i = 0; i < 5000; ++i) {
    loads.push_back(random.index(100) < 98 ? random.index(20) : random.index(101));
    ++counts[loads.back()];
  }
  window.add(kSecond, counts);
  std::sort(loads.begin(), loads.end());
  EXPECT_DOUBLE_EQ(*window.quantile(0.5), double(loads[2499]) + 0.5);
  const double high = double(loads[4994]);
  EXPECT_DOUBLE_EQ(*window.quantile(0.999), high == 100.0 ? 100.0 : high + 0.5);
}

}  // namespace
}  // namespace icome::ui
