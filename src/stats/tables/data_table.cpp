#include "stats/tables/data_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "base/parse_number.h"
#include "base/utf8.h"

namespace icome::stats {
namespace {

constexpr std::size_t kLongestQuotedCell = 40;
constexpr std::size_t kMostListedColumns = 30;

bool stands_for_missing(std::string_view cell) {
  return cell.empty() || cell == "NA" || cell == "NaN" || cell == "nan" || cell == ".";
}

std::string list_of(const std::vector<Column>& columns) {
  std::string text;
  const std::size_t shown = std::min(columns.size(), kMostListedColumns);
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0) text += ", ";
    text += quoted_cell(columns[i].name());
  }
  if (shown < columns.size()) text += fmt::format(" and {} more", columns.size() - shown);
  return text;
}

/// Sorts the names by number, ascending, if all of them are numbers.
void sort_by_number(Levels& levels) {
  std::vector<double> values;
  for (const std::string& name : levels.names) {
    const auto value = base::parse_finite(name);
    if (!value) return;
    values.push_back(*value);
  }
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return values[i]; });
  std::vector<std::string> names;
  std::vector<std::size_t> place(order.size());
  for (const std::size_t i : order) {
    place[i] = names.size();
    names.push_back(std::move(levels.names[i]));
  }
  levels.names = std::move(names);
  for (std::size_t& level : levels.of)
    if (level != Levels::kMissing) level = place[level];
}

}  // namespace

std::string_view Column::cell(std::size_t row) const {
  const std::size_t begin = row == 0 ? 0 : ends_[row - 1];
  return std::string_view(text_).substr(begin, ends_[row] - begin);
}

bool Column::missing(std::size_t row) const { return stands_for_missing(cell(row)); }

void Column::add(std::string_view cell) {
  text_ += cell;
  ends_.push_back(static_cast<std::uint32_t>(text_.size()));
}

base::Result<const Column*> DataTable::find(std::string_view name) const {
  const auto found = std::ranges::find(columns_, name, &Column::name);
  if (found != columns_.end()) return &*found;
  return base::fail(
      fmt::format("{}: there is no column {}; there are {}.", source_, quoted_cell(name), list_of(columns_)));
}

base::Result<std::vector<double>> DataTable::numbers(const Column& column) const {
  std::vector<double> values;
  values.reserve(column.size());
  for (std::size_t row = 0; row < column.size(); ++row) {
    const std::string_view cell = column.cell(row);
    const auto value = stands_for_missing(cell) ? std::numeric_limits<double>::quiet_NaN() : number(cell);
    if (!value)
      return base::fail(
          fmt::format("{}:{}: {} in the column {} is not a finite number; leave the cell empty "
                      "or write NA where a value is missing.",
                      source_, line(row), quoted_cell(cell), quoted_cell(column.name())));
    values.push_back(*value);
  }
  return values;
}

bool DataTable::numeric(const Column& column) const {
  bool any = false;
  for (std::size_t row = 0; row < column.size(); ++row) {
    if (column.missing(row)) continue;
    if (!number(column.cell(row))) return false;
    any = true;
  }
  return any;
}

Levels DataTable::levels(const Column& column) const {
  Levels levels;
  levels.of.reserve(column.size());
  std::unordered_map<std::string_view, std::size_t> known;  // views into the column
  for (std::size_t row = 0; row < column.size(); ++row) {
    const std::string_view cell = column.cell(row);
    if (stands_for_missing(cell)) {
      levels.of.push_back(Levels::kMissing);
      continue;
    }
    const auto [place, fresh] = known.try_emplace(cell, levels.names.size());
    if (fresh) levels.names.emplace_back(cell);
    levels.of.push_back(place->second);
  }
  sort_by_number(levels);
  return levels;
}

Column& DataTable::add_column(std::string name) { return columns_.emplace_back(std::move(name)); }

std::optional<double> DataTable::number(std::string_view cell) const {
  const std::size_t comma = decimal_comma_ ? cell.find(',') : std::string_view::npos;
  if (comma == std::string_view::npos) return base::parse_finite(cell);
  std::string with_point(cell);
  with_point[comma] = '.';
  return base::parse_finite(with_point);  // text with a second comma, or a point beside it, is not a number
}

std::string quoted_cell(std::string_view text) {
  std::string shown = "\"";
  std::size_t end = std::min(text.size(), kLongestQuotedCell);
  // Does not cut a character in two.
  while (end < text.size() && end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80U) --end;
  for (const char c : base::as_utf8(text.substr(0, end))) {
    const bool control = static_cast<unsigned char>(c) < 0x20U || c == 0x7f;
    shown += control ? '?' : c;
  }
  return shown + (end < text.size() ? "...\"" : "\"");
}

}  // namespace icome::stats
