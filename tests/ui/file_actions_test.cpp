#include "ui/file_actions.h"

#include <QAbstractButton>
#include <QMainWindow>
#include <QMessageBox>
#include <QSettings>
#include <QTemporaryDir>
#include <thread>

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
  EXPECT_TRUE(session().modified());
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
  session().save(file("a.icome"));
  finish_files();
  ASSERT_EQ(session().path(), file("a.icome"));
  change();
  bool done = false;
  files_.when_safe([&] { done = true; });
  EXPECT_TRUE(answer(QMessageBox::Save));
  finish_files();
  EXPECT_TRUE(done);
  EXPECT_FALSE(session().modified());
}

TEST_F(FileActionsTest, AFailedSaveDoesNotGoOn) {
  change();
  session().save(file("a.icome"));
  finish_files();
  change();
  std::filesystem::remove_all(path_of(folder_.path()));
  bool done = false;
  files_.when_safe([&] { done = true; });
  EXPECT_TRUE(answer(QMessageBox::Save));
  finish_files();
  EXPECT_FALSE(done);
  EXPECT_TRUE(session().modified());
}

TEST_F(FileActionsTest, OpensAndRemembersWhatWasOpened) {
  change();
  session().save(file("a.icome"));
  finish_files();
  session().make_new();
  EXPECT_EQ(files_.design_name(), "Untitled");
  files_.open(file("a.icome"));
  finish_files();
  EXPECT_EQ(files_.design_name(), "a.icome");
  EXPECT_EQ(world().objects().size(), 1U);
  EXPECT_EQ(RecentFiles(settings_).paths(), QStringList(folder_.filePath("a.icome")));
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
