#include "ui/study/study_page.h"

#include <QLabel>
#include <QTest>

#include "ui/desktop_test.h"

namespace icome::ui {
namespace {

class StudyPageTest : public ::testing::Test {
 protected:
  StudyPageTest() { application(); }

  static void show(StudyPage& page) {
    page.setAttribute(Qt::WA_DontShowOnScreen);
    page.resize(900, 700);
    page.show();
    page.take_keyboard();
  }
  static void enter(StudyPage& page) { QTest::keyClick(page.focusWidget(), Qt::Key_Return); }
};

TEST_F(StudyPageTest, EnterPressesTheMainButtonUnlessAnotherHasTheKeyboard) {
  StudyPage page("Title", nullptr);
  std::string pressed;
  page.add_button("No", [&] { pressed += "no "; });
  page.add_main_button("Yes", [&] { pressed += "yes "; });
  show(page);
  enter(page);
  EXPECT_EQ(pressed, "yes ");
  page.findChild<QPushButton*>("study.button")->setFocus();
  enter(page);
  EXPECT_EQ(pressed, "yes no ");
}

TEST_F(StudyPageTest, TheSecondClickOfADoubleOneIsNotForTheNextPage) {
  StudyPage page("Title", nullptr);
  int pressed = 0;
  page.add_main_button("Go on", [&] { ++pressed; });
  show(page);
  auto* button = page.findChild<QPushButton*>("study.main");
  QTest::mouseDClick(button, Qt::LeftButton);  // which sends the second one only
  EXPECT_EQ(pressed, 0);
  QTest::mouseClick(button, Qt::LeftButton);
  EXPECT_EQ(pressed, 1);
}

TEST_F(StudyPageTest, TextIsPartedAtEmptyLines) {
  StudyPage page("Title", nullptr);
  page.add_text("One\nline.\n\nTwo.\n \nThree.\n");
  QStringList said;
  for (const QLabel* label : page.findChildren<QLabel*>("study.text")) said << label->text();
  EXPECT_EQ(said, QStringList({"One\nline.", "Two.", "Three."}));
}

TEST_F(StudyPageTest, ARestCannotBeLeftBeforeItsTime) {
  StudyRestPage page("Break", "Wait %1", nullptr);
  int left = 0;
  page.add_main_button("Go on", [&] { ++left; });
  page.wait(75.0);
  show(page);
  EXPECT_EQ(page.findChild<QLabel*>("study.left")->text(), "Wait 1:15");
  enter(page);
  EXPECT_EQ(left, 0);
  page.end_wait();
  enter(page);
  EXPECT_EQ(left, 1);
}

TEST_F(StudyPageTest, ARestOfNoTimeIsOverAtOnce) {
  StudyRestPage page("Break", "Wait %1", nullptr);
  page.add_main_button("Go on", [] {});
  page.wait(0.0);
  EXPECT_TRUE(page.findChild<QPushButton*>("study.main")->isEnabled());
}

}  // namespace
}  // namespace icome::ui
