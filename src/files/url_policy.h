#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"

namespace icome::files {

/// The file that a url inside `base_file` means, with links resolved. Only urls that count from the file
/// they stand in are followed (`part.wrl`, `../a%20b.png`, `file:part.wrl`): what names a place on the
/// machine or on the network is refused, so that a design shows nothing but what came with it. Fails with a
/// sentence that names the url; also when there is no such regular file.
base::Result<std::filesystem::path> find_beside(const std::filesystem::path& base_file, std::string_view url);

/// The content of that file, if it has no more than `limit` bytes. The caller must see that it is what the
/// url stands for (a picture, VRML) before any of it goes into a design: a url may lead to a file that
/// belongs to someone else, such as `../../../../etc/passwd`.
base::Result<std::string> fetch_beside(const std::filesystem::path& base_file, std::string_view url,
                                       std::uint64_t limit);

/// Where packages put data that anybody may read.
inline constexpr const char* kInstalledData = "/usr/share";

/// As find_beside(), and also what packages have installed: an absolute name (`/usr/share/a/b.obj`,
/// `file:///usr/share/a/b.obj`) of a regular file that lies below `installed` once all links are resolved.
/// Nothing there is anybody's secret. For meshes only; the caller must see that it is one.
base::Result<std::filesystem::path> find_installed_or_beside(const std::filesystem::path& base_file,
                                                             std::string_view url,
                                                             const std::filesystem::path& installed);

/// Does `path` lie in the folder or below it? Both with links resolved.
bool is_below(const std::filesystem::path& folder, const std::filesystem::path& path);

}  // namespace icome::files
