#include "io/table_reader.h"

#include <gtest/gtest.h>

namespace icome::io {
namespace {

using TextRows = std::vector<std::vector<std::string>>;

/// All rows of the text; a last row of one cell holds the error where there is one.
TextRows text_rows_of(std::string_view text, char separator = ',', TableStyle style = TableStyle::Quoted) {
  TableReader reader(text, "t.csv", separator, style);
  TextRows rows;
  for (;;) {
    const auto more = reader.next();
    if (!more) rows.push_back({more.error().message});
    if (!more || !*more) return rows;
    rows.emplace_back(reader.cells().begin(), reader.cells().end());
  }
}

TEST(TableReader, QuotedCellsHoldSeparatorsLineEndsAndQuotes) {
  EXPECT_EQ(text_rows_of("a,\"b, \"\"c\"\"\"\r\n\"x\ny\",\"\" ,z"),
            (TextRows{{"a", "b, \"c\""}, {"x\ny", "", "z"}}));
  EXPECT_EQ(text_rows_of("\"a\tb\"\t c\n", '\t'), (TextRows{{"a\tb", "c"}}));
}

TEST(TableReader, LinesEndInThreeWaysAndMayBeginWithAByteOrderMark) {
  EXPECT_EQ(text_rows_of("\xef\xbb\xbf"
                         "a , b\r\n1,2\r3,\n"),
            (TextRows{{"a", "b"}, {"1", "2"}, {"3", ""}}));
  EXPECT_EQ(text_rows_of(""), TextRows{});
}

TEST(TableReader, PlainCellsKeepEveryByte) {
  EXPECT_EQ(text_rows_of(" a\t\"b\r\n\"c\t", '\t', TableStyle::Plain),
            (TextRows{{" a", "\"b\r"}, {"\"c", ""}}));
}

TEST(TableReader, RowsKnowTheirPlace) {
  const std::string_view text = "\"a\nb\",c\n\n\"\"\nd";
  TableReader reader(text, "t.csv", ',');
  ASSERT_TRUE(*reader.next());
  EXPECT_EQ(reader.line(), 1U);
  EXPECT_EQ(reader.end(), 8U);
  ASSERT_TRUE(*reader.next());
  EXPECT_EQ(reader.line(), 3U);
  EXPECT_TRUE(reader.is_blank());
  ASSERT_TRUE(*reader.next());
  EXPECT_FALSE(reader.is_blank());  // an empty text between quotes
  EXPECT_TRUE(reader.has_line_end());
  ASSERT_TRUE(*reader.next());
  EXPECT_FALSE(reader.has_line_end());
  EXPECT_EQ(reader.end(), text.size());
  EXPECT_FALSE(*reader.next());
}

TEST(TableReader, ErrorsNameFileLineAndColumn) {
  EXPECT_EQ(text_rows_of("a\n1,\"2\n3").back().front(),
            "t.csv:2: column 2: a quote is opened and never closed.");
  EXPECT_EQ(text_rows_of("\"1\"2").back().front(),
            "t.csv:1: column 1: text follows a closing quote; write a quote within quotes twice.");
}

TEST(FindSeparator, IsTheMostFrequentOutsideQuotesInTheFirstLine) {
  EXPECT_EQ(find_separator("\n\"a;b;c\",d\n;;;"), ',');
  EXPECT_EQ(find_separator("a\tb, c"), '\t');
  EXPECT_EQ(find_separator("a;b"), ';');
  EXPECT_EQ(find_separator("a"), ',');
}

}  // namespace
}  // namespace icome::io
