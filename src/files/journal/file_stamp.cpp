#include "files/journal/file_stamp.h"

#include <sys/stat.h>

#include "files/journal/journal.h"
#include "io/file_ending.h"

namespace icome::files {

std::optional<FileStamp> stamp_of(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  return FileStamp{.device = std::uint64_t(status.st_dev),
                   .file = std::uint64_t(status.st_ino),
                   .bytes = std::uint64_t(status.st_size),
                   .changed = std::int64_t(status.st_mtim.tv_sec) * kNanoseconds + status.st_mtim.tv_nsec};
}

std::optional<std::string> why_not_replace(const std::filesystem::path& path,
                                           const std::optional<FileStamp>& seen) {
  const auto now = stamp_of(path);
  if (!now) return std::nullopt;
  if (seen && *seen != *now)
    return path.string() +
           ": another program has changed this file since it was opened here, and that would be lost.";
  if (now->bytes == 0 || io::ending_of(path).type != ".icome") return std::nullopt;
  const auto whole = is_whole_journal(path);
  if (whole && *whole) return std::nullopt;
  return path.string() +
         ": this file is damaged or no design of ICOME: what it still holds beside what could be read would "
         "be lost.";
}

}  // namespace icome::files
