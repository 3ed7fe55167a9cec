#include "io/text_scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/parse_number.h"

namespace icome::io {
namespace {

constexpr std::size_t kLongestQuote = 24;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool is_line_end(char c) { return c == '\n' || c == '\r'; }
bool is_space(char c) { return is_blank(c) || is_line_end(c); }

}  // namespace

TextScanner::TextScanner(std::string_view text, std::string name, Lines lines, char comment,
                         TimeBudget* time_budget)
    : text_(text),
      name_(std::move(name)),
      lines_(lines),
      comment_(comment),
      at_(text.data()),
      end_(text.data() + text.size()),
      word_begin_(at_),
      watch_(text, time_budget) {}

void TextScanner::ask_whether_to_go_on() {
  if (watch_.lasts(at_) || failed()) return;
  error_ = interruption();
  at_ = end_;
}

void TextScanner::skip_blanks() {
  for (; at_ < end_; ++at_) {
    if (is_blank(*at_)) continue;
    if (*at_ != '\\' || lines_ != Lines::Continue) return;
    const char* next = at_ + 1;
    if (next < end_ && *next == '\r') ++next;
    if (next == end_ || *next != '\n') return;
    at_ = next;
  }
}

bool TextScanner::more_on_line() {
  skip_blanks();
  return at_ < end_ && !is_line_end(*at_) && !(comment_ != '\0' && *at_ == comment_);
}

void TextScanner::skip_line() {
  ask_whether_to_go_on();
  while (at_ < end_ && !is_line_end(*at_)) {
    if (*at_ == '\\' && lines_ == Lines::Continue) {
      const char* before = at_;
      skip_blanks();
      if (at_ != before) continue;
    }
    ++at_;
  }
  if (at_ < end_) ++at_;
}

bool TextScanner::at_end() {
  while (!more_on_line()) {
    if (at_ == end_) return true;
    skip_line();
  }
  return false;
}

std::string_view TextScanner::word() {
  ask_whether_to_go_on();
  const bool found = lines_ == Lines::AreSpace ? !at_end() : more_on_line();
  word_begin_ = at_;
  if (!found) return {};
  while (at_ < end_ && !is_space(*at_)) ++at_;
  return {word_begin_, static_cast<std::size_t>(at_ - word_begin_)};
}

std::string_view TextScanner::rest() {
  word_begin_ = at_;
  if (!more_on_line()) return {};
  word_begin_ = at_;
  const char* last = at_;  // behind the last letter
  for (; at_ < end_ && !is_line_end(*at_); ++at_) {
    if (comment_ != '\0' && *at_ == comment_ && is_blank(at_[-1])) break;
    if (!is_blank(*at_)) last = at_ + 1;
  }
  return {word_begin_, static_cast<std::size_t>(last - word_begin_)};
}

double TextScanner::number(const char* what) {
  const std::string_view text = word();
  const auto read = base::number_at_front<double>(text);
  if (read.good() && read.rest.empty()) return read.value;
  if (read.is_all())
    fail(quoted(text) + " is out of range");
  else
    fail_word(text, what);
  return 0.0;
}

std::int64_t TextScanner::integer(const char* what) {
  const std::string_view text = word();
  if (const auto value = base::parse_number<std::int64_t>(text)) return *value;
  fail_word(text, what);
  return 0;
}

void TextScanner::fail_word(std::string_view word, const char* what) {
  if (!word.empty())
    fail(quoted(word) + " is not " + what);
  else if (at_ == end_)
    fail(fmt::format("the file ends where {} is expected: it may be cut short", what));
  else
    fail(fmt::format("the line ends where {} is expected", what));
}

int TextScanner::line() const { return 1 + int(std::count(text_.data(), word_begin_, '\n')); }

void TextScanner::fail(const std::string& message) {
  if (failed()) return;
  error_.message = fmt::format("{}:{}: {}", name_, line(), message);
  at_ = end_;
}

std::string quoted(std::string_view word) {
  std::string text = "'";
  for (const char c : word.substr(0, kLongestQuote)) text += c > ' ' && c <= '~' ? c : '?';
  if (word.size() > kLongestQuote) text += "...";
  return text + "'";
}

bool same_word(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::ranges::equal(a, b, {}, lower, lower);
}

}  // namespace icome::io
