#include "study/records/tsv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/near_names.h"
#include "base/parse_number.h"
#include "base/utf8.h"
#include "io/table_reader.h"

namespace icome::study {
namespace {

constexpr std::size_t kMostQuoted = 40;  // bytes of a cell that a message repeats

constexpr std::string_view kMarkColumn = "data";
/// Members of a table's JSON file other than its columns.
constexpr std::array<std::string_view, 3> kOtherMembers = {"Escapes", "Simulated", "MeasurementToolMetadata"};

bool marks_simulated(const Column& column) { return column.name == kMarkColumn && !column.of_study; }

std::string in_quotes(std::string_view text) {
  std::string result = cell_of(base::as_utf8(text.substr(0, kMostQuoted)));
  return fmt::format("'{}{}'", result, text.size() > kMostQuoted ? "..." : "");
}

std::string escaped_byte(char byte) {
  switch (byte) {
    case '\\':
      return "\\\\";
    case '\t':
      return "\\t";
    case '\n':
      return "\\n";
    case '\r':
      return "\\r";
    default:
      return fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
  }
}

bool is_escaped(char byte) {
  return static_cast<unsigned char>(byte) < 0x20 || byte == 0x7f || byte == '\\' || byte == '"';
}

/// Reads an escape behind its backslash. Returns false if there is no such escape.
bool take_escaped(std::string_view& rest, std::string& text) {
  if (rest.empty()) return false;
  const char kind = rest.front();
  rest.remove_prefix(1);
  constexpr std::string_view kKinds = "tnr\\/";
  constexpr std::string_view kMeant = "\t\n\r\\/";
  if (const std::size_t found = kKinds.find(kind); found != kKinds.npos) {
    text += kMeant[found];
    return true;
  }
  if (kind != 'x' || rest.size() < 2) return false;
  const auto value = base::parse_number<unsigned>(rest.substr(0, 2), 16);
  if (!value) return false;
  text += static_cast<char>(*value);
  rest.remove_prefix(2);
  return true;
}

base::Result<TsvRow> parse_row(const std::vector<std::string_view>& cells, std::size_t number,
                               const std::string& source, const Columns& columns) {
  if (cells.size() != columns.size())
    return base::fail(fmt::format("{}:{}: has {} columns, and the table has {}.", source, number,
                                  cells.size(), columns.size()));
  TsvRow row{number, {}};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    auto text = cell_text(cells[i]);
    if (!text)
      return base::fail(fmt::format("{}:{}: {} {}", source, number, columns[i].name, text.error().message));
    row.texts.push_back(std::move(*text));
  }
  if (marks_simulated(columns.back()) && row.texts.back() != kSimulated)
    return base::fail(fmt::format("{}:{}: {} is {}; in simulated data it is always {}.", source, number,
                                  kMarkColumn, in_quotes(row.texts.back()), kSimulated));
  return row;
}

}  // namespace

Columns finished_columns(Columns columns, bool simulated) {
  if (simulated)
    columns.push_back({std::string(kMarkColumn),
                       "Marks data that the program made up; no person gave them.",
                       "",
                       {{std::string(kSimulated), "made up by the program"}}});
  std::set<std::string> names(kOtherMembers.begin(), kOtherMembers.end());
  for (const Column& column : columns)
    if (!column.of_study) names.insert(column.name);
  for (Column& column : columns) {
    if (!column.of_study) continue;
    while (!names.insert(column.name).second) column.name += '_';
  }
  return columns;
}

std::string header_of(const Columns& columns) {
  std::string header;
  for (const Column& column : columns) header.append(header.empty() ? "" : "\t").append(column.name);
  return header + '\n';
}

std::string cell_of(std::string_view text) {
  if (text.empty()) return std::string(kNotAvailable);
  if (text == kNotAvailable) return "n\\/a";
  std::string cell;
  while (!text.empty()) {
    const std::size_t length = base::utf8_length(text);
    if (length == 0 || is_escaped(text.front())) {
      cell += escaped_byte(text.front());
    } else {
      cell += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return cell;
}

base::Result<std::string> cell_text(std::string_view cell) {
  std::string text;
  if (cell == kNotAvailable) return text;
  while (!cell.empty()) {
    const char byte = cell.front();
    cell.remove_prefix(1);
    if (byte == '\\' && !take_escaped(cell, text))
      return base::fail("holds a backslash that stands for nothing.");
    if (byte == '\\') continue;
    if (static_cast<unsigned char>(byte) < 0x20 || byte == 0x7f)
      return base::fail(
          fmt::format("holds the control character {}; was the file saved by another program?", int(byte)));
    text += byte;
  }
  return text;
}

std::string cell_of(double number) {
  return std::isfinite(number) ? fmt::format("{}", number) : std::string(kNotAvailable);
}

std::string row_of(const std::vector<std::string>& cells, bool simulated) {
  std::string row = fmt::format("{}", fmt::join(cells, "\t"));
  if (simulated) row.append("\t").append(kSimulated);
  return row + '\n';
}

base::Result<TsvTable> parse_tsv(std::string_view text, const std::string& source, const Columns& columns) {
  TsvTable table;
  const std::string header = header_of(columns);
  if (text.size() < header.size() && header.starts_with(text)) {
    table.torn = true;
    return table;
  }
  if (!text.starts_with(header))
    return base::fail(fmt::format("{}:1: the header is not '{}'; put back the file as it was written.",
                                  source, header.substr(0, header.size() - 1)));
  io::TableReader reader(text, source, '\t', io::TableStyle::Plain);
  // Plain cells cannot be wrong, so that every next() succeeds.
  for (auto more = reader.next(); *more && reader.has_line_end(); more = reader.next()) {
    table.whole = reader.end();
    if (reader.line() == 1) continue;  // the header
    auto row = parse_row(reader.cells(), reader.line(), source, columns);
    if (!row) return tl::unexpected(row.error());
    table.rows.push_back(std::move(*row));
  }
  table.torn = table.whole < text.size();
  return table;
}

RowReader::RowReader(const TsvRow& row, const Columns& columns, const std::string& source)
    : row_(row), columns_(columns), source_(source) {}

const std::string& RowReader::text() { return row_.texts[next_++]; }

double RowReader::number() {
  const std::string& cell = text();
  const auto value = base::parse_finite(cell);
  if (!value && !cell.empty()) refuse("is no number");
  return value.value_or(std::nan(""));
}

std::size_t RowReader::whole() {
  const auto value = base::parse_number<std::size_t>(text());
  if (!value) refuse("is no whole number");
  return value.value_or(0);
}

std::optional<std::size_t> RowReader::whole_or_none() {
  if (!row_.texts[next_].empty()) return whole();
  ++next_;
  return std::nullopt;
}

std::size_t RowReader::one_of(const std::vector<std::string>& names) {
  const std::size_t found = std::size_t(std::ranges::find(names, text()) - names.begin());
  if (found < names.size()) return found;
  const std::string near = base::suggestion(row_.texts[next_ - 1], names);
  refuse("is none of those it can be" + near);
  return 0;
}

std::size_t RowReader::one_of_or_none(const std::vector<std::string>& names) {
  if (!row_.texts[next_].empty()) return one_of(names);
  ++next_;
  return names.size();
}

void RowReader::refuse(const std::string& sentence) {
  if (!good()) return;
  problem_ = fmt::format("{}:{}: {}: {} {}{}", source_, row_.line, columns_[next_ - 1].name,
                         in_quotes(row_.texts[next_ - 1]), sentence, sentence.ends_with('?') ? "" : ".");
}

base::Result<void> RowReader::result() const {
  if (good()) return {};
  return base::fail(problem_);
}

}  // namespace icome::study
