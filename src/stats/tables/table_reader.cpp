#include "stats/tables/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_map>

#include "base/parse_number.h"
#include "base/utf8.h"

namespace icome::stats {
namespace {

constexpr std::size_t kLargestCell = 1U << 20U;     // bytes
constexpr std::size_t kLargestTable = 0xffff'ffff;  // bytes
constexpr std::string_view kRowNames = "row";

/// Reads the text cell by cell.
class CellScanner {
 public:
  enum class After { Cell, Row, Error };

  CellScanner(std::string_view text, char separator) : text_(text), separator_(separator) {}

  bool at_end() const { return at_ >= text_.size(); }
  /// The line of the cell that next() reads or has read.
  std::size_t line() const { return line_; }
  std::string_view cell() const { return cell_; }
  /// Did the cell stand between quotes?
  bool quoted() const { return quoted_; }
  const std::string& error() const { return error_; }

  /// Reads a cell. Returns whether another cell or the row's end follows it, or an error.
  After next() {
    line_ = next_line_;
    quoted_ = false;
    const std::size_t begin = text_.find_first_not_of(separator_ == '\t' ? " " : " \t", at_);
    if (begin != std::string_view::npos && text_[begin] == '"') {
      at_ = begin + 1;
      return quoted_cell();
    }
    return plain_cell();
  }

 private:
  static bool ends_row(char c) { return c == '\n' || c == '\r'; }

  After fail(std::string what) {
    error_ = std::move(what);
    return After::Error;
  }

  /// Reads the end of the cell: the separator, the row's end in one of its three forms, or the text's end.
  After take_end() {
    if (at_ >= text_.size()) return After::Row;
    const char end = text_[at_++];
    if (end == separator_) return After::Cell;
    if (end == '\r' && at_ < text_.size() && text_[at_] == '\n') ++at_;
    ++next_line_;
    return After::Row;
  }

  After plain_cell() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && text_[at_] != separator_ && !ends_row(text_[at_])) ++at_;
    cell_ = text_.substr(begin, at_ - begin);
    const std::size_t first = cell_.find_first_not_of(" \t");
    cell_ = first == std::string_view::npos ? std::string_view{}
                                            : cell_.substr(first, cell_.find_last_not_of(" \t") - first + 1);
    if (cell_.size() > kLargestCell) return fail("a cell is larger than 1 MiB; give a table of values");
    return take_end();
  }

  /// Reads a quoted cell from behind its opening quote.
  After quoted_cell() {
    quoted_ = true;
    unquoted_.clear();
    for (;;) {
      const std::size_t quote = text_.find('"', at_);
      const std::size_t length = std::min(quote, text_.size()) - at_;
      if (unquoted_.size() + length > kLargestCell || quote == std::string_view::npos)
        return fail(unclosed());
      take_quoted(length);
      at_ = quote + 1;
      if (at_ >= text_.size() || text_[at_] != '"') break;
      unquoted_ += '"';
      ++at_;
    }
    cell_ = unquoted_;
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    if (at_ < text_.size() && text_[at_] != separator_ && !ends_row(text_[at_]))
      return fail("text follows a closing quote; write a quote within quotes twice");
    return take_end();
  }

  std::string unclosed() const {
    return text_.find('"', at_) == std::string_view::npos
               ? std::string("a quote is opened and never closed")
               : std::string("a quoted cell is larger than 1 MiB; close its quote");
  }

  void take_quoted(std::size_t length) {
    const std::string_view piece = text_.substr(at_, length);
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const bool line_ends = piece[i] == '\n' || (piece[i] == '\r' && !piece.substr(i + 1).starts_with('\n'));
      next_line_ += line_ends ? 1U : 0U;
    }
    unquoted_ += piece;
  }

  std::string_view text_;
  char separator_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t next_line_ = 1;
  std::string_view cell_;
  bool quoted_ = false;
  std::string unquoted_;
  std::string error_;
};

char character(Separator separator) {
  return separator == Separator::Tab ? '\t' : separator == Separator::Semicolon ? ';' : ',';
}

const char* word_for(Separator separator) {
  return separator == Separator::Tab ? "tab" : separator == Separator::Semicolon ? "semicolon" : "comma";
}

/// The most frequent separator outside quotes in the first line; in a tie the one that is rarer in text.
Separator separator_of(std::string_view text) {
  constexpr std::array kAll = {Separator::Tab, Separator::Semicolon, Separator::Comma};
  std::array<std::size_t, kAll.size()> counts{};
  bool in_quotes = false, any = false;
  for (const char c : text) {
    if (c == '"') in_quotes = !in_quotes;
    if (in_quotes) continue;
    if ((c == '\n' || c == '\r') && any) break;
    any = any || (c != '\n' && c != '\r');
    for (std::size_t i = 0; i < kAll.size(); ++i) counts[i] += c == character(kAll[i]) ? 1U : 0U;
  }
  const auto most = std::ranges::max_element(counts);
  return *most == 0 ? Separator::Comma : kAll[static_cast<std::size_t>(most - counts.begin())];
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
  TableFiller(std::string_view text, const std::string& source, Separator separator)
      : scanner_(text, character(separator)),
        source_(source),
        separator_(separator),
        table_(source, separator == Separator::Semicolon) {}

  base::Result<DataTable> read() {
    if (const auto named = read_headings(); !named) return tl::unexpected(named.error());
    while (!scanner_.at_end())
      if (const auto row = read_row(); !row) return tl::unexpected(row.error());
    if (table_.rows() == 0) return base::fail(fmt::format("{}: there is no row under the heading.", source_));
    return std::move(table_);
  }

 private:
  tl::unexpected<base::Error> fail_here(const std::string& what) const {
    return base::fail(fmt::format("{}:{}: {}.", source_, scanner_.line(), what));
  }

  base::Result<void> read_headings() {
    std::unordered_map<std::string, std::size_t> seen;
    for (bool more = true; more;) {
      const auto after = scanner_.next();
      if (after == CellScanner::After::Error) return fail_here(scanner_.error());
      more = after == CellScanner::After::Cell;
      std::string name(scanner_.cell());
      const std::size_t number = table_.columns().size() + 1;
      const bool blank_line = number == 1 && !more && name.empty() && !scanner_.quoted();
      if (blank_line) {
        more = true;
        continue;
      }
      if (name.empty() && number == 1 && more) name = kRowNames;
      if (name.empty())
        return fail_here(
            fmt::format("column {} has no heading; the first line must name every column", number));
      if (const auto [place, fresh] = seen.try_emplace(name, number); !fresh)
        return fail_here(fmt::format("columns {} and {} are both called {}; name them apart", place->second,
                                     number, stats::quoted_cell(name)));
      table_.add_column(std::move(name));
    }
    return {};
  }

  base::Result<void> read_row() {
    std::vector<Column>& columns = table_.columns();
    std::size_t cells = 0, line = 0;
    for (bool more = true; more; ++cells) {
      const auto after = scanner_.next();
      if (after == CellScanner::After::Error)
        return fail_here(fmt::format("column {}: {}", cells + 1, scanner_.error()));
      if (cells == 0) line = scanner_.line();
      more = after == CellScanner::After::Cell;
      if (cells == 0 && !more && scanner_.cell().empty() && !scanner_.quoted()) return {};  // an empty line
      if (cells < columns.size()) columns[cells].add(scanner_.cell());
    }
    if (cells != columns.size()) return wrong_count(cells, line);
    table_.add_row(line);
    return {};
  }

  base::Result<void> wrong_count(std::size_t cells, std::size_t line) const {
    const std::size_t expected = table_.columns().size();
    return base::fail(fmt::format(
        "{}:{}: the row has {} cell{} where {} column{} {} named; put quotes around a cell that holds a {}.",
        source_, line, cells, cells == 1 ? "" : "s", expected, expected == 1 ? "" : "s",
        expected == 1 ? "is" : "are", word_for(separator_)));
  }

  CellScanner scanner_;
  std::string source_;
  Separator separator_;
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
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  if (const std::string why = not_text(bytes); !why.empty())
    return base::fail(fmt::format("{} {}", source, why));
  if (const std::size_t at = find_not_utf8(bytes); at != std::string_view::npos)
    return base::fail(fmt::format(
        "{}:{}: the byte 0x{:02x} is no UTF-8; save the table as UTF-8 (spreadsheets: \"CSV UTF-8\").",
        source, 1 + std::count(bytes.begin(), bytes.begin() + std::ptrdiff_t(at), '\n'),
        static_cast<unsigned char>(bytes[at])));
  if (separator == Separator::Found) separator = separator_of(bytes);
  return TableFiller(bytes, source, separator).read();
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
