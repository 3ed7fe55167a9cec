// The whole window, where there is no OpenGL: all but the picture of the scene.
#include "ui/window/main_window.h"

#include <QComboBox>
#include <QDropEvent>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QPushButton>
#include <QTest>
#include <QTreeView>
#include <thread>

#include "places.h"
#include "ui/window/scene_window.h"
#include "ui/window_test.h"
#include "world/motion.h"
#include "world/sample_world.h"

namespace icome::ui {
namespace {

class MainWindowTest : public WindowTest {};

TEST_F(MainWindowTest, SaysWhyThereIsNoPictureAndWorksOn) {
  auto* reason = window_->findChild<QLabel*>("scene.reason");
  ASSERT_TRUE(reason);
  ASSERT_TRUE(until([&] { return reason->isVisible(); }));
  EXPECT_TRUE(reason->text().contains("OpenGL 3.3"));
  window_->findChild<QPushButton*>("scene.retry")->click();
  ASSERT_TRUE(until([&] { return reason->isVisible(); }));
  add("leg");
  EXPECT_TRUE(until_title("Untitled* - ICOME"));
}

TEST_F(MainWindowTest, NamesWhatCanBeUndone) {
  EXPECT_FALSE(action("edit.undo")->isEnabled());
  add("R&D leg");
  ASSERT_TRUE(until([&] { return action("edit.undo")->isEnabled(); }));
  EXPECT_EQ(action("edit.undo")->text(), "&Undo Add R&&D leg");
  action("edit.undo")->trigger();
  EXPECT_TRUE(world().objects().empty());
  ASSERT_TRUE(until([&] { return action("edit.redo")->isEnabled(); }));
  action("edit.redo")->trigger();
  EXPECT_EQ(world().objects().size(), 1U);
}

TEST_F(MainWindowTest, WhatIsSelectedCanBeDeletedAtOnce) {
  session().select({add("one")});
  action("edit.delete")->trigger();
  EXPECT_TRUE(world().objects().empty());
}

TEST_F(MainWindowTest, DeletesAndDuplicatesAsOneAction) {
  const auto table = add("table"), lamp = add("lamp");
  session().select({table, lamp});
  ASSERT_TRUE(until([&] { return action("edit.duplicate")->isEnabled(); }));
  action("edit.duplicate")->trigger();
  EXPECT_EQ(world().objects().size(), 4U);
  EXPECT_EQ(session().selection().size(), 2U);
  EXPECT_EQ(session().history().undo_name(), "Duplicate 2 objects");
  ASSERT_TRUE(session().history().undo());
  EXPECT_EQ(world().objects().size(), 2U);
  session().select({table, lamp});
  action("edit.delete")->trigger();
  EXPECT_TRUE(world().objects().empty());
  ASSERT_TRUE(session().history().undo());
  EXPECT_EQ(world().objects().size(), 2U);
}

TEST_F(MainWindowTest, EveryOperationIsInAMenuOnce) {
  for (const interaction::Operation& operation : interaction::operations()) {
    int found = 0;
    for (const QAction* it : window_->findChildren<QAction*>()) {
      const QString name = QString::fromStdString(operation.name);
      found += int(it->objectName() == "model." + name || it->objectName() == "edit." + name);
    }
    EXPECT_EQ(found, 1) << operation.name;
  }
}

TEST_F(MainWindowTest, AnOperationIsAskedForAndPerformed) {
  auto* dock = window_->findChild<QWidget*>("dock.operation");
  EXPECT_FALSE(dock->isVisible());
  action("model.create")->trigger();
  EXPECT_TRUE(dock->isVisible());
  auto* name = window_->findChild<QLineEdit*>("parameter.name");
  ASSERT_TRUE(name);
  auto* shape = window_->findChild<QComboBox*>("parameter.shape");
  ASSERT_TRUE(shape);
  shape->setCurrentIndex(shape->findData("box"));
  QTest::keyClicks(name, "seat");
  window_->findChild<QPushButton*>("operation.apply")->click();
  ASSERT_EQ(world().objects().size(), 1U);
  EXPECT_EQ(world().objects().begin()->second.name, "seat");
  EXPECT_EQ(session().history().undo_name(), "Create");
  window_->findChild<QPushButton*>("operation.close")->click();
  EXPECT_FALSE(dock->isVisible());
}

TEST_F(MainWindowTest, OpensWhatIsDroppedOnIt) {
  add("leg");
  session().files().save(path_of(file("tables.icome")));
  ASSERT_TRUE(until_title("tables.icome - ICOME"));
  session().files().make_new();
  ASSERT_TRUE(until_title("Untitled - ICOME"));
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(file("tables.icome"))});
  QDragEnterEvent entered({10, 10}, Qt::CopyAction, &data, Qt::LeftButton, {});
  QCoreApplication::sendEvent(window_.get(), &entered);
  EXPECT_TRUE(entered.isAccepted());
  QDropEvent drop({10.0, 10.0}, Qt::CopyAction, &data, Qt::LeftButton, {});
  QCoreApplication::sendEvent(window_.get(), &drop);
  EXPECT_TRUE(until_title("tables.icome - ICOME"));
  EXPECT_EQ(world().objects().size(), 1U);
}

/// Drops a file on the middle of the scene.
void drop_on_scene(const QString& file) {
  for (QWindow* window : QGuiApplication::allWindows()) {
    if (!dynamic_cast<SceneWindow*>(window)) continue;
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(file)});
    const QPointF middle(window->width() / 2.0, window->height() / 2.0);
    QDragEnterEvent entered(middle.toPoint(), Qt::CopyAction, &data, Qt::LeftButton, {});
    QCoreApplication::sendEvent(window, &entered);
    EXPECT_TRUE(entered.isAccepted());
    QDropEvent drop(middle, Qt::CopyAction, &data, Qt::LeftButton, {});
    QCoreApplication::sendEvent(window, &drop);
    return;
  }
  FAIL() << "there is no scene";
}

TEST_F(MainWindowTest, LaysAPictureOnTheObjectThatItIsDroppedOn) {
  world::World cube;
  world::IdSource ids;
  world::add_object(cube, ids, "cube", world::box(0.1));
  load(cube);
  session().settle();
  session().update();
  session().view().home();
  const std::uint64_t before = hash(world());
  const QString wood = QString::fromStdString((places::project_folder() / "examples" / "wood.png").string());
  drop_on_scene(wood);
  ASSERT_TRUE(until([&] { return !world().textures().empty(); }));
  EXPECT_EQ(session().history().undo_name(), "Put Picture on cube");
  const world::PhysicalObject& object = world().objects().begin()->second;
  EXPECT_TRUE(world().find(world().find(object.material)->texture));
  ASSERT_TRUE(session().history().undo());
  EXPECT_EQ(hash(world()), before);

  QFile words(file("words.png"));
  ASSERT_TRUE(words.open(QIODevice::WriteOnly) && words.write("no picture") > 0);
  words.close();
  drop_on_scene(file("words.png"));
  QLabel* text = nullptr;
  ASSERT_TRUE(until([&] { return (text = window_->findChild<QLabel*>("banner.text")) != nullptr; }));
  EXPECT_TRUE(text->text().contains("none of PNG, JPEG and GIF")) << text->text().toStdString();
  EXPECT_EQ(hash(world()), before);
}

TEST_F(MainWindowTest, ChoosesAPictureForWhatIsSelected) {
  world::World cube;
  world::IdSource ids;
  const auto id = world::add_object(cube, ids, "cube", world::box(0.1));
  load(cube);
  action("model.picture")->trigger();  // nothing is selected
  EXPECT_FALSE(window_->findChild<QFileDialog*>("picture"));
  session().select({id});
  action("model.picture")->trigger();
  auto* dialog = window_->findChild<QFileDialog*>("picture");
  ASSERT_TRUE(dialog);
  emit dialog->fileSelected(
      QString::fromStdString((places::project_folder() / "examples" / "wood.png").string()));
  EXPECT_TRUE(until([&] { return !world().textures().empty(); }));
}

TEST_F(MainWindowTest, SaysWhyADesignCannotBeOpened) {
  window_->begin(path_of(file("nothing.wrl")));
  QLabel* text = nullptr;
  ASSERT_TRUE(until([&] { return (text = window_->findChild<QLabel*>("banner.text")) != nullptr; }));
  EXPECT_TRUE(text->text().contains("nothing.wrl"));
  EXPECT_TRUE(window_->findChild<QAbstractButton*>("banner.Open Another\u2026"));
}

TEST_F(MainWindowTest, ClosesAtOnceWhenNothingWouldBeLost) {
  EXPECT_TRUE(window_->close());
  EXPECT_TRUE(window_->isHidden());
}

TEST_F(MainWindowTest, AsksBeforeItClosesOverUnsavedWork) {
  add("leg");
  EXPECT_FALSE(window_->close());
  auto* box = window_->findChild<QMessageBox*>("save_changes");
  ASSERT_TRUE(box);
  box->button(QMessageBox::Cancel)->click();
  EXPECT_FALSE(window_->isHidden());
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  EXPECT_FALSE(window_->close());
  window_->findChild<QMessageBox*>("save_changes")->button(QMessageBox::Discard)->click();
  EXPECT_TRUE(until([&] { return window_->isHidden(); }));
}

TEST_F(MainWindowTest, WhatIsBeingTypedIsSavedToo) {
  const auto leg = add("leg");
  session().files().save(path_of(file("a.icome")));
  ASSERT_TRUE(until_title("a.icome - ICOME"));
  session().select({leg});
  QTest::keyClicks(&name_field(), "table leg");
  EXPECT_EQ(world().find(leg)->name, "leg");
  action("file.save")->trigger();
  EXPECT_EQ(world().find(leg)->name, "table leg");
  EXPECT_TRUE(until([&] { return !session().files().saving() && !session().files().modified(); }));
}

TEST_F(MainWindowTest, NothingGoesOnOverWhatWasRefused) {
  const auto leg = add("leg");
  session().select({leg});
  ASSERT_TRUE(until([&] { return action("edit.delete")->isEnabled(); }));
  QLineEdit& x = field("Position, mm x");
  QTest::keyClicks(&x, "nonsense");
  EXPECT_FALSE(window_->close());
  EXPECT_FALSE(window_->findChild<QMessageBox*>());
  EXPECT_EQ(x.text(), "nonsense");
  EXPECT_TRUE(x.property("refused").toBool());
  action("edit.delete")->trigger();
  EXPECT_TRUE(world().find(leg));
  QTest::keyClick(&x, Qt::Key_Escape);
  action("edit.delete")->trigger();
  EXPECT_FALSE(world().find(leg));
}

TEST_F(MainWindowTest, CommittedFieldsLeaveUndoToTheDesign) {
  const auto leg = add("leg");
  session().select({leg});
  const auto place = [&] { return world().find(leg)->parent_from_object.translation().x(); };
  const auto undo = [](QLineEdit& it) { QTest::keyClick(&it, Qt::Key_Z, Qt::ControlModifier); };
  const auto redo = [](QLineEdit& it) {
    QTest::keyClick(&it, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  };
  QLineEdit& x = field("Position, mm x");
  QTest::keyClicks(&x, "25");
  QTest::keyClick(&x, Qt::Key_Return);
  EXPECT_EQ(place(), 0.025);
  ASSERT_TRUE(until([&] { return action("edit.undo")->text().contains("Move"); }));
  undo(x);
  EXPECT_EQ(place(), 0.0);
  ASSERT_TRUE(until([&] { return x.text() == "0" && action("edit.redo")->isEnabled(); }));
  redo(x);
  EXPECT_EQ(place(), 0.025);
  ASSERT_TRUE(until([&] { return x.text() == "25" && action("edit.undo")->isEnabled(); }));
  const std::string before = session().history().undo_name();
  x.clearFocus();
  EXPECT_EQ(place(), 0.025);
  EXPECT_EQ(session().history().undo_name(), before) << "leaving the field does nothing";
  undo(x);
  EXPECT_EQ(place(), 0.0);

  // What is being typed is the field's to take back, and given up so it makes no edit.
  QLineEdit& y = field("Position, mm y");
  QTest::keyClicks(&y, "7");
  undo(y);
  EXPECT_EQ(y.text(), "0");
  EXPECT_TRUE(world().find(leg)) << "not the object, which the design would have taken back";
  y.clearFocus();
  EXPECT_EQ(session().history().undo_name(), "Add leg");

  QLineEdit& name = name_field();
  QTest::keyClicks(&name, "table leg");
  QTest::keyClick(&name, Qt::Key_Return);
  EXPECT_EQ(world().find(leg)->name, "table leg");
  ASSERT_TRUE(until([&] { return action("edit.undo")->text().contains("Rename"); }));
  undo(name);
  EXPECT_EQ(world().find(leg)->name, "leg");
  name.clearFocus();
  EXPECT_EQ(world().find(leg)->name, "leg");
}

TEST_F(MainWindowTest, ATechniqueIsInSightAsLongAsItIsAtWork) {
  auto& technique = *window_->findChild<QLabel*>("status.technique");
  auto& hint = *window_->findChild<QLabel*>("status.hint");
  ASSERT_TRUE(until([&] { return !technique.isVisible(); }));
  action("tool.touch")->trigger();
  ASSERT_TRUE(until([&] { return hint.text().startsWith("Press to touch"); }));
  action("technique.miniature")->trigger();
  ASSERT_TRUE(until([&] { return technique.isVisible(); }));
  EXPECT_EQ(technique.text(), "Technique: World in Miniature");
  EXPECT_TRUE(hint.text().startsWith("World in Miniature: press to take")) << hint.text().toStdString();
  open_window();
  auto& again = *window_->findChild<QLabel*>("status.technique");
  ASSERT_TRUE(until([&] { return again.isVisible(); })) << "after a restart, too";
  action("technique.touch")->trigger();
  ASSERT_TRUE(until([&] { return !again.isVisible(); }));
}

TEST_F(MainWindowTest, WhatAnOperationRemarkedGivesWayToTheHintOfAnotherTool) {
  const auto shape = session().ids().next<world::GeometryId>();
  perform(world::CreateGeometry{shape, world::box(0.2)});
  for (const char* name : {"one", "other"}) {
    const auto id = session().ids().next<world::ObjectId>();
    perform(world::CreateObject{id, 0, {.name = name, .geometry = shape}});
    session().select({id});
  }
  action("model.reshape")->trigger();
  auto* size = window_->findChild<QLineEdit*>("parameter.size");
  ASSERT_TRUE(size);
  size->setFocus();
  size->selectAll();
  QTest::keyClicks(size, "300");
  window_->findChild<QPushButton*>("operation.apply")->click();
  const QString remark = window_->findChild<QLabel*>("operation.note")->text();
  EXPECT_NE(remark, "");
  auto& hint = *window_->findChild<QLabel*>("status.hint");
  ASSERT_TRUE(until([&] { return hint.text() == remark; }));
  action("tool.touch")->trigger();
  EXPECT_TRUE(until([&] { return hint.text().startsWith("Press to touch"); }));
}

TEST_F(MainWindowTest, ClosingAsksAboutWhatIsBeingTyped) {
  const auto leg = add("leg");
  session().files().save(path_of(file("a.icome")));
  ASSERT_TRUE(until_title("a.icome - ICOME"));
  session().select({leg});
  QTest::keyClicks(&name_field(), "table leg");
  EXPECT_FALSE(window_->close());
  EXPECT_TRUE(window_->findChild<QMessageBox*>("save_changes"));
}

TEST_F(MainWindowTest, ANameThatIsBeingTypedInTheTreeIsSavedToo) {
  const auto leg = add("leg");
  session().select({leg});
  ASSERT_TRUE(until([&] { return action("edit.rename")->isEnabled(); }));
  action("edit.rename")->trigger();
  QLineEdit* editor = nullptr;
  for (QTreeView* it : window_->findChildren<QTreeView*>()) {
    if (auto* found = it->viewport()->findChild<QLineEdit*>()) editor = found;
  }
  ASSERT_TRUE(editor);
  editor->selectAll();
  QTest::keyClicks(editor, "foot");
  action("edit.duplicate")->trigger();
  EXPECT_EQ(world().find(leg)->name, "foot");
  EXPECT_EQ(world().objects().size(), 2U);
}

TEST_F(MainWindowTest, NoNameOfADesignWidensItOrIsTakenForMarkup) {
  // What stands there when a thing with a short name is selected is as wide as it gets.
  auto* hint = window_->findChild<QLabel*>("status.hint");
  session().select({add("short")});
  ASSERT_TRUE(until([&] { return hint->text().startsWith("short"); }));
  QCoreApplication::processEvents();
  const int before = window_->minimumSizeHint().width();
  const std::string name = "<h1>big</h1>" + std::string(2000, 'w');
  const auto id = add(name.c_str());
  session().select({id});
  ASSERT_TRUE(until([&] { return hint->text().startsWith("<h1>big</h1>ww"); }));
  EXPECT_EQ(hint->textFormat(), Qt::PlainText);
  EXPECT_LT(hint->text().size(), 100);
  QCoreApplication::processEvents();
  // Numbers of the load, which come and go, may take some pixels more; the name would take thousands.
  EXPECT_LT(window_->minimumSizeHint().width(), before + 50);
  ASSERT_TRUE(until([&] { return action("edit.undo")->isEnabled(); }));
  EXPECT_LE(action("edit.undo")->text().size(), 81);
  EXPECT_FALSE(action("edit.undo")->toolTip().contains("<h1>"));
}

TEST_F(MainWindowTest, TheSignOverTheReasonFollowsTheTheme) {
  const auto sign = [this] { return window_->findChild<QLabel*>("scene.sign")->pixmap().toImage(); };
  apply_theme(application(), Theme::Light);
  QCoreApplication::processEvents();
  const QImage light = sign();
  apply_theme(application(), Theme::Dark);
  QCoreApplication::processEvents();
  EXPECT_NE(sign(), light);
  apply_theme(application(), Theme::Light);
  QCoreApplication::processEvents();
  EXPECT_EQ(sign(), light);
}

TEST_F(MainWindowTest, F6GoesRoundAllPartsThatAreSeen) {
  auto* retry = window_->findChild<QPushButton*>("scene.retry");
  ASSERT_TRUE(until([&] { return retry->isVisible(); }));
  QApplication::setActiveWindow(window_.get());
  const auto leg = add("leg");
  session().select({leg});
  field("Name").clearFocus();
  retry->setFocus();
  const auto part = [&]() -> QString {
    const QWidget* focus = QApplication::focusWidget();
    for (const QWidget* it = focus; it; it = it->parentWidget()) {
      for (const char* name :
           {"scene", "banner", "dock.world", "dock.properties", "dock.operation", "dock.hand"}) {
        if (it->objectName() == name) return name;
      }
    }
    return focus ? "elsewhere" : "nowhere";
  };
  const auto round = [&] {
    QStringList parts;
    do {
      parts << part();
      action("window.next_part")->trigger();
    } while (part() != parts.front() && parts.size() < 6);
    parts.removeAll("dock.hand");  // has a place for the keyboard or not
    return parts;
  };
  EXPECT_EQ(round(), (QStringList{"scene", "dock.world", "dock.properties"}));
  session().files().save(path_of(file("a.icome")));
  ASSERT_TRUE(until_title("a.icome - ICOME"));
  window_->begin(path_of(file("nothing.wrl")));
  ASSERT_TRUE(until([&] { return window_->findChild<QWidget*>("banner")->isVisible(); }));
  retry->setFocus();
  EXPECT_EQ(round(), (QStringList{"scene", "banner", "dock.world", "dock.properties"}));
  window_->findChild<QWidget*>("dock.world")->hide();
  EXPECT_EQ(round(), (QStringList{"scene", "banner", "dock.properties"}));
}

TEST_F(MainWindowTest, NoTwoActionsHaveTheSameKeys) {
  QMap<QString, QString> users;
  for (const QAction* it : window_->findChildren<QAction*>()) {
    if (it->shortcutContext() != Qt::WindowShortcut) continue;
    for (const QKeySequence& keys : it->shortcuts()) {
      EXPECT_FALSE(users.contains(keys.toString()))
          << keys.toString().toStdString() << " of " << it->text().toStdString() << " and "
          << users[keys.toString()].toStdString();
      users[keys.toString()] = it->text();
    }
  }
  EXPECT_GE(users.size(), 25);
}

TEST_F(MainWindowTest, PlaysMotionsAndPutsThingsBack) {
  QAction* const play = action("view.play");
  EXPECT_EQ(play->shortcut(), QKeySequence("F5"));
  play->trigger();
  EXPECT_FALSE(session().stage().playing());  // nothing moves
  EXPECT_FALSE(play->isChecked());
  world::Motion motion;
  motion.translation = {.times = {0.0, 1.0}, .values = {0, 0, 0, 1, 0, 0}};
  perform(world::ChangeMotion{add("lift"), std::make_shared<const world::Motion>(motion)});
  play->trigger();
  EXPECT_TRUE(session().stage().playing());
  EXPECT_TRUE(play->isChecked());
  play->trigger();
  EXPECT_FALSE(session().stage().playing());
  EXPECT_FALSE(play->isChecked());
  play->trigger();
  session().files().make_new();
  EXPECT_TRUE(until([&] { return !play->isChecked(); }));
}

}  // namespace
}  // namespace icome::ui
