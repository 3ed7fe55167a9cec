#include "ui/actions/file_actions.h"

#include <QAbstractButton>
#include <QMainWindow>
#include <QMessageBox>
#include <QSettings>
#include <QTemporaryDir>
#include <fstream>

#include "ui/desktop_test.h"

namespace icome::ui {
namespace {

class FileActionsTest : public DesktopTest {
 protected:
  FileActionsTest()
      : settings_(folder_.filePath("icome.conf"), QSettings::IniFormat),
        files_(session(), settings_, window_) {}

  void change() {
    world::PhysicalObject object{.name = "thing"};
    perform(world::CreateObject{session().ids().next<world::ObjectId>(), 0, object});
  }
  /// Presses a button of the question that is asked; false: there is none.
  bool answer(QMessageBox::StandardButton button) {
    auto* box = window_.findChild<QMessageBox*>("save_changes");
    if (!box) return false;
    box->button(button)->click();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    return true;
  }
  /// Runs the session until what is read and written is done.
  void finish_files() {
    session().settle();
    for (const auto& event : session().update()) files_.hear(event);
  }
  /// What people are told when that is done.
  std::vector<Note> notes() {
    session().settle();
    std::vector<Note> all;
    for (const auto& event : session().update()) all.push_back(files_.hear(event));
    return all;
  }
  std::filesystem::path file(const char* name) { return path_of(folder_.filePath(name)); }

  QTemporaryDir folder_;
  QSettings settings_;
  QMainWindow window_;
  FileActions files_;
};

TEST_F(FileActionsTest, NobodyIsAskedWhenNothingWouldBeLost) {
  bool done = false;
  files_.when_safe([&] { done = true; });
  EXPECT_TRUE(done);
  EXPECT_FALSE(window_.findChild<QMessageBox*>());
}

TEST_F(FileActionsTest, CancelKeepsTheWork) {
  change();
  bool done = false;
  files_.when_safe([&] { done = true; });
  EXPECT_FALSE(done);
  EXPECT_TRUE(answer(QMessageBox::Cancel));
  EXPECT_FALSE(done);
  EXPECT_TRUE(session().files().modified());
}

TEST_F(FileActionsTest, DontSaveGoesOn) {
  change();
  bool done = false;
  files_.when_safe([&] { done = true; });
  files_.when_safe([&] { done = true; });  // asks once
  EXPECT_TRUE(answer(QMessageBox::Discard));
  EXPECT_TRUE(done);
}

TEST_F(FileActionsTest, SaveGoesOnWhenAllIsWritten) {
  change();
  session().files().save(file("a.icome"));
  finish_files();
  ASSERT_EQ(session().files().path(), file("a.icome"));
  change();
  bool done = false;
  files_.when_safe([&] { done = true; });
  EXPECT_TRUE(answer(QMessageBox::Save));
  finish_files();
  EXPECT_TRUE(done);
  EXPECT_FALSE(session().files().modified());
}

TEST_F(FileActionsTest, AFailedSaveDoesNotGoOn) {
  change();
  session().files().save(file("a.icome"));
  finish_files();
  change();
  std::filesystem::remove_all(path_of(folder_.path()));
  bool done = false;
  files_.when_safe([&] { done = true; });
  EXPECT_TRUE(answer(QMessageBox::Save));
  finish_files();
  EXPECT_FALSE(done);
  EXPECT_TRUE(session().files().modified());
}

TEST_F(FileActionsTest, WhatAFormatCannotHoldKeepsTheQuestionWithTheReason) {
  change();
  perform(world::CreateMaterial{session().ids().next<world::MaterialId>(), {.name = "oak"}});
  session().files().save(file("a.off"));
  finish_files();
  EXPECT_TRUE(session().files().modified());
  bool done = false;
  files_.when_safe([&] { done = true; });
  auto* const box = window_.findChild<QMessageBox*>("save_changes");
  ASSERT_TRUE(box);
  EXPECT_TRUE(box->informativeText().contains("a.off cannot hold all of your design"))
      << qPrintable(box->informativeText());
  EXPECT_TRUE(box->informativeText().contains("materials")) << qPrintable(box->informativeText());
  EXPECT_TRUE(answer(QMessageBox::Cancel));
  session().files().save(file("a.icome"));
  finish_files();
  EXPECT_FALSE(session().files().modified());
  files_.when_safe([&] { done = true; });
  EXPECT_TRUE(done);
}

TEST_F(FileActionsTest, AsksBeforeItReplacesWhatAnotherProgramWrote) {
  change();
  session().files().save(file("a.icome"));
  finish_files();
  const auto write = [&](const char* text) { std::ofstream(file("a.icome")) << text; };
  write("# somebody else's\nv 0 0 0\n");
  change();
  bool done = false;
  files_.when_safe([&] { done = true; });
  EXPECT_TRUE(answer(QMessageBox::Save));
  finish_files();
  auto* box = window_.findChild<QMessageBox*>("replace_file");
  ASSERT_TRUE(box);
  EXPECT_TRUE(box->text().contains("another program has changed this file")) << qPrintable(box->text());
  box->button(QMessageBox::Cancel)->click();
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  EXPECT_FALSE(done);
  EXPECT_TRUE(session().files().modified());
  std::string first;
  std::getline(std::ifstream(file("a.icome")), first);
  EXPECT_EQ(first, "# somebody else's");

  files_.save();
  finish_files();
  box = window_.findChild<QMessageBox*>("replace_file");
  ASSERT_TRUE(box);
  for (QAbstractButton* button : box->buttons())
    if (box->buttonRole(button) == QMessageBox::DestructiveRole) button->click();
  finish_files();
  std::getline(std::ifstream(file("a.icome")), first);
  EXPECT_EQ(first, "\x89ICOME\r");
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  files_.save();
  finish_files();
  EXPECT_FALSE(window_.findChild<QMessageBox*>("replace_file")) << "what was saved here is known";
}

TEST_F(FileActionsTest, OpensAndRemembersWhatWasOpened) {
  change();
  session().files().save(file("a.icome"));
  finish_files();
  session().files().make_new();
  EXPECT_EQ(files_.design_name(), "Untitled");
  files_.open(file("a.icome"));
  finish_files();
  EXPECT_EQ(files_.design_name(), "a.icome");
  EXPECT_EQ(world().objects().size(), 1U);
  EXPECT_EQ(RecentFiles(settings_).paths(), QStringList(folder_.filePath("a.icome")));
}

TEST_F(FileActionsTest, WhatWaitsToBeWrittenIsWrittenBeforeAnybodyIsAskedAgain) {
  change();
  session().files().save(file("a.icome"));
  finish_files();
  change();
  session().files().save(file("a.icome"));
  change();
  bool done = false;
  files_.when_safe([&] { done = true; });
  EXPECT_TRUE(answer(QMessageBox::Save));
  ASSERT_TRUE(session().files().saving());
  files_.hear({.kind = session::SessionEvent::Kind::Saved, .text = "The first was saved."});
  EXPECT_FALSE(window_.findChild<QMessageBox*>("save_changes"));
  EXPECT_FALSE(done);
  finish_files();
  EXPECT_TRUE(done);
  EXPECT_FALSE(session().files().modified());
}

TEST_F(FileActionsTest, WhoGoesOnMeanwhileIsToldAndCanOpenItAgain) {
  change();
  session().files().save(file("a.icome"));
  finish_files();
  session().files().make_new();
  files_.open(file("a.icome"));
  change();
  EXPECT_FALSE(session().files().opening());
  const std::vector<Note> told = notes();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].text, "a.icome was not opened, as you went on with Untitled. Open it again to have it.");
  EXPECT_EQ(told[0].weight, Note::Weight::Plain);
  EXPECT_EQ(told[0].remedies, std::vector{Note::Remedy::Open});
  EXPECT_EQ(told[0].design, file("a.icome"));
  EXPECT_EQ(world().objects().size(), 1U);
  EXPECT_TRUE(session().files().modified());
}

TEST_F(FileActionsTest, WhoCancelsIsToldThatItWasCancelled) {
  change();
  session().files().save(file("a.icome"));
  finish_files();
  files_.open(file("a.icome"));
  session().files().cancel_open();
  const std::vector<Note> told = notes();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].text.find("cancelled"), std::string::npos);
  EXPECT_TRUE(told[0].remedies.empty());
}

TEST_F(FileActionsTest, AnEditCountsMoreThanWorkWithoutANameThatIsBeingRead) {
  change();
  session().files().save(file("a.icome"));
  finish_files();
  session().files().open(file("a.icome"));  // as if it had no name: these actions know none
  change();
  finish_files();
  EXPECT_EQ(world().objects().size(), 2U);
  EXPECT_TRUE(session().files().modified());
}

TEST_F(FileActionsTest, WhatIsGoneIsNotOfferedAgain) {
  change();
  session().files().save(file("a.icome"));
  finish_files();
  session().files().save(file("b.icome"));
  finish_files();
  EXPECT_EQ(RecentFiles(settings_).paths().size(), 2);
  std::filesystem::remove(file("a.icome"));
  files_.open(file("a.icome"));
  finish_files();
  EXPECT_EQ(RecentFiles(settings_).paths(), QStringList(folder_.filePath("b.icome")));
  // What is there and cannot be read may be put right.
  std::ofstream(file("b.icome")) << "nonsense";
  files_.open(file("b.icome"));
  finish_files();
  EXPECT_EQ(RecentFiles(settings_).paths(), QStringList(folder_.filePath("b.icome")));
}

TEST(FileFilters, OfferWhatCanBeReadAndWritten) {
  EXPECT_TRUE(open_filters().front().contains("*.wrl"));
  EXPECT_TRUE(open_filters().front().contains("*.csg"));
  EXPECT_FALSE(save_filters().join(' ').contains("*.csg"));
  EXPECT_EQ(ending_of("VRML 2.0 (*.wrl *.vrml)"), "wrl");
  EXPECT_EQ(ending_of("STL (*.stl)"), "stl");
  EXPECT_EQ(ending_of("All files (*)"), "");
}

}  // namespace
}  // namespace icome::ui
