#include "files/picture_type.h"

#include <array>

namespace icome::files {
namespace {

struct Beginning {
  std::string_view bytes;
  const char* type;
};
constexpr std::array<Beginning, 6> kBeginnings{{{"\x89PNG\r\n\x1a\n", "image/png"},
                                                {"\xff\xd8\xff", "image/jpeg"},
                                                {"GIF87a", "image/gif"},
                                                {"GIF89a", "image/gif"},
                                                {"BM", "image/bmp"},
                                                {"II*", "image/tiff"}}};

}  // namespace

std::string picture_media_type(std::string_view bytes) {
  if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return "image/webp";
  for (const Beginning& known : kBeginnings) {
    if (bytes.starts_with(known.bytes)) return known.type;
  }
  return {};
}

}  // namespace icome::files
