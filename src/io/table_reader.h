#pragma once
#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace icome::io {

/// The ways in which a table is written as text.
enum class TableStyle {
  /// RFC 4180: a cell with separators, line ends or quotes stands between quotes, with quotes in it doubled.
  /// Blanks around other cells are removed, lines end with LF, CR LF or CR, and a UTF-8 byte order mark may
  /// come first. A cell has at most 1 MiB.
  Quoted,
  /// Every byte between two separators is the cell's, and lines end with LF.
  Plain,
};

/// Reads a table of text row by row.
class TableReader {
 public:
  /// The text must outlive the reader; `source` is its name in errors.
  TableReader(std::string_view text, std::string source, char separator,
              TableStyle style = TableStyle::Quoted);

  /// Reads a row. Returns false at the end of the text. Fails, with source, line and column, on a quote that
  /// is not closed or has text behind it, and on a cell that is too large.
  base::Result<bool> next();

  /// The cells of the row read last, without their quotes; valid until the next one is read.
  const std::vector<std::string_view>& cells() const { return cells_; }
  /// The line on which the row begins, counted from 1.
  std::size_t line() const { return line_; }
  /// Is the row a line without text?
  bool is_blank() const { return cells_.size() == 1 && cells_.front().empty() && !first_is_quoted_; }
  /// Bytes of the text up to the end of the row.
  std::size_t end() const { return at_; }
  /// Does the row end with the line, and not just where the text does?
  bool has_line_end() const { return has_line_end_; }

 private:
  const char* read_cell();
  const char* read_unquoted();
  const char* read_quoted(std::size_t begin);
  bool take_separator();
  bool ends_line(char c) const { return c == '\n' || (c == '\r' && style_ == TableStyle::Quoted); }

  std::string_view text_;
  std::string source_;
  char separator_;
  TableStyle style_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t next_line_ = 1;
  std::vector<std::string_view> cells_;
  std::deque<std::string> unescaped_;  // cells of the row that have doubled quotes
  bool first_is_quoted_ = false;
  bool has_line_end_ = false;
};

/// The tab, semicolon or comma that is most frequent outside quotes in the first line with text; in a tie the
/// one that is rarer in text. The comma if there is none.
char find_separator(std::string_view text);

/// The text without the UTF-8 byte order mark that some spreadsheets write first.
std::string_view without_byte_order_mark(std::string_view text);

}  // namespace icome::io
