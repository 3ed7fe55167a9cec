#pragma once
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/utf8.h"

namespace icome::base {

/// The text as a terminal may be given it, whatever file it came from: a control character, with which a text
/// could move the cursor, write over what stands there or send the terminal commands, is shown as `\u001b`
/// and the like, which JSON reads as that character; so are marks that turn the direction of reading around.
/// Line ends and tabs stay, and a byte that is not UTF-8 becomes a question mark.
inline std::string terminal_text(std::string_view text) {
  const auto code_of = [](std::string_view character) -> std::uint32_t {
    const auto byte = [&](std::size_t i) { return std::uint32_t(static_cast<unsigned char>(character[i])); };
    if (character.size() == 1) return byte(0);
    if (character.size() == 2) return (byte(0) & 0x1FU) << 6U | (byte(1) & 0x3FU);
    if (character.size() == 3) return (byte(0) & 0x0FU) << 12U | (byte(1) & 0x3FU) << 6U | (byte(2) & 0x3FU);
    return 0x10000;  // those are letters and pictures
  };
  const auto is_harmless = [](std::uint32_t code) {
    const bool control = code < 0x20 || (code >= 0x7F && code < 0xA0);
    const bool turns = (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
    return code == '\n' || code == '\t' || !(control || turns);
  };
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(1, length));
    text.remove_prefix(character.size());
    const std::uint32_t code = length > 0 ? code_of(character) : 0;
    if (length == 0) {
      result += '?';
    } else if (is_harmless(code)) {
      result += character;
    } else {
      result += "\\u";
      for (const unsigned shift : {12U, 8U, 4U, 0U}) result += kDigits[code >> shift & 0xFU];
    }
  }
  return result;
}

}  // namespace icome::base
