#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace icome::base {

/// Bytes of the UTF-8 character that begins a text, which is not empty; 0 if it begins with none.
inline std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const auto follows = [&](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return follows(1) ? 2 : 0;
  if (first >= 0xE0 && first < 0xF0) {
    const bool overlong = first == 0xE0 && byte(1) < 0xA0;
    const bool surrogate = first == 0xED && byte(1) >= 0xA0;
    return follows(1) && follows(2) && !overlong && !surrogate ? 3 : 0;
  }
  if (first >= 0xF0 && first < 0xF5) {
    const bool overlong = first == 0xF0 && byte(1) < 0x90;
    const bool too_high = first == 0xF4 && byte(1) >= 0x90;
    return follows(1) && follows(2) && follows(3) && !overlong && !too_high ? 4 : 0;
  }
  return 0;
}

/// The text with a question mark for every byte that is not UTF-8, as JSON requires.
inline std::string as_utf8(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length > 0) {
      result += text.substr(0, length);
    } else {
      result += '?';
    }
    text.remove_prefix(length > 0 ? length : 1);
  }
  return result;
}

/// The letters of valid UTF-8 text.
inline std::vector<char32_t> letters_of(std::string_view utf8) {
  std::vector<char32_t> letters;
  for (std::size_t i = 0; i < utf8.size();) {
    const auto first = static_cast<unsigned char>(utf8[i]);
    const std::size_t more = first < 0xC0 ? 0 : first < 0xE0 ? 1 : first < 0xF0 ? 2 : 3;
    char32_t letter = more == 0 ? first : first & (0x3FU >> more);
    for (std::size_t k = 1; k <= more && i + k < utf8.size(); ++k)
      letter = (letter << 6U) | (static_cast<unsigned char>(utf8[i + k]) & 0x3FU);
    letters.push_back(letter);
    i += 1 + more;
  }
  return letters;
}

}  // namespace icome::base
