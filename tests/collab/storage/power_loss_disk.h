#pragma once
#include <sqlite3.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/random.h"

namespace icome::collab {

/// A disk whose power fails: a file system for SQLite that hands on to the real one only what was synced. At
/// the loss a random part of the rest gets there, in pieces of at most a sector, some of which are torn;
/// files and removals that no sync made durable may be undone. While it lives, it is SQLite's default file
/// system. One thread uses it; several connections may.
class PowerLossDisk {
 public:
  struct Settings {
    std::uint64_t seed = 1;
    std::uint64_t steps = ~std::uint64_t{0};  // writes, syncs, cuts and removals until the power fails
    double syncs = 1.0;                       // share of the syncs that are done; the others only say so
  };
  explicit PowerLossDisk(const Settings& settings);
  PowerLossDisk(const PowerLossDisk&) = delete;
  PowerLossDisk& operator=(const PowerLossDisk&) = delete;
  ~PowerLossDisk();

  bool is_off() const { return off_; }
  /// Fails now, unless it has. From here on all that is asked of the disk fails.
  void lose_power();

 private:
  struct Change {  // a write, or a cut to `offset` where there are no bytes
    std::int64_t offset = 0;
    std::optional<std::string> bytes = {};
  };
  struct Contents {  // of a path; the real file has what was synced
    bool is_loaded = false;
    std::string now = {};              // what programs read
    std::vector<Change> pending = {};  // what a sync would change in the real file
    bool is_new = false;               // its name is not durable
    std::optional<std::string> removed =
        {};  // the real file before it was removed, where that is not durable
  };
  struct File;  // what SQLite sees of an open file

  static int open(sqlite3_vfs* vfs, const char* name, sqlite3_file* file, int flags, int* given);
  static int remove(sqlite3_vfs* vfs, const char* name, int sync_folder);
  static int access(sqlite3_vfs* vfs, const char* name, int flags, int* result);
  static int close(sqlite3_file* file);
  static int read(sqlite3_file* file, void* bytes, int count, sqlite3_int64 offset);
  static int write(sqlite3_file* file, const void* bytes, int count, sqlite3_int64 offset);
  static int truncate(sqlite3_file* file, sqlite3_int64 size);
  static int sync(sqlite3_file* file, int flags);
  static int size(sqlite3_file* file, sqlite3_int64* size);
  static int lock(sqlite3_file* file, int level);
  static int unlock(sqlite3_file* file, int level);
  static int check_lock(sqlite3_file* file, int* result);
  static int control(sqlite3_file* file, int operation, void* argument);
  static int sector_size(sqlite3_file* file);
  static int characteristics(sqlite3_file* file);
  static int map_shared(sqlite3_file* file, int page, int size, int extend, void volatile** memory);
  static int lock_shared(sqlite3_file* file, int offset, int count, int flags);
  static void shared_barrier(sqlite3_file* file);
  static int unmap_shared(sqlite3_file* file, int remove);
  static const sqlite3_io_methods kMethods;

  /// Counts a step; false once the power is off.
  bool step();
  bool does_sync();
  void keep_some(const std::string& path, const Contents& contents);

  Settings settings_;
  base::Random random_;
  bool off_ = false;
  sqlite3_vfs* real_;
  sqlite3_vfs vfs_;
  std::map<std::string, Contents> contents_;
};

}  // namespace icome::collab
