#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace icome::stats {

/// One column of a table: cells of text, all kept in one piece of memory.
class Column {
 public:
  explicit Column(std::string name) : name_(std::move(name)) {}

  /// The heading.
  const std::string& name() const { return name_; }
  /// How many cells there are.
  std::size_t size() const { return ends_.size(); }
  /// What stands in a row, counted from 0; valid until the next cell is added.
  std::string_view cell(std::size_t row) const;
  /// Whether that row has no value: the cell is empty, NA, NaN, nan or a single point.
  bool missing(std::size_t row) const;
  /// All cells together stay below 4 GiB.
  void add(std::string_view cell);

 private:
  std::string name_;
  std::string text_;
  std::vector<std::uint32_t> ends_;  // of each cell in the text
};

/// A column taken for a nominal variable: what level each row has.
struct Levels {
  static constexpr std::size_t kMissing = static_cast<std::size_t>(-1);

  std::vector<std::string> names;  ///< numbers ascending, or else text in the order of its first appearance
  std::vector<std::size_t> of;     ///< for each row an index into names, or kMissing
};

/// Named columns of the same length, and where they were read.
class DataTable {
 public:
  /// `source` is what errors call it: the file's name.
  DataTable(std::string source, bool decimal_comma)
      : source_(std::move(source)), decimal_comma_(decimal_comma) {}

  const std::string& source() const { return source_; }
  /// Whether the comma is the decimal sign, and semicolons part the cells.
  bool decimal_comma() const { return decimal_comma_; }
  std::size_t rows() const { return lines_.size(); }
  const std::vector<Column>& columns() const { return columns_; }
  /// The line of the source on which a row begins, counted from 1.
  std::size_t line(std::size_t row) const { return lines_[row]; }

  /// The column with that heading. Fails with the list of those there are.
  base::Result<const Column*> find(std::string_view name) const;

  /// The column's numbers, one a row; NaN where the value is missing. Fails, with line and column, at the
  /// first cell that is no finite number. Where columns are parted by semicolons a comma is the decimal sign.
  base::Result<std::vector<double>> numbers(const Column& column) const;

  /// Whether there is a value in the column and all of them are finite numbers.
  bool numeric(const Column& column) const;

  /// The column as a nominal variable. 2, 2.0 and 2e0 are different levels: a level is its text.
  Levels levels(const Column& column) const;

  // For those who fill it: columns first, and then row after row, a cell for every column.
  Column& add_column(std::string name);
  std::vector<Column>& columns() { return columns_; }
  void add_row(std::size_t line) { lines_.push_back(line); }

 private:
  std::optional<double> number(std::string_view cell) const;

  std::string source_;
  bool decimal_comma_;
  std::vector<Column> columns_;
  std::vector<std::size_t> lines_;
};

/// The text between quotation marks, for a message: cut where it is long, printable.
std::string quoted_cell(std::string_view text);

/// The finite number that all of the text is, as 1, -2.5, +3 or 1e-3; nothing for any other text.
std::optional<double> parse_number(std::string_view text);

}  // namespace icome::stats
