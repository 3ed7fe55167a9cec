#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/result.h"
#include "io/open_file.h"

namespace icome::study {

/// The bytes of a file; none where there is no such file. Fails when it is not an ordinary file, larger than
/// any file of a study, or cannot be read.
base::Result<std::optional<std::string>> read_whole(const std::filesystem::path& path);

/// Is this a file that was being written when its program ended?
bool is_part(const std::filesystem::path& path);

/// Writes a whole file in place of the one that was there, or changes nothing. The bytes are on the disk
/// itself; that the file's name is, too, only sync_folder() tells.
base::Result<void> write_whole(const std::filesystem::path& path, std::string_view bytes);

/// Writes a whole file if there is no such file.
base::Result<void> write_missing(const std::filesystem::path& path, std::string_view bytes);

/// Brings the files that were added to a folder or removed from it to the disk itself.
base::Result<void> sync_folder(const std::filesystem::path& folder);

/// Makes a folder and its parents, where there are none, on the disk itself.
base::Result<void> make_folder(const std::filesystem::path& folder);

/// A lock on a file against other programs and other holders in this one, released at its end.
class FileLock {
 public:
  /// Waits until the lock is free; makes the file if there is none.
  static base::Result<FileLock> take(const std::filesystem::path& path);
  /// Returns nothing if another holds the lock.
  static base::Result<std::optional<FileLock>> try_take(const std::filesystem::path& path);

 private:
  explicit FileLock(io::OpenFile file) : file_(std::move(file)) {}
  io::OpenFile file_;
};

/// A file that grows by rows.
class AppendFile {
 public:
  /// Opens an existing file up to `size`; anything after it (a row that was cut off) is removed.
  static base::Result<AppendFile> open(const std::filesystem::path& path, std::uint64_t size);

  /// Adds a row, which is on the disk itself afterwards. On failure, the file is as it was before.
  base::Result<void> append(std::string_view row);

 private:
  AppendFile(io::OpenFile file, std::uint64_t size) : file_(std::move(file)), size_(size) {}
  base::Result<void> cut_to_size();

  io::OpenFile file_;
  std::uint64_t size_;   // bytes on record
  bool longer_ = false;  // bytes of a failed row could not be removed yet
};

}  // namespace icome::study
