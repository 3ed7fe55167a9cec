#pragma once
// Journals to damage, and what should be left of them.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "files/journal/journaled_world.h"
#include "files/sample_files.h"
#include "world/random_edits.h"

namespace icome::files {

inline const world::GeometryFactory& factory() {
  static const world::GeometryFactory kAll;
  return kAll;
}

inline std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// As ScratchFolder::write, for thousands: file systems bring a file that is written over to the disk.
inline std::filesystem::path write_fresh(const ScratchFolder& folder, const std::string& name,
                                         std::string_view bytes) {
  std::filesystem::remove(folder.path() / name);
  return folder.write(name, bytes);
}

/// Where waiting for the disk takes no time, so that much can be tried.
inline std::filesystem::path memory_folder() {
  const std::filesystem::path memory = "/dev/shm";
  return ::access(memory.c_str(), W_OK) == 0 ? memory : std::filesystem::temp_directory_path();
}

inline JournaledWorld opened(const std::filesystem::path& path, const JournalOptions& options = {}) {
  auto journal = JournaledWorld::open(path, factory(), options);
  if (!journal) throw std::runtime_error(journal.error().message);
  return std::move(*journal);
}

inline ReadJournal read(const std::filesystem::path& path) {
  auto journal = read_journal(path, factory());
  if (!journal) throw std::runtime_error(journal.error().message);
  return std::move(*journal);
}

/// Performs what must work.
inline world::Edit performed(JournaledWorld& journal, const world::Edit& edit) {
  auto inverse = journal.perform(edit);
  if (!inverse) throw std::runtime_error(inverse.error().message);
  return std::move(*inverse);
}

/// A few small edits of several kinds, each of which changes the hash of the world.
inline std::vector<world::Edit> few_edits() {
  using namespace world;
  const GeometryId shape{101};
  const ObjectId table{102}, leg{103};
  return {CreateGeometry{shape, box(1.0)},
          CreateObject{table, 0, {.name = "table", .geometry = shape}},
          CreateObject{leg, 0, {.name = "leg", .parent = table}},
          PlaceObject{leg, at(1.0, 2.0, 3.0)},
          EditGroup{{RenameObject{leg, "foot"}, ChooseGeometry{leg, shape}}},
          MoveObject{leg, {}, 1, at(0.0, 0.0, 1.0)}};
}

/// The bytes of a journal with a snapshot and some edits, where each part ends, and the hash of the world
/// after each edit.
struct SampleJournal {
  std::string bytes;
  std::vector<std::size_t> ends;      // of the snapshot, then of each edit
  std::vector<std::uint64_t> hashes;  // the same

  SampleJournal() {
    const ScratchFolder folder;
    const std::filesystem::path path = folder.path() / "sample.icome";
    world::World before;
    world::IdSource ids;
    world::add_object(before, ids, "floor", nullptr);
    EXPECT_TRUE(write_journal(path, before));
    JournaledWorld journal = opened(path);
    const auto note = [&] {
      ends.push_back(journal.bytes());
      hashes.push_back(hash(journal.world()));
    };
    note();
    for (const world::Edit& edit : few_edits()) {
      performed(journal, edit);
      note();
    }
    bytes = content_of(path);
  }
};

inline const SampleJournal& sample_journal() {
  static const SampleJournal kSample;
  return kSample;
}

}  // namespace icome::files
