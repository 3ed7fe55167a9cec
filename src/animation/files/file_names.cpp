#include "animation/files/file_names.h"

#include <algorithm>
#include <string_view>

namespace icome::animation {
namespace {

constexpr std::ptrdiff_t kMostStepsUp = 3;  // farther away a file is named by its whole path
constexpr std::string_view kInDesign = ".icome#";

}  // namespace

std::string name_from(const std::filesystem::path& folder, const std::filesystem::path& file) {
  const std::filesystem::path whole = std::filesystem::absolute(file).lexically_normal();
  const std::filesystem::path home = std::filesystem::absolute(folder / ".").lexically_normal();
  const std::filesystem::path relative = whole.lexically_relative(home);
  const auto up = std::ranges::count(relative, std::filesystem::path(".."));
  return relative.empty() || up > kMostStepsUp ? whole.string() : relative.generic_string();
}

ProjectEdit renamed_files(const Project& project, const std::filesystem::path& from,
                          const std::filesystem::path& to) {
  const auto renamed = [&](const std::string& name) {
    const std::size_t in_design = name.rfind(kInDesign);
    const std::size_t end = in_design == std::string::npos ? name.size() : in_design + kInDesign.size() - 1;
    return name_from(to, from / name.substr(0, end)) + name.substr(end);
  };
  ProjectEdit edit;
  for (const Layer& layer : project.layers)
    for (const Cell& cell : layer.cells) {
      CellLook look = look_of(cell);
      std::ranges::transform(look.pictures, look.pictures.begin(), renamed);
      if (look.pictures != cell.pictures) edit.push_back(ChangeCell{cell.id, std::move(look)});
    }
  if (std::optional<Sound> sound = project.sound) {
    sound->file = renamed(sound->file);
    if (sound != project.sound) edit.push_back(ChangeSound{sound});
  }
  return edit;
}

}  // namespace icome::animation
