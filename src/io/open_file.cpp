#include "io/open_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "io/sync_folder.h"

namespace icome::io {
namespace {

int flags_for(OpenFile::Use use) {
  // Opening must not wait for the other end of a pipe.
  constexpr int kAlways = O_CLOEXEC | O_NONBLOCK;
  switch (use) {
    case OpenFile::Use::Read:
      return kAlways | O_RDONLY;
    case OpenFile::Use::Change:
      return kAlways | O_RDWR;
    case OpenFile::Use::ChangeOrCreate:
      return kAlways | O_RDWR | O_CREAT;
  }
  return kAlways;
}

/// Repeats a call that a signal interrupted.
template <typename Call>
auto retry_on_eintr(Call&& call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

}  // namespace

base::Result<OpenFile> OpenFile::open(const std::filesystem::path& path, Use use) {
  constexpr mode_t kForAll = 0666;  // less what the person's umask takes away
  OpenFile file(path, retry_on_eintr([&] { return ::open(path.c_str(), flags_for(use), kForAll); }));
  if (file.descriptor_ < 0 && errno == EISDIR)
    return base::fail(path.string() + ": is a folder, not a file.");
  if (file.descriptor_ < 0) return file.failed("cannot be opened");
  struct stat status {};
  if (::fstat(file.descriptor_, &status) != 0) return file.failed("cannot be opened");
  if (S_ISDIR(status.st_mode)) return base::fail(path.string() + ": is a folder, not a file.");
  if (!S_ISREG(status.st_mode)) return base::fail(path.string() + ": is not an ordinary file.");
  return file;
}

base::Result<OpenFile> OpenFile::copy_of(int descriptor, const std::filesystem::path& path) {
  OpenFile file(path, ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0));
  if (file.descriptor_ < 0) return file.failed("cannot be opened");
  return file;
}

OpenFile::~OpenFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

tl::unexpected<base::Error> OpenFile::failed(const char* what) const {
  return base::fail(fmt::format("{}: {} ({}).", path_.string(), what, std::strerror(errno)));
}

base::Result<std::uint64_t> OpenFile::size() const {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) return failed("cannot be read");
  return static_cast<std::uint64_t>(status.st_size);
}

bool OpenFile::is_at_its_path() const {
  struct stat mine {
  }, there{};
  return ::fstat(descriptor_, &mine) == 0 && ::stat(path_.c_str(), &there) == 0 &&
         mine.st_dev == there.st_dev && mine.st_ino == there.st_ino;
}

base::Result<bool> OpenFile::lock() const {
  if (retry_on_eintr([&] { return ::flock(descriptor_, LOCK_EX | LOCK_NB); }) == 0) return true;
  if (errno == EWOULDBLOCK) return false;
  return failed("cannot be locked against other programs");
}

base::Result<void> OpenFile::read(std::uint64_t offset, char* bytes, std::size_t count) const {
  while (count > 0) {
    const ssize_t done = retry_on_eintr([&] { return ::pread(descriptor_, bytes, count, off_t(offset)); });
    if (done < 0) return failed("cannot be read");
    if (done == 0) return base::fail(path_.string() + ": became shorter while it was read.");
    bytes += done;
    offset += std::uint64_t(done);
    count -= std::size_t(done);
  }
  return {};
}

base::Result<void> OpenFile::write(std::uint64_t offset, std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t done =
        retry_on_eintr([&] { return ::pwrite(descriptor_, bytes.data(), bytes.size(), off_t(offset)); });
    if (done < 0) return failed("cannot be written");
    offset += std::uint64_t(done);
    bytes.remove_prefix(std::size_t(done));
  }
  return {};
}

base::Result<void> OpenFile::cut_to(std::uint64_t size) const {
  if (retry_on_eintr([&] { return ::ftruncate(descriptor_, off_t(size)); }) != 0)
    return failed("cannot be written");
  return {};
}

base::Result<void> OpenFile::sync() const {
  if (retry_on_eintr([&] { return ::fdatasync(descriptor_); }) != 0) return failed("did not reach the disk");
  return {};
}

base::Result<void> sync_folder(const std::filesystem::path& folder) {
  const int descriptor =
      retry_on_eintr([&] { return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
  const bool synced = descriptor >= 0 && retry_on_eintr([&] { return ::fsync(descriptor); }) == 0;
  const int why = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (synced) return {};
  return base::fail(fmt::format("{}: cannot be written ({}).", folder.string(), std::strerror(why)));
}

void sync_folder_of(const std::filesystem::path& path) {
  (void)sync_folder(path.has_parent_path() ? path.parent_path() : ".");
}

}  // namespace icome::io
