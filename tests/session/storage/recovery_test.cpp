#include "session/storage/recovery.h"

#include "files/journal/journal_format.h"
#include "files/journal/journaled_world.h"
#include "session/autosave_samples.h"
#include "session/storage/autosave_files.h"

namespace icome::session {
namespace {

namespace fs = std::filesystem;

/// A journal as a session that crashed leaves it.
fs::path left_work(const ScratchFolder& folder, std::uint64_t steps, const fs::path& design = {}) {
  const fs::path path = new_autosave_journal(folder.path());
  auto journal = files::JournaledWorld::open(path, world::GeometryFactory(), {.create = true});
  EXPECT_TRUE(write_design_of(path, design));
  for (std::uint64_t i = 0; i < steps; ++i) EXPECT_TRUE(journal->perform(edit_number(i)));
  return path;
}

files::LoadedDesign recovered(const fs::path& folder) {
  const auto works = find_recoverable_work(folder);
  EXPECT_EQ(works.size(), 1U);
  const auto claimed = ClaimedWork::claim(works.at(0));
  if (!claimed) throw std::runtime_error(claimed.error().message);
  auto read = (*claimed)->read({});
  if (!read) throw std::runtime_error(read.error().message);
  return std::move(*read);
}

TEST(Recovery, FindsWhatWasLeftTheLastChangedFirst) {
  const ScratchFolder folder;
  EXPECT_TRUE(find_recoverable_work(folder.path()).empty());
  EXPECT_TRUE(find_recoverable_work(folder.path() / "gone").empty());
  EXPECT_TRUE(find_recoverable_work({}).empty());
  const fs::path older = left_work(folder, 2, "/designs/old.wrl");
  const fs::path newer = left_work(folder, 3);
  const auto now = fs::file_time_type::clock::now();
  fs::last_write_time(older, now - std::chrono::hours(2));
  fs::last_write_time(newer, now - std::chrono::hours(1));
  const auto works = find_recoverable_work(folder.path());
  ASSERT_EQ(works.size(), 2U);
  EXPECT_EQ(works[0].journal, newer);
  EXPECT_EQ(works[0].design, fs::path());
  EXPECT_EQ(works[1].journal, older);
  EXPECT_EQ(works[1].design, "/designs/old.wrl");
  EXPECT_EQ(works[0].changed - works[1].changed, std::chrono::hours(1));
}

TEST(Recovery, LeavesAloneWhatARunningSessionHas) {
  const ScratchFolder folder;
  const fs::path path = left_work(folder, 2);
  const auto running = files::JournaledWorld::open(path, world::GeometryFactory());
  EXPECT_TRUE(find_recoverable_work(folder.path()).empty());
  EXPECT_FALSE(ClaimedWork::claim({path}).has_value());
  EXPECT_EQ(journals_in(folder.path()).size(), 1U);
}

TEST(Recovery, GivesTheWorldAndLeavesTheWorkUntilItIsDiscarded) {
  const ScratchFolder folder;
  left_work(folder, 30, "/designs/a.wrl");
  for (int crash = 0; crash < 3; ++crash) {
    const auto design = recovered(folder.path());
    EXPECT_EQ(hash(design.world), hash(world_after(30)));
    EXPECT_TRUE(design.remarks.empty());
  }
  const auto works = find_recoverable_work(folder.path());
  (*ClaimedWork::claim(works.at(0)))->discard();
  EXPECT_TRUE(names_in(folder.path()).empty());
  const auto late = ClaimedWork::claim(works.at(0));
  ASSERT_FALSE(late);
  EXPECT_NE(late.error().message.find("recovered or discarded elsewhere"), std::string::npos);
}

TEST(Recovery, OneOfTwoProgramsGetsTheWork) {
  const ScratchFolder folder;
  left_work(folder, 2);
  const auto works = find_recoverable_work(folder.path());
  auto mine = ClaimedWork::claim(works.at(0));
  ASSERT_TRUE(mine);
  const auto yours = ClaimedWork::claim(works.at(0));
  ASSERT_FALSE(yours);
  EXPECT_NE(yours.error().message.find("another ICOME is recovering this work"), std::string::npos);
  EXPECT_TRUE(find_recoverable_work(folder.path()).empty()) << "it is offered to nobody else";
  mine->reset();
  EXPECT_TRUE(ClaimedWork::claim(works.at(0)).has_value());
}

TEST(Recovery, CleansAwayWhatHoldsNothing) {
  const ScratchFolder folder;
  left_work(folder, 0, "/designs/a.wrl");
  folder.write("autosave-empty.icome", "");
  folder.write("autosave-cut.icome", files::journal_header().substr(0, 5));
  folder.write("autosave-gone.of", "");
  EXPECT_TRUE(find_recoverable_work(folder.path()).empty());
  EXPECT_TRUE(names_in(folder.path()).empty());
}

TEST(Recovery, SetsAsideWhatCannotBeRead) {
  const ScratchFolder folder;
  folder.write("autosave-zeros.icome", std::string(5000, '\0'));
  folder.write("autosave-zeros.of", "");
  EXPECT_TRUE(find_recoverable_work(folder.path()).empty());
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"autosave-zeros.damaged"});
}

TEST(Recovery, LeavesStrangersAlone) {
  const ScratchFolder folder;
  // A person's own design, and one that a newer version keeps.
  ASSERT_TRUE(files::write_journal(folder.path() / "plan.icome", world_after(5)));
  const fs::path newer = left_work(folder, 5);
  std::fstream file(newer, std::ios::in | std::ios::out | std::ios::binary);
  std::string header = files::journal_header();
  file.seekp(8).put(char(files::kJournalVersion + 1));
  file.close();
  fs::create_directory(folder.path() / "autosave-folder.icome");
  const auto before = names_in(folder.path());
  // Without its checksum a changed version is damage, and then what follows is read.
  const auto works = find_recoverable_work(folder.path());
  ASSERT_EQ(works.size(), 1U);
  EXPECT_EQ(works[0].journal, newer);
  EXPECT_EQ(names_in(folder.path()), before);
}

TEST(Recovery, TellsWhatWasCutOff) {
  const ScratchFolder folder;
  const fs::path path = left_work(folder, 30);
  fs::resize_file(path, fs::file_size(path) - 11);
  const auto design = recovered(folder.path());
  EXPECT_EQ(hash(design.world), hash(world_after(29)));
  ASSERT_EQ(design.remarks.size(), 1U);
  EXPECT_NE(design.remarks[0].text.find("The last edit was cut off"), std::string::npos);
}

TEST(Recovery, KeepsADamagedFileThatHasMore) {
  const ScratchFolder folder;
  const fs::path path = left_work(folder, 30);
  const auto middle = fs::file_size(path) / 2;
  std::fstream(path, std::ios::in | std::ios::out | std::ios::binary)
      .seekp(std::streamoff(middle))
      .write("damaged!", 8);
  const auto claimed = ClaimedWork::claim(find_recoverable_work(folder.path()).at(0));
  const auto design = (*claimed)->read({});
  ASSERT_TRUE(design);
  EXPECT_EQ(steps_in(design->world), 30U) << "what is behind the damage is there, too";
  EXPECT_GE(design->world.objects().size() + 2, world_after(30).objects().size());
  ASSERT_EQ(design->remarks.size(), 2U);
  EXPECT_NE(design->remarks[0].text.find("among them"), std::string::npos);
  (*claimed)->discard();
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{damaged_name(path).filename().string()});
  EXPECT_TRUE(find_recoverable_work(folder.path()).empty());
}

}  // namespace
}  // namespace icome::session
