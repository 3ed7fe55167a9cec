#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace icome::io {

/// The reach of a design's urls: beside it and below its folder or, where a person has allowed it, above it,
/// too. Remembers the files found above.
class UrlReach {
 public:
  explicit UrlReach(const std::filesystem::path& design, bool above = false);

  /// Does `path`, with its links resolved, lie in the design's folder or below it?
  bool is_within(const std::filesystem::path& path) const;
  bool may_lead_above() const { return above_; }
  void note(const std::filesystem::path& found);
  /// Sentences about the files found above, which go into saved designs.
  std::vector<std::string> sentences() const;

 private:
  std::array<std::filesystem::path, 2> folders_;  // of the design's name, and of the file where it is a link
  bool above_;
  std::vector<std::filesystem::path> found_above_;
};

/// The file that a url inside `base_file` means, with links resolved. Only urls that count from the file
/// they stand in are followed (`part.wrl`, `parts/a%20b.png`, `file:part.wrl`), and only as far as `reach`
/// goes: a design shows nothing but what came with it. Fails with a sentence that names the url; also when
/// there is no such regular file.
base::Result<std::filesystem::path> find_beside(const std::filesystem::path& base_file, std::string_view url,
                                                UrlReach& reach);

/// The content of that file, if it has no more than `limit` bytes. The caller must see that it is what the
/// url stands for (a picture, VRML) before any of it goes into a design: with a long reach a url may lead to
/// a file that belongs to someone else, such as `../../../../etc/passwd`.
base::Result<std::string> fetch_beside(const std::filesystem::path& base_file, std::string_view url,
                                       std::uint64_t limit, UrlReach& reach);

/// The folder where packages put data that anybody may read.
inline constexpr const char* kInstalledData = "/usr/share";

/// As find_beside(), and also what packages have installed: an absolute name (`/usr/share/a/b.obj`,
/// `file:///usr/share/a/b.obj`) of a regular file that lies below `installed` once all links are resolved.
/// Nothing there is anybody's secret. For meshes only; the caller must see that it is one.
base::Result<std::filesystem::path> find_installed_or_beside(const std::filesystem::path& base_file,
                                                             std::string_view url,
                                                             const std::filesystem::path& installed,
                                                             UrlReach& reach);

/// Does `path` lie in the folder or below it? Both with links resolved.
bool is_below(const std::filesystem::path& folder, const std::filesystem::path& path);

}  // namespace icome::io
