#pragma once
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <utility>

#include "base/result.h"

namespace icome::io {

/// An ordinary file that is open, closed on destruction. Errors name the file and give the system's message.
class OpenFile {
 public:
  enum class Use { Read, Change, ChangeOrCreate };

  /// Fails for missing files (unless they may be created), folders and other special files.
  static base::Result<OpenFile> open(const std::filesystem::path& path, Use use);
  /// Uses a copy of an open descriptor.
  static base::Result<OpenFile> copy_of(int descriptor, const std::filesystem::path& path);

  OpenFile(OpenFile&& other) noexcept
      : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}
  OpenFile& operator=(OpenFile&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~OpenFile();

  const std::filesystem::path& path() const { return path_; }
  base::Result<std::uint64_t> size() const;
  /// Is this what the path leads to, or has another file taken its name?
  bool is_at_its_path() const;

  /// Keeps other programs, and others in this one, from locking the file while it is open. Gives false
  /// where one of them has done so before.
  base::Result<bool> lock() const;

  /// Reads exactly `count` bytes, which must be there.
  base::Result<void> read(std::uint64_t offset, char* bytes, std::size_t count) const;
  /// Writes all bytes; where that fails, some of them may be there.
  base::Result<void> write(std::uint64_t offset, std::string_view bytes) const;
  base::Result<void> cut_to(std::uint64_t size) const;
  /// Forces written data to the disk, where it survives a power failure.
  base::Result<void> sync() const;

 private:
  OpenFile(std::filesystem::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}
  tl::unexpected<base::Error> failed(const char* what) const;

  std::filesystem::path path_;
  int descriptor_ = -1;  // below zero once moved from
};

/// Forces the name of a new file to the disk. Not every file system can, and the file is whole in any
/// case.
void sync_folder_of(const std::filesystem::path& path);

}  // namespace icome::io
