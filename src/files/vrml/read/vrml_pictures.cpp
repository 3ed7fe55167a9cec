#include "files/vrml/read/vrml_pictures.h"

#include <fmt/format.h>

#include <functional>

namespace icome::files {
namespace {

constexpr std::size_t kMostUrls = 20;  // tried for a picture

}  // namespace

std::optional<world::Texture> VrmlPictures::from_file(const std::string& base,
                                                      const std::vector<std::string>& urls) {
  std::string why = "its url is empty";
  for (std::size_t i = 0; i < urls.size() && i < kMostUrls; ++i) {
    const auto bytes = fetch(base, urls[i]);
    if (bytes) return world::Texture{urls[i], std::string(picture_type(**bytes)), *bytes};
    why = bytes.error().message;
  }
  findings_.tell(fmt::format("The picture {} is left out: {}.",
                             urls.empty() ? "of an ImageTexture" : quoted_name(urls.front()), why));
  return std::nullopt;
}

std::optional<world::Texture> VrmlPictures::from_pixels(const PixelPicture& picture) {
  auto png = png_of(picture);
  auto bytes = png ? keep(std::move(*png)) : base::Result<Bytes>(tl::unexpected(png.error()));
  if (bytes) return world::Texture{"PixelTexture", "image/png", *bytes};
  // VRML expresses that there is no picture by one without pixels.
  if (picture.width != 0 && picture.height != 0)
    findings_.tell(fmt::format("A PixelTexture is left out: {}.", bytes.error().message));
  return std::nullopt;
}

base::Result<VrmlPictures::Bytes> VrmlPictures::fetch(const std::string& base, const std::string& url) {
  const auto [place, fresh] = known_.try_emplace({base, url}, Bytes());
  if (!fresh) return place->second;
  auto content = fetch_(base, url, left_);
  if (content && picture_type(*content).empty()) content = base::fail("it is not a PNG, JPEG or GIF picture");
  place->second = content ? keep(std::move(*content)) : base::Result<Bytes>(tl::unexpected(content.error()));
  return place->second;
}

base::Result<VrmlPictures::Bytes> VrmlPictures::keep(std::string bytes) {
  const std::size_t hash = std::hash<std::string>{}(bytes);
  const auto [begin, end] = kept_.equal_range(hash);
  for (auto it = begin; it != end; ++it) {
    if (*it->second == bytes) return it->second;
  }
  if (bytes.size() > left_) return base::fail("the pictures of the file are too large together");
  left_ -= bytes.size();
  return kept_.emplace(hash, std::make_shared<const std::string>(std::move(bytes)))->second;
}

}  // namespace icome::files
