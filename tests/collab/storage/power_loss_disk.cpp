#include "collab/storage/power_loss_disk.h"

#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>

#include "collab/storage/sample_log.h"

namespace icome::collab {
namespace {

constexpr std::int64_t kSector = 512;

void put(std::string& contents, std::int64_t offset, std::string_view bytes) {
  const std::size_t end = std::size_t(offset) + bytes.size();
  if (contents.size() < end) contents.resize(end);
  std::copy(bytes.begin(), bytes.end(), contents.begin() + offset);
}

void write_whole(const std::string& path, const std::string& contents) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << contents;
}

}  // namespace

/// Followed in memory by the real file.
struct PowerLossDisk::File {
  sqlite3_file base;
  PowerLossDisk* disk;
  Contents* contents;

  static File& of(sqlite3_file* file) { return *reinterpret_cast<File*>(file); }
  sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
};

const sqlite3_io_methods PowerLossDisk::kMethods = {2,
                                                    close,
                                                    read,
                                                    write,
                                                    truncate,
                                                    sync,
                                                    size,
                                                    lock,
                                                    unlock,
                                                    check_lock,
                                                    control,
                                                    sector_size,
                                                    characteristics,
                                                    map_shared,
                                                    lock_shared,
                                                    shared_barrier,
                                                    unmap_shared,
                                                    nullptr,
                                                    nullptr};

PowerLossDisk::PowerLossDisk(const Settings& settings)
    : settings_(settings), random_(settings.seed), real_(sqlite3_vfs_find(nullptr)), vfs_(*real_) {
  vfs_.szOsFile = int(sizeof(File)) + real_->szOsFile;
  vfs_.zName = "power loss";
  vfs_.pAppData = this;
  vfs_.pNext = nullptr;
  vfs_.xOpen = open;
  vfs_.xDelete = remove;
  vfs_.xAccess = access;
  sqlite3_vfs_register(&vfs_, 1);
}

PowerLossDisk::~PowerLossDisk() {
  lose_power();
  sqlite3_vfs_unregister(&vfs_);
  sqlite3_vfs_register(real_, 1);
}

bool PowerLossDisk::step() {
  if (off_) return false;
  if (settings_.steps > 0) {
    --settings_.steps;
    return true;
  }
  lose_power();
  return false;
}

bool PowerLossDisk::does_sync() { return random_.uniform() < settings_.syncs; }

void PowerLossDisk::lose_power() {
  if (std::exchange(off_, true)) return;
  for (const auto& [path, contents] : contents_) keep_some(path, contents);
}

void PowerLossDisk::keep_some(const std::string& path, const Contents& contents) {
  const bool undone = random_.index(2) == 0;
  if (contents.removed && undone) return write_whole(path, *contents.removed);
  if (!std::filesystem::exists(path)) return;
  if (contents.is_new && undone) {
    std::filesystem::remove(path);
    return;
  }
  std::string kept = bytes_in(path);
  const double share = random_.uniform(-0.3, 1.3);  // none and all are as likely as any other
  for (const Change& change : contents.pending) {
    if (!change.bytes) {
      if (random_.uniform() < share) kept.resize(std::size_t(change.offset));
      continue;
    }
    const std::string_view bytes = *change.bytes;
    for (std::size_t i = 0, count = 0; i < bytes.size(); i += count) {
      const std::int64_t at = change.offset + std::int64_t(i);
      count = std::min(bytes.size() - i, std::size_t(kSector - at % kSector));
      if (random_.uniform() >= share) continue;
      const std::size_t torn = random_.index(8) == 0 ? random_.index(count + 1) : count;
      put(kept, at, bytes.substr(i, torn));
    }
  }
  write_whole(path, kept);
}

int PowerLossDisk::open(sqlite3_vfs* vfs, const char* name, sqlite3_file* file, int flags, int* given) {
  auto& disk = *static_cast<PowerLossDisk*>(vfs->pAppData);
  file->pMethods = nullptr;
  if (disk.off_) return SQLITE_CANTOPEN;
  if (name == nullptr)
    return disk.real_->xOpen(disk.real_, name, file, flags, given);  // scratch, lost anyhow
  File& ours = *new (file) File{.base = {}, .disk = &disk, .contents = nullptr};
  const bool was_there = std::filesystem::exists(name);
  const int code = disk.real_->xOpen(disk.real_, name, ours.real(), flags, given);
  if (code != SQLITE_OK) return code;
  Contents& contents = disk.contents_[name];
  if (!was_there) contents = {.is_loaded = true, .is_new = true, .removed = std::move(contents.removed)};
  if (!std::exchange(contents.is_loaded, true)) {
    sqlite3_int64 size = 0;
    ours.real()->pMethods->xFileSize(ours.real(), &size);
    contents.now.resize(std::size_t(size));
    ours.real()->pMethods->xRead(ours.real(), contents.now.data(), int(size), 0);
  }
  ours.contents = &contents;
  ours.base.pMethods = &kMethods;
  return SQLITE_OK;
}

int PowerLossDisk::remove(sqlite3_vfs* vfs, const char* name, int sync_folder) {
  auto& disk = *static_cast<PowerLossDisk*>(vfs->pAppData);
  if (!disk.step()) return SQLITE_IOERR_DELETE;
  Contents& contents = disk.contents_[name];
  if (!contents.is_new && std::filesystem::exists(name)) contents.removed = bytes_in(name);
  if (sync_folder && disk.does_sync()) contents.removed.reset();
  contents = {.removed = std::move(contents.removed)};
  return disk.real_->xDelete(disk.real_, name, 0);
}

int PowerLossDisk::access(sqlite3_vfs* vfs, const char* name, int flags, int* result) {
  auto& disk = *static_cast<PowerLossDisk*>(vfs->pAppData);
  const auto found = disk.contents_.find(name);
  const int code = disk.real_->xAccess(disk.real_, name, flags, result);
  if (flags == SQLITE_ACCESS_EXISTS && found != disk.contents_.end() && found->second.is_loaded)
    *result = !found->second.now.empty();
  return code;
}

int PowerLossDisk::close(sqlite3_file* file) {
  sqlite3_file* const real = File::of(file).real();
  return real->pMethods->xClose(real);
}

int PowerLossDisk::read(sqlite3_file* file, void* bytes, int count, sqlite3_int64 offset) {
  const File& ours = File::of(file);
  if (ours.disk->off_) return SQLITE_IOERR_READ;
  const std::string& now = ours.contents->now;
  const sqlite3_int64 left = std::max<sqlite3_int64>(0, sqlite3_int64(now.size()) - offset);
  const auto there = std::size_t(std::min<sqlite3_int64>(left, count));
  if (there > 0) std::memcpy(bytes, now.data() + offset, there);
  std::memset(static_cast<char*>(bytes) + there, 0, std::size_t(count) - there);
  return there < std::size_t(count) ? SQLITE_IOERR_SHORT_READ : SQLITE_OK;
}

int PowerLossDisk::write(sqlite3_file* file, const void* bytes, int count, sqlite3_int64 offset) {
  const File& ours = File::of(file);
  if (ours.disk->off_) return SQLITE_IOERR_WRITE;
  const std::string written(static_cast<const char*>(bytes), std::size_t(count));
  put(ours.contents->now, offset, written);
  ours.contents->pending.push_back({offset, written});
  return ours.disk->step() ? SQLITE_OK : SQLITE_IOERR_WRITE;
}

int PowerLossDisk::truncate(sqlite3_file* file, sqlite3_int64 size) {
  const File& ours = File::of(file);
  if (ours.disk->off_) return SQLITE_IOERR_TRUNCATE;
  ours.contents->now.resize(std::size_t(size));
  ours.contents->pending.push_back({size, std::nullopt});
  return ours.disk->step() ? SQLITE_OK : SQLITE_IOERR_TRUNCATE;
}

int PowerLossDisk::sync(sqlite3_file* file, int) {
  File& ours = File::of(file);
  if (!ours.disk->step()) return SQLITE_IOERR_FSYNC;
  if (!ours.disk->does_sync()) return SQLITE_OK;
  const auto* const real = ours.real()->pMethods;
  for (const Change& it : ours.contents->pending) {
    const int code = it.bytes ? real->xWrite(ours.real(), it.bytes->data(), int(it.bytes->size()), it.offset)
                              : real->xTruncate(ours.real(), it.offset);
    if (code != SQLITE_OK) return code;
  }
  ours.contents->pending.clear();
  ours.contents->is_new = false;
  ours.contents->removed.reset();
  return SQLITE_OK;
}

int PowerLossDisk::size(sqlite3_file* file, sqlite3_int64* size) {
  *size = sqlite3_int64(File::of(file).contents->now.size());
  return File::of(file).disk->off_ ? SQLITE_IOERR_FSTAT : SQLITE_OK;
}

int PowerLossDisk::control(sqlite3_file* file, int operation, void* argument) {
  // What would change the size of the real file is none of SQLite's business here.
  if (operation == SQLITE_FCNTL_SIZE_HINT || operation == SQLITE_FCNTL_CHUNK_SIZE) return SQLITE_NOTFOUND;
  sqlite3_file* const real = File::of(file).real();
  return real->pMethods->xFileControl(real, operation, argument);
}

// Locks and the memory that connections share are the real file's.

int PowerLossDisk::lock(sqlite3_file* file, int level) {
  sqlite3_file* const real = File::of(file).real();
  return real->pMethods->xLock(real, level);
}

int PowerLossDisk::unlock(sqlite3_file* file, int level) {
  sqlite3_file* const real = File::of(file).real();
  return real->pMethods->xUnlock(real, level);
}

int PowerLossDisk::check_lock(sqlite3_file* file, int* result) {
  sqlite3_file* const real = File::of(file).real();
  return real->pMethods->xCheckReservedLock(real, result);
}

int PowerLossDisk::sector_size(sqlite3_file* file) {
  sqlite3_file* const real = File::of(file).real();
  return real->pMethods->xSectorSize(real);
}

int PowerLossDisk::characteristics(sqlite3_file* file) {
  sqlite3_file* const real = File::of(file).real();
  return real->pMethods->xDeviceCharacteristics(real);
}

int PowerLossDisk::map_shared(sqlite3_file* file, int page, int size, int extend, void volatile** memory) {
  sqlite3_file* const real = File::of(file).real();
  return real->pMethods->xShmMap(real, page, size, extend, memory);
}

int PowerLossDisk::lock_shared(sqlite3_file* file, int offset, int count, int flags) {
  sqlite3_file* const real = File::of(file).real();
  return real->pMethods->xShmLock(real, offset, count, flags);
}

void PowerLossDisk::shared_barrier(sqlite3_file* file) {
  sqlite3_file* const real = File::of(file).real();
  real->pMethods->xShmBarrier(real);
}

int PowerLossDisk::unmap_shared(sqlite3_file* file, int remove) {
  sqlite3_file* const real = File::of(file).real();
  return real->pMethods->xShmUnmap(real, remove);
}

}  // namespace icome::collab
