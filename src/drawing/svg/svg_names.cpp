#include "drawing/svg/svg_names.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstdint>
#include <cstdlib>

#include "base/parse_number.h"

namespace icome::drawing {
namespace {

constexpr int kMmDecimals = 3;             // 1 m = 10^3 mm
constexpr int kMostPlacesBeforePoint = 9;  // and behind it; beyond that with an exponent

/// Digits with a point before the one at `places`, which may lie before or behind all of them.
void append_with_point(std::string& text, std::string_view digits, int places) {
  const auto count = int(digits.size());
  if (places <= 0) {
    text.append("0.").append(std::size_t(-places), '0').append(digits);
  } else if (places >= count) {
    text.append(digits).append(std::size_t(places - count), '0');
  } else {
    text.append(digits.substr(0, std::size_t(places))).append(".");
    text.append(digits.substr(std::size_t(places)));
  }
}

}  // namespace

std::string drawn_mark(std::string_view path_data) {
  std::uint64_t mark = 0xcbf29ce484222325ULL;
  for (const char c : path_data) mark = (mark ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return fmt::format("{:016x}", mark);
}

void append_mm(std::string& text, double metres) {
  std::array<char, 32> room;
  const auto written =
      std::to_chars(room.data(), room.data() + room.size(), metres, std::chars_format::scientific);
  std::string_view number(room.data(), std::size_t(written.ptr - room.data()));
  if (number.starts_with('-')) {
    text += '-';
    number.remove_prefix(1);
  }
  const std::size_t e = number.find('e');
  std::string digits(number.substr(0, 1));
  if (e > 2) digits += number.substr(2, e - 2);
  const int exponent = base::parse_number<int>(number.substr(e + (number[e + 1] == '+' ? 2 : 1))).value_or(0);
  const int places = digits == "0" ? 1 : exponent + kMmDecimals + 1;
  if (std::abs(places) <= kMostPlacesBeforePoint) return append_with_point(text, digits, places);
  append_with_point(text, digits, 1);
  text.append("e").append(std::to_string(places - 1));
}

std::optional<double> metres_from_mm(std::string_view mm) {
  const std::size_t e = mm.find_first_of("eE");
  if (e == std::string_view::npos) return base::parse_finite(std::string(mm).append("e-3"));
  std::string_view power = mm.substr(e + 1);
  if (power.starts_with('+') && !power.starts_with("+-")) power.remove_prefix(1);
  const auto exponent = base::parse_number<int>(power);
  if (!exponent || *exponent < -10000 || *exponent > 10000) return std::nullopt;
  return base::parse_finite(std::string(mm.substr(0, e)) + "e" + std::to_string(*exponent - kMmDecimals));
}

}  // namespace icome::drawing
