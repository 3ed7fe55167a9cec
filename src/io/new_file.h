#pragma once
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

#include "base/result.h"

namespace icome::io {

/// A file that appears whole or not at all: written beside its path, and renamed by finish().
class NewFile {
 public:
  /// Opens the file beside `path`. The error names the path and gives the system's message, so that an
  /// impossible path is reported before the work. Half-written files that killed programs left beside `path`
  /// are removed.
  static base::Result<NewFile> create(const std::filesystem::path& path);

  NewFile(NewFile&&) noexcept = default;
  /// Leaves what is at the path as it was unless finish() succeeded.
  ~NewFile();

  /// Appends the bytes; finish() reports a failure.
  void write(std::string_view bytes);
  /// Gives the file its name. Call once.
  base::Result<void> finish();
  const std::filesystem::path& path() const { return path_; }
  /// Descriptor of the file that is being written, for further use: copy it before finish(), which closes it.
  int descriptor() const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  NewFile(std::filesystem::path path, std::filesystem::path beside, std::FILE* file);

  std::filesystem::path path_;
  std::filesystem::path beside_;
  std::unique_ptr<std::FILE, Close> file_;  // null once finished or moved from
  int write_error_ = 0;                     // errno of the first failure
};

/// Is `name` that of a file that is written beside one called `whole`, to be renamed? "a.obj.part-1234" for
/// "a.obj", and "a.obj.part-1234-2" where process 1234 writes several.
bool is_part_of(std::string_view name, std::string_view whole);

}  // namespace icome::io
