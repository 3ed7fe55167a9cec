#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace icome::files {

/// Identity and last change of the file that a name leads to: two equal stamps mean the same file with the
/// same bytes, as far as the system tells.
struct FileStamp {
  std::uint64_t device = 0, file = 0;  // the system's numbers
  std::uint64_t bytes = 0;
  std::int64_t changed = 0;  // ns since 1970

  bool operator==(const FileStamp&) const = default;
};

/// Nothing unless there is an ordinary file.
std::optional<FileStamp> stamp_of(const std::filesystem::path& path);

/// The loss by writing a design in place of the file at `path`, as a sentence for the person; nothing where
/// that is safe. `seen`: the file as it was when the design was read or written there; nothing: it was not.
/// An `.icome` file that is damaged, or is no journal, is not safe to replace: it may hold more than can be
/// read.
std::optional<std::string> why_not_replace(const std::filesystem::path& path,
                                           const std::optional<FileStamp>& seen);

}  // namespace icome::files
