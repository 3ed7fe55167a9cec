#include "io/number_rows.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "base/parse_number.h"
#include "io/table_reader.h"
#include "io/text_scanner.h"

namespace icome::io {
namespace {

constexpr std::size_t kLongestHeaderShown = 40;

/// "x,y,z" of "xyz".
std::string header_of(std::string_view columns) {
  std::string header;
  for (const char column : columns) header.append(header.empty() ? "" : ",").append(1, column);
  return header;
}

/// Fills the row with the numbers in the cells. Returns what is wrong with them; empty if nothing is.
std::string why_no_row(const TableReader& reader, std::string_view columns, std::vector<double>& row) {
  const std::vector<std::string_view>& cells = reader.cells();
  if (cells.size() != columns.size() || reader.is_blank())
    return fmt::format("a row has {} numbers ({}), this one has {}", columns.size(), header_of(columns),
                       reader.is_blank() ? 0 : cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto read = base::number_at_front<double>(cells[i]);
    if (!read.is_all()) return fmt::format("{} is not a number: {}", columns[i], quoted(cells[i]));
    if (!read.good() || !std::isfinite(read.value))
      return fmt::format("{} is not finite: {}", columns[i], quoted(cells[i]));
    row[i] = read.value;
  }
  return {};
}

}  // namespace

base::Result<void> read_number_rows(std::string_view text, const std::string& source,
                                    std::string_view columns, VisitNumbers visit) {
  // Empty lines at the end are no rows.
  TableReader reader(text.substr(0, text.find_last_not_of(" \t\r\n") + 1), source, ',');
  const auto fail_here = [&](const std::string& what) {
    return base::fail(fmt::format("{}:{}: {}", source, reader.line(), what));
  };
  if (const auto first = reader.next(); !first) return tl::unexpected(first.error());
  const std::string header = fmt::format("{}", fmt::join(reader.cells(), ","));
  if (header != header_of(columns))
    return fail_here(fmt::format("the first line must be \"{}\", not \"{}\"", header_of(columns),
                                 header.substr(0, kLongestHeaderShown)));
  std::vector<double> row(columns.size());
  for (;;) {
    const auto more = reader.next();
    if (!more) return tl::unexpected(more.error());
    if (!*more) return {};
    if (const std::string why = why_no_row(reader, columns, row); !why.empty()) return fail_here(why);
    if (const auto taken = visit(row); !taken) return fail_here(taken.error().message);
  }
}

}  // namespace icome::io
