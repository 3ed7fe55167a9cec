#include "ui/cutout/cutout_window.h"

#include <QDockWidget>
#include <QInputDialog>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QPushButton>
#include <QStatusBar>
#include <QTest>
#include <QToolButton>
#include <QTreeWidget>
#include <fstream>

#include "ui/cutout/cutout_stage.h"
#include "ui/look/theme.h"

namespace icome::ui {
namespace {

class CutoutWindowTest : public CutoutStage {
 protected:
  void key(QWidget& to, int code, const QString& text = {}, Qt::KeyboardModifiers modifiers = {}) {
    QKeyEvent event(QEvent::KeyPress, code, modifiers, text);
    QCoreApplication::sendEvent(&to, &event);
  }
};

TEST_F(CutoutWindowTest, AnEmptyStageTellsHowToBegin) {
  EXPECT_EQ(window_->windowTitle(), "Untitled animation[*] - ICOME");
  EXPECT_FALSE(window_->isWindowModified());
  EXPECT_FALSE(action("edit.undo")->isEnabled());
}

TEST_F(CutoutWindowTest, ADragMovesTheCellUnderThePointerAndIsOneStepToUndo) {
  add_cell("boat");
  drag({640, 360}, {740, 320});
  const animation::Track& x = cell("boat").tracks[std::size_t(Channel::X)];
  ASSERT_EQ(x.size(), 1U);
  EXPECT_NEAR(x[0].value, 740, 1e-6);
  EXPECT_NEAR(shown("boat").place.y(), 320, 1e-6);
  EXPECT_TRUE(document().is_selected(cell("boat").id));
  action("edit.undo")->trigger();
  EXPECT_TRUE(cell("boat").tracks[std::size_t(Channel::X)].empty());
  EXPECT_NEAR(shown("boat").place.x(), 640, 1e-6);
  action("edit.redo")->trigger();
  EXPECT_NEAR(shown("boat").place.x(), 740, 1e-6);
}

TEST_F(CutoutWindowTest, AClickSelectsAndMovesNothing) {
  add_cell("boat");
  document().select({});
  click({640, 360});
  EXPECT_TRUE(document().is_selected(cell("boat").id));
  EXPECT_TRUE(cell("boat").tracks[std::size_t(Channel::X)].empty());
  click({50, 50});
  EXPECT_TRUE(document().selection().empty());
}

TEST_F(CutoutWindowTest, HandlesTurnScaleAndMoveThePivot) {
  document().select({add_cell("boat", 100, 60)});
  const auto frame = [&] { return *handle_frame(document(), stage().screen_from_stage()); };
  // A quarter turn, counter-clockwise: from above the pivot to the left of it.
  const QPointF middle = on_screen({640, 360});
  const QPointF above = frame().turn;
  const double reach = middle.y() - above.y();
  drag_on(stage(), above, middle - QPointF(reach, 0));
  EXPECT_NEAR(shown("boat").angle, M_PI / 2, 0.02);
  // A corner of the turned picture, drawn out to twice its distance.
  const QPointF corner = frame().corners[0];
  drag_on(stage(), corner, middle + 2.0 * (corner - middle));
  EXPECT_NEAR(shown("boat").scale, 2.0, 0.02);
  const auto before = *corners_of(document(), cell("boat").id);
  drag({640, 360}, {660, 390}, Qt::ControlModifier);
  const QPointF pivot = *frame().pivot;
  EXPECT_NEAR(pivot.x(), on_screen({660, 390}).x(), 0.5);
  const auto after = *corners_of(document(), cell("boat").id);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT((after[i] - before[i]).norm(), 1e-6) << i;
}

TEST_F(CutoutWindowTest, EscapeGivesUpADrag) {
  add_cell("boat");
  send_mouse(stage(), QEvent::MouseButtonPress, on_screen({640, 360}));
  send_mouse(stage(), QEvent::MouseMove, on_screen({700, 400}));
  EXPECT_NEAR(shown("boat").place.x(), 700, 1.0);
  key(stage(), Qt::Key_Escape);
  send_mouse(stage(), QEvent::MouseButtonRelease, on_screen({700, 400}));
  EXPECT_NEAR(shown("boat").place.x(), 640, 1e-9);
  EXPECT_TRUE(cell("boat").tracks[std::size_t(Channel::X)].empty());
}

TEST_F(CutoutWindowTest, ArrowKeysMoveByPixels) {
  add_cell("boat");
  document().select({cell("boat").id});
  key(stage(), Qt::Key_Right);
  key(stage(), Qt::Key_Up, {}, Qt::ShiftModifier);
  EXPECT_NEAR(shown("boat").place.x(), 641, 1e-9);
  EXPECT_NEAR(shown("boat").place.y(), 350, 1e-9);
}

TEST_F(CutoutWindowTest, AnArrowKeyThatIsHeldDownIsOneStepToUndo) {
  add_cell("boat");
  document().select({cell("boat").id});
  key(stage(), Qt::Key_Down);
  for (int i = 0; i < 3; ++i) {
    QKeyEvent press(QEvent::KeyPress, Qt::Key_Right, {}, {}, i > 0);
    QCoreApplication::sendEvent(&stage(), &press);
  }
  EXPECT_NEAR(shown("boat").place.x(), 643, 1e-9);
  document().undo();
  EXPECT_NEAR(shown("boat").place.x(), 640, 1e-9);
  EXPECT_NEAR(shown("boat").place.y(), 361, 1e-9) << "another press is another step";
  auto* const angle = window_->findChild<QLineEdit*>("cell.angle");
  angle->setFocus();
  for (int i = 0; i < 3; ++i) key(*angle, Qt::Key_Up);
  EXPECT_GT(shown("boat").angle, 0.0);
  document().undo();
  EXPECT_NEAR(shown("boat").angle, 0.0, 1e-12);
  EXPECT_NEAR(shown("boat").place.y(), 361, 1e-9);
}

TEST_F(CutoutWindowTest, UndoIsTheFieldsOwnOnlyUntilAValueIsEntered) {
  add_cell("boat");
  document().select({cell("boat").id});
  auto* const angle = window_->findChild<QLineEdit*>("cell.angle");
  angle->setFocus();
  const auto field_takes_undo = [&] {
    QKeyEvent event(QEvent::ShortcutOverride, Qt::Key_Z, Qt::ControlModifier);
    event.ignore();
    QCoreApplication::sendEvent(angle, &event);
    return event.isAccepted();
  };
  angle->selectAll();
  QTest::keyClicks(angle, "90");
  EXPECT_TRUE(field_takes_undo());
  key(*angle, Qt::Key_Return);
  EXPECT_NEAR(shown("boat").angle, M_PI / 2, 1e-12);
  EXPECT_FALSE(field_takes_undo());
  QTest::keyClick(angle, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_NEAR(shown("boat").angle, 0.0, 1e-12);
  EXPECT_TRUE(project().find("boat"));
}

TEST_F(CutoutWindowTest, CopiesAreSelectedAndLieBesideTheirCells) {
  add_cell("boat");
  add_cell("bird");
  document().select({cell("boat").id});
  document().go_to(5);
  drag({640, 360}, {700, 330});
  document().select({cell("boat").id, cell("bird").id});
  action("cell.duplicate")->trigger();
  ASSERT_EQ(project().cell_count(), 4U);
  ASSERT_EQ(document().selection().size(), 2U);
  for (const auto& [of, copy] :
       {std::pair("boat", document().selection()[0]), std::pair("bird", document().selection()[1])}) {
    EXPECT_NE(copy, cell(of).id);
    for (const int frame : {0, 5, 9}) {
      const animation::CellState one = animation::state_at(cell(of), frame);
      const animation::CellState other = animation::state_at(*project().find(copy), frame);
      EXPECT_NEAR(other.place.x() - one.place.x(), 12, 1e-9) << of << frame;
      EXPECT_NEAR(other.place.y() - one.place.y(), 12, 1e-9) << of << frame;
    }
  }
  document().undo();
  EXPECT_EQ(project().cell_count(), 2U) << "one step";
}

TEST_F(CutoutWindowTest, ConstraintsAreToldByTheNamesOfTheirCells) {
  add_cell("body", 200, 100, Qt::darkRed);
  add_cell("arm", 100, 30);
  document().select({cell("arm").id, cell("body").id});
  action("cell.join")->trigger();
  click({640, 360});
  EXPECT_EQ(window_->statusBar()->currentMessage(), "arm hangs on body.");
}

TEST_F(CutoutWindowTest, TheTabKeyStaysOutOfPanelsThatAreNotSeen) {
  add_cell("boat");
  document().select({cell("boat").id});
  ASSERT_TRUE(window_->table().visibleRegion().isEmpty());
  stage().setFocus();
  int passed = 0;
  for (int i = 0; i < 200; ++i) {
    QWidget* const focus = QApplication::focusWidget();
    ASSERT_TRUE(focus);
    ASSERT_FALSE(window_->table().isAncestorOf(focus)) << focus->objectName().toStdString();
    if (focus->objectName() == "cell.angle") ++passed;
    QTest::keyClick(focus, Qt::Key_Tab,
                    focus->inherits("QPlainTextEdit") ? Qt::ControlModifier : Qt::NoModifier);
  }
  EXPECT_GT(passed, 0) << "it goes round through those that are seen";
  window_->findChild<QDockWidget*>("dock.table")->raise();
  QCoreApplication::processEvents();
  EXPECT_TRUE(window_->findChild<QLineEdit*>("table.source")->isEnabled());
}

TEST_F(CutoutWindowTest, ItOpensNoLargerThanTheScreen) {
  CutoutWindow window(folder_.filePath("settings.conf"));
  window.show();
  const QSize room = window.screen()->availableSize();
  EXPECT_LE(window.height(), room.height());
  EXPECT_LE(window.width(), std::max(room.width(), window.minimumSizeHint().width()));
}

TEST_F(CutoutWindowTest, ASmallButtonWithTheFocusHasARing) {
  for (const Theme theme : {Theme::Dark, Theme::Light}) {
    apply_theme(application(), theme);
    auto* const button = window_->findChild<QToolButton*>("cells.add");
    const auto ringed = [&] {
      const QImage picture = button->grab().toImage();
      int count = 0;
      for (int x = 4; x < picture.width() - 4; ++x)
        for (const int y : {0, 1, 2}) {
          const QColor colour = picture.pixelColor(x, y);
          const QColor accent = colours().accent;
          if (std::abs(colour.red() - accent.red()) + std::abs(colour.green() - accent.green()) +
                  std::abs(colour.blue() - accent.blue()) <
              90) {
            ++count;
            break;
          }
        }
      return double(count) / std::max(1, picture.width() - 8);
    };
    stage().setFocus();
    EXPECT_LT(ringed(), 0.1);
    button->setFocus();
    EXPECT_GT(ringed(), 0.9);
  }
}

TEST_F(CutoutWindowTest, ASecondWindowOfAFileStandsWarned) {
  add_cell("boat");
  ASSERT_TRUE(document().save(file("r.cutout")));
  drag({640, 360}, {700, 300});
  const animation::Project saved_in_file = animation::read_project_file(file("r.cutout"))->as_saved.value();
  CutoutWindow second(folder_.filePath("second.conf"));
  second.show();
  second.open(file("r.cutout"));
  EXPECT_EQ(second.document().project(), saved_in_file) << "what the first has not saved is its own";
  EXPECT_FALSE(second.isWindowModified());
  QCoreApplication::processEvents();
  QStringList told;
  for (const QLabel* label : second.findChildren<QLabel*>())
    if (label->isVisible()) told << label->text();
  EXPECT_TRUE(
      told.contains("r.cutout is open in another window already. What is done here is not kept "
                    "against a crash, and saving asks first."))
      << told.join("\n").toStdString();
  second.close();
  window_.reset();
  open_window();
  window_->open(file("r.cutout"));
  EXPECT_TRUE(window_->isWindowModified()) << "the journal of the first was left to it";
}

TEST_F(CutoutWindowTest, WorkThatIsRecoveredIsToldWithTheNumberOfItsEdits) {
  add_cell("boat");
  ASSERT_TRUE(document().save(file("trip.cutout")));
  drag({640, 360}, {700, 300});
  drag({700, 300}, {720, 300});
  window_.reset();  // without being closed
  open_window();
  window_->open(file("trip.cutout"));
  EXPECT_TRUE(is_told("2 edits of trip.cutout were not saved when the program ended."));
  document().undo();
  EXPECT_TRUE(is_told("2 edits of trip.cutout"));
  action("file.save")->trigger();
  QCoreApplication::processEvents();
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  EXPECT_FALSE(is_told("2 edits of trip.cutout"));
}

TEST_F(CutoutWindowTest, WhatIsTypedWhenTheWindowIsClosedIsAskedForAndLeavesNothingBehind) {
  add_cell("boat");
  ASSERT_TRUE(document().save(file("trip.cutout")));
  document().select({cell("boat").id});
  auto* const angle = window_->findChild<QLineEdit*>("cell.angle");
  angle->setFocus();
  QTest::keyClicks(angle, "90");
  window_->close();
  auto* const box = window_->findChild<QMessageBox*>("cutout.save_changes");
  ASSERT_TRUE(box) << "what was typed would be lost";
  box->button(QMessageBox::Discard)->click();
  EXPECT_FALSE(window_->isVisible());
  EXPECT_FALSE(std::filesystem::exists(animation::journal_of(file("trip.cutout"))));
  window_.reset();
  EXPECT_EQ(kept_files(), 0);
}

TEST_F(CutoutWindowTest, AnAnimationThatIsSavedIsNoLongerKeptAsUnsaved) {
  add_cell("boat");
  EXPECT_EQ(kept_files(), 2);
  ASSERT_TRUE(document().save(file("trip.cutout")));
  EXPECT_EQ(kept_files(), 0);
  drag({640, 360}, {700, 300});
  EXPECT_EQ(kept_files(), 0);
}

/// Parts that are drawn anew make the picture that is drawn whole.
TEST_F(CutoutWindowTest, MovedCellsLeaveNothingBehindOnTheStage) {
  add_cell("sea", 900, 200, Qt::blue);
  add_cell("boat", 120, 70, Qt::darkRed);
  add_cell("bird", 60, 40, Qt::yellow);
  document().select({});
  (void)stage().grab();
  for (int step = 0; step < 12; ++step) {
    std::vector<animation::Hold> holds;
    for (const char* name : {"boat", "bird"}) {
      animation::Hold hold{.cell = cell(name).id, .wish = shown(name)};
      hold.wish.place += animation::Vector2(name[1] == 'o' ? 23.7 : -41.3, 9.1 * (step % 3));
      hold.wish.angle += 0.21;
      hold.wish.scale *= 1.03;
      holds.push_back(hold);
    }
    document().try_out(holds);
    const QImage moved = stage().grab().toImage();
    stage().refresh();
    const QImage whole = stage().grab().toImage();
    int differing = 0;
    for (int y = 0; y < whole.height(); ++y)
      for (int x = 0; x < whole.width(); ++x) {
        const QColor a = moved.pixelColor(x, y), b = whole.pixelColor(x, y);
        const int apart = std::max(
            {std::abs(a.red() - b.red()), std::abs(a.green() - b.green()), std::abs(a.blue() - b.blue())});
        if (apart > 2) ++differing;
      }
    ASSERT_EQ(differing, 0) << "step " << step;
  }
}

TEST_F(CutoutWindowTest, SpaceKeysThePoseAndGoesOn) {
  add_cell("boat");
  window_->look().step = 2;
  action("frame.pose")->trigger();
  EXPECT_EQ(document().frame(), 2);
  drag({640, 360}, {700, 360});
  action("frame.pose")->trigger();
  drag({700, 360}, {800, 360});
  EXPECT_EQ(document().frame(), 4);
  const animation::Track& x = cell("boat").tracks[std::size_t(Channel::X)];
  ASSERT_EQ(x.size(), 2U);
  EXPECT_EQ(x[0].frame, 2);
  EXPECT_NEAR(x[1].value, 800, 1.0);
  // It keys cells that hands have moved, too.
  animation::Hold hold{.cell = cell("boat").id, .wish = shown("boat")};
  hold.wish.place.x() = 900;
  document().try_out({hold});
  action("frame.pose")->trigger();
  EXPECT_NEAR(animation::state_at(cell("boat"), 4).place.x(), 900, 1e-9);
}

TEST_F(CutoutWindowTest, TheAnimationGrowsWherePosesGoBeyondItsEnd) {
  add_cell("boat");
  const int length = project().stage.length;
  document().go_to(length - 1);
  action("frame.pose")->trigger();
  EXPECT_EQ(project().stage.length, length + 1);
  EXPECT_EQ(document().frame(), length);
}

TEST_F(CutoutWindowTest, JointsAreKeptWhileACellIsDragged) {
  add_cell("body", 200, 100, Qt::darkRed);
  add_cell("arm", 100, 30);
  document().select({cell("arm").id});
  document().perform(cutout_command("rest", {{"cell", "arm"}, {"x", 760}, {"y", 360}}));
  ASSERT_TRUE(document().perform(
      cutout_command("join", {{"parent", "body"}, {"child", "arm"}, {"at", command_point({720, 360})}})));
  drag({640, 330}, {700, 430});
  const animation::Vector2 pin_on_body = animation::on_stage(cell("body"), shown("body"), {180, 50});
  const animation::Vector2 pin_on_arm = animation::on_stage(cell("arm"), shown("arm"), {10, 15});
  EXPECT_NEAR(shown("body").place.x(), 700, 1.0);
  EXPECT_LT((pin_on_body - pin_on_arm).norm(), 1e-6);
}

TEST_F(CutoutWindowTest, ConstraintsAreMadeByClicks) {
  add_cell("body", 200, 100, Qt::darkRed);
  add_cell("arm", 100, 30);
  document().select({cell("arm").id, cell("body").id});
  action("cell.join")->trigger();
  EXPECT_TRUE(stage().is_asking());
  click({640, 360});
  EXPECT_FALSE(stage().is_asking());
  ASSERT_EQ(project().constraints.size(), 1U);
  const auto* const joint = std::get_if<animation::Joint>(&project().constraints[0].what);
  ASSERT_TRUE(joint);
  EXPECT_EQ(joint->child, cell("arm").id);
  EXPECT_EQ(joint->parent, cell("body").id);
  document().select({cell("body").id});
  action("cell.path")->trigger();
  click({100, 100});
  click({900, 200});
  click({900, 600});
  key(stage(), Qt::Key_Return);
  ASSERT_EQ(project().constraints.size(), 2U);
  EXPECT_EQ(std::get<animation::PathGuide>(project().constraints[1].what).way.size(), 3U);
  action("cell.release")->trigger();
  EXPECT_TRUE(project().constraints.empty());
}

TEST_F(CutoutWindowTest, WhatIsSavedIsOpenedAgainWithNamesOfItsFolder) {
  add_cell("boat");
  drag({640, 360}, {700, 300});
  EXPECT_TRUE(window_->isWindowModified());
  ASSERT_TRUE(document().save(file("trip.cutout")));
  EXPECT_FALSE(window_->isWindowModified());
  EXPECT_EQ(cell("boat").pictures, std::vector<std::string>{"boat.png"});
  EXPECT_EQ(window_->windowTitle(), "trip.cutout[*] - ICOME");
  const animation::Project saved = project();
  open_window();
  window_->open(file("trip.cutout"));
  EXPECT_EQ(project(), saved);
  EXPECT_FALSE(window_->isWindowModified());
  EXPECT_TRUE(document().pictures().size("boat.png"));
}

TEST_F(CutoutWindowTest, WhatWasNotSavedIsThereAfterACrash) {
  add_cell("boat");
  ASSERT_TRUE(document().save(file("trip.cutout")));
  drag({640, 360}, {700, 300});
  const animation::Project lost = project();
  window_.reset();  // without being closed
  open_window();
  window_->open(file("trip.cutout"));
  EXPECT_EQ(project(), lost);
  EXPECT_TRUE(window_->isWindowModified());
}

TEST_F(CutoutWindowTest, AnAnimationThatWasNeverSavedIsKeptUntilItsWindowIsClosed) {
  EXPECT_FALSE(std::filesystem::exists(file("data")));
  add_cell("boat");
  const auto kept = [&] {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(file("data")))
      if (entry.path().extension() == ".cutout") found.push_back(entry.path());
    return found;
  };
  ASSERT_EQ(kept().size(), 1U);
  EXPECT_TRUE(lost_animations().empty());  // this program lives
  const animation::Project lost = project();
  window_.reset();
  // As one that a program which is gone has left: no process has so great a number.
  const auto left = kept().front().parent_path() / "999999999-1.cutout";
  std::filesystem::rename(animation::journal_of(kept().front()), animation::journal_of(left));
  std::filesystem::rename(kept().front(), left);
  ASSERT_EQ(lost_animations(), std::vector{left});
  open_window();
  window_->offer_lost();
  EXPECT_TRUE(is_told("never saved"));
  ASSERT_TRUE(document().recover(left));
  EXPECT_EQ(project(), lost);
  EXPECT_TRUE(window_->isWindowModified());
  ASSERT_TRUE(document().save(file("found.cutout")));
  EXPECT_TRUE(lost_animations().empty());
}

TEST_F(CutoutWindowTest, AFileThatIsNoAnimationIsToldByNameAndLine) {
  std::ofstream(file("broken.cutout")) << "[stage]\nwidth = \"wide\"\n";
  window_->open(file("broken.cutout"));
  EXPECT_TRUE(is_told("broken.cutout:"));
  EXPECT_EQ(project().cell_count(), 0U);
}

TEST_F(CutoutWindowTest, APictureThatIsMissingIsTold) {
  add_cell("boat");
  ASSERT_TRUE(document().save(file("trip.cutout")));
  window_->close();
  std::filesystem::remove(file("boat.png"));
  open_window();
  window_->open(file("trip.cutout"));
  EXPECT_TRUE(is_told("cannot be shown"));
}

TEST_F(CutoutWindowTest, ClosingAsksOnlyWhenSomethingWouldBeLost) {
  add_cell("boat");
  window_->close();
  auto* const box = window_->findChild<QMessageBox*>("cutout.save_changes");
  ASSERT_TRUE(box);
  EXPECT_TRUE(window_->isVisible());
  box->button(QMessageBox::Discard)->click();
  EXPECT_FALSE(window_->isVisible());
}

TEST_F(CutoutWindowTest, LayersAreRenamedHiddenAndLocked) {
  add_cell("boat");
  auto* const tree = window_->findChild<QTreeWidget*>("cells.tree");
  ASSERT_EQ(tree->topLevelItemCount(), 2);  // the layer, and the camera
  tree->topLevelItem(0)->setText(0, "sea");
  QCoreApplication::processEvents();
  EXPECT_EQ(project().layers[0].name, "sea");
  tree->topLevelItem(0)->setCheckState(2, Qt::Checked);
  QCoreApplication::processEvents();
  EXPECT_TRUE(project().layers[0].locked);
  drag({640, 360}, {700, 300});
  EXPECT_TRUE(cell("boat").tracks[std::size_t(Channel::X)].empty());
  tree->topLevelItem(0)->setCheckState(1, Qt::Unchecked);
  QCoreApplication::processEvents();
  EXPECT_FALSE(project().layers[0].visible);
}

TEST_F(CutoutWindowTest, ValuesOfTheCellSetKeysAtThePresentFrame) {
  add_cell("boat");
  document().select({cell("boat").id});
  document().go_to(12);
  auto* const angle = window_->findChild<QLineEdit*>("cell.angle");
  ASSERT_TRUE(angle);
  angle->setFocus();
  angle->setText("90");
  emit angle->textEdited("90");
  key(*angle, Qt::Key_Return);
  const animation::Key* const key_there =
      animation::key_at(cell("boat").tracks[std::size_t(Channel::Angle)], 12);
  ASSERT_TRUE(key_there);
  EXPECT_NEAR(key_there->value, M_PI / 2, 1e-12);
}

TEST_F(CutoutWindowTest, MarksAreWrittenAndTakenAway) {
  add_cell("boat");
  document().go_to(5);
  action("frame.mark")->trigger();
  auto* const dialog = window_->findChild<QInputDialog*>("cutout.mark");
  ASSERT_TRUE(dialog);
  dialog->setTextValue("O");
  dialog->accept();
  ASSERT_EQ(project().marks.size(), 1U);
  EXPECT_EQ(project().marks[0].frame, 5);
}

TEST_F(CutoutWindowTest, EveryActionIsInAMenuAndNoShortcutIsThereTwice) {
  std::map<QString, QString> shortcuts;
  int count = 0;
  const std::function<void(const QMenu&)> visit = [&](const QMenu& menu) {
    for (const QAction* it : menu.actions()) {
      if (it->menu()) {
        visit(*it->menu());
        continue;
      }
      if (it->isSeparator()) continue;
      ++count;
      EXPECT_FALSE(it->objectName().isEmpty()) << it->text().toStdString();
      for (const QKeySequence& keys : it->shortcuts()) {
        const QString text = keys.toString();
        EXPECT_FALSE(shortcuts.contains(text))
            << text.toStdString() << " of " << it->objectName().toStdString();
        shortcuts[text] = it->objectName();
      }
    }
  };
  for (const QAction* it : window_->menuBar()->actions()) visit(*it->menu());
  EXPECT_GT(count, 50);
}

TEST_F(CutoutWindowTest, EveryActionCanBeUsedAtAnyTime) {
  add_cell("boat");
  add_cell("sea", 400, 100, Qt::blue);
  const std::set<QString> elsewhere = {"file.new", "file.close"};
  for (QAction* it : window_->findChildren<QAction*>()) {
    if (it->objectName().isEmpty() || !it->objectName().contains('.') || elsewhere.contains(it->objectName()))
      continue;
    document().select({cell("boat").id});
    it->trigger();
    QCoreApplication::processEvents();
    window_->transport().stop();
    stage().back_out();
    for (QDialog* dialog : window_->findChildren<QDialog*>()) dialog->reject();
    QCoreApplication::processEvents();
    // Whatever it was can be taken back.
    while (document().project().find("boat") == nullptr && document().can_undo()) document().undo();
    ASSERT_TRUE(project().find("boat")) << it->objectName().toStdString();
  }
}

TEST_F(CutoutWindowTest, EveryControlHasANameForThoseWhoDoNotSeeIt) {
  for (const QWidget* widget : window_->findChildren<QWidget*>()) {
    if (widget->focusPolicy() == Qt::NoFocus || !widget->isVisible()) continue;
    const auto* const button = qobject_cast<const QAbstractButton*>(widget);
    const bool named = !widget->accessibleName().isEmpty() || (button && !button->text().isEmpty()) ||
                       widget->objectName().startsWith("qt_") || widget->inherits("QTabBar") ||
                       widget->inherits("QTabWidget");
    EXPECT_TRUE(named || widget->inherits("QScrollArea"))
        << widget->metaObject()->className() << " " << widget->objectName().toStdString();
  }
}

}  // namespace
}  // namespace icome::ui
