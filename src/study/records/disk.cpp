#include "study/records/disk.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

namespace icome::study {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPartEnding = ".part";
constexpr std::uint64_t kLargestFile = 1U << 28U;  // bytes; a session of a whole day has less
constexpr mode_t kForAll = 0666;                   // less the bits of the person's umask

/// Repeats a call that a signal interrupted.
template <typename Call>
auto retry_on_eintr(Call&& call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

tl::unexpected<base::Error> failed(const fs::path& path, const char* what, int why) {
  return base::fail(fmt::format("{}: {} ({}).", path.string(), what, std::strerror(why)));
}

tl::unexpected<base::Error> not_written(const fs::path& path, int why) {
  return base::fail(
      fmt::format("{}: cannot be written ({}), and nothing of it is on record. Make room or bring the disk "
                  "back, and do it again.",
                  path.string(), std::strerror(why)));
}

Descriptor opened(const fs::path& path, int flags) {
  // Opening must not wait for the other end of a pipe.
  return Descriptor(
      retry_on_eintr([&] { return ::open(path.c_str(), flags | O_CLOEXEC | O_NONBLOCK, kForAll); }));
}

/// Writes all bytes at the offset. Returns false, with errno, when not all could be written.
bool write_at(int file, std::uint64_t offset, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t done =
        retry_on_eintr([&] { return ::pwrite(file, bytes.data(), bytes.size(), off_t(offset)); });
    if (done < 0) return false;
    offset += std::uint64_t(done);
    bytes.remove_prefix(std::size_t(done));
  }
  return true;
}

bool sync_file(int file) {
  return retry_on_eintr([&] { return ::fsync(file); }) == 0;
}

}  // namespace

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  Descriptor old(std::exchange(number_, other.release()));
  return *this;
}

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

int Descriptor::release() { return std::exchange(number_, -1); }

base::Result<std::optional<std::string>> read_whole(const fs::path& path) {
  const Descriptor file = opened(path, O_RDONLY);
  if (file.number() < 0 && errno == ENOENT) return std::nullopt;
  struct stat status {};
  if (file.number() < 0 || ::fstat(file.number(), &status) != 0) return failed(path, "cannot be read", errno);
  if (!S_ISREG(status.st_mode)) return base::fail(path.string() + ": is not an ordinary file.");
  if (std::uint64_t(status.st_size) > kLargestFile)
    return base::fail(path.string() + ": is larger than any file of a study that is read here.");
  std::string bytes(std::size_t(status.st_size), '\0');
  std::size_t have = 0;
  while (have < bytes.size()) {
    const ssize_t done = retry_on_eintr(
        [&] { return ::pread(file.number(), &bytes[have], bytes.size() - have, off_t(have)); });
    if (done < 0) return failed(path, "cannot be read", errno);
    if (done == 0) break;  // it became shorter meanwhile
    have += std::size_t(done);
  }
  bytes.resize(have);
  return bytes;
}

fs::path part_of(const fs::path& path) {
  return path.parent_path() / fmt::format(".{}{}", path.filename().string(), kPartEnding);
}

bool is_part(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.starts_with('.') && name.ends_with(kPartEnding);
}

base::Result<void> write_whole(const fs::path& path, std::string_view bytes) {
  const fs::path part = part_of(path);
  const Descriptor file = opened(part, O_WRONLY | O_CREAT | O_TRUNC);
  if (file.number() < 0) return not_written(path, errno);
  const bool there = write_at(file.number(), 0, bytes) && sync_file(file.number()) &&
                     ::rename(part.c_str(), path.c_str()) == 0;
  if (there) return {};
  const int why = errno;
  ::unlink(part.c_str());
  return not_written(path, why);
}

base::Result<void> write_missing(const fs::path& path, std::string_view bytes) {
  std::error_code error;
  return fs::exists(path, error) ? base::Result<void>() : write_whole(path, bytes);
}

base::Result<void> sync_folder(const fs::path& folder) {
  const Descriptor file = opened(folder, O_RDONLY | O_DIRECTORY);
  if (file.number() < 0 || !sync_file(file.number())) return not_written(folder, errno);
  return {};
}

base::Result<void> make_folder(const fs::path& folder) {
  if (folder.empty()) return base::fail("give the folder a name.");
  std::error_code error;
  std::vector<fs::path> missing;
  for (fs::path it = fs::absolute(folder); !fs::exists(it, error); it = it.parent_path())
    if (it.has_filename()) missing.push_back(it);  // else the slash at its end
  for (; !missing.empty(); missing.pop_back()) {
    if (::mkdir(missing.back().c_str(), kForAll | 0111) != 0 && errno != EEXIST)
      return failed(missing.back(), "this folder cannot be made", errno);
    if (auto synced = sync_folder(missing.back().parent_path()); !synced) return synced;
  }
  if (fs::is_directory(folder, error)) return {};
  return base::fail(folder.string() + ": is a file, not a folder; give another name.");
}

base::Result<FileLock> FileLock::take(const fs::path& path) {
  Descriptor file = opened(path, O_RDWR | O_CREAT);
  if (file.number() < 0 || retry_on_eintr([&] { return ::flock(file.number(), LOCK_EX); }) != 0)
    return failed(path, "cannot be locked against other programs", errno);
  return FileLock(std::move(file));
}

base::Result<std::optional<FileLock>> FileLock::try_take(const fs::path& path) {
  Descriptor file = opened(path, O_RDWR | O_CREAT);
  const bool held =
      file.number() >= 0 && retry_on_eintr([&] { return ::flock(file.number(), LOCK_EX | LOCK_NB); }) == 0;
  if (held) return FileLock(std::move(file));
  if (file.number() >= 0 && errno == EWOULDBLOCK) return std::nullopt;
  return failed(path, "cannot be locked against other programs", errno);
}

AppendFile::AppendFile(fs::path path, Descriptor file, std::uint64_t size)
    : path_(std::move(path)), file_(std::move(file)), size_(size) {}

base::Result<AppendFile> AppendFile::open(const fs::path& path, std::uint64_t size) {
  AppendFile file(path, opened(path, O_RDWR), size);
  struct stat status {};
  if (file.file_.number() < 0 || ::fstat(file.file_.number(), &status) != 0)
    return failed(path, "cannot be opened to add to it", errno);
  if (!S_ISREG(status.st_mode)) return base::fail(path.string() + ": is not an ordinary file.");
  file.longer_ = std::uint64_t(status.st_size) > size;
  if (!file.cut_to_size()) return not_written(path, errno);
  return file;
}

bool AppendFile::cut_to_size() {
  if (!longer_) return true;
  if (retry_on_eintr([&] { return ::ftruncate(file_.number(), off_t(size_)); }) != 0) return false;
  longer_ = false;
  return sync_file(file_.number());
}

/// Checks that the path still names this file; otherwise rows would go where nobody finds them.
base::Result<void> AppendFile::look_that_it_is_there() const {
  struct stat mine {
  }, there{};
  const bool same = ::fstat(file_.number(), &mine) == 0 && ::stat(path_.c_str(), &there) == 0 &&
                    mine.st_dev == there.st_dev && mine.st_ino == there.st_ino;
  if (same) return {};
  return base::fail(fmt::format(
      "{}: was taken away or replaced while it is in use; put it back and do it again.", path_.string()));
}

base::Result<void> AppendFile::append(std::string_view row) {
  if (auto there = look_that_it_is_there(); !there) return there;
  if (!cut_to_size()) return not_written(path_, errno);
  if (write_at(file_.number(), size_, row) && sync_file(file_.number())) {
    size_ += row.size();
    return {};
  }
  const int why = errno;
  longer_ = true;
  cut_to_size();
  return not_written(path_, why);
}

}  // namespace icome::study
