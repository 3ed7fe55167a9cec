#include "animation/project/track.h"

#include <gtest/gtest.h>

namespace icome::animation {
namespace {

TEST(Track, HasTheOtherValueWithoutKeys) { EXPECT_EQ(value_at({}, Channel::X, 3, 7.5), 7.5); }

TEST(Track, HoldsItsEndsBeyondThem) {
  const Track track = {{4, 1.0}, {8, 3.0}};
  EXPECT_EQ(value_at(track, Channel::X, 0, 9), 1.0);
  EXPECT_EQ(value_at(track, Channel::X, 100, 9), 3.0);
}

TEST(Track, GoesStraightOrEasedOrHolds) {
  Track track = {{0, 0.0, Ease::Straight}, {4, 8.0}};
  EXPECT_DOUBLE_EQ(value_at(track, Channel::Y, 1, 0), 2.0);
  track[0].ease = Ease::Eased;
  EXPECT_DOUBLE_EQ(value_at(track, Channel::Y, 1, 0), 8.0 * (3.0 / 16 - 2.0 / 64));
  EXPECT_DOUBLE_EQ(value_at(track, Channel::Y, 2, 0), 4.0);
  track[0].ease = Ease::Hold;
  EXPECT_EQ(value_at(track, Channel::Y, 3.999, 0), 0.0);
  EXPECT_EQ(value_at(track, Channel::Y, 4, 0), 8.0);
}

TEST(Track, NeverBlendsPictures) {
  const Track track = {{0, 1.0, Ease::Straight}, {10, 4.0}};
  EXPECT_EQ(value_at(track, Channel::Picture, 9, 0), 1.0);
}

}  // namespace
}  // namespace icome::animation
