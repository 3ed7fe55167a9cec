#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "stats/tables/data_table.h"

namespace icome::stats {

/// The separator between the cells of a row.
enum class Separator {
  Found,      ///< the most frequent one in the heading; the comma if it has none
  Comma,      ///< numbers have a decimal point
  Tab,        ///< numbers have a decimal point
  Semicolon,  ///< as spreadsheets with a decimal comma write: 2,5 and 2.5 are both numbers
};

/// Reads a table whose first row names the columns, in the format of RFC 4180: cells with separators, line
/// ends or quotes stand between quotes, with quotes in them doubled. Blanks around other cells are removed
/// and empty lines skipped; lines end with LF, CR LF or CR, and a UTF-8 byte order mark may come first. An
/// empty first heading, as R and pandas write above row names, becomes "row".
///
/// Fails, with `source`, line and column, on an empty table, no row under the heading, a row with more or
/// fewer cells, an empty or repeated heading, a quote that is not closed or has text behind it, a cell
/// above 1 MiB, bytes that are not UTF-8 text (Latin-1, UTF-16, NUL), and 4 GiB or more.
base::Result<DataTable> read_table(std::string_view bytes, const std::string& source,
                                   Separator separator = Separator::Found);

/// Do the bytes begin like the files of NIST's Statistical Reference Datasets?
bool is_nist_layout(std::string_view bytes);

/// Reads a file of NIST's Statistical Reference Datasets: its head gives the lines of the data, and the line
/// before these names the columns. In the sets for analysis of variance the first column is the factor,
/// the last the response. Fails, with `source` and line, where the head has no such line, the file ends
/// before the data does or a row has a different number of words than there are headings.
base::Result<DataTable> read_nist_table(std::string_view bytes, const std::string& source);

/// Reads a table in the format that its bytes and the ending of the source's name show: NIST's layout, tabs
/// for .tsv and .tab, and otherwise the separator found in the heading.
base::Result<DataTable> read_any_table(std::string_view bytes, const std::string& source);

}  // namespace icome::stats
