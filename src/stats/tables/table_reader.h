#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "stats/tables/data_table.h"

namespace icome::stats {

/// What parts the cells of a row.
enum class Separator {
  Found,      ///< the one that the heading has most of; the comma where it has none
  Comma,      ///< numbers have a decimal point
  Tab,        ///< numbers have a decimal point
  Semicolon,  ///< as spreadsheets write where the decimal sign is a comma: 2,5 and 2.5 are numbers then
};

/// Reads a table whose first row names the columns, as RFC 4180 has it: cells with separators, line ends or
/// quotes stand between quotes, a quote within them twice. Blanks around other cells are taken off, empty
/// lines passed over; lines end with LF, CR LF or CR, and a UTF-8 byte order mark may come first. An empty
/// first heading, as R and pandas write above row names, becomes "row".
///
/// Fails with `source`, line and column: nothing in it, no row under the heading, a row with more or fewer
/// cells, a heading that is empty or there twice, a quote that is not closed or has text behind it, a cell
/// above 1 MiB, bytes that are no UTF-8 text (Latin-1, UTF-16, NUL), 4 GiB or more.
base::Result<DataTable> read_table(std::string_view bytes, const std::string& source,
                                   Separator separator = Separator::Found);

/// Whether the bytes begin as the files of NIST's Statistical Reference Datasets do.
bool is_nist_layout(std::string_view bytes);

/// Reads a file of NIST's Statistical Reference Datasets: its head says in which lines the data is, and the
/// line before these names the columns. In the sets for analysis of variance the first column is the factor,
/// the last the response. Fails, with `source` and line, where the head has no such line, the file ends
/// before the data does or a row has not as many words as there are headings.
base::Result<DataTable> read_nist_table(std::string_view bytes, const std::string& source);

/// By what the bytes are and how the source's name ends: NIST's layout, .tsv and .tab by tabs, and others by
/// what the heading shows.
base::Result<DataTable> read_any_table(std::string_view bytes, const std::string& source);

}  // namespace icome::stats
