#include "ui/sketch/sketch_window.h"

#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QTemporaryDir>
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

  QTemporaryDir folder_;
};

TEST_F(SketchWindowTest, WhatIsSavedIsOpenedAgain) {
  draw_line();
  EXPECT_TRUE(window_->isWindowModified());
  ASSERT_TRUE(document().save(file("drawing.svg")));
  EXPECT_FALSE(window_->isWindowModified());
  EXPECT_EQ(window_->windowTitle(), "drawing.svg[*] - ICOME");
  const drawing::Curve drawn = strokes()[0]->curve;
  SketchWindow other;
  other.open(file("drawing.svg"));
  ASSERT_EQ(other.document().drawing().stroke_count(), 1U);
  const drawing::Curve& read = other.document().drawing().layers[0].strokes[0]->curve;
  ASSERT_EQ(read.segments.size(), drawn.segments.size());
  EXPECT_LT((read.at(0.5) - drawn.at(0.5)).norm(), 1e-9);
  EXPECT_FALSE(other.isWindowModified());
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
