#include "ui/window/command_palette.h"

#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QTest>
#include <QTreeWidget>

#include "ui/actions/actions.h"
#include "ui/desktop_test.h"

namespace icome::ui {
namespace {

class CommandPaletteTest : public ::testing::Test {
 protected:
  CommandPaletteTest() : bar_((application(), nullptr)) {
    QMenu* edit = bar_.addMenu("&Edit");
    add_action(*edit, "edit.delete", "De&lete", QKeySequence::Delete, [this] { done_ << "delete"; });
    edit->addSeparator();
    QMenu* group = bar_.addMenu("&Model")->addMenu("A&rrange");
    add_action(*group, "model.move", "&Move…", {}, [this] {
      done_ << "move";
    })->setStatusTip("Shifts objects along the axes.");
    add_action(*group, "model.take-apart", "R&&D", {}, [this] {
      done_ << "take-apart";
    })->setStatusTip("Undoes what combine did.");
    add_action(*group, "model.off", "Off", {}, [this] { done_ << "off"; })->setEnabled(false);
    palette_ = std::make_unique<CommandPalette>(commands_of(bar_), nullptr);
    palette_->setAttribute(Qt::WA_DontShowOnScreen);
    palette_->show();
  }

  QLineEdit& field() { return *palette_->findChild<QLineEdit*>("palette.field"); }
  QStringList shown() {
    QStringList titles;
    auto* list = palette_->findChild<QTreeWidget*>("palette.list");
    for (int i = 0; i < list->topLevelItemCount(); ++i) titles << list->topLevelItem(i)->text(0);
    return titles;
  }

  QStringList done_;
  QMenuBar bar_;
  std::unique_ptr<CommandPalette> palette_;
};

TEST_F(CommandPaletteTest, FindsByTitleNamePlaceAndSummary) {
  EXPECT_EQ(shown(), (QStringList{"Delete", "Move", "R&D", "Off"}));
  field().setText("mov");
  EXPECT_EQ(shown(), QStringList{"Move"});
  field().setText("apart");
  EXPECT_EQ(shown(), QStringList{"R&D"});
  field().setText("shifts along");
  EXPECT_EQ(shown(), QStringList{"Move"});
  field().setText("edit");
  EXPECT_EQ(shown(), QStringList{"Delete"});
  field().setText("rubbish");
  EXPECT_EQ(shown(), QStringList());
  // Its title comes before those that only tell of it.
  field().setText("d");
  EXPECT_EQ(shown().front(), "Delete");
}

TEST_F(CommandPaletteTest, DoesWhatIsChosenByKeys) {
  QTest::keyClick(&field(), Qt::Key_Down);
  QTest::keyClick(&field(), Qt::Key_Return);
  EXPECT_EQ(done_, QStringList{"move"});
  EXPECT_FALSE(palette_->isVisible());
}

TEST_F(CommandPaletteTest, WhatCannotBeDoneNowIsNotDone) {
  field().setText("off");
  ASSERT_EQ(shown(), QStringList{"Off"});
  QTest::keyClick(&field(), Qt::Key_Return);
  EXPECT_TRUE(done_.isEmpty());
  EXPECT_TRUE(palette_->isVisible());
}

TEST_F(CommandPaletteTest, AnEntryThatIsGoneIsNoLongerFound) {
  delete bar_.actions().front()->menu()->actions().front();
  field().setText("delete");
  EXPECT_EQ(shown(), QStringList());
}

}  // namespace
}  // namespace icome::ui
