// The haptic menu of the window, as people use it: by keys, by the mouse, and by a hand that pushes.
#include "ui/actions/menu_actions.h"

#include <QFile>
#include <QKeyEvent>
#include <QLabel>
#include <cmath>

#include "devices/simulated/simulated_device.h"
#include "places.h"
#include "ui/forms/operation_arguments.h"
#include "ui/window_test.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::ui {
namespace {

using base::Vector3;
using world::ObjectId;

ObjectId add_box(session::Session& session, const Vector3& centre = Vector3::Zero()) {
  const auto shape = session.ids().next<world::GeometryId>();
  const auto id = session.ids().next<ObjectId>();
  world::PhysicalObject object{.name = "box", .geometry = shape};
  object.parent_from_object.translation() = centre;
  const auto box = std::make_shared<world::PrimitiveGeometry>(geometry::Box{Vector3::Constant(0.05)});
  const auto done = session.history().perform(
      world::EditGroup{{world::CreateGeometry{shape, box}, world::CreateObject{id, 0, object}}}, "Add");
  EXPECT_TRUE(done) << done.error().message;
  return id;
}

class MenuActionsTest : public WindowTest {
 protected:
  void key(int key) {
    for (const auto type : {QEvent::KeyPress, QEvent::KeyRelease}) {
      QKeyEvent event(type, key, Qt::NoModifier);
      QCoreApplication::sendEvent(&mouse_.window(), &event);
    }
  }
  bool is_open() { return session().menu().use() != nullptr; }
  /// Where a widget of the open menu is in the scene's window.
  QPointF pixel(const char* name) {
    const auto& use = *session().menu().use();
    for (const interaction::LaidWidget& it : use.layout().widgets)
      if (it.widget->name == name) return pixel_of(it.centre);
    ADD_FAILURE() << name << " is not to be seen";
    return {};
  }
  /// The pixel at which a place of the menu's plane is seen.
  QPointF pixel_of(const base::Vector2& place) {
    const interaction::View& view = session().view().now();
    const Vector3 seen = view.world_from_eye.inverse() * session().menu().use()->frame().in_world(place);
    const QSizeF size = mouse_.size();
    const double scale =
        0.5 * std::min(size.width(), size.height()) / (std::tan(0.5 * view.field) * -seen.z());
    return {0.5 * size.width() + scale * seen.x(), 0.5 * size.height() - scale * seen.y()};
  }
  void turn_wheel(QPointF at, int notches) {
    QWheelEvent event(at, at, {}, {0, 120 * notches}, Qt::NoButton, {}, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(&mouse_.window(), &event);
  }
  /// Opens the menu of a file of the project.
  void open_menu(const char* name) {
    const auto path = places::project_folder() / "data" / "menus" / name;
    settings_.setValue("menu/file", QString::fromStdString(path.string()));
    mouse_.move({300.0, 200.0});
    key(Qt::Key_Space);
    ASSERT_TRUE(is_open());
  }
  const interaction::Widget& widget(const char* name) {
    return *interaction::find_widget(session().menu().use()->element().widgets, name);
  }
  void click(const char* name) { click_at(pixel(name)); }
  void click_at(QPointF at) {
    mouse_.move(at);
    mouse_.press(at);
    mouse_.release(at);
  }
  std::optional<world::Colour> colour_of(ObjectId id) {
    const auto material = world().find(id)->material;
    return material == world::MaterialId{} ? std::nullopt : std::optional(world().find(material)->diffuse);
  }
  bool enabled(const char* name) {
    return interaction::find_widget(session().menu().use()->element().widgets, name)->enabled;
  }

  SceneMouse mouse_;
};

TEST_F(MenuActionsTest, SpaceOpensItAndKeysChoose) {
  key(Qt::Key_Space);
  ASSERT_TRUE(is_open());
  EXPECT_FALSE(enabled("Undo"));
  EXPECT_FALSE(enabled("Red")) << "nothing is selected";
  key(Qt::Key_Down);
  EXPECT_EQ(session().menu().use()->lit()->name, "New");
  key(Qt::Key_Right);
  EXPECT_EQ(session().menu().use()->lit()->name, "Box");
  key(Qt::Key_Down);
  key(Qt::Key_Return);
  EXPECT_TRUE(until([&] { return world().roots().size() == 1; }));
  EXPECT_EQ(world().find(world().roots().front())->name, "sphere");
  EXPECT_EQ(session().selection(), world().roots());
  EXPECT_FALSE(is_open()) << "a menu that popped up goes when something was chosen";
  key(Qt::Key_Space);
  EXPECT_TRUE(until([&] { return enabled("Undo"); }));
  EXPECT_TRUE(enabled("Red"));
  key(Qt::Key_Space);
  EXPECT_FALSE(is_open());
  key(Qt::Key_Space);
  key(Qt::Key_Down);
  key(Qt::Key_Right);
  key(Qt::Key_Escape);
  EXPECT_TRUE(is_open()) << "only the menu in it has closed";
  key(Qt::Key_Escape);
  EXPECT_FALSE(is_open());
}

TEST_F(MenuActionsTest, TheMouseColoursWhatIsSelectedAndTakesItBack) {
  const ObjectId box = add_box(session());
  session().select({box});
  mouse_.move({300.0, 200.0});
  key(Qt::Key_Space);
  ASSERT_TRUE(is_open());
  ASSERT_TRUE(until([&] { return session().menu().use()->opacity() > 0.99; }));
  click("Colour");
  ASSERT_TRUE(until([&] { return session().menu().use()->open().size() == 1; }));
  click("Blue");
  ASSERT_TRUE(until([&] { return colour_of(box).has_value(); }));
  const auto blue = *colour_of(box);
  EXPECT_GT(blue[2], blue[0]);
  EXPECT_EQ(session().selection(), std::vector{box}) << "the click was the menu's";
  key(Qt::Key_Space);
  ASSERT_TRUE(until([&] { return enabled("Undo"); }));
  click("Undo");
  EXPECT_TRUE(until([&] { return !colour_of(box).has_value(); }));
}

TEST_F(MenuActionsTest, AHandThatPushesChoosesTheSame) {
  const ObjectId box = add_box(session());
  session().select({box});
  action("tool.touch")->trigger();
  mouse_.move({300.0, 200.0});
  key(Qt::Key_Space);
  ASSERT_TRUE(is_open());
  for (const char* const name : {"Colour", "Green"}) {
    ASSERT_TRUE(until([&] {
      mouse_.move(pixel(name));  // the window may have been laid out anew
      const auto* const lit = session().menu().use()->lit();
      return lit != nullptr && lit->name == name;
    }));
    mouse_.press(pixel(name));
    const bool is_menu = std::string_view(name) == "Colour";
    ASSERT_TRUE(until([&] { return is_menu ? session().menu().use()->open().size() == 1 : !is_open(); }))
        << name;
    mouse_.release({});
    ASSERT_TRUE(until([&] { return session().hands().pointer(0).force.norm() < 2.0; }));
  }
  EXPECT_TRUE(until([&] { return colour_of(box).has_value(); }));
  EXPECT_FALSE(is_open());
  EXPECT_EQ(world_from_object(world(), box).translation(), Vector3::Zero().eval()) << "it was not dragged";
}

TEST_F(MenuActionsTest, ADoubleClickOnItIsTwoClicks) {
  add_box(session());
  QFile ticks(file("ticks.toml"));
  ASSERT_TRUE(ticks.open(QIODevice::WriteOnly));
  ticks.write("at = \"pointer\"\n[[item]]\nname = \"Tick\"\nkind = \"check\"\n");
  ticks.close();
  settings_.setValue("menu/file", ticks.fileName());
  key(Qt::Key_Space);
  ASSERT_TRUE(is_open());
  const auto is_ticked = [&] {
    const auto& use = *session().menu().use();
    return use.is_checked(use.element().widgets.front());
  };
  const interaction::View before = session().view().now();
  click("Tick");
  EXPECT_TRUE(is_ticked());
  const QPointF at = pixel("Tick");
  QMouseEvent twice(QEvent::MouseButtonDblClick, at, at, Qt::LeftButton, Qt::LeftButton, {});
  QCoreApplication::sendEvent(&mouse_.window(), &twice);
  mouse_.release(at);
  EXPECT_FALSE(is_ticked());
  until([] { return true; });
  EXPECT_EQ(session().view().now().world_from_eye.matrix(), before.world_from_eye.matrix());
}

TEST_F(MenuActionsTest, ARowOfAListIsChosenByMouseWheelKeysAndName) {
  std::vector<std::string> made;
  for (const int way : {0, 1, 2, 3}) {
    open_menu("properties.toml");
    if (way == 0) {
      click("Shapes");
      const interaction::View before = session().view().now();
      const QPointF over = pixel("cylinder");
      mouse_.move(over);
      for (int i = 0; i < 3; ++i) turn_wheel(over, -1);
      EXPECT_EQ(session().view().now().world_from_eye.matrix(), before.world_from_eye.matrix())
          << "the wheel is the menu's";
      click("polygon");
    } else if (way == 1) {
      click("Shapes");
      for (int i = 0; i < 6; ++i) {
        const interaction::LaidHandle* const more =
            session().menu().use()->layout().handle(interaction::HandleKind::More, &widget("New shape"));
        click_at(pixel_of(more->box.centre));
      }
      click("polygon");
    } else if (way == 2) {
      mouse_.move({5.0, 5.0});
      key(Qt::Key_Down);
      key(Qt::Key_Right);
      key(Qt::Key_Right);
      for (int i = 0; i < 10; ++i) key(Qt::Key_Down);
      EXPECT_EQ(session().menu().use()->lit()->name, "polygon");
      key(Qt::Key_Return);
    } else {
      EXPECT_TRUE(session().menu().choose("polygon"));
    }
    EXPECT_TRUE(until([&] { return world().roots().size() == std::size_t(way) + 1; })) << way;
    made.push_back(world().find(world().roots().back())->name);
    EXPECT_TRUE(is_open()) << "a row is one of several";
    session().menu().close();
  }
  for (const std::string& name : made) EXPECT_EQ(name.substr(0, 7), "polygon") << name;
}

TEST_F(MenuActionsTest, ThePickerColoursWhatIsSelectedByMouseAndKeys) {
  const ObjectId box = add_box(session());
  session().select({box});
  open_menu("properties.toml");
  const auto& use = *session().menu().use();
  const interaction::Widget& picker = widget("Any colour");
  const auto wheel = interaction::wheel_of(*use.layout().widget(picker), use.element().text_height);
  // Held at the ring, and let go beside the menu, two thirds round.
  const QPointF from = pixel_of(wheel.place_of_hue(0.5)),
                to = pixel_of(wheel.centre + base::Vector2(-0.9, -0.5196));
  mouse_.move(from);
  mouse_.press(from);
  mouse_.move(0.5 * (from + to));
  ASSERT_TRUE(until([&] { return colour_of(box).has_value(); })) << "it is seen while it is dragged";
  EXPECT_TRUE(session().history().trying());
  mouse_.move(to);
  mouse_.release(to);
  ASSERT_TRUE(until([&] { return !session().history().trying(); }));
  ASSERT_TRUE(colour_of(box).has_value());
  const double hue = interaction::hsv_of(*colour_of(box)).hue;
  EXPECT_NEAR(hue, 2.0 * 2.0 * M_PI / 3.0, 0.05);
  EXPECT_FALSE(use.is_holding());
  EXPECT_TRUE(is_open());
  const auto before = *colour_of(box);
  key(Qt::Key_Right);
  key(Qt::Key_Right);
  key(Qt::Key_Return);
  ASSERT_TRUE(until([&] { return *colour_of(box) != before; }));
  EXPECT_NEAR(interaction::hsv_of(*colour_of(box)).hue - hue, M_PI / 18.0, 0.02);
  session().menu().close();
}

TEST_F(MenuActionsTest, ValuesBeginAsThoseOfTheSelectionAndGivingUpLeavesNoTrace) {
  const ObjectId box = add_box(session());
  session().select({box});
  const interaction::Operation& colour = **interaction::find_operation("colour");
  ASSERT_TRUE(perform_operation(session(), colour,
                                *completed_fields(colour, {{"colour", "#2040c0"}}, session().selection())));
  const interaction::Operation& feel = **interaction::find_operation("feel");
  ASSERT_TRUE(perform_operation(session(), feel,
                                *completed_fields(feel, {{"stiffness", 700.0}}, session().selection())));
  open_menu("properties.toml");
  const auto& use = *session().menu().use();
  const auto picked = [&] { return *use.settings().value_of(widget("Any colour")).text(); };
  EXPECT_TRUE(until([&] { return picked() == "#2040c0"; }));
  EXPECT_EQ(use.value_of(widget("Stiffness")), 700.0);
  // By keys, and given up.
  key(Qt::Key_Down);
  key(Qt::Key_Down);
  ASSERT_EQ(use.lit(), &widget("Any colour"));
  key(Qt::Key_Right);
  key(Qt::Key_Right);
  EXPECT_TRUE(until([&] { return session().history().trying(); }));
  key(Qt::Key_Escape);
  EXPECT_TRUE(until([&] { return !session().history().trying(); }));
  EXPECT_EQ(picked(), "#2040c0");
  EXPECT_EQ(interaction::colour_text(*colour_of(box)), "#2040c0");
  EXPECT_EQ(session().history().undo_name(), "Feel");
  ASSERT_TRUE(session().history().undo());
  ASSERT_TRUE(session().history().undo());
  EXPECT_FALSE(colour_of(box));
  // A menu that closes while something is held takes it back, too.
  key(Qt::Key_Right);
  EXPECT_TRUE(until([&] { return session().history().trying(); }));
  session().menu().close();
  EXPECT_TRUE(until([&] { return !session().history().trying(); }));
  EXPECT_FALSE(colour_of(box));
}

TEST_F(MenuActionsTest, ANumberIsTypedSteppedAndHeld) {
  const ObjectId box = add_box(session());
  session().select({box});
  open_menu("properties.toml");
  ASSERT_TRUE(session().menu().choose("Size"));
  const auto size = [&] { return world_from_object(world(), box).linear().col(0).norm(); };
  mouse_.move(pixel("Times"));
  EXPECT_EQ(session().menu().use()->lit()->name, "Times");
  for (const int digit : {Qt::Key_5, Qt::Key_0, Qt::Key_0, Qt::Key_0}) {
    QKeyEvent asked(QEvent::ShortcutOverride, digit, Qt::NoModifier);
    asked.ignore();
    QCoreApplication::sendEvent(&mouse_.window(), &asked);
    EXPECT_TRUE(asked.isAccepted()) << "a digit is no view now";
    key(digit);
  }
  key(Qt::Key_Return);
  until([] { return true; });
  EXPECT_NEAR(size(), 1.0, 1e-12) << "5000 % is too much";
  EXPECT_NE(session().menu().use()->trouble().find("not between 1 and 1000 %"), std::string::npos);
  key(Qt::Key_Backspace);
  key(Qt::Key_Backspace);
  key(Qt::Key_Return);
  ASSERT_TRUE(until([&] { return std::abs(size() - 0.5) < 1e-9; }));
  turn_wheel(pixel("Times"), 2);
  ASSERT_TRUE(until([&] { return std::abs(size() - 0.6) < 1e-9; }));
  const auto* const less =
      session().menu().use()->layout().handle(interaction::HandleKind::Less, &widget("Times"));
  const QPointF at = pixel_of(less->box.centre);
  mouse_.move(at);
  mouse_.press(at);
  // Nothing but time passes.
  ASSERT_TRUE(until([&] { return session().menu().use()->value_of(widget("Times")) < 45.0; }));
  mouse_.release(at);
  EXPECT_TRUE(until([&] { return size() < 0.45; }));
  session().menu().close();
}

TEST_F(MenuActionsTest, WhatAnOperationLacksItsFormAsksFor) {
  QFile words(file("words.toml"));
  ASSERT_TRUE(words.open(QIODevice::WriteOnly));
  words.write(
      "at = \"pointer\"\n[[item]]\nname = \"Words\"\noperation = \"create\"\nwith = { shape = \"text\" }\n"
      "[[item]]\nname = \"Pink\"\noperation = \"colour\"\nwith = { colour = \"#ff66cc\" }\n");
  words.close();
  settings_.setValue("menu/file", words.fileName());
  key(Qt::Key_Space);
  ASSERT_TRUE(is_open());
  EXPECT_FALSE(enabled("Pink")) << "only a selection would do";
  ASSERT_TRUE(session().menu().choose("Words"));
  const auto* const form = window_->findChild<QWidget*>("dock.operation");
  EXPECT_TRUE(until([&] { return form->isVisible(); }));
  EXPECT_TRUE(world().roots().empty());
}

TEST_F(MenuActionsTest, TicksAreThoseOfTheCommands) {
  key(Qt::Key_Space);
  const auto& use = *session().menu().use();
  const auto& widgets = use.element().widgets;
  EXPECT_TRUE(use.is_checked(*interaction::find_widget(widgets, "Select")));
  EXPECT_TRUE(session().menu().choose("Touch"));
  EXPECT_TRUE(until([&] { return action("tool.touch")->isChecked(); }));
  EXPECT_TRUE(is_open()) << "a choice of several is not over with one";
}

TEST_F(MenuActionsTest, AMenuOfAFileIsUsedAndAWrongOneTold) {
  QFile good(file("mine.toml")), bad(file("bad.toml"));
  ASSERT_TRUE(good.open(QIODevice::WriteOnly) && bad.open(QIODevice::WriteOnly));
  good.write(
      "at = \"head\"\ncentre = [-0.1, 0, 0]\n[[item]]\nname = \"Whole\"\ncommand = \"view.home\"\n"
      "[[item]]\nname = \"Nonsense\"\ncommand = \"no.such\"\n");
  bad.write("[[item]]\nnam = 1\n");
  good.close();
  bad.close();
  QSettings settings(file("menu.conf"), QSettings::IniFormat);
  std::vector<Note> told;
  MenuActions actions(session(), settings,
                      {.begin = [] { return true; },
                       .tell = [&](const Note& note) { told.push_back(note); },
                       .ask = [](const interaction::Operation&) {}},
                      *window_);
  actions.choose(bad.fileName().toStdString());
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told.front().text.find("bad.toml:2"), std::string::npos) << told.front().text;
  EXPECT_FALSE(is_open());
  actions.choose(good.fileName().toStdString());
  ASSERT_TRUE(is_open());
  EXPECT_TRUE(enabled("Whole"));
  EXPECT_FALSE(enabled("Nonsense"));
  // It stays to the left of where one looks.
  const auto beside = [&] {
    const interaction::View& view = session().view().now();
    return Vector3(view.world_from_eye.inverse() * session().menu().use()->frame().centre).x();
  };
  EXPECT_LT(beside(), 0.0);
  const double before = beside();
  interaction::View turned = session().view().now();
  turned.world_from_eye = Eigen::AngleAxisd(1.0, Vector3::UnitY()) * turned.world_from_eye;
  session().view().set(turned);
  session().update();
  EXPECT_NEAR(beside(), before, 1e-9);
  EXPECT_EQ(settings.value("menu/file").toString(), good.fileName());
  session().menu().close();
}

TEST_F(MenuActionsTest, APanelForTheOtherHandIsRefusedWithoutOneAndUnknownCommandsAreTold) {
  const auto use_file = [&](const char* name, const char* toml) {
    QFile menu(file(name));
    EXPECT_TRUE(menu.open(QIODevice::WriteOnly));
    menu.write(toml);
    menu.close();
    settings_.setValue("menu/file", menu.fileName());
    key(Qt::Key_Space);
  };
  const auto is_told = [&](const char* words) {
    return until([&] {
      for (const QLabel* const label : window_->findChildren<QLabel*>())
        if (label->text().contains(words)) return true;
      return false;
    });
  };
  use_file("hand.toml", "at = \"hand\"\n[[item]]\nname = \"A\"\n");
  EXPECT_FALSE(is_open());
  EXPECT_TRUE(is_told("connect another device"));
  use_file("unknown.toml", "[[item]]\nname = \"A\"\ncommand = \"edit.und\"\n");
  EXPECT_TRUE(is_open());
  EXPECT_TRUE(is_told("items that do nothing"));
  session().menu().close();
}

TEST_F(MenuActionsTest, ADialogIsAnsweredOnceAndMayClearTheScene) {
  add_box(session());
  add_box(session(), Vector3(0.1, 0.0, 0.0));
  const std::size_t count = session().world().objects().size();
  settings_.setValue("menu/file",
                     QString::fromStdString((places::project_folder() / "data/menus/clear.toml").string()));
  key(Qt::Key_Space);
  ASSERT_TRUE(is_open());
  key(Qt::Key_Return);  // Keep
  EXPECT_TRUE(until([&] { return !is_open(); }));
  EXPECT_EQ(session().world().objects().size(), count);
  key(Qt::Key_Space);
  ASSERT_TRUE(session().menu().choose("Clear"));
  session().update();
  EXPECT_TRUE(until([&] { return session().world().objects().empty(); }));
  EXPECT_FALSE(is_open());
  ASSERT_TRUE(session().history().undo());
  EXPECT_EQ(session().world().objects().size(), count);
}

TEST_F(MenuActionsTest, AMenuThatPopsUpStaysInThePictureWithAllThatIsOpen) {
  QFile deep(file("deep.toml"));
  ASSERT_TRUE(deep.open(QIODevice::WriteOnly));
  QByteArray toml = "at = \"pointer\"\n", item = "item";
  for (int level = 1; level <= 8; ++level, item += ".item")
    toml += "[[" + item + "]]\nname = \"A long name of level " + QByteArray::number(level) + "\"\n";
  for (int row = 0; row < 200; ++row) toml += "[[item]]\nname = \"" + QByteArray::number(row) + "\"\n";
  deep.write(toml);
  deep.close();
  settings_.setValue("menu/file", deep.fileName());
  const QSizeF size = mouse_.size();
  session().view().set_aspect(size.width() / size.height());
  for (const QPointF at : {QPointF(size.width() - 5.0, size.height() - 5.0), QPointF(5.0, 5.0)}) {
    mouse_.move(at);
    key(Qt::Key_Space);
    ASSERT_TRUE(is_open());
    key(Qt::Key_Down);
    for (int level = 1; level < 8; ++level) key(Qt::Key_Right);
    const interaction::ElementLayout& layout = session().menu().use()->layout();
    ASSERT_EQ(layout.sheets.size(), 8U);
    for (const interaction::LaidSheet& sheet : layout.sheets)
      for (const double side : {-1.0, 1.0}) {
        const QPointF corner = pixel_of(sheet.centre + side * sheet.half);
        EXPECT_TRUE(QRectF({-1.0, -1.0}, size + QSizeF(2.0, 2.0)).contains(corner))
            << corner.x() << ' ' << corner.y();
      }
    session().menu().close();
  }
}

/// A stylus alone, without a mouse in the scene.
class StylusMenuTest : public WindowTest {
 protected:
  StylusMenuTest() : StylusMenuTest(new devices::SimulatedDevice()) {}

  bool is_open() { return session().menu().use() != nullptr; }
  /// Leads the tip to a place of the stage; its workspace is there without a turn.
  void lead(const Vector3& place) { stylus_->set_target(place - offset_); }
  Vector3 at(const char* name, double front) {
    const auto& use = *session().menu().use();
    for (const interaction::LaidWidget& it : use.layout().widgets)
      if (it.widget->name == name)
        return use.frame().in_world(it.centre) + front * use.frame().size * use.frame().normal();
    return Vector3::Constant(std::nan(""));
  }

  /// Leads the tip before an item, and lets it come to rest there; the item is lit then.
  bool comes_to(const char* name) {
    constexpr std::int64_t kRests = 200'000'000;  // ns
    lead(at(name, 0.01));
    std::int64_t there_since = session().hands().pointer(0).time;
    return until([&] {
      const session::PointerView& now = session().hands().pointer(0);
      if ((now.tip - at(name, 0.01)).norm() > 0.001) there_since = now.time;
      const auto* const lit = session().menu().use()->lit();
      return now.time - there_since > kRests && lit != nullptr && lit->name == name;
    });
  }

  devices::SimulatedDevice* stylus_;  // the session's
  Vector3 offset_ = Vector3::Zero();  // of the workspace

 private:
  explicit StylusMenuTest(devices::SimulatedDevice* stylus)
      : WindowTest(settings_with(stylus)), stylus_(stylus) {}
  static session::SessionSettings settings_with(devices::SimulatedDevice* stylus) {
    session::SessionSettings settings;
    settings.pointers.emplace_back(stylus);
    return settings;
  }
};

TEST_F(StylusMenuTest, TheSecondButtonOpensItAtTheHandWhichPushes) {
  ASSERT_TRUE(until([&] { return session().hands().pointer(0).time != 0; }));
  offset_ = session().hands().pointer(0).tip;
  stylus_->hold_buttons(2);
  ASSERT_TRUE(until([&] { return is_open(); }));
  const auto& frame = session().menu().use()->frame();
  EXPECT_EQ(frame.size, 1.0) << "a device without a scale";
  EXPECT_NEAR(frame.front_distance(session().hands().pointer(0).tip), 0.012, 1e-3);
  stylus_->hold_buttons(0);
  ASSERT_TRUE(comes_to("New"));
  lead(at("New", -0.01));
  ASSERT_TRUE(until([&] { return session().menu().use()->open().size() == 1; }));
  EXPECT_GT(session().hands().pointer(0).force.norm(), 0.5) << "it is felt";
  ASSERT_TRUE(comes_to("New"));
  ASSERT_TRUE(comes_to("Cylinder"));
  // On a box that a press would take hold of.
  const Vector3 tip = session().hands().pointer(0).tip;
  const ObjectId box = add_box(session(), tip - Vector3(0.0, 0.05, 0.0));
  lead(at("Cylinder", 0.01) - Vector3(0.0, 0.003, 0.0));
  ASSERT_TRUE(until([&] { return session().hands().touched(0) == box; }));
  stylus_->hold_buttons(1);
  ASSERT_TRUE(until([&] { return world().roots().size() == 2; })) << "near is enough to click";
  EXPECT_FALSE(session().hands().holds(0)) << "the press was the menu's";
  stylus_->hold_buttons(0);
  stylus_->hold_buttons(2);
  ASSERT_TRUE(until([&] { return is_open(); }));
  stylus_->hold_buttons(0);
  ASSERT_TRUE(until([&] { return session().hands().pointer(0).buttons == 0; }));
  stylus_->hold_buttons(2);
  EXPECT_TRUE(until([&] { return !is_open(); }));
}

}  // namespace
}  // namespace icome::ui
