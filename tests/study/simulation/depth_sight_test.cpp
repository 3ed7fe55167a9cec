#include "study/simulation/depth_sight.h"

#include <gtest/gtest.h>

#include <cmath>

namespace icome::study {
namespace {

constexpr double kEyes = 3e-4 * 0.25 / 0.063;  // m, of two eyes at half a metre

DepthSight looked_for(double seconds, bool stereo, bool tracked) {
  DepthSight sight(interaction::PersonModel(), stereo, tracked);
  for (int tick = 0; tick <= int(1000.0 * seconds); ++tick) sight.look(0.001 * tick);
  return sight;
}

TEST(DepthSight, CuesCombineByTheirVariances) {
  const double picture = 0.005;
  EXPECT_NEAR(looked_for(1.0, false, false).deviation(), picture, 1e-12);
  EXPECT_NEAR(looked_for(1.0, true, false).deviation(), 1.0 / std::hypot(1.0 / picture, 1.0 / kEyes), 1e-12);
  const DepthSight swayed = looked_for(2.0, false, true);
  // Table 5.4 along x: 50 mm are below its first knee of 120 mm, so the view goes by 0.05^2 / 0.12 m; the
  // mean of five samples lowers the swing by less than a hundredth.
  EXPECT_NEAR(swayed.width(), 2.0 * 0.05 * 0.05 / 0.12, 0.0005);
  const double parallax = 6e-4 * 0.25 / swayed.width();
  EXPECT_NEAR(swayed.deviation(), 1.0 / std::hypot(1.0 / picture, 1.0 / parallax), 1e-12);
  EXPECT_LT(looked_for(2.0, true, true).deviation(), kEyes);
}

TEST(DepthSight, IsAsBeforeUntilTheHeadHasMoved) {
  DepthSight sight = looked_for(0.6, false, true);
  EXPECT_LT(sight.deviation(), 0.005);
  sight.recentre();
  EXPECT_NEAR(sight.deviation(), 0.005, 1e-12);
  double last = sight.deviation();
  for (int tick = 600; tick < 1000; ++tick) {
    sight.look(0.001 * tick);
    EXPECT_LE(sight.deviation(), last);
    last = sight.deviation();
  }
  EXPECT_LT(last, 0.005);
}

}  // namespace
}  // namespace icome::study
