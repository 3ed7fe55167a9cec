#include "ui/forms/operation_preview.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTest>
#include <QTimer>
#include <thread>

#include "interaction/operations/operation_runner.h"
#include "ui/desktop_test.h"
#include "ui/forms/operation_panel.h"

namespace icome::ui {
namespace {

using base::Vector3;
using interaction::Operation;
using interaction::Value;
using world::ObjectId;

/// A panel as the window has one, and a box, which is selected.
class OperationPreviewTest : public DesktopTest {
 protected:
  OperationPreviewTest()
      : panel_(session(), {.begin = [this] { return may_begin_; }, .closed = [this] { ++closed_; }},
               nullptr) {
    panel_.setAttribute(Qt::WA_DontShowOnScreen);
    panel_.resize(320, 600);
    panel_.show();
    box_ = make("box");
    // So that there is something to redo.
    perform(world::RenameObject{box_, "crate"}, "Rename");
    EXPECT_TRUE(session().history().undo());
    session().select({box_});
    before_ = hash(world());
  }

  ObjectId make(const char* name) {
    const auto create = interaction::find_operation("create");
    const Value::Fields fields{{"shape", "box"}, {"name", name}};
    const auto plan = interaction::plan_operation(**create, fields, world(), session().ids());
    EXPECT_TRUE(plan) << plan.error().message;
    perform(plan->edit, "Create");
    return plan->objects.front();
  }
  void ask(const char* name) {
    const auto operation = interaction::find_operation(name);
    ASSERT_TRUE(operation) << operation.error().message;
    panel_.ask(**operation);
  }
  template <typename Widget>
  Widget& part(const char* name) {
    auto* found = panel_.findChild<Widget*>(name);
    EXPECT_TRUE(found) << name;
    return *found;
  }
  void type(const char* parameter, const QString& text) {
    auto& line = part<QLineEdit>(qPrintable(QString("parameter.%1").arg(parameter)));
    line.setFocus();
    line.selectAll();
    text.isEmpty() ? QTest::keyClick(&line, Qt::Key_Delete) : QTest::keyClicks(&line, text);
  }
  /// Waits until what was said last has been shown or refused.
  void settle() {
    QTimer& due = part<QTimer>("operation.due");
    EXPECT_TRUE(QTest::qWaitFor([&] { return !due.isActive(); }, 60'000));
  }
  Vector3 place(ObjectId id) { return world::world_from_object(world(), id).translation(); }
  QString foot() { return part<QLabel>("operation.note").text(); }
  QString close_text() { return part<QPushButton>("operation.close").text(); }
  /// What stands beneath fields.
  QString explanation() {
    for (const QLabel* label : panel_.findChildren<QLabel*>())
      if (label->isVisible() && label->objectName() != "operation.note" &&
          label->accessibleName() == "Why something was refused")
        return label->text();
    return {};
  }
  void expect_as_before() {
    EXPECT_EQ(hash(world()), before_);
    EXPECT_EQ(session().selection(), std::vector{box_});
    EXPECT_EQ(session().history().undo_name(), "Create");
    EXPECT_EQ(session().history().redo_name(), "Rename");
    EXPECT_FALSE(session().history().trying());
  }

  bool may_begin_ = true;
  int closed_ = 0;
  OperationPanel panel_;
  ObjectId box_;
  std::uint64_t before_ = 0;
};

TEST_F(OperationPreviewTest, FollowsWhatIsTypedAndIsTakenBackByEscape) {
  ask("move");
  type("by", "5");
  settle();
  EXPECT_EQ(place(box_), Vector3(0.005, 0, 0));
  EXPECT_EQ(close_text(), "&Cancel");
  QTest::keyClicks(&part<QLineEdit>("parameter.by"), "0");
  settle();
  EXPECT_EQ(place(box_), Vector3(0.05, 0, 0));
  QTest::keyClick(&panel_, Qt::Key_Escape);
  EXPECT_EQ(closed_, 1);
  expect_as_before();
  EXPECT_EQ(close_text(), "&Close");
}

TEST_F(OperationPreviewTest, ApplyKeepsItAsOneAction) {
  ask("create");
  settle();
  EXPECT_EQ(world().objects().size(), 2U);
  EXPECT_EQ(session().selection(), std::vector{box_});
  type("name", "seat");
  settle();
  type("at", "150");
  part<QPushButton>("operation.apply").click();
  ASSERT_EQ(world().objects().size(), 2U);
  ASSERT_EQ(session().selection().size(), 1U);
  const ObjectId seat = session().selection().front();
  EXPECT_EQ(world().find(seat)->name, "seat");
  EXPECT_EQ(place(seat), Vector3(0.15, 0, 0));
  EXPECT_FALSE(session().history().can_redo());
  // Nothing more comes by itself.
  session().select({box_});
  settle();
  EXPECT_EQ(world().objects().size(), 2U);
  ASSERT_TRUE(session().history().undo());
  EXPECT_EQ(hash(world()), before_);
  EXPECT_EQ(session().history().undo_name(), "Create");
}

TEST_F(OperationPreviewTest, WhatIsWrongIsExplainedAtItsFieldAndTakesItBack) {
  ask("repeat");
  type("move", "200");
  settle();
  EXPECT_EQ(explanation(), "") << "nobody has said how many yet";
  expect_as_before();
  type("count", "2");
  settle();
  EXPECT_EQ(world().objects().size(), 3U);
  type("count", "0");
  settle();
  EXPECT_TRUE(explanation().startsWith("'count' must be")) << explanation().toStdString();
  EXPECT_TRUE(part<QLineEdit>("parameter.count").property("refused").toBool());
  expect_as_before();
  type("count", "3");
  EXPECT_EQ(explanation(), "");
  settle();
  EXPECT_EQ(world().objects().size(), 4U);
  type("count", "three");
  settle();
  EXPECT_TRUE(explanation().startsWith("'count': ")) << explanation().toStdString();
  expect_as_before();
  type("count", "");
  settle();
  EXPECT_EQ(explanation(), "");
  expect_as_before();
}

TEST_F(OperationPreviewTest, WhatAnOperationRefusesIsTold) {
  // A box is no mesh.
  ask("subdivide");
  settle();
  EXPECT_FALSE(foot().isEmpty());
  expect_as_before();
  part<QCheckBox>("parameter.as_mesh").setChecked(true);
  settle();
  EXPECT_EQ(foot(), "");
  EXPECT_TRUE(session().history().trying());
  part<QPushButton>("operation.close").click();
  expect_as_before();
}

TEST_F(OperationPreviewTest, GoesOnWithWhatIsSelectedButNotWithWhatItMadeItself) {
  const ObjectId other = make("other");
  session().select({box_});
  ask("copy");
  type("by", "100");
  settle();
  ASSERT_EQ(world().roots().size(), 3U);
  const ObjectId made = world().roots().back();
  EXPECT_EQ(place(made), Vector3(0.1, 0, 0));
  session().select({made});
  settle();
  EXPECT_EQ(part<QLineEdit>("parameter.object").text(), "box");
  EXPECT_TRUE(world().find(made));
  session().select({other});
  settle();
  EXPECT_EQ(part<QLineEdit>("parameter.object").text(), "other");
  ASSERT_EQ(world().roots().size(), 3U);
  EXPECT_TRUE(world().find(world().roots().back())->name.starts_with("other"));
  part<QPushButton>("operation.close").click();
  EXPECT_EQ(world().roots().size(), 2U);
  EXPECT_EQ(session().selection(), std::vector{other});
}

TEST_F(OperationPreviewTest, OfDeletingBringsBackWhatWasSelected) {
  ask("delete");
  settle();
  EXPECT_TRUE(world().objects().empty());
  EXPECT_EQ(part<QLineEdit>("parameter.objects").text(), "box");
  part<QPushButton>("operation.close").click();
  expect_as_before();
  ask("delete");
  settle();
  part<QPushButton>("operation.apply").click();
  EXPECT_TRUE(world().objects().empty());
  EXPECT_EQ(part<QLineEdit>("parameter.objects").text(), "");
}

TEST_F(OperationPreviewTest, AnotherEditKeepsIt) {
  ask("move");
  type("by", "5");
  settle();
  perform(world::RenameObject{box_, "chest"}, "Rename");
  EXPECT_TRUE(foot().startsWith("It stays")) << foot().toStdString();
  EXPECT_EQ(close_text(), "&Close");
  settle();
  QTest::keyClick(&panel_, Qt::Key_Escape);
  EXPECT_EQ(place(box_), Vector3(0.005, 0, 0));
  EXPECT_EQ(world().find(box_)->name, "chest");
  EXPECT_EQ(session().history().undo_name(), "Rename");
  ASSERT_TRUE(session().history().undo());
  EXPECT_EQ(session().history().undo_name(), "Move");
  ASSERT_TRUE(session().history().undo());
  EXPECT_EQ(hash(world()), before_);
}

TEST_F(OperationPreviewTest, UndoingTakesItBackAlone) {
  ask("move");
  type("by", "5");
  settle();
  ASSERT_TRUE(session().history().undo());
  settle();
  EXPECT_EQ(hash(world()), before_);
  EXPECT_EQ(session().history().undo_name(), "Create");
  EXPECT_EQ(session().history().redo_name(), "Move");
  EXPECT_EQ(close_text(), "&Close");
  // Until something else is said.
  type("by", "6");
  settle();
  EXPECT_EQ(place(box_), Vector3(0.006, 0, 0));
  part<QPushButton>("operation.close").click();
  EXPECT_EQ(session().history().redo_name(), "Move");
}

TEST_F(OperationPreviewTest, GoesWithItsDesign) {
  ask("move");
  type("by", "5");
  settle();
  session().files().make_new();
  settle();
  EXPECT_TRUE(world().objects().empty());
  EXPECT_EQ(close_text(), "&Close");
  EXPECT_EQ(foot(), "");
  panel_.leave();
  EXPECT_FALSE(session().history().can_undo());
}

TEST_F(OperationPreviewTest, StaysWhenItIsSavedAndGoesWhenItIsLeft) {
  ask("move");
  type("by", "5");
  settle();
  panel_.keep();
  panel_.leave();
  EXPECT_EQ(place(box_), Vector3(0.005, 0, 0));
  type("by", "6");
  settle();
  EXPECT_EQ(place(box_), Vector3(0.011, 0, 0));
  panel_.leave();
  EXPECT_EQ(place(box_), Vector3(0.005, 0, 0));
  ask("move");
  type("by", "7");
  settle();
  ask("turn");
  EXPECT_EQ(place(box_), Vector3(0.005, 0, 0));
}

TEST_F(OperationPreviewTest, IsNotShownToWhoDoesNotWantIt) {
  auto& wanted = part<QCheckBox>("operation.preview");
  EXPECT_TRUE(wanted.isChecked());
  ask("move");
  type("by", "5");
  settle();
  wanted.setChecked(false);
  expect_as_before();
  type("by", "6");
  settle();
  expect_as_before();
  wanted.setChecked(true);
  settle();
  EXPECT_EQ(place(box_), Vector3(0.006, 0, 0));
  wanted.setChecked(false);
  part<QPushButton>("operation.apply").click();
  EXPECT_EQ(place(box_), Vector3(0.006, 0, 0));
  EXPECT_EQ(session().history().undo_name(), "Move");
}

TEST_F(OperationPreviewTest, DoesNotBeginOverWhatWasRefusedElsewhere) {
  may_begin_ = false;
  ask("move");
  type("by", "5");
  settle();
  expect_as_before();
}

TEST_F(OperationPreviewTest, TellsWhatAnOperationRemarks) {
  ask("clone");
  settle();
  part<QPushButton>("operation.apply").click();
  session().select({box_});
  ask("reshape");
  type("size", "300");
  settle();
  EXPECT_TRUE(foot().contains("2 objects")) << foot().toStdString();
  part<QPushButton>("operation.apply").click();
  EXPECT_TRUE(foot().contains("2 objects")) << foot().toStdString();
}

TEST_F(OperationPreviewTest, WhatWasRemarkedIsOverWhenSomethingElseIsGoneOnWith) {
  const ObjectId other = make("other");
  session().select({box_});
  ask("clone");
  settle();
  part<QPushButton>("operation.apply").click();
  session().select({box_});
  ask("reshape");
  const auto reshape = [&](const char* size) {
    type("size", size);
    settle();
    part<QPushButton>("operation.apply").click();
    EXPECT_TRUE(panel_.remark().contains("2 objects")) << panel_.remark().toStdString();
  };
  reshape("300");
  session().select({other});
  EXPECT_EQ(panel_.remark(), "");
  session().select({box_});
  reshape("400");
  ASSERT_TRUE(session().history().undo());
  EXPECT_EQ(panel_.remark(), "") << "though no object has changed but its shape";
  reshape("500");
  panel_.forget_remark();
  EXPECT_EQ(panel_.remark(), "");
  type("size", "600");
  settle();
  panel_.forget_remark();
  EXPECT_TRUE(panel_.remark().contains("2 objects")) << "of what is only shown it stays";
}

int slow_runs = 0;
std::chrono::milliseconds slowness{0};

/// Moves a box as far as is said, in its own time.
const Operation& slow_operation() {
  static const Operation kOperation{
      .name = "slow",
      .title = "Slow",
      .group = {},
      .summary = {},
      .parameters = {{.name = "far", .meaning = "m", .required = true}},
      .plan = [](const world::World& world, const interaction::Arguments& arguments,
                 world::IdSource&) -> base::Result<interaction::Plan> {
        ++slow_runs;
        std::this_thread::sleep_for(slowness);
        const world::Affine3 there(Eigen::Translation3d(arguments.number("far"), 0, 0));
        return interaction::Plan{world::PlaceObject{world.roots().front(), there}};
      }};
  return kOperation;
}

TEST_F(OperationPreviewTest, OfASlowOperationWaitsForAPauseInTyping) {
  constexpr int kAtOnce = 20, kPause = 300;  // ms
  QTimer& due = part<QTimer>("operation.due");
  slow_runs = 0;
  slowness = std::chrono::milliseconds(150);
  panel_.ask(slow_operation());
  type("far", "1");
  EXPECT_LT(due.interval(), kAtOnce);
  settle();
  EXPECT_EQ(slow_runs, 1);
  QTest::keyClicks(&part<QLineEdit>("parameter.far"), "0");
  EXPECT_GT(due.interval(), kPause);
  QTest::keyClicks(&part<QLineEdit>("parameter.far"), "00");
  EXPECT_GT(due.interval(), kPause);
  slowness = {};
  settle();
  EXPECT_EQ(slow_runs, 2);
  EXPECT_EQ(place(box_), Vector3(1, 0, 0));
  QTest::keyClicks(&part<QLineEdit>("parameter.far"), "0");
  EXPECT_LT(due.interval(), kAtOnce);
  panel_.leave();
  expect_as_before();
}

}  // namespace
}  // namespace icome::ui
