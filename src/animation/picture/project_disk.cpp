#include "animation/picture/project_disk.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "animation/sound/sound_track.h"
#include "cutout/source/frame_source.h"
#include "io/file_ending.h"

namespace icome::animation {
namespace {

bool is_picture(const std::filesystem::path& file) {
  const io::FileEnding ending = io::ending_of(file);
  constexpr std::array<std::string_view, 5> kPictures = {".png", ".jpg", ".jpeg", ".svg", ".svgz"};
  return !ending.packed && std::ranges::find(kPictures, ending.type) != kPictures.end();
}

base::Result<std::vector<std::string>> pictures_below(const std::filesystem::path& home,
                                                      const std::string& folder) {
  std::error_code error;
  std::vector<std::string> names;
  std::filesystem::directory_iterator entry(home / folder, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    if (is_picture(entry->path()))
      names.push_back((std::filesystem::path(folder) / entry->path().filename()).lexically_normal().string());
    if (names.size() > kMostPictures)
      return base::fail(fmt::format("{}: has more than {} pictures", folder, kMostPictures));
  }
  if (error) return base::fail(fmt::format("{}: {}", folder, error.message()));
  std::ranges::sort(names, cutout::before_by_number);
  return names;
}

}  // namespace

ProjectDisk disk_of(CellPictures& pictures) {
  return {[&pictures](const std::string& file) -> base::Result<Vector2> {
            const auto size = pictures.size(file);
            if (!size) return tl::unexpected(size.error());
            return Vector2(size->width, size->height);
          },
          [&pictures](const std::string& folder) { return pictures_below(pictures.folder(), folder); },
          [&pictures](const Sound& sound) -> base::Result<void> {
            const auto track = read_track(pictures.folder(), sound, 0, pictures.options().reach);
            if (!track) return tl::unexpected(track.error());
            return {};
          }};
}

}  // namespace icome::animation
