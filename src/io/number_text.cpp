#include "io/number_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

#include "base/parse_number.h"

namespace icome::io {
namespace {

constexpr std::size_t kLongestNumber = 32;

template <typename Number>
void append_shortest(std::string& text, Number number) {
  char digits[kLongestNumber];
  text.append(digits, std::to_chars(digits, digits + kLongestNumber, number).ptr);
}

}  // namespace

void append_number(std::string& text, double number) { append_shortest(text, number); }
void append_number(std::string& text, float number) { append_shortest(text, number); }
void append_number(std::string& text, std::uint32_t number) { append_shortest(text, number); }

float to_single(double number) {
  constexpr double kMost = std::numeric_limits<float>::max();
  return float(std::clamp(number, -kMost, kMost));
}

double as_written(float number) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), number);
  return base::number_at_front<double>({text.data(), end}).value;
}

}  // namespace icome::io
