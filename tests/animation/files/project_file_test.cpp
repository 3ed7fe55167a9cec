#include "animation/files/project_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "animation/random_project.h"
#include "own_folder.h"

namespace icome::animation {
namespace {

class ProjectFileTest : public ::testing::Test {
 protected:
  std::string journal_text() const {
    std::ifstream file(journal_of(file_));
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void write_journal(const std::string& text) const { std::ofstream(journal_of(file_)) << text; }

  void SetUp() override { std::filesystem::create_directories(file_.parent_path()); }
  void TearDown() override { std::filesystem::remove_all(file_.parent_path()); }

  std::filesystem::path file_ = own_folder("cutout") / "boat.cutout";
};

TEST_F(ProjectFileTest, KeepsWhatWasDoneSinceItWasSaved) {
  Project project;
  ASSERT_TRUE(write_project_file(project, file_));
  {
    auto journal = ProjectJournal::open(file_);
    ASSERT_TRUE(journal) << journal.error().message;
    for (const ProjectEdit& edit : {ProjectEdit{PutLayer{LayerId{2}, 0, {.name = "sea"}}},
                                    ProjectEdit{ChangeStage{{200, 100}}, SmoothHands{true}}}) {
      ASSERT_TRUE(apply_edit(project, edit));
      ASSERT_TRUE(journal->add(edit));
    }
  }
  const auto read = read_project_file(file_);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->project, project);
  EXPECT_EQ(read->recovered, 2U);
  EXPECT_EQ(read->note, "");
}

TEST_F(ProjectFileTest, LosesOnlyTheLineThatWasNotWrittenToItsEnd) {
  Project project;
  ASSERT_TRUE(write_project_file(project, file_));
  auto journal = ProjectJournal::open(file_);
  const ProjectEdit first = {ChangeStage{{200, 100}}}, second = {ChangeStage{{300, 100}}};
  ASSERT_TRUE(journal->add(first));
  const std::size_t whole = journal_text().size();
  ASSERT_TRUE(journal->add(second));
  const std::string text = journal_text();
  for (std::size_t length = whole; length < text.size(); ++length) {
    write_journal(text.substr(0, length));
    const auto read = read_project_file(file_);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->project.stage.width, 200);
    EXPECT_EQ(read->journal_length, whole);
    EXPECT_EQ(read->note.empty(), length == whole) << length;
  }
}

TEST_F(ProjectFileTest, GoesOnWithAJournalAfterItsWholePart) {
  ASSERT_TRUE(write_project_file({}, file_));
  ASSERT_TRUE(ProjectJournal::open(file_)->add({ChangeStage{{200, 100}}}));
  write_journal(journal_text() + "edit = [{ do = ");
  const auto read = read_project_file(file_);
  ASSERT_TRUE(ProjectJournal::open(file_, read->journal_length)->add({SmoothHands{true}}));
  const auto again = read_project_file(file_);
  EXPECT_EQ(again->recovered, 2U);
  EXPECT_EQ(again->note, "");
  EXPECT_TRUE(again->project.smooth_hands);
}

TEST_F(ProjectFileTest, PartsOfARecordingCountUntilTheWholeIsThere) {
  using Line = ProjectJournal::Line;
  Project project;
  ASSERT_TRUE(write_project_file(project, file_));
  std::size_t with_parts = 0;
  {
    auto journal = ProjectJournal::open(file_);
    ASSERT_TRUE(journal->add({ChangeStage{{200, 100}}}, Line::Part));
    ASSERT_TRUE(journal->add({SmoothHands{true}}, Line::Part));
    with_parts = journal_text().size();
    ASSERT_TRUE(journal->add({ChangeStage{{300, 100}}}, Line::Whole));
  }
  const std::string text = journal_text();
  for (std::size_t length = with_parts; length <= text.size(); ++length) {
    const bool is_whole = length == text.size();
    write_journal(text.substr(0, length));
    const auto read = read_project_file(file_);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->recovered, 1U) << length;
    EXPECT_EQ(read->project.stage.width, is_whole ? 300 : 200) << length;
    EXPECT_EQ(read->project.smooth_hands, !is_whole) << length;
  }
}

/// What comes after parts that were taken up once comes after them ever after.
TEST_F(ProjectFileTest, GoesOnAfterPartsOfARecordingThatWasCutOff) {
  using Line = ProjectJournal::Line;
  ASSERT_TRUE(write_project_file({}, file_));
  ASSERT_TRUE(ProjectJournal::open(file_)->add({ChangeStage{{200, 100}}}, Line::Part));
  const auto read = read_project_file(file_);
  {
    auto journal = ProjectJournal::open(file_, read->journal_length);
    ASSERT_TRUE(journal->add({ChangeStage{{300, 100}}}));
    ASSERT_TRUE(journal->add({SmoothHands{true}}, Line::Part));
    ASSERT_TRUE(journal->add({}, Line::Whole));
  }
  const auto again = read_project_file(file_);
  EXPECT_EQ(again->note, "");
  EXPECT_EQ(again->recovered, 2U);
  EXPECT_EQ(again->project.stage.width, 300);
  EXPECT_FALSE(again->project.smooth_hands) << "nothing came of that recording";
}

TEST_F(ProjectFileTest, LeavesAJournalOfAnotherVersionAlone) {
  ASSERT_TRUE(write_project_file({}, file_));
  ASSERT_TRUE(ProjectJournal::open(file_)->add({SmoothHands{true}}));
  const std::string old = journal_text();
  Project other;
  ASSERT_TRUE(apply_edit(other, {ChangeStage{{200, 100}}}));
  ASSERT_TRUE(write_project_file(other, file_));
  const auto read = read_project_file(file_);
  EXPECT_EQ(read->project, other);
  EXPECT_EQ(read->recovered, 0U);
  EXPECT_NE(read->note.find("is a journal of another version"), std::string::npos);
  ASSERT_TRUE(ProjectJournal::open(file_));
  std::ifstream kept(journal_of(file_).string() + ".old");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(kept), {}), old);
}

TEST_F(ProjectFileTest, IsOpenOnlyOnce) {
  ASSERT_TRUE(write_project_file({}, file_));
  const auto journal = ProjectJournal::open(file_);
  const auto second = ProjectJournal::open(file_);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().message, file_.string() + ": is open in another window already");
}

TEST_F(ProjectFileTest, TellsWhetherItIsOpenAndWhatItsTextIs) {
  ASSERT_TRUE(write_project_file({}, file_));
  EXPECT_FALSE(ProjectJournal::is_open(file_));
  {
    auto journal = ProjectJournal::open(file_);
    EXPECT_TRUE(ProjectJournal::is_open(file_));
    ASSERT_TRUE(journal->add({SmoothHands{true}}));
  }
  EXPECT_FALSE(ProjectJournal::is_open(file_)) << "it is left, as after a crash";
  const auto read = read_project_file(file_);
  ASSERT_TRUE(read && read->as_saved);
  EXPECT_FALSE(read->as_saved->smooth_hands);
  EXPECT_TRUE(read->project.smooth_hands);
  EXPECT_EQ(read->hash, hash_of_text(project_text({})));
  EXPECT_EQ(hash_of_file(file_), read->hash);
  std::ofstream(file_, std::ios::app) << "\n";
  EXPECT_NE(hash_of_file(file_), read->hash);
  EXPECT_EQ(hash_of_file(file_.string() + "x"), std::nullopt);
}

TEST_F(ProjectFileTest, SaysWhichFileIsMissing) {
  EXPECT_NE(read_project_file(file_).error().message.find("boat.cutout"), std::string::npos);
}

}  // namespace
}  // namespace icome::animation
