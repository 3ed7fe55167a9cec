#pragma once
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace icome::base {

// Numbers in text, read here alone. Real numbers are decimal with a point, whatever the language of the
// system: 1, -2.5, +.5, 1e-3, and also inf and nan. Whole numbers have no plus sign. Blanks belong to no
// number.

/// The number that a text begins with.
template <typename Number>
struct NumberAtFront {
  enum class Status { Good, NoNumber, OutOfRange };

  Status status = Status::NoNumber;
  Number value{};              ///< 0 unless the status is Good
  std::string_view rest = {};  ///< the text behind the number; the whole text where it begins with none

  bool good() const { return status == Status::Good; }
  /// Is the whole text a number, though perhaps one out of range?
  bool is_all() const { return status != Status::NoNumber && rest.empty(); }
};

/// Reads a number at the front of the text, as far as it goes. Only whole numbers take another `radix`; in 16
/// the digits have no 0x before them.
template <typename Number>
NumberAtFront<Number> number_at_front(std::string_view text, int radix = 10) {
  using Read = NumberAtFront<Number>;
  const char* first = text.data();
  const char* const last = first + text.size();
  Read read;
  std::from_chars_result result{};
  if constexpr (std::is_floating_point_v<Number>) {
    if (text.starts_with('+') && !text.starts_with("+-")) ++first;
    result = std::from_chars(first, last, read.value);
  } else {
    result = std::from_chars(first, last, read.value, radix);
  }
  if (result.ec == std::errc::invalid_argument) {
    read.rest = text;
    return read;
  }
  read.status = result.ec == std::errc{} ? Read::Status::Good : Read::Status::OutOfRange;
  read.rest = {result.ptr, static_cast<std::size_t>(last - result.ptr)};
  return read;
}

/// The whole text as a number; nothing for any other text and for numbers out of range.
template <typename Number>
std::optional<Number> parse_number(std::string_view text, int radix = 10) {
  const auto read = number_at_front<Number>(text, radix);
  return read.good() && read.rest.empty() ? std::optional<Number>(read.value) : std::nullopt;
}

/// As parse_number(), without inf and nan.
inline std::optional<double> parse_finite(std::string_view text) {
  const auto number = parse_number<double>(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

/// Fills `numbers` from a text of exactly so many with a blank between each two. Returns false for any other
/// text.
inline bool parse_numbers(std::string_view text, std::span<double> numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0 && !text.starts_with(' ')) return false;
    if (i > 0) text.remove_prefix(1);
    const auto read = number_at_front<double>(text);
    if (!read.good()) return false;
    numbers[i] = read.value;
    text = read.rest;
  }
  return text.empty();
}

}  // namespace icome::base
