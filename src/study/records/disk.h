#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"

namespace icome::study {

/// A file that the system has opened for us. Owns it; without one it is negative.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor();
  int number() const { return number_; }

 private:
  int release();
  int number_;
};

/// The bytes of a file; none where there is no such file. Fails when it is no ordinary file, larger than any
/// that a study has, or cannot be read.
base::Result<std::optional<std::string>> read_whole(const std::filesystem::path& path);

/// What a file is called while it is written.
std::filesystem::path part_of(const std::filesystem::path& path);
bool is_part(const std::filesystem::path& path);

/// Puts a file there with all of its bytes, in place of the one that was, or changes nothing. The bytes are
/// on the disk itself; that the file is there, only after sync_folder().
base::Result<void> write_whole(const std::filesystem::path& path, std::string_view bytes);

/// The same where there is no such file.
base::Result<void> write_missing(const std::filesystem::path& path, std::string_view bytes);

/// What came to a folder or went from it, on the disk itself.
base::Result<void> sync_folder(const std::filesystem::path& folder);

/// Makes a folder and those that it lies in, where there is none, on the disk itself.
base::Result<void> make_folder(const std::filesystem::path& folder);

/// Holds a file against other programs and other holders in this one, until it ends.
class FileLock {
 public:
  /// Waits until it is free; makes the file where there is none.
  static base::Result<FileLock> take(const std::filesystem::path& path);
  /// None: another holds it.
  static base::Result<std::optional<FileLock>> try_take(const std::filesystem::path& path);

 private:
  explicit FileLock(Descriptor file) : file_(std::move(file)) {}
  Descriptor file_;
};

/// A file that grows by rows.
class AppendFile {
 public:
  /// Of a file that is there, up to `size`; what lies after it (a row that was cut off) is taken away.
  static base::Result<AppendFile> open(const std::filesystem::path& path, std::uint64_t size);

  /// Adds a row, which is on the disk itself then. When that fails, the file is as it was before.
  base::Result<void> append(std::string_view row);

 private:
  AppendFile(std::filesystem::path path, Descriptor file, std::uint64_t size);
  base::Result<void> look_that_it_is_there() const;
  bool cut_to_size();

  std::filesystem::path path_;
  Descriptor file_;
  std::uint64_t size_;   // of what is on record
  bool longer_ = false;  // what failed could not be taken away yet
};

}  // namespace icome::study
