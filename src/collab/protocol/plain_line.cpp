#include "collab/protocol/plain_line.h"

#include "base/utf8.h"

namespace icome::collab {

std::string plain_line(std::string_view text, std::size_t most_bytes) {
  std::string line;
  for (std::string valid = base::as_utf8(text), rest = valid; !rest.empty();) {
    const std::size_t length = base::utf8_length(rest);
    if (line.size() + length > most_bytes) break;
    const auto first = static_cast<unsigned char>(rest.front());
    const bool is_control =
        first < 0x20 || first == 0x7F || (first == 0xC2 && static_cast<unsigned char>(rest[1]) < 0xA0);
    line += is_control ? " " : rest.substr(0, length);
    rest.erase(0, length);
  }
  return line;
}

}  // namespace icome::collab
