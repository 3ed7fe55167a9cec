#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "base/result.h"

namespace icome::animation {

/// A name as errors repeat it: on one line, and not too long.
std::string shown_name(const std::string& name);

/// May names lead out of a project's folder (../hand.png, /home/.../hand.png, links)? If not, a project shows
/// nothing but what came with it.
enum class Reach : std::uint8_t { Folder, Anywhere };

/// The file that a project means by a name, with links resolved. Names count from the project's folder. Fails
/// with a sentence that begins with `name`: it is no name, lies outside of the folder, or is not there.
base::Result<std::filesystem::path> file_of_project(const std::filesystem::path& folder,
                                                    const std::filesystem::path& file,
                                                    const std::string& name, Reach reach);

}  // namespace icome::animation
