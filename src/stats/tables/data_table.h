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
  /// The number of cells.
  std::size_t size() const { return ends_.size(); }
  /// The text of the cell in a row, counted from 0; valid until the next cell is added.
  std::string_view cell(std::size_t row) const;
  /// Is the value of that row missing: is the cell empty, NA, NaN, nan or a single point?
  bool missing(std::size_t row) const;
  /// Appends a cell. All cells together stay below 4 GiB.
  void add(std::string_view cell);

 private:
  std::string name_;
  std::string text_;
  std::vector<std::uint32_t> ends_;  // of each cell in the text
};

/// A column taken for a nominal variable: the level of each row.
struct Levels {
  static constexpr std::size_t kMissing = static_cast<std::size_t>(-1);

  std::vector<std::string> names;  ///< ascending if all are numbers, else in the order of first appearance
  std::vector<std::size_t> of;     ///< for each row an index into names, or kMissing
};

/// Named columns of the same length, with the source and the lines that they were read from.
class DataTable {
 public:
  /// `source` is the name of the table in errors: the file's name.
  DataTable(std::string source, bool decimal_comma)
      : source_(std::move(source)), decimal_comma_(decimal_comma) {}

  const std::string& source() const { return source_; }
  /// Is the comma the decimal sign, with semicolons between the cells?
  bool decimal_comma() const { return decimal_comma_; }
  std::size_t rows() const { return lines_.size(); }
  const std::vector<Column>& columns() const { return columns_; }
  /// The line of the source on which a row begins, counted from 1.
  std::size_t line(std::size_t row) const { return lines_[row]; }

  /// The column with that heading. Fails with a list of the headings.
  base::Result<const Column*> find(std::string_view name) const;

  /// The column's numbers, one a row; NaN where the value is missing. Fails, with line and column, at the
  /// first cell that is not a finite number. If semicolons separate the columns, a comma is the decimal sign.
  base::Result<std::vector<double>> numbers(const Column& column) const;

  /// Does the column have values, all of them finite numbers?
  bool numeric(const Column& column) const;

  /// The column as a nominal variable. 2, 2.0 and 2e0 are different levels: a level is its text.
  Levels levels(const Column& column) const;

  // To fill the table, add the columns first and then row after row, with a cell for every column.
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

/// The text in quotation marks for a message: shortened where it is long, and printable.
std::string quoted_cell(std::string_view text);

}  // namespace icome::stats
