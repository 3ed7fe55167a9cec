#include "collab/protocol/plain_line.h"

#include "base/utf8.h"

namespace icome::collab {

namespace {

/// Is it one of the characters that turn the direction of the text around them, so that a name could change
/// what a program says? U+202A to 202E, U+2066 to 2069.
bool turns_text(std::string_view character) {
  if (character.size() != 3 || character.substr(0, 2) != "\xE2\x80") {
    return character.size() == 3 && character.substr(0, 2) == "\xE2\x81" && character[2] >= '\xA6' &&
           character[2] <= '\xA9';
  }
  return character[2] >= '\xAA' && character[2] <= '\xAE';
}

}  // namespace

std::string plain_line(std::string_view text, std::size_t most_bytes) {
  std::string line;
  for (std::string valid = base::as_utf8(text), rest = valid; !rest.empty();) {
    const std::size_t length = base::utf8_length(rest);
    if (line.size() + length > most_bytes) break;
    const auto first = static_cast<unsigned char>(rest.front());
    const bool is_control =
        first < 0x20 || first == 0x7F || (first == 0xC2 && static_cast<unsigned char>(rest[1]) < 0xA0);
    line += is_control || turns_text(std::string_view(rest).substr(0, length)) ? " " : rest.substr(0, length);
    rest.erase(0, length);
  }
  return line;
}

}  // namespace icome::collab
