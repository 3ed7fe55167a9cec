#include "base/parse_number.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace icome::base {
namespace {

TEST(ParseNumber, TheWholeTextIsTheNumber) {
  EXPECT_EQ(parse_number<double>("+1.5e-3"), 1.5e-3);
  EXPECT_EQ(parse_number<double>("-.5"), -0.5);
  EXPECT_EQ(parse_number<float>("0.1"), 0.1F);
  EXPECT_EQ(parse_number<int>("-12"), -12);
  EXPECT_EQ(parse_number<std::uint32_t>("ff8000", 16), 0xff8000U);
  for (const std::string_view text :
       {"", " 1", "1 ", "1,5", "--1", "+-1", "-+1", "++1", "1e", "0x10", "1e400"})
    EXPECT_FALSE(parse_number<double>(text)) << text;
  for (const std::string_view text : {"", "+1", "1.0", "1e3", "99999999999"})
    EXPECT_FALSE(parse_number<int>(text)) << text;
  EXPECT_FALSE(parse_number<std::size_t>("-1"));
}

TEST(ParseNumber, OnlyFiniteOnesWhereThatIsAsked) {
  EXPECT_TRUE(parse_number<double>("inf"));
  for (const std::string_view text : {"inf", "-Infinity", "nan", "1e400"})
    EXPECT_FALSE(parse_finite(text)) << text;
  EXPECT_EQ(parse_finite("7"), 7.0);
}

TEST(NumberAtFront, LeavesWhatIsBehind) {
  const auto read = number_at_front<int>("7/1");
  EXPECT_TRUE(read.good());
  EXPECT_EQ(read.value, 7);
  EXPECT_EQ(read.rest, "/1");
  EXPECT_FALSE(read.is_all());
  EXPECT_EQ(number_at_front<double>("x1").rest, "x1");
}

TEST(NumberAtFront, OutOfRangeIsANumberStill) {
  const auto read = number_at_front<double>("-1e999;");
  EXPECT_EQ(read.status, NumberAtFront<double>::Status::OutOfRange);
  EXPECT_EQ(read.rest, ";");
  EXPECT_TRUE(number_at_front<double>("1e999").is_all());
}

TEST(ParseNumbers, ExactlySoManyWithABlankBetweenEachTwo) {
  std::array<double, 3> numbers{};
  ASSERT_TRUE(parse_numbers("1 -2.5 3e2", numbers));
  EXPECT_EQ(numbers, (std::array{1.0, -2.5, 300.0}));
  for (const std::string_view text : {"", "1 2", "1 2 3 4", "1  2 3", "1 2 3 ", "1 2 x"})
    EXPECT_FALSE(parse_numbers(text, numbers)) << text;
}

}  // namespace
}  // namespace icome::base
