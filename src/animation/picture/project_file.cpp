#include "animation/picture/project_file.h"

#include <fmt/format.h>

#include "base/shown_text.h"
#include "io/url_policy.h"

namespace icome::animation {

std::string shown_name(const std::string& name) {
  std::string text = base::shown_text(name);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  return text;
}

base::Result<std::filesystem::path> file_of_project(const std::filesystem::path& folder,
                                                    const std::filesystem::path& file,
                                                    const std::string& name, Reach reach) {
  const std::string shown = shown_name(name);
  if (file.empty() || file.native().find('\0') != std::string::npos)
    return base::fail(fmt::format("'{}' is no name of a file", shown));
  std::error_code error;
  const std::filesystem::path found = std::filesystem::weakly_canonical(folder / file, error);
  if (error) return base::fail(fmt::format("{}: {}", shown, error.message()));
  const std::filesystem::path whole = std::filesystem::weakly_canonical(folder, error);
  if (reach == Reach::Folder && (error || !io::is_below(whole, found)))
    return base::fail(
        fmt::format("{}: it lies outside of the animation's folder; put a copy into that", shown));
  if (!std::filesystem::exists(found, error))
    return base::fail(fmt::format("{}: there is no such file", shown));
  return found;
}

}  // namespace icome::animation
