#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace icome::study {

/// What stands where there is no value (BIDS).
constexpr std::string_view kNotAvailable = "n/a";
/// The last cell of each row of data that no person gave.
constexpr std::string_view kSimulated = "SIMULATED";

/// A value of a column, with what it means.
struct ColumnLevel {
  std::string id;
  std::string meaning;
};

/// A column of a table, as its JSON file describes it.
struct Column {
  std::string name = {};
  std::string description = {};
  std::string unit = {};                 // of SI; empty: none
  std::vector<ColumnLevel> levels = {};  // of what has only these
  bool of_study = false;                 // the study names it; otherwise it is always called so
};
using Columns = std::vector<Column>;

/// Puts "_" behind names that the study has given to columns and others have already, in the table or in its
/// JSON file; adds the column that marks simulated data.
Columns finished_columns(Columns columns, bool simulated);

/// Names with tabs between them, and the end of the line.
std::string header_of(const Columns& columns);

/// A text as a cell of one line, from which cell_text() gives it back: "n/a" where it is empty; a backslash
/// before t, n, r and another one stands for tab, line feed, carriage return and backslash, "\xHH" for the
/// byte of that hexadecimal number: control characters, quotation marks (which readers of tables would take
/// away) and what is no UTF-8. "n\/a" is the text "n/a".
std::string cell_of(std::string_view text);
/// Fails on what cell_of() does not write.
base::Result<std::string> cell_text(std::string_view cell);
/// With as many digits as bring its bits back; "n/a" where it is not finite.
std::string cell_of(double number);

/// "a\tb\n", with the mark of simulated data at its end where they are.
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
  bool torn = false;      // something follows them
};

/// Fails, naming the line, on another header, rows of another length and texts that cell_text() refuses.
base::Result<TsvTable> parse_tsv(std::string_view text, const std::string& source, const Columns& columns);

/// Takes the cells of a row in their order, and keeps what is wrong with the first that is no such value.
class RowReader {
 public:
  RowReader(const TsvRow& row, const Columns& columns, const std::string& source);

  const std::string& text();
  /// Not a number where there is none.
  double number();
  std::size_t whole();
  std::optional<std::size_t> whole_or_none();
  /// One of the names; their count where the cell is none of them and `none` allows for it.
  std::size_t one_of(const std::vector<std::string>& names);
  std::size_t one_of_or_none(const std::vector<std::string>& names);
  /// Fails where the cell before this is not as it should be.
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
