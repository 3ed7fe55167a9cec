#include "ui/sketch/sketch_window.h"

#include <QDockWidget>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <QToolButton>
#include <QTreeWidget>
#include <fstream>

#include "ui/sketch/sketch_hands.h"

namespace icome::ui {
namespace {

class SketchWindowTest : public SketchHands {
 protected:
  QAction* action(const char* name) {
    auto* const found = window_->findChild<QAction*>(name);
    EXPECT_TRUE(found) << name;
    return found;
  }
  std::filesystem::path file(const char* name) const { return folder_.filePath(name).toStdString(); }
  void draw_line() { mouse({{50.0, 50.0}, {100.0, 55.0}, {150.0, 50.0}}); }
};

TEST_F(SketchWindowTest, WhatIsSavedIsOpenedAgain) {
  draw_line();
  EXPECT_TRUE(window_->isWindowModified());
  ASSERT_TRUE(document().save(file("drawing.svg")));
  EXPECT_FALSE(window_->isWindowModified());
  EXPECT_EQ(window_->windowTitle(), "drawing.svg[*] - ICOME");
  const drawing::Curve drawn = strokes()[0]->curve;
  SketchWindow other(settings_file());
  other.open(file("drawing.svg"));
  ASSERT_EQ(other.document().drawing().stroke_count(), 1U);
  const drawing::Curve& read = other.document().drawing().layers[0].strokes[0]->curve;
  ASSERT_EQ(read.segments.size(), drawn.segments.size());
  EXPECT_LT((read.at(0.5) - drawn.at(0.5)).norm(), 1e-9);
  EXPECT_FALSE(other.isWindowModified());
}

TEST_F(SketchWindowTest, ChoicesAndPanelsAreAsTheLastWindowLeftThem) {
  SketchLook& look = window_->look();
  look.colour = {1.0F, 0.0F, 0.0F};
  look.opacity = 0.25;
  look.tip = {.thinnest = 0.0005, .widest = 0.004};
  look.pressure = {.lightest = 0.2, .middle = 0.3, .hardest = 0.9};
  look.ends = drawing::CurveEnds::Flat;
  look.whole_strokes = look.onion = true;
  look.predict = false;
  window_->findChild<QDockWidget*>("dock.layers")->hide();
  window_.reset();
  SketchWindow next(settings_file());
  next.show();
  EXPECT_EQ(next.look().colour, (drawing::Colour{1.0F, 0.0F, 0.0F}));
  EXPECT_EQ(next.look().opacity, 0.25);
  EXPECT_EQ(next.look().tip.thinnest, 0.0005);
  EXPECT_EQ(next.look().tip.widest, 0.004);
  EXPECT_NEAR(next.look().pressure(0.5), 0.3, 1e-12);
  EXPECT_EQ(next.look().ends, drawing::CurveEnds::Flat);
  EXPECT_TRUE(next.look().whole_strokes && next.look().onion && !next.look().predict);
  EXPECT_TRUE(next.findChild<QAction*>("view.onion")->isChecked());
  EXPECT_FALSE(next.findChild<QAction*>("view.predict")->isChecked());
  EXPECT_TRUE(next.findChild<QDockWidget*>("dock.layers")->isHidden());
}

TEST_F(SketchWindowTest, SettingsThatMakeNoSenseAreLeft) {
  {
    QSettings wrong(settings_file(), QSettings::IniFormat);
    wrong.beginGroup("drawing");
    for (const char* name : {"colour", "fill", "opacity", "thinnest", "widest", "eraser_radius"})
      wrong.setValue(name, "nan");
    wrong.setValue("hardest", 7);
    wrong.setValue("middle", -1);
    wrong.setValue("window/state", QByteArray("state"));
  }
  SketchWindow next(settings_file());
  const SketchLook usual;
  EXPECT_EQ(next.look().opacity, usual.opacity);
  EXPECT_EQ(next.look().tip.widest, usual.tip.widest);
  EXPECT_EQ(next.look().eraser_radius, usual.eraser_radius);
  EXPECT_EQ(next.look().pressure(0.5), usual.pressure(0.5));
  EXPECT_EQ(next.look().pressure(1.0), 1.0);
  EXPECT_EQ(next.look().colour, usual.colour);
}

TEST_F(SketchWindowTest, UndoComesBackToWhatWasSaved) {
  draw_line();
  ASSERT_TRUE(document().save(file("drawing.svg")));
  action("edit.undo")->trigger();
  EXPECT_TRUE(window_->isWindowModified());
  action("edit.redo")->trigger();
  EXPECT_FALSE(window_->isWindowModified());
  EXPECT_FALSE(action("edit.redo")->isEnabled());
}

TEST_F(SketchWindowTest, AFileThatIsNoDrawingIsToldByName) {
  std::ofstream(file("broken.svg")) << "<svg";
  window_->open(file("broken.svg"));
  bool told = false;
  for (const QLabel* label : window_->findChildren<QLabel*>())
    told = told || label->text().contains("broken.svg");
  EXPECT_TRUE(told);
  EXPECT_EQ(document().drawing().stroke_count(), 0U);
}

TEST_F(SketchWindowTest, ARecordingIsOpenedAsADrawingThatHasNoFileYet) {
  std::ofstream(file("pen.csv")) << "t,x,y,pressure\n0,10,10,1\n0.01,20,12,1\n0.02,30,10,1\n";
  window_->open(file("pen.csv"));
  EXPECT_EQ(document().drawing().stroke_count(), 1U);
  EXPECT_TRUE(window_->isWindowModified());
  EXPECT_TRUE(document().file().empty());
}

TEST_F(SketchWindowTest, ClosingAsksOnlyWhenSomethingWouldBeLost) {
  draw_line();
  window_->close();
  auto* const box = window_->findChild<QMessageBox*>("sketch.save_changes");
  ASSERT_TRUE(box);
  EXPECT_TRUE(window_->isVisible());
  box->button(QMessageBox::Discard)->click();
  EXPECT_FALSE(window_->isVisible());
}

TEST_F(SketchWindowTest, AllThatIsSelectedGetsTheColourOfThePen) {
  draw_line();
  action("edit.select_all")->trigger();
  action("edit.duplicate")->trigger();
  EXPECT_EQ(strokes().size(), 2U);
  action("edit.delete")->trigger();
  EXPECT_EQ(strokes().size(), 1U);
  EXPECT_FALSE(action("edit.delete")->isEnabled());
}

TEST_F(SketchWindowTest, LayersAreAddedHiddenAndDeleted) {
  draw_line();
  auto* const tree = window_->findChild<QTreeWidget*>("layers.tree");
  window_->findChild<QToolButton*>("layers.add")->click();
  ASSERT_EQ(tree->topLevelItemCount(), 2);
  draw_line();
  EXPECT_EQ(document().drawing().layers[1].strokes.size(), 1U);
  tree->topLevelItem(0)->setCheckState(1, Qt::Unchecked);
  QCoreApplication::processEvents();
  EXPECT_FALSE(document().drawing().layers[1].visible);
  tree->topLevelItem(0)->setText(0, "Ink");
  QCoreApplication::processEvents();
  EXPECT_EQ(document().drawing().layers[1].name, "Ink");
  window_->findChild<QToolButton*>("layers.down")->click();
  EXPECT_EQ(document().drawing().layers[0].name, "Ink");
  window_->findChild<QToolButton*>("layers.delete")->click();
  EXPECT_EQ(tree->topLevelItemCount(), 1);
  EXPECT_EQ(strokes().size(), 1U);
}

TEST_F(SketchWindowTest, EveryControlHasANameForThoseWhoDoNotSeeIt) {
  for (const QWidget* widget : window_->findChildren<QWidget*>()) {
    if (widget->focusPolicy() == Qt::NoFocus || !widget->isVisible()) continue;
    const auto* const button = qobject_cast<const QAbstractButton*>(widget);
    const bool named = !widget->accessibleName().isEmpty() || (button && !button->text().isEmpty()) ||
                       widget->objectName().startsWith("qt_");
    EXPECT_TRUE(named || widget->inherits("QScrollArea"))
        << widget->metaObject()->className() << " " << widget->objectName().toStdString();
  }
}

}  // namespace
}  // namespace icome::ui
