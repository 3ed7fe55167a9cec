#include "io/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace icome::io {
namespace {

constexpr std::size_t kLargestCell = 1U << 20U;  // bytes
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view kBlanks = " \t";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::size_t count_line_ends(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < text.size(); ++i)
    count += text[i] == '\n' || (text[i] == '\r' && !text.substr(i + 1).starts_with('\n')) ? 1U : 0U;
  return count;
}

/// Single quotes for doubled ones.
std::string with_single_quotes(std::string_view cell) {
  std::string text;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    text += cell[i];
    if (cell[i] == '"') ++i;
  }
  return text;
}

}  // namespace

TableReader::TableReader(std::string_view text, std::string source, char separator, TableStyle style)
    : text_(text), source_(std::move(source)), separator_(separator), style_(style) {
  if (style_ == TableStyle::Quoted && text_.starts_with(kByteOrderMark)) at_ = kByteOrderMark.size();
}

base::Result<bool> TableReader::next() {
  cells_.clear();
  unescaped_.clear();
  first_is_quoted_ = false;
  line_ = next_line_;
  if (at_ >= text_.size()) return false;
  for (bool more = true; more; more = take_separator()) {
    const std::size_t line = next_line_;
    if (const char* const wrong = read_cell(); wrong != nullptr)
      return base::fail(fmt::format("{}:{}: column {}: {}.", source_, line, cells_.size() + 1, wrong));
  }
  return true;
}

/// Reads a cell. Returns what is wrong with it, or null.
const char* TableReader::read_cell() {
  if (style_ == TableStyle::Plain) return read_unquoted();
  const std::size_t begin = text_.find_first_not_of(separator_ == '\t' ? " " : " \t", at_);
  const bool quoted = begin != std::string_view::npos && text_[begin] == '"';
  return quoted ? read_quoted(begin + 1) : read_unquoted();
}

const char* TableReader::read_unquoted() {
  const std::size_t begin = at_;
  while (at_ < text_.size() && text_[at_] != separator_ && !ends_line(text_[at_])) ++at_;
  std::string_view cell = text_.substr(begin, at_ - begin);
  if (style_ == TableStyle::Quoted) cell = without_blanks(cell);
  if (style_ == TableStyle::Quoted && cell.size() > kLargestCell)
    return "a cell is larger than 1 MiB; give a table of values";
  cells_.push_back(cell);
  return nullptr;
}

/// Reads a cell whose text begins behind its opening quote.
const char* TableReader::read_quoted(std::size_t begin) {
  first_is_quoted_ = first_is_quoted_ || cells_.empty();
  bool has_quotes = false;
  std::size_t quote = text_.find('"', begin);
  while (quote != std::string_view::npos && text_.substr(quote + 1).starts_with('"')) {
    has_quotes = true;
    quote = text_.find('"', quote + 2);
  }
  if (quote == std::string_view::npos) return "a quote is opened and never closed";
  const std::string_view cell = text_.substr(begin, quote - begin);
  if (cell.size() > kLargestCell) return "a quoted cell is larger than 1 MiB; close its quote";
  next_line_ += count_line_ends(cell);
  cells_.push_back(has_quotes ? unescaped_.emplace_back(with_single_quotes(cell)) : cell);
  at_ = std::min(text_.find_first_not_of(' ', quote + 1), text_.size());
  if (at_ < text_.size() && text_[at_] != separator_ && !ends_line(text_[at_])) {
    cells_.pop_back();
    return "text follows a closing quote; write a quote within quotes twice";
  }
  return nullptr;
}

/// Reads the end of a cell: a separator, the end of the line in one of its forms, or the end of the text.
/// Returns whether another cell of the row follows.
bool TableReader::take_separator() {
  has_line_end_ = at_ < text_.size() && text_[at_] != separator_;
  if (at_ >= text_.size()) return false;
  const char end = text_[at_++];
  if (!has_line_end_) return true;
  if (end == '\r' && text_.substr(at_).starts_with('\n')) ++at_;
  ++next_line_;
  return false;
}

char find_separator(std::string_view text) {
  constexpr std::array kAll = {'\t', ';', ','};
  std::array<std::size_t, kAll.size()> counts{};
  bool in_quotes = false, any = false;
  for (const char c : text) {
    if (c == '"') in_quotes = !in_quotes;
    if (in_quotes) continue;
    const bool ends_line = c == '\n' || c == '\r';
    if (ends_line && any) break;
    any = any || !ends_line;
    for (std::size_t i = 0; i < kAll.size(); ++i) counts[i] += c == kAll[i] ? 1U : 0U;
  }
  const auto most = std::ranges::max_element(counts);
  return *most == 0 ? ',' : kAll[static_cast<std::size_t>(most - counts.begin())];
}

std::string_view without_byte_order_mark(std::string_view text) {
  return text.substr(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
}

}  // namespace icome::io
