#include "collab/content/content_cache.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <vector>

#include "collab/storage/random_bytes.h"
#include "io/file_bytes.h"
#include "io/new_file.h"

namespace icome::collab {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostToWrite = 64;  // contents that wait for the disk; more are not kept

}  // namespace

FolderContents::FolderContents(fs::path folder, std::uint64_t most_bytes)
    : folder_(std::move(folder)), most_bytes_(most_bytes), thread_([this] { run(); }) {
  std::error_code ignored;
  fs::create_directories(folder_, ignored);
  fs::permissions(folder_, fs::perms::owner_all, ignored);
}

FolderContents::~FolderContents() {
  {
    const std::lock_guard lock(mutex_);
    stops_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

ContentCachePointer FolderContents::of_user() {
  const char* const cache = std::getenv("XDG_CACHE_HOME");
  const char* const home = std::getenv("HOME");
  fs::path folder;
  if (cache != nullptr && fs::path(cache).is_absolute()) {  // the specification has others ignored
    folder = cache;
  } else if (home != nullptr && fs::path(home).is_absolute()) {
    folder = fs::path(home) / ".cache";
  } else {
    return nullptr;
  }
  try {
    return std::make_shared<FolderContents>(folder / "icome" / "contents");
  } catch (const std::system_error&) {  // no thread can be started
    return nullptr;
  }
}

fs::path FolderContents::path_of(const ContentHash& hash) const { return folder_ / hex_text(hash); }

ContentPointer FolderContents::find(const ContentHash& hash) {
  {
    const std::lock_guard lock(mutex_);
    for (const Kept& kept : to_write_)
      if (kept.first == hash) return kept.second;
  }
  const fs::path path = path_of(hash);
  std::error_code error;
  if (!fs::exists(path, error)) return nullptr;
  auto bytes = io::read_bytes(path, most_bytes_);
  if (!bytes || hash_of_content(*bytes) != hash) {
    fs::remove(path, error);
    return nullptr;
  }
  fs::last_write_time(path, fs::file_time_type::clock::now(), error);  // it was used last
  return std::make_shared<const std::string>(std::move(*bytes));
}

void FolderContents::keep(const ContentHash& hash, const ContentPointer& content) {
  {
    const std::lock_guard lock(mutex_);
    if (to_write_.size() >= kMostToWrite) return;
    to_write_.emplace_back(hash, content);
  }
  wake_.notify_one();
}

void FolderContents::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return stops_ || !to_write_.empty(); });
    if (to_write_.empty()) return;
    const Kept kept = to_write_.front();
    lock.unlock();
    write(kept);
    remove_oldest();
    lock.lock();
    to_write_.pop_front();
  }
}

void FolderContents::write(const Kept& kept) const {
  std::error_code ignored;
  const fs::path path = path_of(kept.first);
  if (kept.second->size() > most_bytes_ || fs::exists(path, ignored)) return;
  auto file = io::NewFile::create(path);
  if (!file) return;
  file->write(*kept.second);
  (void)file->finish();
}

void FolderContents::remove_oldest() const {
  struct File {
    fs::file_time_type used;
    std::uint64_t bytes;
    fs::path path;
  };
  std::vector<File> files;
  std::uint64_t bytes = 0;
  std::error_code error;
  for (fs::directory_iterator it(folder_, error), end; !error && it != end; it.increment(error)) {
    std::error_code gone;
    const std::uint64_t size = it->file_size(gone);
    const auto used = it->last_write_time(gone);
    if (gone) continue;
    bytes += size;
    files.push_back({used, size, it->path()});
  }
  std::ranges::sort(files, {}, &File::used);
  for (const File& file : files) {
    if (bytes <= most_bytes_) return;
    fs::remove(file.path, error);
    bytes -= file.bytes;
  }
}

}  // namespace icome::collab
