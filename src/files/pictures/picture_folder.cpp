#include "files/pictures/picture_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include "io/file_bytes.h"
#include "io/new_file.h"

namespace icome::files {
namespace {

struct PictureKind {
  std::string_view media_type;
  std::array<std::string_view, 3> endings;  // the usual one first
};
constexpr PictureKind kKinds[] = {{"image/png", {".png", ".PNG", ""}},
                                  {"image/jpeg", {".jpg", ".jpeg", ".JPG"}},
                                  {"image/gif", {".gif", ".GIF", ""}}};

/// Letters, digits and signs that urls and all file systems accept unchanged.
bool is_safe(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
}

std::string safe(std::string_view name, std::string_view fallback) {
  constexpr std::size_t kLongest = 80;
  std::string result(name.substr(0, kLongest));
  std::replace_if(
      result.begin(), result.end(), [](char c) { return !is_safe(c); }, '_');
  return result.empty() ? std::string(fallback) : result;
}

/// "wood" and ".png" of "maps/wood.png": the ending fits the kind of picture.
std::pair<std::string, std::string> safe_name(const world::Texture& texture) {
  std::string_view name = texture.name;
  name.remove_prefix(std::min(name.size(), name.find_last_of("/\\") + 1));
  const std::size_t dot = std::min(name.rfind('.'), name.size());
  const std::string_view ending = name.substr(dot);
  for (const PictureKind& kind : kKinds) {
    if (kind.media_type != texture.media_type) continue;
    const bool fits = std::find(kind.endings.begin(), kind.endings.end(), ending) != kind.endings.end();
    return {safe(fits ? name.substr(0, dot) : name, "picture"),
            std::string(fits && !ending.empty() ? ending : kind.endings[0])};
  }
  return {safe(name.substr(0, dot), "picture"),
          ending.size() < 2 ? "" : fmt::format(".{}", safe(ending.substr(1), ""))};
}

base::Result<void> make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directory(folder, error);
  // Not through a link: it may lead anywhere.
  if (std::filesystem::symlink_status(folder, error).type() == std::filesystem::file_type::directory)
    return {};
  return base::fail(fmt::format("{}: the folder for the design's pictures cannot be made.", folder.string()));
}

base::Result<void> write_whole(const std::filesystem::path& path, std::string_view bytes) {
  auto file = io::NewFile::create(path);
  if (!file) return tl::unexpected(file.error());
  file->write(bytes);
  return file->finish();
}

}  // namespace

PictureFolder::PictureFolder(const std::filesystem::path& design)
    : name_(safe(design.stem().string(), "design") + "_textures") {
  folder_ = design.parent_path() / name_;
}

base::Result<std::string> PictureFolder::add(const world::Texture& texture) {
  if (const auto made = make_folder(folder_); !made) return tl::unexpected(made.error());
  const auto [stem, ending] = safe_name(texture);
  for (int number = 1;; ++number) {
    const std::string name = number == 1 ? stem + ending : fmt::format("{}-{}{}", stem, number, ending);
    const std::filesystem::path path = folder_ / name;
    std::error_code error;
    const bool there = std::filesystem::exists(std::filesystem::symlink_status(path, error));
    if (there) {
      const auto bytes = io::read_bytes(path, texture.bytes->size());
      if (!bytes || *bytes != *texture.bytes) continue;
    } else if (const auto written = write_whole(path, *texture.bytes); !written) {
      return tl::unexpected(written.error());
    }
    return fmt::format("{}/{}", name_, name);
  }
}

}  // namespace icome::files
