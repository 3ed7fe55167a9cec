#include "collab/storage/private_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>

#include "io/open_file.h"

namespace icome::collab {
namespace {

constexpr mode_t kOwnerOnly = 0600;

tl::unexpected<base::Error> cannot_make(const std::filesystem::path& path) {
  return base::fail(fmt::format("{}: cannot be made ({}).", path.string(), std::strerror(errno)));
}

/// Writes a new file at `path` to the disk.
base::Result<void> write_private(const std::filesystem::path& path, std::string_view bytes) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kOwnerOnly);
  if (descriptor < 0) return cannot_make(path);
  const auto file = io::OpenFile::copy_of(descriptor, path);
  ::close(descriptor);
  if (!file) return tl::unexpected(file.error());
  if (const auto written = file->write(0, bytes); !written) return written;
  return file->sync();
}

}  // namespace

base::Result<bool> make_private_file(const std::filesystem::path& path, std::string_view bytes) {
  std::error_code error;
  if (std::filesystem::exists(path, error)) return false;
  static std::atomic<unsigned> given = 0;
  // A name that io::NewFile knows, and removes when this process was killed before it could.
  std::filesystem::path beside = path;
  beside += fmt::format(".part-{}-{}", ::getpid(), ++given);
  const auto written = write_private(beside, bytes);
  // Unlike renaming, a link never takes the place of what is there.
  const bool linked = written && ::link(beside.c_str(), path.c_str()) == 0;
  const int why = errno;
  std::filesystem::remove(beside, error);
  if (!written) return tl::unexpected(written.error());
  errno = why;
  if (!linked && why != EEXIST) return cannot_make(path);
  io::sync_folder_of(path);
  return linked;
}

base::Result<void> demand_private(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    return base::fail(fmt::format("{}: cannot be read ({}).", path.string(), std::strerror(errno)));
  if ((status.st_mode & 077U) == 0) return {};
  return base::fail(
      fmt::format("{0}: others may read this secret, so it is none any more. Remove it, or, if nobody has "
                  "read it, take away their right: chmod 600 {0}",
                  path.string()));
}

}  // namespace icome::collab
