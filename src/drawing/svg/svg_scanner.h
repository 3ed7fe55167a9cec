#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "base/parse_number.h"

namespace icome::drawing {

/// Reads the numbers of SVG attributes, which may stand without anything between them: "1.5.5-3e2" is 1.5, .5
/// and -300. Does not own the text. Blanks and commas before anything are skipped.
class SvgScanner {
 public:
  explicit SvgScanner(std::string_view text) : rest_(text) {}

  bool at_end() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n\f,"), rest_.size()));
    return rest_.empty();
  }
  /// The text that was not read yet.
  std::string_view rest() { return at_end() ? std::string_view() : rest_; }

  /// The text that comes next, up to a blank or comma, without moving: for messages.
  std::string_view next_word() {
    const std::string_view begin = rest();
    return begin.substr(0, begin.find_first_of(" \t\r\n\f,"));
  }

  /// The next number; nothing, without moving, where none follows or it is not finite.
  std::optional<double> number() {
    if (at_end()) return std::nullopt;
    const std::size_t first = rest_.find_first_not_of("+-");
    if (first > 1 || std::string_view("0123456789.").find(rest_[first]) == std::string_view::npos)
      return std::nullopt;
    const auto read = base::number_at_front<double>(rest_);
    if (!read.good() || !std::isfinite(read.value)) return std::nullopt;
    rest_ = read.rest;
    return read.value;
  }

  /// The next 0 or 1, which may stand right before a number.
  std::optional<bool> flag() {
    if (at_end() || (rest_.front() != '0' && rest_.front() != '1')) return std::nullopt;
    const bool is_set = rest_.front() == '1';
    rest_.remove_prefix(1);
    return is_set;
  }

  /// The next letter; 0, without moving, for anything else.
  char letter() {
    if (at_end()) return '\0';
    const char c = rest_.front();
    if (!is_letter(c)) return '\0';
    rest_.remove_prefix(1);
    return c;
  }

  /// The letters that follow, as many as there are.
  std::string_view word() {
    at_end();
    const auto end = std::ranges::find_if_not(rest_, is_letter);
    const std::string_view word = rest_.substr(0, std::size_t(end - rest_.begin()));
    rest_.remove_prefix(word.size());
    return word;
  }

  /// Moves past that character if it is next.
  bool take(char c) {
    if (at_end() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }

 private:
  static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

  std::string_view rest_;
};

}  // namespace icome::drawing
