#include "devices/driver/warnings.h"

#include <gtest/gtest.h>

#include <array>

namespace icome::devices {
namespace {

constexpr std::array<const char*, 2> kSentences = {"It is hot", "It is loud"};
constexpr std::int64_t kStart = 1'000'000'000;  // ns

TEST(DriverWarnings, AreToldWhileTheyLastAndCounted) {
  DriverLink link(DeviceInfo{});
  Warnings warnings(kSentences);
  warnings.tell(link, kStart);
  EXPECT_EQ(link.condition(), "");
  warnings.note(1, kStart);
  warnings.tell(link, kStart);
  EXPECT_EQ(link.condition(), "It is loud");
  warnings.note(0, kStart + Warnings::kLasting / 2);
  warnings.tell(link, kStart + Warnings::kLasting / 2);
  EXPECT_EQ(link.condition(), "It is hot. It is loud");
  warnings.tell(link, kStart + Warnings::kLasting);
  EXPECT_EQ(link.condition(), "It is hot");
  warnings.tell(link, kStart + 2 * Warnings::kLasting);
  EXPECT_EQ(link.condition(), "");
  EXPECT_EQ(warnings.count(0), 1U);
  EXPECT_EQ(warnings.count(1), 1U);
}

TEST(DriverWarnings, OthersSentencesStayUntilThereIsAnother) {
  DriverLink link(DeviceInfo{});
  Warnings warnings(kSentences);
  link.tell("Something else");
  warnings.tell(link, kStart);
  EXPECT_EQ(link.condition(), "Something else");
}

TEST(DriverWarnings, AreToldAgainOnceForgotten) {
  DriverLink link(DeviceInfo{});
  Warnings warnings(kSentences);
  warnings.note(0, kStart);
  warnings.tell(link, kStart);
  link.connect(DeviceInfo{});
  warnings.forget();
  warnings.tell(link, kStart);
  EXPECT_EQ(link.condition(), "");
  warnings.note(0, kStart);
  warnings.tell(link, kStart);
  EXPECT_EQ(link.condition(), "It is hot");
}

}  // namespace
}  // namespace icome::devices
