#include "devices/device_news.h"

#include <gtest/gtest.h>

namespace icome::devices {
namespace {

class DeviceNewsTest : public testing::Test {
 public:
  /// The texts of a look, with bars between them.
  std::string look(const std::string& condition, bool is_lost = false) {
    std::string all;
    for (const DeviceNews::Item& item : news.look(is_lost, condition))
      all += (all.empty() ? "" : "|") + item.text;
    return all;
  }
  /// Likewise of two looks at the same.
  std::string looks(const std::string& condition, bool is_lost = false) {
    const std::string first = look(condition, is_lost);
    const std::string second = look(condition, is_lost);
    return first.empty() || second.empty() ? first + second : first + "|" + second;
  }
  DeviceNews news{"arm"};
};

TEST_F(DeviceNewsTest, ASentenceIsToldOnceWhileItLasts) {
  EXPECT_EQ(looks(""), "");
  EXPECT_EQ(looks("It is hot"), "arm: It is hot.");
  EXPECT_EQ(looks("It is hot\nNo force: it has no power"), "arm: No force: it has no power.");
  EXPECT_EQ(looks("It is hot\nIt is loud"), "arm: It is loud.") << "the first one lasts";
  EXPECT_EQ(looks("It is loud"), "");
  EXPECT_EQ(looks("It is loud\nIt is hot"), "arm: It is hot.") << "it has come again";
}

TEST_F(DeviceNewsTest, CountsThatGoOnAreNoNews) {
  EXPECT_EQ(looks("It slips (times so far: 9)"), "arm: It slips (times so far: 9).");
  EXPECT_EQ(looks("It slips (times so far: 10)"), "");
}

TEST_F(DeviceNewsTest, ALossIsToldOnceWithItsReason) {
  // The condition tells of it before the servo does.
  EXPECT_EQ(look("it was unplugged"), "");
  EXPECT_EQ(looks("it was unplugged", true),
            "The device \"arm\" is lost: it was unplugged. It is used again as soon as it answers.");
  EXPECT_TRUE(news.is_lost());
  EXPECT_EQ(looks(""), "The device \"arm\" is back.");
  EXPECT_EQ(looks("", true).find("The device \"arm\" does not answer"), 0u);
}

TEST_F(DeviceNewsTest, NoForceIsKnownFromASentence) {
  EXPECT_FALSE(gives_no_force(""));
  EXPECT_FALSE(gives_no_force("It is hot"));
  EXPECT_TRUE(gives_no_force("It is hot\nNo force: it has no power"));
  EXPECT_EQ(in_one_line("It is hot\nNo force: it has no power."), "It is hot. No force: it has no power.");
}

}  // namespace
}  // namespace icome::devices
