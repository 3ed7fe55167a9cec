#include "io/number_rows.h"

#include <gtest/gtest.h>

#include <vector>

namespace icome::io {
namespace {

using ManyNumbers = std::vector<std::vector<double>>;

/// The rows of a table with the columns x and y, where x is not below zero.
base::Result<ManyNumbers> numbers_in(std::string_view text) {
  ManyNumbers rows;
  const auto add = [&](std::span<const double> row) -> base::Result<void> {
    if (row[0] < 0.0) return base::fail("x is below zero");
    rows.emplace_back(row.begin(), row.end());
    return {};
  };
  if (const auto read = read_number_rows(text, "p.csv", "xy", add); !read)
    return tl::unexpected(read.error());
  return rows;
}

std::string number_rows_error(std::string_view text) {
  const auto rows = numbers_in(text);
  return rows ? "read" : rows.error().message;
}

TEST(NumberRows, OfAnySpreadsheet) {
  const auto rows = numbers_in("\xef\xbb\xbfx, y\r\n +1e-1 ,\"-2\"\r\n3,.5\r\n\r\n \n");
  ASSERT_TRUE(rows) << rows.error().message;
  EXPECT_EQ(*rows, (ManyNumbers{{0.1, -2.0}, {3.0, 0.5}}));
  EXPECT_EQ(numbers_in("x,y").value(), ManyNumbers{});
}

TEST(NumberRows, ErrorsNameFileAndLine) {
  EXPECT_EQ(number_rows_error(""), "p.csv:1: the first line must be \"x,y\", not \"\"");
  EXPECT_EQ(number_rows_error("x;y\n"), "p.csv:1: the first line must be \"x,y\", not \"x;y\"");
  EXPECT_EQ(number_rows_error("x,y\n1,2\n\n3,4\n"), "p.csv:3: a row has 2 numbers (x,y), this one has 0");
  EXPECT_EQ(number_rows_error("x,y\n1\n"), "p.csv:2: a row has 2 numbers (x,y), this one has 1");
  EXPECT_EQ(number_rows_error("x,y\n1,+-2\n"), "p.csv:2: y is not a number: '+-2'");
  EXPECT_EQ(number_rows_error("x,y\n1e999,2\n"), "p.csv:2: x is not finite: '1e999'");
  EXPECT_EQ(number_rows_error("x,y\n1,nan\n"), "p.csv:2: y is not finite: 'nan'");
  EXPECT_EQ(number_rows_error("x,y\n1,2\n-1,2\n"), "p.csv:3: x is below zero");
}

}  // namespace
}  // namespace icome::io
