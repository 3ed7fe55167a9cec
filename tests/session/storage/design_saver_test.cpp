#include "session/storage/design_saver.h"

#include <sys/resource.h>

#include "session/autosave_samples.h"

namespace icome::session {
namespace {

DesignSaver::Outcome outcome_of(DesignSaver& saver) {
  saver.wait();
  auto outcome = saver.poll();
  if (!outcome) throw std::runtime_error("no outcome");
  return std::move(*outcome);
}

std::string failure_of(const std::filesystem::path& path) {
  DesignSaver saver;
  saver.save(path, world_after(3));
  const auto outcome = outcome_of(saver);
  EXPECT_FALSE(outcome.result.has_value());
  return outcome.result ? "" : outcome.result.error().message;
}

void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << text;
}

world::World boxes() {
  world::World world;
  world::IdSource ids;
  for (int i = 0; i < 3; ++i) world::add_object(world, ids, "box", world::box(1.0 + i));
  return world;
}

TEST(DesignSaver, WritesInTheBackgroundWhatTheWorldIsNow) {
  const ScratchFolder folder;
  DesignSaver saver;
  EXPECT_FALSE(saver.busy());
  world::World world = boxes();
  const auto expected = hash(world);
  saver.save(folder.path() / "boxes.icome", world, 7);
  EXPECT_TRUE(saver.busy());
  world::applied(world, world::RenameObject{world.roots().front(), "later"});
  const auto outcome = outcome_of(saver);
  EXPECT_TRUE(outcome.result.has_value());
  EXPECT_EQ(outcome.number, 7U);
  EXPECT_FALSE(saver.busy());
  EXPECT_EQ(hash(world_in(folder.path() / "boxes.icome")), expected);
}

TEST(DesignSaver, TellsWhatTheFormatCannotHold) {
  const ScratchFolder folder;
  DesignSaver saver;
  world::World world = boxes();
  world::applied(world, world::CreateMaterial{world::MaterialId{99}, {}});
  saver.save(folder.path() / "boxes.stl", world);
  const auto outcome = outcome_of(saver);
  ASSERT_TRUE(outcome.result.has_value());
  EXPECT_FALSE(outcome.result->empty());
}

TEST(DesignSaver, WritesOneAfterTheOther) {
  const ScratchFolder folder;
  DesignSaver saver;
  for (std::uint64_t i = 1; i <= 5; ++i)
    saver.save(folder.path() / (i % 2 == 0 ? "even.icome" : "odd.icome"), world_after(i), i);
  for (std::uint64_t i = 1; i <= 5; ++i) {
    const auto outcome = outcome_of(saver);
    EXPECT_EQ(outcome.number, i);
    EXPECT_TRUE(outcome.result.has_value());
  }
  EXPECT_FALSE(saver.busy());
  EXPECT_EQ(steps_in(world_in(folder.path() / "even.icome")), 4U);
  EXPECT_EQ(steps_in(world_in(folder.path() / "odd.icome")), 5U);
}

TEST(DesignSaver, FinishesWhatIsWaitingWhenItGoes) {
  const ScratchFolder folder;
  {
    DesignSaver saver;
    for (std::uint64_t i = 1; i <= 4; ++i)
      saver.save(folder.path() / (std::to_string(i) + ".icome"), world_after(i));
  }
  for (std::uint64_t i = 1; i <= 4; ++i)
    EXPECT_EQ(steps_in(world_in(folder.path() / (std::to_string(i) + ".icome"))), i);
}

TEST(DesignSaver, TellsWhatToDoWhereItCannotWrite) {
  const ScratchFolder folder;
  const std::vector<std::string> what_to_do = {"Your work is still open here", "Save to another place"};
  expect_parts(failure_of(folder.path() / "gone" / "a.wrl"), {"gone/a.wrl", "No such file", what_to_do[0]});
  expect_parts(failure_of("/proc/a.wrl"), what_to_do);  // not even for root
  expect_parts(failure_of(folder.path() / "a.doc"),
               {"a.doc: designs cannot be written so; .wrl", what_to_do[1]});
  expect_parts(failure_of(folder.path() / "a"), what_to_do);
  expect_parts(failure_of(folder.path()), what_to_do);
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>());
  if (::geteuid() == 0) GTEST_SKIP() << "root may write into a folder that is read-only";
  std::filesystem::permissions(folder.path(),
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  expect_parts(failure_of(folder.path() / "a.wrl"), {"Permission denied", what_to_do[0]});
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

TEST(DesignSaver, AFullDiskLeavesTheOldFile) {
#if defined(ICOME_THREAD_SANITIZER)
  GTEST_SKIP() << "the thread sanitizer cannot follow threads that begin after a fork";
#endif
  const ScratchFolder folder;
  for (const char* const name : {"a.wrl", "a.glb", "a.obj", "a.icome"}) {
    const auto path = folder.write(name, "what was there");
    if (path.extension() == ".icome") {
      ASSERT_TRUE(files::write_journal(path, {}));
    }
    const auto before = std::filesystem::file_size(path);
    EXPECT_TRUE(in_child([&] {
      // As on a disk that is full: nothing can grow beyond this.
      const rlimit limit = {64, 64};
      std::signal(SIGXFSZ, SIG_IGN);
      ::setrlimit(RLIMIT_FSIZE, &limit);
      DesignSaver saver;
      saver.save(path, boxes());
      const auto outcome = outcome_of(saver);
      return holds(!outcome.result.has_value(), "it fails") &&
             holds(outcome.result.error().message.find("too large") != std::string::npos,
                   outcome.result.error().message);
    }));
    EXPECT_EQ(std::filesystem::file_size(path), before);
    EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{name}) << "something half done was left";
    std::filesystem::remove(path);
  }
}

}  // namespace
}  // namespace icome::session
