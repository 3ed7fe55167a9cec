#include "study/records/tsv.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"

namespace icome::study {
namespace {

const Columns kTwoColumns = {{"a", ""}, {"b", ""}};

std::string tsv_error(std::string_view text) {
  const auto table = parse_tsv(text, "t.tsv", kTwoColumns);
  return table ? "read" : table.error().message;
}

TEST(Tsv, CellsGiveTextsBack) {
  const std::string texts[] = {"",
                               "n/a",
                               "n\\/a",
                               "a\tb\r\nc\\",
                               std::string("\0x", 2),
                               "\"quoted\"",
                               " x ",
                               "\xff\xfe",
                               "\x7f",
                               "\\x41",
                               "é€😀",
                               "#x",
                               "N/A",
                               "\\",
                               "\\n",
                               "trailing\\\\",
                               "line\n"};
  for (const std::string& text : texts) {
    const std::string cell = cell_of(text);
    EXPECT_EQ(cell.find_first_of("\t\n\r\"") + 1, 0U) << text;
    EXPECT_EQ(cell_text(cell), text) << cell;
  }
  EXPECT_EQ(cell_of("a\tb"), "a\\tb");
  EXPECT_EQ(cell_of(""), "n/a");
}

TEST(Tsv, AnyBytesMakeOneCell) {
  base::Random random(1);
  for (int i = 0; i < 20000; ++i) {
    std::string text(random.index(12), ' ');
    for (char& byte : text) byte = char(random.bits());
    const std::string cell = cell_of(text);
    EXPECT_EQ(cell.find_first_of(std::string("\t\n\r\"\0", 5)), std::string::npos);
    ASSERT_EQ(cell_text(cell), text);
  }
}

TEST(Tsv, NumbersKeepTheirBits) {
  base::Random random(2);
  const Columns column = {{"x", ""}};
  for (int i = 0; i < 2000; ++i) {
    const double number = std::ldexp(random.uniform(-1.0, 1.0), int(random.index(200)) - 100);
    const TsvRow row{2, {cell_of(number)}};
    const std::string source = "t.tsv";
    EXPECT_EQ(RowReader(row, column, source).number(), number);
  }
  EXPECT_EQ(cell_of(std::nan("")), "n/a");
  EXPECT_EQ(cell_of(std::numeric_limits<double>::infinity()), "n/a");
}

TEST(Tsv, RefusesWhatItDoesNotWrite) {
  EXPECT_EQ(tsv_error("a\tb\n1\t2\n"), "read");
  EXPECT_EQ(tsv_error("a\tc\n1\t2\n"),
            "t.tsv:1: the header is not 'a\tb'; put back the file as it was written.");
  EXPECT_EQ(tsv_error("a\tb\n1\t2\n1\n"), "t.tsv:3: has 1 columns, and the table has 2.");
  EXPECT_EQ(tsv_error("a\tb\n1\t2\t3\n"), "t.tsv:2: has 3 columns, and the table has 2.");
  EXPECT_EQ(tsv_error("a\tb\n1\t\\q\n"), "t.tsv:2: b holds a backslash that stands for nothing.");
  EXPECT_EQ(tsv_error("a\tb\n1\t\\x1\n"), "t.tsv:2: b holds a backslash that stands for nothing.");
  EXPECT_EQ(tsv_error("a\tb\r\n1\t2\r\n"),
            "t.tsv:1: the header is not 'a\tb'; put back the file as it was written.");
  EXPECT_EQ(tsv_error("a\tb\n1\t2\r\n"),
            "t.tsv:2: b holds the control character 13; was the file saved by another program?");
  EXPECT_EQ(tsv_error(std::string("a\tb\n1\t\0\n", 8)),
            "t.tsv:2: b holds the control character 0; was the file saved by another program?");
}

TEST(Tsv, RowWithoutItsEndIsTorn) {
  const std::string text = "a\tb\n1\t2\n3\t4\n";
  for (std::size_t size = 0; size <= text.size(); ++size) {
    const auto table = parse_tsv(text.substr(0, size), "t.tsv", kTwoColumns);
    ASSERT_TRUE(table) << size;
    EXPECT_EQ(table->rows.size(), size < 8 ? 0U : size < 12 ? 1U : 2U);
    EXPECT_EQ(table->torn, size != 4 && size != 8 && size != 12);
  }
}

TEST(Tsv, NamesOfTheStudyGiveWay) {
  const Columns columns =
      finished_columns({{"time", "ours"}, {"time", "", "", {}, true}, {"time_", "", "", {}, true}}, true);
  EXPECT_EQ(header_of(columns), "time\ttime_\ttime__\tdata\n");
  EXPECT_EQ(header_of(finished_columns({{"Escapes", "", "", {}, true}}, false)), "Escapes_\n");
}

TEST(Tsv, SimulatedRowsAreMarked) {
  const Columns columns = finished_columns({{"a", ""}}, true);
  EXPECT_EQ(row_of({"1"}, true), "1\tSIMULATED\n");
  EXPECT_TRUE(parse_tsv("a\tdata\n1\tSIMULATED\n", "t.tsv", columns));
  const auto unmarked = parse_tsv("a\tdata\n1\tn/a\n", "t.tsv", columns);
  ASSERT_FALSE(unmarked);
  EXPECT_EQ(unmarked.error().message, "t.tsv:2: data is 'n/a'; in simulated data it is always SIMULATED.");
}

}  // namespace
}  // namespace icome::study
