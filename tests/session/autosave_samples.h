#pragma once
// Work to keep, and programs that end in bad ways.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <functional>
#include <thread>

#include "files/journal/journal.h"
#include "files/remark.h"
#include "files/sample_files.h"
#include "memory_place.h"
#include "session/storage/autosave_journal.h"
#include "session/storage/claimed_work.h"
#include "world/sample_world.h"

namespace icome::session {

/// A folder of its own for one test, where waiting for the disk takes no time.
class ScratchFolder : public files::ScratchFolder {
 public:
  ScratchFolder() : files::ScratchFolder(memory_place()) {}
};

/// Number `step` of edits that build on each other: a counter whose name tells how many are done, and
/// boxes that come, move and go.
inline world::Edit edit_number(std::uint64_t step) {
  using namespace world;
  constexpr ObjectId kCounter{1};
  constexpr std::uint64_t kBoxes = 20;  // at a time
  if (step == 0) return CreateObject{kCounter, 0, {.name = "1"}};
  const ObjectId made{1 + step};
  EditGroup group;
  group.edits.push_back(RenameObject{kCounter, std::to_string(step + 1)});
  group.edits.push_back(CreateObject{made, 1, {.name = std::string(step % 50, 'x')}});
  group.edits.push_back(PlaceObject{made, at(double(step), 0.0, 0.0)});
  if (step > kBoxes) group.edits.push_back(DeleteObject{ObjectId{1 + step - kBoxes}});
  return group;
}

inline std::uint64_t steps_in(const world::World& world) {
  const world::PhysicalObject* counter = world.find(world::ObjectId{1});
  return counter ? std::stoull(counter->name) : 0;
}

/// The world after the first edits.
inline world::World world_after(std::uint64_t steps) {
  world::World world;
  for (std::uint64_t i = 0; i < steps; ++i) world::applied(world, edit_number(i));
  return world;
}

inline Edited edited(std::uint64_t step) {
  Edited edited;
  edited.edit = std::make_shared<world::Edit>(edit_number(step));
  return edited;
}

inline Edited opened(const world::World& world, SavedWork saved = {}) {
  Edited edited;
  edited.whole = std::make_shared<world::World>(world);
  edited.saved = std::make_shared<SavedWork>(std::move(saved));
  return edited;
}

inline Edited saved(const std::filesystem::path& design, std::uint64_t number) {
  Edited edited;
  edited.saved = std::make_shared<SavedWork>(SavedWork{design, number});
  return edited;
}

/// The names in a folder, in order.
inline std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (std::filesystem::directory_iterator it(folder, error), end; it != end; it.increment(error))
    names.push_back(it->path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

inline std::vector<std::filesystem::path> journals_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> journals;
  for (const std::string& name : names_in(folder))
    if (name.ends_with(".icome")) journals.push_back(folder / name);
  return journals;
}

inline world::World world_in(const std::filesystem::path& journal) {
  auto read = files::read_journal(journal, world::GeometryFactory());
  if (!read) throw std::runtime_error(read.error().message);
  EXPECT_TRUE(read->report.damage.empty());
  return read->world;
}

/// Runs `work` in a process of its own, which it may harm; true when it returned true.
inline bool in_child(const std::function<bool()>& work) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(work() ? 0 : 1);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// Tells why a check in a child failed, where Google Test cannot.
inline bool holds(bool condition, const std::string& what) {
  if (!condition) std::fprintf(stderr, "does not hold: %s\n", what.c_str());
  return condition;
}

/// Waits until something is so, which other threads bring about; the test's own limit on time ends it.
inline void wait_until(const std::function<bool()>& is_so) {
  while (!is_so()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace icome::session
