#include "stats/tables/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "base/parse_number.h"
#include "base/utf8.h"
#include "io/table_reader.h"

namespace icome::stats {
namespace {

constexpr std::size_t kLargestTable = 0xffff'ffff;  // bytes
constexpr std::string_view kRowNames = "row";

/// The character between the cells of this text.
char separator_in(std::string_view text, Separator separator) {
  switch (separator) {
    case Separator::Found:
      return io::find_separator(text);
    case Separator::Comma:
      return ',';
    case Separator::Tab:
      return '\t';
    case Separator::Semicolon:
      return ';';
  }
  return ',';
}

const char* word_for(char separator) {
  return separator == '\t' ? "tab" : separator == ';' ? "semicolon" : "comma";
}

/// The reason why these bytes are not a table of text; empty if they may be one.
std::string not_text(std::string_view bytes) {
  if (bytes.size() >= kLargestTable) return "has 4 GiB or more; split it.";
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) return "is UTF-16; save it as UTF-8.";
  if (bytes.find('\0') != std::string_view::npos) return "is no text; give a table as CSV or TSV.";
  if (bytes.find_first_not_of(" \t\r\n") == std::string_view::npos)
    return "is empty; its first line must name the columns.";
  return {};
}

/// The place of the first byte that is not UTF-8; npos if there is none.
std::size_t find_not_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const bool ascii = static_cast<unsigned char>(text[at]) < 0x80;
    const std::size_t length = ascii ? 1 : base::utf8_length(text.substr(at));
    if (length == 0) return at;
    at += length;
  }
  return std::string_view::npos;
}

/// Reads rows into a table; errors are sentences that begin with source and line.
class TableFiller {
 public:
  TableFiller(std::string_view text, const std::string& source, char separator)
      : reader_(text, source, separator),
        source_(source),
        separator_(separator),
        table_(source, separator == ';') {}

  base::Result<DataTable> read() {
    if (const auto named = read_headings(); !named) return tl::unexpected(named.error());
    for (;;) {
      const auto more = reader_.next();
      if (!more) return tl::unexpected(more.error());
      if (!*more) break;
      if (reader_.is_blank()) continue;
      if (const auto added = add_row(); !added) return tl::unexpected(added.error());
    }
    if (table_.rows() == 0) return base::fail(fmt::format("{}: there is no row under the heading.", source_));
    return std::move(table_);
  }

 private:
  tl::unexpected<base::Error> fail_here(const std::string& what) const {
    return base::fail(fmt::format("{}:{}: {}.", source_, reader_.line(), what));
  }

  /// Reads the first row with text, which must be there.
  base::Result<void> read_headings() {
    do {
      if (const auto more = reader_.next(); !more) return tl::unexpected(more.error());
    } while (reader_.is_blank());
    std::unordered_map<std::string_view, std::size_t> seen;  // views into the row
    const std::vector<std::string_view>& cells = reader_.cells();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const bool names_rows = i == 0 && cells.size() > 1 && cells[i].empty();
      const std::string_view name = names_rows ? kRowNames : cells[i];
      if (name.empty())
        return fail_here(
            fmt::format("column {} has no heading; the first line must name every column", i + 1));
      if (const auto [place, fresh] = seen.try_emplace(name, i); !fresh)
        return fail_here(fmt::format("columns {} and {} are both called {}; name them apart",
                                     place->second + 1, i + 1, quoted_cell(name)));
      table_.add_column(std::string(name));
    }
    return {};
  }

  base::Result<void> add_row() {
    const std::vector<std::string_view>& cells = reader_.cells();
    std::vector<Column>& columns = table_.columns();
    if (cells.size() != columns.size()) return wrong_count();
    for (std::size_t i = 0; i < cells.size(); ++i) columns[i].add(cells[i]);
    table_.add_row(reader_.line());
    return {};
  }

  base::Result<void> wrong_count() const {
    const std::size_t cells = reader_.cells().size();
    const std::size_t expected = table_.columns().size();
    return fail_here(fmt::format(
        "the row has {} cell{} where {} column{} {} named; put quotes around a cell that holds a {}", cells,
        cells == 1 ? "" : "s", expected, expected == 1 ? "" : "s", expected == 1 ? "is" : "are",
        word_for(separator_)));
  }

  io::TableReader reader_;
  std::string source_;
  char separator_;
  DataTable table_;
};

// ------------------------------------------------------------ NIST

constexpr std::string_view kNistBegin = "NIST/ITL StRD";

/// Removes the first line from the text and returns it without its line end.
std::string_view take_line(std::string_view& text) {
  const std::size_t length = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, length);
  text.remove_prefix(std::min(length + 1, text.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (;;) {
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return words;
    line.remove_prefix(begin);
    const std::size_t length = std::min(line.find_first_of(" \t"), line.size());
    words.push_back(line.substr(0, length));
    line.remove_prefix(length);
  }
}

/// The lines of the data, counted from 1.
struct LineRange {
  std::size_t first = 0, last = 0;
};

/// The lines of the data, read from "Data (lines 61 to 85)"; nothing for any other line.
std::optional<LineRange> data_lines(std::string_view line) {
  const std::vector<std::string_view> words = words_of(line);
  if (words.size() != 5 || words[0] != "Data" || words[1] != "(lines" || words[3] != "to")
    return std::nullopt;
  LineRange range;
  range.first = base::number_at_front<std::size_t>(words[2]).value;
  range.last = base::number_at_front<std::size_t>(words[4]).value;
  if (range.first < 2 || range.last < range.first) return std::nullopt;
  return range;
}

std::vector<std::string_view> nist_headings(std::string_view line) {
  if (line.starts_with("Data:")) line.remove_prefix(5);
  return words_of(line);
}

}  // namespace

base::Result<DataTable> read_table(std::string_view bytes, const std::string& source, Separator separator) {
  bytes = io::without_byte_order_mark(bytes);
  if (const std::string why = not_text(bytes); !why.empty())
    return base::fail(fmt::format("{} {}", source, why));
  if (const std::size_t at = find_not_utf8(bytes); at != std::string_view::npos)
    return base::fail(fmt::format(
        "{}:{}: the byte 0x{:02x} is no UTF-8; save the table as UTF-8 (spreadsheets: \"CSV UTF-8\").",
        source, 1 + std::count(bytes.begin(), bytes.begin() + std::ptrdiff_t(at), '\n'),
        static_cast<unsigned char>(bytes[at])));
  return TableFiller(bytes, source, separator_in(bytes, separator)).read();
}

bool is_nist_layout(std::string_view bytes) { return bytes.starts_with(kNistBegin); }

base::Result<DataTable> read_nist_table(std::string_view bytes, const std::string& source) {
  const auto fail_at = [&](std::size_t line, const std::string& what) {
    return base::fail(fmt::format("{}:{}: {}.", source, line, what));
  };
  if (bytes.size() >= kLargestTable) return base::fail(fmt::format("{} {}", source, not_text(bytes)));
  DataTable table(source, false);
  std::optional<LineRange> range;
  std::size_t number = 1;
  for (; !bytes.empty() && (!range || number <= range->last); ++number) {
    const std::string_view line = take_line(bytes);
    if (!range) {
      range = data_lines(line);
      if (range && range->first <= number + 1)
        return fail_at(number, "the data cannot begin before this line");
      continue;
    }
    if (number == range->first - 1)
      for (const std::string_view heading : nist_headings(line)) table.add_column(std::string(heading));
    if (number < range->first) continue;
    const std::vector<std::string_view> words = words_of(line);
    if (words.size() != table.columns().size())
      return fail_at(number, fmt::format("the row has {} values where {} columns are named", words.size(),
                                         table.columns().size()));
    for (std::size_t i = 0; i < words.size(); ++i) table.columns()[i].add(words[i]);
    table.add_row(number);
  }
  if (!range) return base::fail(fmt::format("{}: its head has no line \"Data (lines A to B)\".", source));
  if (table.columns().empty() || number <= range->last)
    return fail_at(number, fmt::format("the file ends before line {}, the last of its data", range->last));
  return table;
}

base::Result<DataTable> read_any_table(std::string_view bytes, const std::string& source) {
  if (is_nist_layout(bytes)) return read_nist_table(bytes, source);
  const bool tabs = source.ends_with(".tsv") || source.ends_with(".tab");
  return read_table(bytes, source, tabs ? Separator::Tab : Separator::Found);
}

}  // namespace icome::stats
