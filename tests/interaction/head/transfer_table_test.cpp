#include "interaction/head/transfer_table.h"

#include <gtest/gtest.h>

#include <numbers>

namespace icome::interaction {
namespace {

std::string wrong(const char* text) {
  const auto read = read_transfer_table(text, "head.toml");
  return read ? "" : read.error().message;
}

TEST(TransferTable, KeepsWhatItDoesNotName) {
  const auto read = read_transfer_table("[move_x]\nslope1 = 2\n[turn_y]\nknee2_deg = 90.0\n", "head.toml");
  ASSERT_TRUE(read) << read.error().message;
  HeadTransfer expected = HeadTransfer::of_thesis();
  expected.moves[0].slope1 = 2.0;
  expected.turns[1].knee2 = std::numbers::pi / 2.0;
  EXPECT_EQ(*read, expected);
  EXPECT_EQ(read_transfer_table("", "head.toml").value(), HeadTransfer::of_thesis());
}

TEST(TransferTable, IsReadAsItIsWritten) {
  const HeadTransfer thesis = HeadTransfer::of_thesis();
  const auto read = read_transfer_table(transfer_table_text(thesis), "head.toml");
  ASSERT_TRUE(read) << read.error().message;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(read->moves[i], thesis.moves[i]);
    EXPECT_NEAR(read->turns[i].knee1, thesis.turns[i].knee1, 1e-12);
    EXPECT_NEAR(read->turns[i].knee2, thesis.turns[i].knee2, 1e-12);
  }
}

TEST(TransferTable, NamesThePlaceOfWhatIsWrong) {
  EXPECT_EQ(wrong("\n[move_w]\n").substr(0, 14), "head.toml:2:2:");
  EXPECT_EQ(wrong("[move_x]\nslope1 = -1\n"), "head.toml:2:10: slope1 must be a number from 0 to 100");
  EXPECT_EQ(wrong("[move_x]\nknee1_m = nan\n"), "head.toml:2:11: knee1_m must be a number from 0 to 10");
  EXPECT_NE(wrong("[turn_x]\nknee1_m = 1\n").find("turn_x has no key \"knee1_m\""), std::string::npos);
  EXPECT_NE(wrong("[move_x]\nknee1_m = 0.3\n").find("knee1_m is 0.3, which must not be above knee2_m, 0.22"),
            std::string::npos);
  EXPECT_NE(wrong("move_x = 3\n").find("move_x must be a table"), std::string::npos);
  EXPECT_NE(wrong("[move_x\n"), "");
  EXPECT_EQ(wrong("[move_x]\nslope1 = -1\n[turn_q]\n[move_y]\nslope2 = \"x\"\n"),
            "head.toml:2:10: slope1 must be a number from 0 to 100\n"
            "head.toml:3:2: a head has no axis \"turn_q\"; did you mean 'turn_x'?\n"
            "head.toml:5:10: slope2 must be a number from 0 to 100");
}

}  // namespace
}  // namespace icome::interaction
