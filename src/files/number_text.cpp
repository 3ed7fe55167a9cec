#include "files/number_text.h"

#include <charconv>

namespace icome::files {
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

}  // namespace icome::files
