#include "study/records/disk.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <system_error>
#include <thread>
#include <vector>

#include "io/file_bytes.h"
#include "io/new_file.h"
#include "io/sync_folder.h"

namespace icome::study {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargestFile = 1U << 28U;        // bytes; a session of a whole day has less
constexpr std::chrono::milliseconds kLockAskedAgain(2);  // others hold it while they write a row

/// The error of a file or folder that could not be written, with what it means and what to do.
tl::unexpected<base::Error> not_on_record(const base::Error& error) {
  return base::fail(error.message +
                    " So nothing of it is on record: make room or bring the disk back, and do it again.");
}

}  // namespace

base::Result<std::optional<std::string>> read_whole(const fs::path& path) {
  std::error_code error;
  (void)fs::status(path, error);
  if (error == std::errc::no_such_file_or_directory) return std::nullopt;
  auto bytes = io::read_bytes(path, kLargestFile);
  if (!bytes) return tl::unexpected(bytes.error());
  return std::move(*bytes);
}

bool is_part(const fs::path& path) {
  const std::string name = path.filename().string();
  const bool of_earlier_program = name.starts_with('.') && name.ends_with(".part");
  const std::size_t whole = name.rfind(".part-");
  return of_earlier_program || (whole != name.npos && io::is_part_of(name, name.substr(0, whole)));
}

base::Result<void> write_whole(const fs::path& path, std::string_view bytes) {
  auto file = io::NewFile::create(path);
  if (!file) return not_on_record(file.error());
  file->write(bytes);
  if (auto wrote = file->finish(); !wrote) return not_on_record(wrote.error());
  return {};
}

base::Result<void> write_missing(const fs::path& path, std::string_view bytes) {
  std::error_code error;
  return fs::exists(path, error) ? base::Result<void>() : write_whole(path, bytes);
}

base::Result<void> sync_folder(const fs::path& folder) {
  if (auto synced = io::sync_folder(folder); !synced) return not_on_record(synced.error());
  return {};
}

base::Result<void> make_folder(const fs::path& folder) {
  constexpr mode_t kForAll = 0777;  // less the bits of the person's umask
  if (folder.empty()) return base::fail("give the folder a name.");
  std::error_code error;
  std::vector<fs::path> missing;
  for (fs::path it = fs::absolute(folder); !fs::exists(it, error); it = it.parent_path())
    if (it.has_filename()) missing.push_back(it);  // else the slash at its end
  for (; !missing.empty(); missing.pop_back()) {
    if (::mkdir(missing.back().c_str(), kForAll) != 0 && errno != EEXIST)
      return base::fail(
          fmt::format("{}: this folder cannot be made ({}).", missing.back().string(), std::strerror(errno)));
    if (auto synced = sync_folder(missing.back().parent_path()); !synced) return synced;
  }
  if (fs::is_directory(folder, error)) return {};
  return base::fail(folder.string() + ": is a file, not a folder; give another name.");
}

base::Result<FileLock> FileLock::take(const fs::path& path) {
  auto file = io::OpenFile::open(path, io::OpenFile::Use::ChangeOrCreate);
  if (!file) return tl::unexpected(file.error());
  for (;;) {
    const auto locked = file->lock();
    if (!locked) return tl::unexpected(locked.error());
    if (*locked) return FileLock(std::move(*file));
    std::this_thread::sleep_for(kLockAskedAgain);
  }
}

base::Result<std::optional<FileLock>> FileLock::try_take(const fs::path& path) {
  auto file = io::OpenFile::open(path, io::OpenFile::Use::ChangeOrCreate);
  if (!file) return tl::unexpected(file.error());
  const auto locked = file->lock();
  if (!locked) return tl::unexpected(locked.error());
  return *locked ? std::optional(FileLock(std::move(*file))) : std::nullopt;
}

base::Result<AppendFile> AppendFile::open(const fs::path& path, std::uint64_t size) {
  auto opened = io::OpenFile::open(path, io::OpenFile::Use::Change);
  if (!opened) return tl::unexpected(opened.error());
  const auto there = opened->size();
  if (!there) return tl::unexpected(there.error());
  AppendFile file(std::move(*opened), size);
  file.longer_ = *there > size;
  if (const auto cut = file.cut_to_size(); !cut) return not_on_record(cut.error());
  return file;
}

base::Result<void> AppendFile::cut_to_size() {
  if (!longer_) return {};
  if (auto cut = file_.cut_to(size_); !cut) return cut;
  longer_ = false;
  return file_.sync();
}

base::Result<void> AppendFile::append(std::string_view row) {
  // Rows would go where nobody finds them.
  if (!file_.is_at_its_path())
    return base::fail(
        fmt::format("{}: was taken away or replaced while it is in use; put it back and do it again.",
                    file_.path().string()));
  if (const auto cut = cut_to_size(); !cut) return not_on_record(cut.error());
  auto wrote = file_.write(size_, row);
  if (wrote) wrote = file_.sync();
  if (wrote) {
    size_ += row.size();
    return {};
  }
  longer_ = true;
  (void)cut_to_size();  // else before the next row
  return not_on_record(wrote.error());
}

}  // namespace icome::study
