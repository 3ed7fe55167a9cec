#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace icome::study {

/// The cell for a missing value (BIDS).
constexpr std::string_view kNotAvailable = "n/a";
/// The last cell of each row of simulated data, which no person gave.
constexpr std::string_view kSimulated = "SIMULATED";

/// A value of a column, with its meaning.
struct ColumnLevel {
  std::string id;
  std::string meaning;
};

/// A column of a table, as its JSON file describes it.
struct Column {
  std::string name = {};
  std::string description = {};
  std::string unit = {};                 // of SI; empty: none
  std::vector<ColumnLevel> levels = {};  // the only values that the column may have; empty: any
  bool of_study = false;                 // named by the study; otherwise its name is fixed
};
using Columns = std::vector<Column>;

/// Puts "_" behind names from the study that other columns, or other members of the JSON file, have already;
/// adds the column that marks simulated data.
Columns finished_columns(Columns columns, bool simulated);

/// The header line: names with tabs between them, and the end of the line.
std::string header_of(const Columns& columns);

/// A text as a cell of one line, which cell_text() turns back into the text: "n/a" if it is empty; a
/// backslash before t, n, r and another one stands for tab, line feed, carriage return and backslash,
/// "\xHH" for the byte of that hexadecimal number: control characters, quotation marks (which readers of
/// tables would remove) and bytes that are not UTF-8. "n\/a" is the text "n/a".
std::string cell_of(std::string_view text);
/// The text of a cell. Fails on control characters and on escapes that have no meaning.
base::Result<std::string> cell_text(std::string_view cell);
/// A number with enough digits to restore its bits; "n/a" if it is not finite.
std::string cell_of(double number);

/// A row such as "a\tb\n", with the mark of simulated data at its end if they are.
std::string row_of(const std::vector<std::string>& cells, bool simulated);

/// A row of a table, with the texts of its cells.
struct TsvRow {
  std::size_t line = 0;
  std::vector<std::string> texts;
};

/// A table as it was read.
struct TsvTable {
  std::vector<TsvRow> rows;
  std::size_t whole = 0;  // bytes up to the end of the last row that is whole; 0: not even the header is
  bool torn = false;      // more bytes follow them
};

/// Fails, naming the line, on another header, rows of another length and texts that cell_text() refuses.
base::Result<TsvTable> parse_tsv(std::string_view text, const std::string& source, const Columns& columns);

/// Reads the cells of a row in order, and keeps the error of the first that does not hold such a value.
class RowReader {
 public:
  RowReader(const TsvRow& row, const Columns& columns, const std::string& source);

  const std::string& text();
  /// NaN for an empty cell.
  double number();
  std::size_t whole();
  std::optional<std::size_t> whole_or_none();
  /// The index of the cell among the names; one_of_or_none() returns their count if the cell is empty.
  std::size_t one_of(const std::vector<std::string>& names);
  std::size_t one_of_or_none(const std::vector<std::string>& names);
  /// Records an error of the cell read last, unless there is one already.
  void refuse(const std::string& sentence);

  bool good() const { return problem_.empty(); }
  base::Result<void> result() const;

 private:
  const TsvRow& row_;
  const Columns& columns_;
  const std::string& source_;
  std::size_t next_ = 0;
  std::string problem_;
};

}  // namespace icome::study
