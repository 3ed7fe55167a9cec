// How things move, as the menu sets it and the settings keep it.
#include "ui/actions/move_actions.h"

#include <QDialog>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "ui/desktop_test.h"
#include "ui/forms/quantity_field.h"

namespace icome::ui {
namespace {

class MoveActionsTest : public DesktopTest {
 protected:
  /// The menu of a program that has just begun.
  void begin() {
    window_ = std::make_unique<QWidget>();
    menu_ = std::make_unique<QMenu>();
    actions_ = std::make_unique<MoveActions>(session(), settings_);
    actions_->fill(*menu_, *window_);
  }
  void trigger(const char* name) {
    auto* action = menu_->findChild<QAction*>(name);
    ASSERT_TRUE(action) << name;
    action->trigger();
  }
  /// Types into a field of the dialog.
  void type(const char* name, const QString& text) {
    auto* field = window_->findChild<QuantityField*>(name);
    ASSERT_TRUE(field) << name;
    field->selectAll();
    QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
  }
  const session::GrabSettings& grab() { return session().hands().grab(); }

  QTemporaryDir folder_;
  QSettings settings_{folder_.filePath("icome.conf"), QSettings::IniFormat};
  std::unique_ptr<QWidget> window_;
  std::unique_ptr<QMenu> menu_;
  std::unique_ptr<MoveActions> actions_;
};

TEST_F(MoveActionsTest, BeginsWithStopsAndWithoutSnaps) {
  begin();
  EXPECT_TRUE(grab().stop);
  EXPECT_TRUE(grab().pull_back);
  EXPECT_FALSE(grab().snaps.any());
  EXPECT_EQ(grab().weight, 0.0);
}

TEST_F(MoveActionsTest, KeepsWhatIsSwitched) {
  begin();
  trigger("move.stop");
  trigger("move.snap_edges");
  for (int run = 0; run < 2; ++run) {
    EXPECT_FALSE(grab().stop);
    EXPECT_TRUE(grab().snaps.edges && grab().snaps.middles);
    EXPECT_FALSE(grab().snaps.vertices || grab().snaps.faces || grab().snaps.grid);
    session().hands().set_grab({});
    begin();
  }
  EXPECT_FALSE(menu_->findChild<QAction*>("move.stop")->isChecked());
}

TEST_F(MoveActionsTest, TakesDistancesAndForcesThatMakeSense) {
  begin();
  trigger("move.numbers");
  type("move.grid_spacing", "2.5 cm");
  type("move.snap_radius", "4");
  type("move.snap_strength", "1.5");
  type("move.weight", "300 mN");
  type("move.weight", "-1");
  type("move.snap_radius", "0");
  for (int run = 0; run < 2; ++run) {
    EXPECT_NEAR(grab().snaps.spacing, 0.025, 1e-12);
    EXPECT_NEAR(grab().snaps.radius, 0.004, 1e-12);
    EXPECT_EQ(grab().snap_strength, 1.5);
    EXPECT_NEAR(grab().weight, 0.3, 1e-12);
    session().hands().set_grab({});
    begin();
  }
}

TEST_F(MoveActionsTest, PassesOverSettingsThatAreNone) {
  for (const char* bad : {"nan", "-5", "1e99", "wide"}) {
    settings_.setValue("move.grid_spacing", bad);
    settings_.setValue("move.weight", bad);
    begin();
    EXPECT_EQ(grab().snaps.spacing, 0.01) << bad;
    EXPECT_EQ(grab().weight, 0.0) << bad;
  }
}

}  // namespace
}  // namespace icome::ui
