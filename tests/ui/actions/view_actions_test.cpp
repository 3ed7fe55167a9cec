// The parts of the view menu that say how eyes see the scene.
#include "ui/actions/view_actions.h"

#include <QDoubleSpinBox>
#include <QInputDialog>
#include <QTemporaryDir>
#include <QTimer>

#include "ui/desktop_test.h"

namespace icome::ui {
namespace {

using interaction::StereoKind;

class ViewActionsTest : public DesktopTest {
 protected:
  ViewActionsTest()
      : settings_(folder_.filePath("icome.conf"), QSettings::IniFormat),
        tools_(session(), {}),
        views_(session(), tools_, settings_),
        menu_(&window_) {
    views_.fill(menu_);
  }
  QAction& action(const char* name) {
    auto* found = menu_.findChild<QAction*>(name);
    EXPECT_TRUE(found) << name;
    return *found;
  }

  QTemporaryDir folder_;
  QSettings settings_;
  SceneTools tools_;
  ViewActions views_;
  QWidget window_;
  QMenu menu_;
};

TEST_F(ViewActionsTest, StereoIsChosenAndShown) {
  session::SessionView& view = session().view();
  action("view.stereo_anaglyph").trigger();
  EXPECT_EQ(view.stereo().kind, StereoKind::Anaglyph);
  action("view.stereo_side_by_side").trigger();
  EXPECT_EQ(view.stereo().kind, StereoKind::SideBySide);
  action("view.stereo_squeezed").trigger();
  EXPECT_TRUE(view.stereo().squeezed);
  view.set_stereo({StereoKind::TopBottom, 0.06, false});
  views_.refresh();
  EXPECT_TRUE(action("view.stereo_top_bottom").isChecked());
  EXPECT_FALSE(action("view.stereo_side_by_side").isChecked());
  EXPECT_FALSE(action("view.stereo_squeezed").isChecked());
  action("view.stereo_off").trigger();
  EXPECT_EQ(view.stereo().kind, StereoKind::Off);
  EXPECT_EQ(view.stereo().eye_distance, 0.06) << "is kept";
}

TEST_F(ViewActionsTest, TheScreenBecomesAWindowAndBack) {
  const double before = session().view().now().field;
  session().view().set_screen({0.4, 0.3});
  action("view.fish_tank").trigger();
  EXPECT_TRUE(session().view().is_fish_tank());
  EXPECT_NEAR(session().view().now().field, 2.0 * std::atan(0.15 / 0.6), 1e-12);
  action("view.fish_tank").trigger();
  EXPECT_FALSE(session().view().is_fish_tank());
  EXPECT_NEAR(session().view().now().field, before, 1e-12);
}

TEST_F(ViewActionsTest, TheEyeDistanceIsAsked) {
  QTimer::singleShot(0, &window_, [] {
    auto* const dialog = qobject_cast<QInputDialog*>(QApplication::activeModalWidget());
    ASSERT_TRUE(dialog);
    EXPECT_EQ(dialog->doubleValue(), 63.0);
    dialog->setDoubleValue(58.5);
    dialog->accept();
  });
  action("view.eye_distance").trigger();
  EXPECT_NEAR(session().view().stereo().eye_distance, 0.0585, 1e-12);
}

}  // namespace
}  // namespace icome::ui
