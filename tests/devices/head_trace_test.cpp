#include "devices/head_trace.h"

#include <gtest/gtest.h>

namespace icome::devices {
namespace {

std::string wrong(const char* text) {
  const auto read = read_head_trace(text, "head.txt");
  return read ? "" : read.error().message;
}

TEST(HeadTrace, ReadsBlanksAndCommas) {
  const auto samples = read_head_trace(
      "\xEF\xBB\xBF# a comment\r\nt,x,y,z,qx,qy,qz,qw\r\n0.5,1,2,3,0,0,0,2\r\n\n1\t-1  0 1e-3 0 1 0 0",
      "head.txt");
  ASSERT_TRUE(samples) << samples.error().message;
  ASSERT_EQ(samples->size(), 2U);
  EXPECT_EQ(samples->front().time, 0.5);
  EXPECT_TRUE(samples->front().tracker_from_head.isApprox(base::Pose(Eigen::Translation3d(1, 2, 3))));
  const base::Vector3 ahead = samples->back().tracker_from_head * base::Vector3(0, 0, -1);
  EXPECT_TRUE(ahead.isApprox(base::Vector3(-1.0, 0.0, 1.001))) << "turned by half a turn about y";
}

TEST(HeadTrace, NamesTheLineOfWhatIsWrong) {
  EXPECT_EQ(wrong("# only this\n"), "head.txt: there is no row t x y z qx qy qz qw in it");
  EXPECT_EQ(wrong("0 0 0 0 0 0 0 1\n1 0 0 0 0 0 1\n"),
            "head.txt:2: 7 of the eight numbers t x y z qx qy qz qw");
  EXPECT_EQ(wrong("0 0 0 0 0 0 0 1 1\n"), "head.txt:1: more than the eight numbers t x y z qx qy qz qw");
  EXPECT_EQ(wrong("0 0 0 0 0 0 0 0\n"), "head.txt:1: the quaternion qx qy qz qw has no direction");
  EXPECT_EQ(wrong("0.1,,,1,0,0,0,0,0,1\n"), "head.txt:1: x is empty");
  EXPECT_EQ(wrong(",0,0,1,0,0,0,1\n"), "head.txt:1: t is empty");
  EXPECT_EQ(wrong("0 -2e6 0 0 0 0 0 1\n"), "head.txt:1: a head is at most 1e+06 m away");
  EXPECT_EQ(wrong("0 0 inf 0 0 0 0 1\n"), "head.txt:1: inf is no finite number");
  EXPECT_EQ(wrong("2 0 0 0 0 0 0 1\n\n1 0 0 0 0 0 0 1\n"), "head.txt:3: time goes back, from 2 to 1");
  EXPECT_EQ(wrong("0 0 0 0 0 0 0 1\nt,x,y,z,qx,qy,qz,qw\n"), "head.txt:2: t is no finite number")
      << "names stand in the first line";
}

}  // namespace
}  // namespace icome::devices
