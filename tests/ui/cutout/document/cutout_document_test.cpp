#include "ui/cutout/document/cutout_document.h"

#include <gtest/gtest.h>

#include "own_folder.h"

namespace icome::ui {
namespace {

class CutoutDocumentTest : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override {
    document_.close();
    std::filesystem::remove_all(folder_);
  }
  void make_longer(int frames) {
    ASSERT_TRUE(document_.perform(cutout_command("stage", {{"length", frames}})));
  }
  int length_on_disk() const {
    const auto read = animation::read_project_file(file_);
    return read ? read->project.stage.length : -1;
  }

  std::filesystem::path folder_ = own_folder("document"), file_ = folder_ / "boat.cutout";
  CutoutDocument document_;
};

TEST_F(CutoutDocumentTest, IsSavedAgainUnderItsOwnName) {
  make_longer(40);
  ASSERT_TRUE(document_.save(file_));
  make_longer(50);
  ASSERT_TRUE(document_.save(document_.file()));
  EXPECT_EQ(document_.file(), file_);
  EXPECT_FALSE(document_.is_modified());
  EXPECT_EQ(length_on_disk(), 50);
  make_longer(60);
  EXPECT_TRUE(document_.is_modified());
  EXPECT_EQ(length_on_disk(), 60) << "in the journal of the same file";
}

TEST_F(CutoutDocumentTest, IsOpenedAgainFromItsOwnFile) {
  make_longer(40);
  ASSERT_TRUE(document_.save(file_));
  ASSERT_TRUE(document_.open(document_.file()));
  EXPECT_EQ(document_.file(), file_);
  EXPECT_EQ(document_.project().stage.length, 40);
}

TEST_F(CutoutDocumentTest, LeavesNoJournalWhenItIsClosed) {
  ASSERT_TRUE(document_.save(file_));
  make_longer(40);
  EXPECT_TRUE(std::filesystem::exists(animation::journal_of(file_)));
  document_.close();
  EXPECT_FALSE(std::filesystem::exists(animation::journal_of(file_)));
}

}  // namespace
}  // namespace icome::ui
