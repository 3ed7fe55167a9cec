#include "devices/trace_head.h"

#include <gtest/gtest.h>

namespace icome::devices {
namespace {

TEST(TraceHead, IsWhereTheTraceIsAtThatTime) {
  const auto samples =
      read_head_trace("5 1 0 0 0 0 0 1\n5.5 1 0.1 0 0 0 0 1\n6 1 0.2 0 0 0 0 1\n", "head.txt");
  std::int64_t now = 1'000'000'000;
  TraceHead head("head.txt", samples.value(), [&] { return now; });
  const auto height = [&](double after) {
    now = 1'000'000'000 + std::int64_t(1e9 * after);
    Pose pose = Pose::Identity();
    EXPECT_EQ(head.read(pose), DeviceStatus::Ok);
    EXPECT_EQ(pose.translation().x(), 0.0) << "from the first pose";
    return pose.translation().y();
  };
  EXPECT_EQ(height(0.0), 0.0);
  EXPECT_EQ(height(0.4), 0.0);
  EXPECT_NEAR(height(0.6), 0.1, 1e-15);
  EXPECT_NEAR(height(60.0), 0.2, 1e-15) << "stays at the end";
}

TEST(TraceHead, NamesAFileThatIsNotThere) {
  const auto head = TraceHead::create("/nowhere/head.txt", [] { return std::int64_t{0}; });
  ASSERT_FALSE(head);
  EXPECT_NE(head.error().message.find("/nowhere/head.txt"), std::string::npos);
}

}  // namespace
}  // namespace icome::devices
