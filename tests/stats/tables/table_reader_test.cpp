#include "stats/tables/table_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/parse_number.h"
#include "places.h"

namespace icome::stats {
namespace {

DataTable read(std::string_view bytes, Separator separator = Separator::Found) {
  auto table = read_table(bytes, "d.csv", separator);
  EXPECT_TRUE(table) << table.error().message;
  return table ? std::move(*table) : DataTable("", false);
}

std::string error_of(std::string_view bytes) {
  const auto table = read_table(bytes, "d.csv");
  return table ? "no error" : table.error().message;
}

std::vector<double> numbers_of(const DataTable& table, std::string_view name) {
  const auto column = table.find(name);
  EXPECT_TRUE(column);
  const auto numbers = table.numbers(**column);
  EXPECT_TRUE(numbers) << numbers.error().message;
  return numbers.value_or(std::vector<double>{});
}

TEST(ReadTable, NamedColumnsOfText) {
  const DataTable table = read("time (s),interface\n1.5,ray\n2,hand\n");
  ASSERT_EQ(table.columns().size(), 2U);
  EXPECT_EQ(table.rows(), 2U);
  EXPECT_EQ(numbers_of(table, "time (s)"), (std::vector{1.5, 2.0}));
  EXPECT_EQ((*table.find("interface"))->cell(1), "hand");
  EXPECT_TRUE(table.numeric(table.columns()[0]));
  EXPECT_FALSE(table.numeric(table.columns()[1]));
  EXPECT_EQ(table.line(1), 3U);
}

TEST(ReadTable, QuotesAsRfc4180HasThem) {
  const DataTable table = read("a,\"b, \"\"c\"\"\"\r\n\"x\ny\",\"\"\r\n\"p\"\"q\",z");
  EXPECT_EQ(table.columns()[1].name(), "b, \"c\"");
  EXPECT_EQ(table.columns()[0].cell(0), "x\ny");
  EXPECT_EQ(table.columns()[1].cell(0), "");
  EXPECT_EQ(table.columns()[0].cell(1), "p\"q");
  EXPECT_EQ(table.line(1), 4U);  // the quoted line end counts
}

TEST(ReadTable, EndsOfLinesMarksAndBlanksOfAllSystems) {
  for (const std::string_view bytes : {"\xef\xbb\xbf"
                                       "a,b\r\n1,2\r\n\r\n3,4",
                                       "a,b\r1,2\r3,4\r", "\n\na , b\n 1\t,2 \n\n3, \"4\" \n\n\n"}) {
    const DataTable table = read(bytes);
    EXPECT_EQ(numbers_of(table, "a"), (std::vector{1.0, 3.0}));
    EXPECT_EQ(numbers_of(table, "b"), (std::vector{2.0, 4.0}));
  }
}

TEST(ReadTable, SeparatorIsFoundInTheHeading) {
  EXPECT_EQ(numbers_of(read("a\tb, c\n1\t2\n"), "b, c"), std::vector{2.0});
  EXPECT_EQ(numbers_of(read("\"a;b;c\",d\n1,2\n"), "d"), std::vector{2.0});
  EXPECT_EQ(numbers_of(read("a\n1\n"), "a"), std::vector{1.0});
  EXPECT_EQ(read("a,b\tc\n1,2\t3\n", Separator::Tab).columns()[0].cell(0), "1,2");
  EXPECT_EQ(read_any_table("a,b,c\td\n1\t2\n", "d.tsv")->columns().size(), 2U);
}

TEST(ReadTable, SemicolonsMakeTheCommaADecimalSign) {
  const DataTable table = read("a;b\n1,5;x\n-2;y\n2.5;z\n");
  EXPECT_EQ(numbers_of(table, "a"), (std::vector{1.5, -2.0, 2.5}));
  EXPECT_FALSE(read("a;b\n1.000,5;2\n").numeric(read("a;b\n1.000,5;2\n").columns()[0]));
  // Where commas part cells they are no decimal sign, even between quotes.
  const DataTable commas = read("a,b\n\"1,5\",2\n");
  EXPECT_FALSE(commas.numbers(commas.columns()[0]));
}

TEST(ReadTable, MissingValues) {
  const DataTable table = read("a,b\nNA,1\n.,2\nNaN,3\n,4\nnan,5\n7,6\n");
  const std::vector<double> values = numbers_of(table, "a");
  for (std::size_t row = 0; row < 5; ++row) {
    EXPECT_TRUE(table.columns()[0].missing(row));
    EXPECT_TRUE(std::isnan(values[row]));
  }
  EXPECT_EQ(values[5], 7.0);
  const Levels levels = table.levels(table.columns()[0]);
  EXPECT_EQ(levels.names, std::vector<std::string>{"7"});
  EXPECT_EQ(levels.of[0], Levels::kMissing);
  EXPECT_FALSE(read("a,b\nNA,1\n").numeric(read("a,b\nNA,1\n").columns()[0]));
}

TEST(ReadTable, LevelsInTheOrderOfNumbersOrOfAppearance) {
  const DataTable table = read("dose,order\n10,low\n2,high\n10,low\n0.5,middle\n");
  EXPECT_EQ(table.levels(table.columns()[0]).names, (std::vector<std::string>{"0.5", "2", "10"}));
  EXPECT_EQ(table.levels(table.columns()[0]).of, (std::vector<std::size_t>{2, 1, 2, 0}));
  EXPECT_EQ(table.levels(table.columns()[1]).names, (std::vector<std::string>{"low", "high", "middle"}));
}

TEST(ReadTable, RowNamesNeedNoHeading) {
  EXPECT_EQ(read(",a\n0,1\n").columns()[0].name(), "row");
  EXPECT_EQ(read("\"\",\"a\"\n\"1\",1\n").columns()[0].name(), "row");
}

TEST(ReadTable, ErrorsNameFileLineAndColumn) {
  EXPECT_EQ(error_of(""), "d.csv is empty; its first line must name the columns.");
  EXPECT_EQ(error_of("\xef\xbb\xbf"), "d.csv is empty; its first line must name the columns.");
  EXPECT_EQ(error_of(" \r\n\n"), "d.csv is empty; its first line must name the columns.");
  EXPECT_EQ(error_of("a,b\n"), "d.csv: there is no row under the heading.");
  EXPECT_EQ(error_of("a,b\n1,2\n3\n"),
            "d.csv:3: the row has 1 cell where 2 columns are named; put quotes around a cell that holds a "
            "comma.");
  EXPECT_EQ(error_of("a\tb\n1\t2\t3\n"),
            "d.csv:2: the row has 3 cells where 2 columns are named; put quotes around a cell that holds a "
            "tab.");
  EXPECT_EQ(error_of("a,b,a\n1,2,3\n"), "d.csv:1: columns 1 and 3 are both called \"a\"; name them apart.");
  EXPECT_EQ(error_of("a,,b\n1,2,3\n"),
            "d.csv:1: column 2 has no heading; the first line must name every column.");
  EXPECT_EQ(error_of("a,b\n1,\"2\n3,4\n"), "d.csv:2: column 2: a quote is opened and never closed.");
  EXPECT_EQ(error_of("a,b\n\"1\"2,3\n"),
            "d.csv:2: column 1: text follows a closing quote; write a quote within quotes twice.");
  EXPECT_EQ(error_of(std::string("a\0b\n1\n", 6)), "d.csv is no text; give a table as CSV or TSV.");
  EXPECT_EQ(error_of("\xff\xfe"
                     "a"),
            "d.csv is UTF-16; save it as UTF-8.");
}

TEST(ReadTable, TextThatIsNoUtf8IsToldWithItsLine) {
  const auto table = read_table("name,v\nb,1\ncaf\xe9,2\n", "t.csv");
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().message,
            "t.csv:3: the byte 0xe9 is no UTF-8; save the table as UTF-8 (spreadsheets: \"CSV UTF-8\").");
  EXPECT_TRUE(read_table("name,v\ncaf\xc3\xa9,2\n", "t.csv"));
}

TEST(ReadTable, HugeCellsAreRefused) {
  const std::string huge((1U << 20U) + 1, 'x');
  EXPECT_EQ(error_of("a\n" + huge + "\n"),
            "d.csv:2: column 1: a cell is larger than 1 MiB; give a table of values.");
  EXPECT_EQ(error_of("a\n\"" + huge + "\"\n"),
            "d.csv:2: column 1: a quoted cell is larger than 1 MiB; close its quote.");
}

TEST(DataTable, ColumnThatIsNotThereIsToldWithThoseThatAre) {
  const auto found = read("a,b\n1,2\n").find("A");
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().message, "d.csv: there is no column \"A\"; there are \"a\", \"b\".");
}

TEST(DataTable, TextAndInfinityAreNoNumbers) {
  const DataTable table = read("a,b\n1,2\nfast,3\n");
  const auto numbers = table.numbers(table.columns()[0]);
  ASSERT_FALSE(numbers);
  EXPECT_EQ(numbers.error().message,
            "d.csv:3: \"fast\" in the column \"a\" is not a finite number; leave the cell empty or write NA "
            "where a value is missing.");
  for (const std::string_view cell :
       {"inf", "-Infinity", "1e400", "0x10", "1 2", "--1", "+-1", "1e", "%", "-"})
    EXPECT_FALSE(base::parse_finite(cell)) << cell;
  EXPECT_EQ(base::parse_finite("+1.5e-3"), 1.5e-3);
}

TEST(QuotedCell, IsCutBetweenCharactersAndPrintable) {
  EXPECT_EQ(quoted_cell("a\tb\xff"), "\"a?b?\"");
  EXPECT_EQ(quoted_cell(std::string(39, 'a') + "\u00fc"), "\"" + std::string(39, 'a') + "...\"");
}

constexpr std::string_view kSmallNist =
    "NIST/ITL StRD\nFile Format:    ASCII\n                Certified Values   (lines 1 to 2)\n"
    "                Data               (lines 6 to 7)\nData:  Instrument   Resistance\n"
    "  1  196.3052\n  2  -1.5\n\n";

TEST(ReadNist, TakesTheLinesThatItsHeadNames) {
  ASSERT_TRUE(is_nist_layout(kSmallNist));
  const auto table = read_any_table(kSmallNist, "S.dat");
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_EQ(numbers_of(*table, "Resistance"), (std::vector{196.3052, -1.5}));
  EXPECT_EQ(table->levels(table->columns()[0]).names, (std::vector<std::string>{"1", "2"}));
  EXPECT_EQ(table->line(0), 6U);
}

TEST(ReadNist, SaysWhatIsWrong) {
  const auto message = [](std::string text, std::string_view what, std::string_view with) {
    text.replace(text.find(what), what.size(), with);
    const auto table = read_nist_table(text, "S.dat");
    return table ? "no error" : table.error().message;
  };
  const std::string good(kSmallNist);
  EXPECT_EQ(message(good, "Data   ", "Dota   "), "S.dat: its head has no line \"Data (lines A to B)\".");
  EXPECT_EQ(message(good, "6 to 7", "6 to 99"), "S.dat:8: the row has 0 values where 2 columns are named.");
  EXPECT_EQ(message(good, "\n\n", "\n"), "no error");
  EXPECT_EQ(message(good, "  2  -1.5\n\n", ""),
            "S.dat:7: the file ends before line 7, the last of its data.");
  EXPECT_EQ(message(good, "6 to 7", "4 to 7"), "S.dat:4: the data cannot begin before this line.");
  EXPECT_EQ(message(good, "6 to 7", "-6 to 7"), "S.dat: its head has no line \"Data (lines A to B)\".");
  EXPECT_EQ(message(good, "196.3052", "1 2"), "S.dat:6: the row has 3 values where 2 columns are named.");
}

TEST(ReadTable, SharedTables) {
  const std::filesystem::path folder = places::shared_data() / "stats";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
  std::size_t read_files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().string();
    if (!name.ends_with(".csv") && !name.ends_with(".dat")) continue;
    std::stringstream bytes;
    bytes << std::ifstream(entry.path(), std::ios::binary).rdbuf();
    const auto table = read_any_table(bytes.str(), name);
    EXPECT_TRUE(table) << table.error().message;
    ++read_files;
  }
  EXPECT_GE(read_files, 20U);
}

}  // namespace
}  // namespace icome::stats
