#include "devices/driver/warnings.h"

#include <gtest/gtest.h>

#include <array>
#include <thread>

namespace icome::devices {
namespace {

constexpr std::array<const char*, 3> kSentences = {"It is hot", "It is loud", "It slips (times so far: {})"};
constexpr std::int64_t kStart = 1'000'000'000;  // ns

TEST(DriverWarnings, AreToldWhileTheyLast) {
  DriverLink link(DeviceInfo{});
  link.connect(DeviceInfo{});
  Warnings warnings(kSentences);
  warnings.tell(link, kStart);
  EXPECT_EQ(link.condition(), "");
  warnings.note(1, kStart);
  warnings.tell(link, kStart);
  EXPECT_EQ(link.condition(), "It is loud");
  warnings.note(0, kStart + Warnings::kLasting / 2);
  warnings.tell(link, kStart + Warnings::kLasting / 2);
  EXPECT_EQ(link.condition(), "It is hot\nIt is loud");
  warnings.tell(link, kStart + Warnings::kLasting);
  EXPECT_EQ(link.condition(), "It is hot");
  warnings.tell(link, kStart + 2 * Warnings::kLasting);
  EXPECT_EQ(link.condition(), "");
}

TEST(DriverWarnings, AreCounted) {
  DriverLink link(DeviceInfo{});
  link.connect(DeviceInfo{});
  Warnings warnings(kSentences);
  warnings.note(2, kStart);
  warnings.tell(link, kStart);
  EXPECT_EQ(link.condition(), "It slips (times so far: 1)");
  warnings.note(2, kStart);
  warnings.note(2, kStart + Warnings::kCountShown);
  warnings.tell(link, kStart + Warnings::kCountShown / 2);
  EXPECT_EQ(link.condition(), "It slips (times so far: 1)") << "not told too often";
  warnings.tell(link, kStart + Warnings::kCountShown);
  EXPECT_EQ(link.condition(), "It slips (times so far: 3)");
  warnings.tell(link, kStart + 10 * Warnings::kLasting);
  EXPECT_EQ(link.condition(), "");
}

TEST(DriverWarnings, NoteOfAnyThreadCounts) {
  DriverLink link(DeviceInfo{});
  link.connect(DeviceInfo{});
  Warnings warnings(kSentences);
  const auto note_often = [&] {
    for (int i = 0; i < 10'000; ++i) warnings.note(2, kStart);
  };
  std::thread other(note_often);
  note_often();
  other.join();
  warnings.tell(link, kStart);
  EXPECT_EQ(link.condition(), "It slips (times so far: 20000)");
}

TEST(DriverWarnings, OthersSentencesStayUntilThereIsAnother) {
  DriverLink link(DeviceInfo{});
  link.connect(DeviceInfo{});
  Warnings warnings(kSentences);
  link.tell("Something else");
  warnings.tell(link, kStart);
  EXPECT_EQ(link.condition(), "Something else");
}

TEST(DriverWarnings, AreToldAgainOnceForgotten) {
  DriverLink link(DeviceInfo{});
  link.connect(DeviceInfo{});
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
