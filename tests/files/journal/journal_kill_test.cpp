// Programs that are killed at any moment of their work on a journal: every edit that they were told was done
// must be there, and at most the one that they were at besides.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <set>
#include <thread>

#include "files/sample_journals.h"

namespace icome::files {
namespace {

using world::Edit;
using world::ObjectId;

#ifdef ICOME_ADDRESS_SANITIZER
constexpr int kKills = 60;
#else
constexpr int kKills = 1000;
#endif
constexpr ObjectId kCounter{1};

/// The number `step` of the edits that the victims do one after the other; the first makes the counter, whose
/// name tells how many are done.
Edit edit_number(std::uint64_t step) {
  const auto object = [](std::uint64_t number) { return ObjectId{2 + number}; };
  if (step == 0) return world::CreateObject{kCounter, 0, {.name = "1"}};
  world::EditGroup group;
  group.edits.reserve(4);
  group.edits.push_back(world::RenameObject{kCounter, std::to_string(step + 1)});
  group.edits.push_back(world::CreateObject{object(step), 1, {.name = std::string(step % 50, 'x')}});
  group.edits.push_back(world::PlaceObject{object(step), world::at(double(step), 0.0, 0.0)});
  if (step > 20) group.edits.push_back(world::DeleteObject{object(step - 20)});
  return group;
}

std::uint64_t steps_done(const world::World& world) {
  const world::PhysicalObject* counter = world.find(kCounter);
  return counter ? std::stoull(counter->name) : 0;
}

/// Goes on with the edits until it is killed, and says each time that one is done.
[[noreturn]] void work(const std::filesystem::path& path, int report) {
  JournaledWorld journal = opened(path, {.create = true, .compact_from = 20000, .compact_factor = 0.0});
  for (std::uint64_t step = steps_done(journal.world());; ++step) {
    if (!journal.perform(edit_number(step))) ::_exit(1);
    const std::uint64_t done = step + 1;
    if (::write(report, &done, sizeof done) != ssize_t(sizeof done)) ::_exit(2);
  }
}

/// Lets a child work until it has done some edits, and a while longer, kills it, and gives the last edit that
/// it heard was done; nothing if none.
std::optional<std::uint64_t> work_and_kill(const std::filesystem::path& path, base::Random& random) {
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    work(path, ends[1]);
  }
  ::close(ends[1]);
  std::optional<std::uint64_t> last;
  std::uint64_t done = 0;
  const auto hear = [&] {
    const bool heard = ::read(ends[0], &done, sizeof done) == ssize_t(sizeof done);
    if (heard) last = done;
    return heard;
  };
  for (std::uint64_t wait = random.index(60); wait > 0 && hear();) --wait;
  std::this_thread::sleep_for(std::chrono::microseconds(random.index(1000)));
  ::kill(child, SIGKILL);
  while (hear()) continue;
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status)) << "the child ended by itself";
  return last;
}

TEST(JournalKill, LosesNoEditThatWasDone) {
  const ScratchFolder folder(memory_folder());
  const auto path = folder.path() / "design.icome";
  base::Random random(13);
  world::World expected;
  std::uint64_t steps = 0;
  std::set<std::filesystem::path> left_behind;
  int one_more = 0;
  for (int i = 0; i < kKills; ++i) {
    const auto told = work_and_kill(path, random);
    for (const auto& file : std::filesystem::directory_iterator(folder.path()))
      if (file.path() != path) left_behind.insert(file.path());
    if (!std::filesystem::exists(path) || std::filesystem::file_size(path) == 0) continue;
    const ReadJournal back = read(path);
    const std::uint64_t done = steps_done(back.world);
    const std::uint64_t least = told.value_or(steps);
    ASSERT_GE(done, least) << "kill " << i;
    ASSERT_LE(done, least + 1) << "kill " << i;
    one_more += done > least ? 1 : 0;
    for (; steps < done; ++steps) world::applied(expected, edit_number(steps));
    ASSERT_EQ(hash(back.world), hash(expected)) << "kill " << i;
  }
  std::printf("%d kills in %llu edits, %zu while compacting, %d between writing and telling\n", kKills,
              static_cast<unsigned long long>(steps), left_behind.size(), one_more);
  EXPECT_GT(steps, std::uint64_t(kKills));
}

}  // namespace
}  // namespace icome::files
