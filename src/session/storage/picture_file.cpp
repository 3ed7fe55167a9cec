#include "session/storage/picture_file.h"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "files/pictures/picture_bytes.h"
#include "io/file_bytes.h"
#include "render/model/picture_decoder.h"

namespace icome::session {

base::Result<world::Texture> read_picture(const std::filesystem::path& file) {
  auto bytes = io::read_bytes(file, kMostPictureBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  // A picture that cannot be drawn is better told now than by an object that stays plain.
  if (const auto drawn = render::decode_picture(*bytes); !drawn)
    return base::fail(fmt::format("{}: {}", file.string(), drawn.error().message));
  const std::string_view type = files::picture_type(*bytes);
  if (type.empty())
    return base::fail(
        fmt::format("{}: the picture begins in an unusual way; save it again as PNG", file.string()));
  return world::Texture{.name = file.filename().string(),
                        .media_type = std::string(type),
                        .bytes = std::make_shared<const std::string>(std::move(*bytes))};
}

}  // namespace icome::session
