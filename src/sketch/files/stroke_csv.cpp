#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "base/near_names.h"
#include "base/parse_number.h"
#include "io/table_reader.h"
#include "io/text_scanner.h"
#include "sketch/files/stroke_collector.h"
#include "sketch/files/stroke_formats.h"

namespace icome::sketch {
namespace {

constexpr std::array<std::string_view, 4> kPenColumns = {"t", "x", "y", "pressure"};
using PenColumns = std::array<std::size_t, kPenColumns.size()>;  // where each stands in a row
using PenRow = std::array<double, kPenColumns.size()>;

/// The places of the columns, or the end of a sentence that begins with file and line.
base::Result<PenColumns> find_pen_columns(const std::vector<std::string_view>& header) {
  PenColumns columns{};
  for (std::size_t i = 0; i < kPenColumns.size(); ++i) {
    const auto is_column = [&](std::string_view cell) { return io::same_word(cell, kPenColumns[i]); };
    const auto found = std::ranges::find_if(header, is_column);
    if (found == header.end()) {
      std::vector<std::string> names;
      for (const std::string_view cell : header) names.push_back(io::quoted(cell));
      return base::fail(fmt::format(
          "there is no column '{}' in the header; write t,x,y,pressure (s, mm, mm, 0 to 1) in the first line",
          kPenColumns[i]));
    }
    columns[i] = std::size_t(found - header.begin());
    if (std::any_of(found + 1, header.end(), is_column))
      return base::fail(fmt::format("the column '{}' stands twice in the header", kPenColumns[i]));
  }
  return columns;
}

base::Result<PenRow> pen_row(const std::vector<std::string_view>& cells, const PenColumns& columns) {
  PenRow row{};
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (columns[i] >= cells.size())
      return base::fail(
          fmt::format("the row has {} cells and so none of the column '{}'", cells.size(), kPenColumns[i]));
    const auto number = base::parse_finite(cells[columns[i]]);
    if (!number)
      return base::fail(fmt::format("{} is {}, which is no finite number with a decimal point",
                                    kPenColumns[i], io::quoted(cells[columns[i]])));
    row[i] = *number;
  }
  if (row[3] < 0.0 || row[3] > 1.0)
    return base::fail(fmt::format("the pressure {:g} is not between 0 and 1", row[3]));
  return row;
}

base::Result<void> add_pen_row(const PenRow& row, StrokeCollector& collector) {
  if (row[3] > 0.0) return collector.add({row[0], kMetresOfMm * base::Vector2(row[1], row[2]), row[3]});
  collector.lift();
  return {};
}

}  // namespace

base::Result<StrokesRead> read_csv_strokes(std::string_view text, const std::string& name) {
  io::TableReader table(text, name, io::find_separator(io::without_byte_order_mark(text)));
  StrokeCollector collector(name);
  std::optional<PenColumns> columns;
  const auto wrong = [&](const base::Error& error) {
    return base::fail(fmt::format("{}:{}: {}", name, table.line(), error.message));
  };
  while (true) {
    const auto more = table.next();
    if (!more) return tl::unexpected(more.error());
    if (!*more) break;
    if (table.is_blank()) continue;
    if (!columns) {
      const auto found = find_pen_columns(table.cells());
      if (!found) return wrong(found.error());
      columns = *found;
      continue;
    }
    const auto row = pen_row(table.cells(), *columns);
    if (!row) return wrong(row.error());
    if (const auto added = add_pen_row(*row, collector); !added) return wrong(added.error());
  }
  if (!columns) return base::fail(name + ": is empty; a stroke CSV begins with the line t,x,y,pressure");
  return collector.finish();
}

}  // namespace icome::sketch
