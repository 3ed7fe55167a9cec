#include "ui/forms/operation_panel.h"

#include <QAction>
#include <QComboBox>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTest>

#include "places.h"
#include "ui/desktop_test.h"

namespace icome::ui {
namespace {

class OperationPanelTest : public DesktopTest {
 protected:
  OperationPanelTest()
      : panel_(session(), {.begin = [this] { return may_begin_; }, .closed = [this] { ++closed_; }},
               nullptr) {
    panel_.setAttribute(Qt::WA_DontShowOnScreen);
    panel_.resize(320, 600);
    panel_.show();
  }

  void ask(const char* name) {
    const auto operation = interaction::find_operation(name);
    ASSERT_TRUE(operation) << operation.error().message;
    panel_.ask(**operation);
    if (auto* shape = panel_.findChild<QComboBox*>("parameter.shape"))
      shape->setCurrentIndex(shape->findData("box"));
  }
  template <typename Widget>
  Widget& part(const char* name) {
    auto* found = panel_.findChild<Widget*>(QString("operation.") + name);
    EXPECT_TRUE(found) << name;
    return *found;
  }
  template <typename Widget>
  Widget& field(const char* parameter) {
    auto* found = panel_.findChild<Widget*>(QString("parameter.") + parameter);
    EXPECT_TRUE(found) << parameter;
    return *found;
  }
  void type(const char* parameter, const QString& text) {
    auto& line = field<QLineEdit>(parameter);
    line.setFocus();
    line.selectAll();
    QTest::keyClicks(&line, text);
  }
  /// What stands beneath a field.
  QString explanation() {
    for (const QLabel* label : panel_.findChildren<QLabel*>())
      if (label->isVisible() && label->accessibleName() == "Why something was refused") return label->text();
    return {};
  }
  QString note() { return part<QLabel>("note").text(); }
  const world::PhysicalObject* selected() {
    return session().selection().size() == 1 ? world().find(session().selection().front()) : nullptr;
  }

  bool may_begin_ = true;
  int closed_ = 0;
  OperationPanel panel_;
};

TEST_F(OperationPanelTest, NothingIsAskedToBeginWith) {
  EXPECT_FALSE(panel_.first_field());
  EXPECT_FALSE(part<QPushButton>("apply").isEnabled());
  panel_.apply();
  EXPECT_FALSE(session().history().can_undo());
}

TEST_F(OperationPanelTest, MakesWhatWasSaidInOneActionAndSelectsIt) {
  ask("create");
  EXPECT_EQ(part<QLabel>("title").text(), "Create");
  type("name", "seat");
  type("at", "150");
  part<QPushButton>("apply").click();
  EXPECT_EQ(note(), "");
  ASSERT_TRUE(selected());
  EXPECT_EQ(selected()->name, "seat");
  EXPECT_EQ(selected()->parent_from_object.translation(), base::Vector3(0.15, 0, 0));
  EXPECT_EQ(session().history().undo_name(), "Create");
  ASSERT_TRUE(session().history().undo());
  EXPECT_TRUE(world().objects().empty());
  EXPECT_FALSE(session().history().can_undo());
}

TEST_F(OperationPanelTest, SaysWhyNothingWasDone) {
  ask("delete");
  QTest::keyClick(&panel_, Qt::Key_Return, Qt::ControlModifier);
  part<QPushButton>("apply").click();
  EXPECT_TRUE(explanation().startsWith("'objects' is missing")) << explanation().toStdString();
  EXPECT_FALSE(session().history().can_undo());
  type("objects", "ghost");
  EXPECT_EQ(explanation(), "");
  part<QPushButton>("apply").click();
  EXPECT_TRUE(explanation().startsWith("there is no object named 'ghost'")) << explanation().toStdString();
  EXPECT_TRUE(field<QLineEdit>("objects").property("refused").toBool());
  EXPECT_FALSE(session().history().can_undo());
}

TEST_F(OperationPanelTest, DoesNothingOverWhatWasRefusedElsewhere) {
  ask("create");
  may_begin_ = false;
  panel_.apply();
  EXPECT_TRUE(world().objects().empty());
  may_begin_ = true;
  panel_.apply();
  EXPECT_EQ(world().objects().size(), 1U);
}

TEST_F(OperationPanelTest, FollowsSelectionAndNames) {
  ask("create");
  type("name", "seat");
  panel_.apply();
  ask("delete");
  EXPECT_EQ(field<QLineEdit>("objects").text(), "seat");
  const world::ObjectId seat = session().selection().front();
  perform(world::RenameObject{seat, "chair"});
  EXPECT_EQ(field<QLineEdit>("objects").text(), "chair");
  panel_.apply();
  EXPECT_TRUE(world().objects().empty());
  EXPECT_EQ(field<QLineEdit>("objects").text(), "");
  session().files().make_new();
  ASSERT_FALSE(session().history().can_undo());
}

TEST_F(OperationPanelTest, EscapeGivesUp) {
  ask("create");
  type("name", "seat");
  QTest::keyClick(&field<QLineEdit>("name"), Qt::Key_Escape);
  EXPECT_EQ(closed_, 1);
  part<QPushButton>("close").click();
  EXPECT_EQ(closed_, 2);
  EXPECT_TRUE(world().objects().empty());
}

TEST_F(OperationPanelTest, TakesThePictureOfAFile) {
  ask("create");
  type("name", "seat");
  part<QPushButton>("apply").click();
  ask("texture");
  auto& file = field<QLineEdit>("file");
  ASSERT_EQ(file.actions().size(), 1);
  file.actions().front()->trigger();
  auto* dialog = panel_.findChild<QFileDialog*>("browse");
  ASSERT_TRUE(dialog);
  const auto wood = places::project_folder() / "examples" / "wood.png";
  emit dialog->fileSelected(QString::fromStdString(wood.string()));
  auto& projection = field<QComboBox>("projection");
  projection.setCurrentIndex(projection.findData("own"));
  part<QPushButton>("apply").click();
  EXPECT_EQ(note(), "");
  EXPECT_EQ(world().textures().size(), 1U);
}

}  // namespace
}  // namespace icome::ui
