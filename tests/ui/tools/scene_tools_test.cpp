// Mouse, pen and keyboard over the scene, as the window system sends them: what they do to the session.
#include "ui/tools/scene_tools.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QResizeEvent>
#include <QTabletEvent>
#include <QWheelEvent>
#include <thread>

#include "ui/desktop_test.h"
#include "ui/window/scene_window.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::ui {
namespace {

using base::Vector3;
using world::ObjectId;

/// Two boxes of 0.2 m, 0.6 m apart; the eye 2 m before them.
class SceneToolsTest : public DesktopTest {
 protected:
  SceneToolsTest()
      : tools_(session(), {.refused = [this](const std::string& why) { refused_ += why; },
                           .asked = [this](QPointF) { ++asked_; }}),
        window_(tools_, session().view().display()) {
    left_ = add_box("left", -0.3);
    right_ = add_box("right", 0.3);
    interaction::View view;
    view.world_from_eye.translation() = Vector3(0.0, 0.0, 2.0);
    view.distance = 2.0;
    session().view().set(view);
    window_.resize(800, 600);
    QResizeEvent resized(window_.size(), QSize());
    QCoreApplication::sendEvent(&window_, &resized);
    settle();
  }

  ObjectId add_box(const char* name, double x) {
    const auto shape = session().ids().next<world::GeometryId>();
    const auto id = session().ids().next<ObjectId>();
    world::PhysicalObject object{.name = name, .geometry = shape};
    object.parent_from_object.translation().x() = x;
    const auto box = std::make_shared<world::PrimitiveGeometry>(geometry::Box{Vector3::Constant(0.1)});
    perform(world::EditGroup{{world::CreateGeometry{shape, box}, world::CreateObject{id, 0, object}}});
    return id;
  }
  void settle() {
    session().settle();
    session().update();
  }

  /// Where a point of the world is in the picture.
  QPointF pixel(const Vector3& point) {
    const interaction::View& view = session().view().now();
    const Vector3 seen = view.world_from_eye.inverse() * point;
    const double scale = 300.0 / (std::tan(0.5 * view.field) * -seen.z());
    return {400.0 + scale * seen.x(), 300.0 - scale * seen.y()};
  }
  QPointF face(ObjectId id) {
    return pixel(world_from_object(world(), id).translation() + Vector3(0.0, 0.0, 0.1));
  }

  void mouse(QEvent::Type type, QPointF at, Qt::MouseButton button = Qt::LeftButton,
             Qt::KeyboardModifiers modifiers = {}) {
    const bool moves = type == QEvent::MouseMove;
    QMouseEvent event(type, at, at, moves ? Qt::NoButton : button,
                      type == QEvent::MouseButtonRelease ? Qt::NoButton : button, modifiers);
    QCoreApplication::sendEvent(&window_, &event);
  }
  void click(QPointF at, Qt::KeyboardModifiers modifiers = {}) {
    mouse(QEvent::MouseButtonPress, at, Qt::LeftButton, modifiers);
    mouse(QEvent::MouseButtonRelease, at, Qt::LeftButton, modifiers);
  }
  void drag(QPointF from, QPointF to, Qt::MouseButton button = Qt::LeftButton) {
    mouse(QEvent::MouseButtonPress, from, button);
    for (int i = 1; i <= 10; ++i) {
      mouse(QEvent::MouseMove, from + 0.1 * i * (to - from), button);
      tools_.tick();
    }
    mouse(QEvent::MouseButtonRelease, to, button);
    settle();
  }
  void key(QEvent::Type type, int key, Qt::KeyboardModifiers modifiers = {}, bool repeats = false) {
    QKeyEvent event(type, key, modifiers, QString(), repeats);
    QCoreApplication::sendEvent(&window_, &event);
  }
  Vector3 at(ObjectId id) { return world_from_object(world(), id).translation(); }
  /// Runs the hand until what was waited for has come.
  template <typename Come>
  bool hand_until(const Come& come) {
    for (int i = 0; i < 6000; ++i) {
      tools_.tick();
      session().update();
      if (come()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  std::string refused_;
  int asked_ = 0;
  SceneTools tools_;
  SceneWindow window_;
  ObjectId left_, right_;
};

TEST_F(SceneToolsTest, AClickSelectsAndOneOnNothingClears) {
  click(face(left_));
  EXPECT_EQ(session().selection(), std::vector{left_});
  click(face(right_));
  EXPECT_EQ(session().selection(), std::vector{right_});
  click(face(left_), Qt::ShiftModifier);
  EXPECT_EQ(session().selection(), (std::vector{right_, left_}));
  click(face(right_), Qt::ControlModifier);
  EXPECT_EQ(session().selection(), std::vector{left_});
  click(QPointF(400.0, 10.0));
  EXPECT_TRUE(session().selection().empty());
}

TEST_F(SceneToolsTest, ADragMovesWithTheMouseAndIsOneAction) {
  const QPointF from = face(left_);
  drag(from, pixel(Vector3(-0.3, 0.2, 0.1)));
  EXPECT_TRUE(at(left_).isApprox(Vector3(-0.3, 0.2, 0.0), 1e-9));
  EXPECT_EQ(session().selection(), std::vector{left_});
  EXPECT_EQ(session().history().undo_name(), "Move left");
  ASSERT_TRUE(session().history().undo());
  EXPECT_EQ(at(left_), Vector3(-0.3, 0.0, 0.0));
  EXPECT_EQ(session().history().undo_name(), "Edit");
  EXPECT_EQ(refused_, "");
}

TEST_F(SceneToolsTest, TheSymbolOfAnEffectIsSelectedAndDraggedAndTheDragUndone) {
  const auto well = session().ids().next<ObjectId>();
  world::PhysicalObject object{.name = "well"};
  object.fixture = std::make_shared<const world::Fixture>(world::ForceEffect{"well:0,0,0,0.05,1"});
  perform(world::CreateObject{well, 0, object});
  settle();
  const QPointF rim = pixel(Vector3(0.0, 0.05, 0.0));
  click(rim);
  EXPECT_EQ(session().selection(), std::vector{well});
  click(QPointF(400.0, 10.0));
  EXPECT_TRUE(session().selection().empty());
  drag(rim, pixel(Vector3(0.0, 0.25, 0.0)));
  EXPECT_LT((at(well) - Vector3(0.0, 0.2, 0.0)).norm(), 1e-3) << at(well).transpose();
  EXPECT_EQ(session().history().undo_name(), "Move well");
  ASSERT_TRUE(session().history().undo());
  EXPECT_EQ(at(well), Vector3(Vector3::Zero()));
  EXPECT_EQ(refused_, "");
}

TEST_F(SceneToolsTest, ADragOfOneMovesAllThatIsSelected) {
  session().select({left_, right_});
  drag(face(left_), pixel(Vector3(-0.4, 0.0, 0.1)));
  EXPECT_TRUE(at(left_).isApprox(Vector3(-0.4, 0.0, 0.0), 1e-9));
  EXPECT_TRUE(at(right_).isApprox(Vector3(0.2, 0.0, 0.0), 1e-9));
  EXPECT_EQ(session().history().undo_name(), "Move 2 objects");
}

TEST_F(SceneToolsTest, AHeldKeyKeepsADragToItsAxis) {
  mouse(QEvent::MouseButtonPress, face(left_));
  key(QEvent::KeyPress, Qt::Key_X);
  mouse(QEvent::MouseMove, pixel(Vector3(-0.1, 0.3, 0.1)));
  tools_.tick();
  EXPECT_GT(at(left_).x(), -0.29);
  EXPECT_EQ(at(left_).y(), 0.0);
  key(QEvent::KeyRelease, Qt::Key_X);
  mouse(QEvent::MouseMove, pixel(Vector3(-0.1, 0.2, 0.1)));
  mouse(QEvent::MouseButtonRelease, pixel(Vector3(-0.1, 0.2, 0.1)));
  EXPECT_TRUE(at(left_).isApprox(Vector3(-0.1, 0.2, 0.0), 1e-9));
}

TEST_F(SceneToolsTest, WhatIsLetGoGetsToWhereItIsDraggedAsSoonAsItIsKnownHowFar) {
  // Of so many triangles that the main thread does not wait for them.
  for (const ObjectId id : {left_, right_}) {
    const auto ball = geometry::tessellate(geometry::Sphere{0.1}, 3e-6);
    perform(world::ReplaceGeometry{world().find(id)->geometry, std::make_shared<world::MeshGeometry>(ball)});
  }
  settle();
  const auto arrive = [&] {
    while (tools_.drag_words() == "Finding out how far it can go\u2026") tools_.tick();
  };
  const auto flick = [&] {
    mouse(QEvent::MouseButtonPress, face(left_));
    mouse(QEvent::MouseMove, pixel(Vector3(0.25, 0.0, 0.1)));
    mouse(QEvent::MouseButtonRelease, pixel(Vector3(0.25, 0.0, 0.1)));
    EXPECT_EQ(at(left_).x(), -0.3);
    EXPECT_EQ(tools_.drag_words(), "Finding out how far it can go\u2026");
  };
  flick();
  tools_.finish();  // as something else begins
  EXPECT_EQ(tools_.drag_words(), "");
  tools_.tick();
  EXPECT_EQ(at(left_).x(), -0.3);
  flick();
  arrive();
  EXPECT_NEAR(at(left_).x(), 0.1, 1e-3);
  EXPECT_EQ(refused_, "");
  ASSERT_TRUE(session().history().undo());
  EXPECT_EQ(at(left_), Vector3(-0.3, 0.0, 0.0));
}

TEST_F(SceneToolsTest, ADragStopsAtWhatIsInTheWay) {
  mouse(QEvent::MouseButtonPress, face(left_));
  mouse(QEvent::MouseMove, pixel(Vector3(0.25, 0.05, 0.1)));
  tools_.tick();
  EXPECT_NEAR(at(left_).x(), 0.1, 1e-5);
  EXPECT_NEAR(at(left_).y(), 0.05, 1e-5) << "it slides along";
  EXPECT_EQ(tools_.drag_words(), "Stopped at right");
  key(QEvent::KeyPress, Qt::Key_X);
  mouse(QEvent::MouseMove, pixel(Vector3(0.9, 0.1, 0.1)));
  mouse(QEvent::MouseButtonRelease, pixel(Vector3(0.9, 0.1, 0.1)));
  EXPECT_NEAR(at(left_).x(), 0.1, 1e-5);
  EXPECT_NEAR(at(left_).y(), 0.0, 1e-9);
  EXPECT_EQ(tools_.drag_words(), "");
  key(QEvent::KeyRelease, Qt::Key_X);
  session().select({left_});
  key(QEvent::KeyPress, Qt::Key_Right);
  EXPECT_NEAR(at(left_).x(), 0.1, 1e-5) << "nor by the keyboard";
  ASSERT_TRUE(session().history().undo());
  EXPECT_EQ(at(left_), Vector3(-0.3, 0.0, 0.0));
  session().hands().set_grab({.stop = false});
  settle();
  drag(face(left_), pixel(Vector3(0.25, 0.05, 0.1)));
  EXPECT_NEAR(at(left_).x(), 0.25, 1e-9);
  EXPECT_EQ(refused_, "");
}

TEST_F(SceneToolsTest, ADragSnapsUnlessAltIsHeld) {
  session::GrabSettings settings;
  settings.snaps.grid = true;
  settings.snaps.spacing = settings.snaps.radius = 0.05;
  session().hands().set_grab(settings);
  mouse(QEvent::MouseButtonPress, face(left_));
  const QPointF there = pixel(Vector3(-0.21, 0.12, 0.1));
  mouse(QEvent::MouseMove, there);
  tools_.tick();
  EXPECT_TRUE(at(left_).isApprox(Vector3(-0.2, 0.1, 0.0), 1e-9)) << at(left_).transpose();
  EXPECT_EQ(tools_.drag_words(), "Snapped to the grid");
  mouse(QEvent::MouseMove, there, Qt::LeftButton, Qt::AltModifier);
  tools_.tick();
  EXPECT_TRUE(at(left_).isApprox(Vector3(-0.21, 0.12, 0.0), 1e-9));
  mouse(QEvent::MouseButtonRelease, there, Qt::LeftButton, Qt::AltModifier);
  EXPECT_TRUE(at(left_).isApprox(Vector3(-0.21, 0.12, 0.0), 1e-9));
}

TEST_F(SceneToolsTest, EscapeTakesADragBack) {
  mouse(QEvent::MouseButtonPress, face(left_));
  mouse(QEvent::MouseMove, pixel(Vector3(0.0, 0.3, 0.1)));
  tools_.tick();
  EXPECT_NE(at(left_), Vector3(-0.3, 0.0, 0.0));
  key(QEvent::KeyPress, Qt::Key_Escape);
  EXPECT_EQ(at(left_), Vector3(-0.3, 0.0, 0.0));
  mouse(QEvent::MouseMove, pixel(Vector3(0.0, -0.3, 0.1)));
  mouse(QEvent::MouseButtonRelease, pixel(Vector3(0.0, -0.3, 0.1)));
  EXPECT_EQ(at(left_), Vector3(-0.3, 0.0, 0.0));
}

TEST_F(SceneToolsTest, AnotherWorldEndsADrag) {
  mouse(QEvent::MouseButtonPress, face(left_));
  mouse(QEvent::MouseMove, pixel(Vector3(0.0, 0.3, 0.1)));
  tools_.tick();
  session().files().make_new();
  session().update();
  mouse(QEvent::MouseMove, pixel(Vector3(0.0, 0.2, 0.1)));
  tools_.tick();
  mouse(QEvent::MouseButtonRelease, pixel(Vector3(0.0, 0.2, 0.1)));
  EXPECT_FALSE(session().history().can_undo());
  EXPECT_EQ(refused_, "");
}

TEST_F(SceneToolsTest, ArrowsNudgeByMillimetres) {
  session().select({left_});
  key(QEvent::KeyPress, Qt::Key_Right);
  EXPECT_TRUE(at(left_).isApprox(Vector3(-0.299, 0.0, 0.0), 1e-9));
  key(QEvent::KeyPress, Qt::Key_Up, Qt::ShiftModifier);
  key(QEvent::KeyPress, Qt::Key_Up, Qt::ShiftModifier, true);
  EXPECT_TRUE(at(left_).isApprox(Vector3(-0.299, 0.02, 0.0), 1e-9));
  ASSERT_TRUE(session().history().undo());  // what one key did while it was held
  EXPECT_TRUE(at(left_).isApprox(Vector3(-0.299, 0.0, 0.0), 1e-9));
}

TEST_F(SceneToolsTest, RightDragTurnsAndMiddleDragShiftsTheView) {
  const Vector3 eye = session().view().now().world_from_eye.translation();
  drag({400.0, 300.0}, {430.0, 300.0}, Qt::RightButton);
  Vector3 moved = session().view().now().world_from_eye.translation();
  EXPECT_LT(moved.x(), eye.x());  // what is seen follows the mouse
  EXPECT_NEAR(moved.norm(), eye.norm(), 1e-9);
  EXPECT_EQ(asked_, 0);
  const interaction::View before = session().view().now();
  drag({400.0, 300.0}, {430.0, 300.0}, Qt::MiddleButton);
  EXPECT_TRUE(session().view().now().world_from_eye.linear().isApprox(before.world_from_eye.linear()));
  moved = before.world_from_eye.inverse() * session().view().now().world_from_eye.translation();
  EXPECT_LT(moved.x(), 0.0);
  EXPECT_TRUE(session().selection().empty());
}

TEST_F(SceneToolsTest, ARightClickAsksForTheMenu) {
  mouse(QEvent::MouseButtonPress, {400.0, 300.0}, Qt::RightButton);
  mouse(QEvent::MouseButtonRelease, {401.0, 300.0}, Qt::RightButton);
  EXPECT_EQ(asked_, 1);
}

TEST_F(SceneToolsTest, TheWheelZoomsTowardsTheMouse) {
  const QPointF mouse_at = face(left_);
  QWheelEvent event(mouse_at, mouse_at, {}, {0, 120}, Qt::NoButton, {}, Qt::NoScrollPhase, false);
  QCoreApplication::sendEvent(&window_, &event);
  const QPointF after = face(left_);
  EXPECT_NEAR(after.x(), mouse_at.x(), 1e-6);
  EXPECT_NEAR(after.y(), mouse_at.y(), 1e-6);
  EXPECT_LT(session().view().now().world_from_eye.translation().z(), 2.0);
}

TEST_F(SceneToolsTest, KeysChooseTheTool) {
  EXPECT_EQ(tools_.tool(), Tool::Select);
  key(QEvent::KeyPress, Qt::Key_Tab);
  EXPECT_EQ(tools_.tool(), Tool::Touch);
  key(QEvent::KeyPress, Qt::Key_Tab);
  EXPECT_EQ(tools_.tool(), Tool::View);
  key(QEvent::KeyPress, Qt::Key_Tab);
  EXPECT_EQ(tools_.tool(), Tool::Shape);
  EXPECT_TRUE(session().hands().shaping());
  key(QEvent::KeyPress, Qt::Key_Escape);
  EXPECT_FALSE(session().hands().shaping());
  EXPECT_EQ(tools_.tool(), Tool::Select);
}

TEST_F(SceneToolsTest, InTheViewToolTheLeftButtonTurns) {
  tools_.choose(Tool::View);
  const Vector3 eye = session().view().now().world_from_eye.translation();
  drag(face(left_), face(left_) + QPointF(0.0, 40.0));
  EXPECT_GT(session().view().now().world_from_eye.translation().y(), eye.y());
  EXPECT_EQ(at(left_), Vector3(-0.3, 0.0, 0.0));
}

/// Pens are tablets' pointing devices.
class PenTest : public SceneToolsTest {
 protected:
  bool pen(QEvent::Type type, QPointF at, double pressure) {
    static const QPointingDevice kPen(
        "pen", 1, QInputDevice::DeviceType::Stylus, QPointingDevice::PointerType::Pen,
        QInputDevice::Capability::Position | QInputDevice::Capability::Pressure, 1, 1);
    QTabletEvent event(type, &kPen, at, at, pressure, 0, 0, 0, 0, 0, {}, Qt::LeftButton,
                       pressure > 0.0 ? Qt::LeftButton : Qt::NoButton);
    event.setAccepted(false);
    QCoreApplication::sendEvent(&window_, &event);
    return event.isAccepted();
  }
};

TEST_F(PenTest, PressesIntoWhatIsUnderIt) {
  EXPECT_FALSE(pen(QEvent::TabletMove, face(left_), 0.0)) << "the other tools take it as a mouse";
  tools_.choose(Tool::Touch);
  EXPECT_TRUE(pen(QEvent::TabletMove, face(left_), 0.0));
  const auto& hand = session().hands().pointer(0);
  // It hovers over the box first, then its tip is held at the surface.
  ASSERT_TRUE(
      hand_until([&] { return !hand.touching && (hand.tip - Vector3(-0.3, 0.0, 0.1)).norm() < 0.05; }));
  EXPECT_TRUE(pen(QEvent::TabletPress, face(left_), 0.8));
  ASSERT_TRUE(hand_until([&] { return hand.touching && hand.force.z() > 0.1; }));
  EXPECT_NEAR(hand.scp.z(), 0.1, 1e-6);
  EXPECT_EQ(session().hands().touched(0), left_);
  EXPECT_TRUE(pen(QEvent::TabletRelease, face(left_), 0.8));
  EXPECT_TRUE(hand_until([&] { return !hand.touching; }));
}

TEST_F(PenTest, IsLiftedWhenTouchIsLeft) {
  tools_.choose(Tool::Touch);
  mouse(QEvent::MouseMove, face(right_));
  mouse(QEvent::MouseButtonPress, face(right_));
  ASSERT_TRUE(hand_until([&] { return session().hands().pointer(0).touching; }));
  tools_.choose(Tool::Select);
  EXPECT_TRUE(hand_until([&] { return !session().hands().pointer(0).touching; }));
}

TEST_F(PenTest, EnterPressesToo) {
  tools_.choose(Tool::Touch);
  mouse(QEvent::MouseMove, face(right_));
  key(QEvent::KeyPress, Qt::Key_Return);
  EXPECT_TRUE(hand_until([&] { return session().hands().pointer(0).touching; }));
  key(QEvent::KeyRelease, Qt::Key_Return);
  EXPECT_TRUE(hand_until([&] { return !session().hands().pointer(0).touching; }));
}

TEST_F(PenTest, AFreeHandGoesAsTheMouseGoesAndTheWheelAway) {
  tools_.stay_with(Tool::Touch);
  mouse(QEvent::MouseMove, {123.0, 456.0});  // wherever the mouse is
  const Vector3 start(0.3, 0.0, 0.3);
  tools_.touch_tool().go_freely(start);
  const auto& hand = session().hands().pointer(0);
  const auto is_at = [&](const Vector3& place) {
    return hand_until([&] { return (hand.tip - place).norm() < 0.002; });
  };
  session().hands().put(start);
  EXPECT_TRUE(is_at(start));
  const QPointF right = pixel(start + Vector3(0.05, 0.0, 0.0)) - pixel(start);
  mouse(QEvent::MouseMove, QPointF(123.0, 456.0) + right);
  EXPECT_TRUE(is_at(start + Vector3(0.05, 0.0, 0.0)));
  tools_.touch_tool().turn_wheel(10.0);  // 5 cm away
  EXPECT_TRUE(is_at(start + Vector3(0.05, 0.0, -0.05)));
  tools_.touch_tool().turn_wheel(32.0);  // 1 cm into the box
  EXPECT_TRUE(hand_until([&] { return hand.touching && hand.force.z() > 0.1; }));
  EXPECT_EQ(session().hands().touched(0), right_);
}

TEST_F(SceneToolsTest, AClickThatIsShorterThanATickIsNotMissed) {
  tools_.choose(Tool::Touch);
  click({400.0, 300.0});
  EXPECT_TRUE(tools_.touch_tool().take_press());
  EXPECT_FALSE(tools_.touch_tool().take_press());
}

TEST_F(SceneToolsTest, AToolThatStaysCannotBeLeftNorTheViewMoved) {
  tools_.stay_with(Tool::Touch);
  const auto before = session().view().now().world_from_eye.matrix();
  tools_.choose(Tool::Select);
  tools_.key_press(Qt::Key_Tab, {}, false);
  tools_.key_press(Qt::Key_Escape, {}, false);
  EXPECT_EQ(tools_.tool(), Tool::Touch);
  drag({300.0, 300.0}, {500.0, 350.0}, Qt::RightButton);
  drag({300.0, 300.0}, {500.0, 350.0}, Qt::MiddleButton);
  tools_.wheel({.at = {400.0, 300.0}, .size = {800.0, 600.0}}, 3.0);
  settle();
  EXPECT_EQ(session().view().now().world_from_eye.matrix(), before);
  EXPECT_EQ(asked_, 0);
}

/// A plate of 0.2 m that the eye looks at, with a hole through it on the right, alone in the design.
class PartToolTest : public SceneToolsTest {
 protected:
  PartToolTest() {
    geometry::CsgTree tree;
    const auto block = tree.add_leaf(geometry::Box{{0.1, 0.1, 0.02}});
    const auto hole = tree.add_leaf(geometry::Cylinder{0.02, 0.1}, at_x(0.05));
    tree.add(geometry::CsgOperator::Difference, block, hole);
    perform(world::ReplaceGeometry{world().find(left_)->geometry,
                                   std::make_shared<world::CsgGeometry>(std::move(tree))});
    perform(world::PlaceObject{left_, base::Affine3::Identity()});
    settle();
  }
  static base::Affine3 at_x(double x) { return base::Affine3(Eigen::Translation3d(x, 0.0, 0.0)); }
  /// Does a finger that comes from the eye's side go through the plate there?
  bool goes_through(double x, double y) {
    session().settle();
    return !session().stage().pick({Vector3(x, y, 1.0), -Vector3::UnitZ()});
  }
  /// On the rim of the hole's ghost, before the plate.
  QPointF rim(double x) { return pixel(Vector3(x, 0.02, 0.05)); }
};

TEST_F(PartToolTest, AHoleIsDraggedByItsGhostAndFeltAtOnceAndTheDragUndone) {
  EXPECT_TRUE(goes_through(0.05, 0.0));
  session().select({left_});
  mouse(QEvent::MouseMove, rim(0.05));
  tools_.tick();
  EXPECT_EQ(tools_.drag_words().substr(0, 18), "Operand 1 of left:");
  mouse(QEvent::MouseButtonPress, rim(0.05));
  for (const double x : {0.03, 0.0, -0.03}) {
    mouse(QEvent::MouseMove, rim(x));
    tools_.tick();
    EXPECT_TRUE(goes_through(x, 0.0)) << x;
  }
  mouse(QEvent::MouseButtonRelease, rim(-0.05));
  EXPECT_TRUE(goes_through(-0.05, 0.0));
  EXPECT_FALSE(goes_through(0.05, 0.0));
  EXPECT_EQ(at(left_), Vector3(Vector3::Zero())) << "the solid itself stays";
  EXPECT_EQ(session().history().undo_name(), "Move operand 1 of left");
  ASSERT_TRUE(session().history().undo());
  EXPECT_TRUE(goes_through(0.05, 0.0));
  EXPECT_EQ(session().history().undo_name(), "Edit");
  EXPECT_EQ(refused_, "");
}

TEST_F(PartToolTest, GhostsAreThereOnlyWhileTheirObjectIsSelectedAndLeaveClicksToWhatIsBehind) {
  drag(rim(0.05), rim(0.0));
  EXPECT_LT(at(left_).x(), -0.04) << "the solid, with its hole";
  ASSERT_TRUE(session().history().undo());
  settle();
  session().select({left_});
  click(rim(0.05), Qt::ControlModifier);
  EXPECT_TRUE(session().selection().empty());
  click(rim(0.05), Qt::ControlModifier);
  EXPECT_EQ(session().selection(), std::vector{left_});
}

TEST_F(PartToolTest, EscapeTakesItBackAndAnAxisKeepsIt) {
  session().select({left_});
  mouse(QEvent::MouseButtonPress, rim(0.05));
  key(QEvent::KeyPress, Qt::Key_X);
  mouse(QEvent::MouseMove, rim(0.0) + QPointF(0.0, 20.0));
  tools_.tick();
  EXPECT_TRUE(goes_through(0.0, 0.0)) << "it keeps to x";
  key(QEvent::KeyPress, Qt::Key_Escape);
  key(QEvent::KeyRelease, Qt::Key_X);
  EXPECT_TRUE(goes_through(0.05, 0.0));
  EXPECT_EQ(session().history().undo_name(), "Edit");
  mouse(QEvent::MouseButtonRelease, rim(0.0));
}

TEST_F(PartToolTest, WhatAHandDragsStaysPointedOutWhereverTheMouseIs) {
  const auto marked = [this] {
    const auto& it = session().stage().marked_part();
    return it ? it->part.operand : std::nullopt;
  };
  session().select({left_});
  const Vector3 grip(0.05, 0.02, 0.05);  // on the rim of the hole's ghost, in the air
  session().hands().put(grip);
  ASSERT_TRUE(hand_until([&] { return (session().hands().pointer(0).tip - grip).norm() < 1e-3; }));
  session().hands().hold_buttons(1);
  ASSERT_TRUE(hand_until([&] { return session().hands().holds(0); }));
  const QPointF edge = pixel(Vector3(0.0, 0.1, 0.02));  // of the block's ghost
  for (const QPointF& there : {face(right_), edge}) {
    mouse(QEvent::MouseMove, there);
    tools_.tick();
    EXPECT_EQ(marked(), 1U);
    EXPECT_EQ(tools_.drag_words(), "");
  }
  session().hands().hold_buttons(0);
  ASSERT_TRUE(hand_until([&] { return !session().hands().holds(0); }));
  tools_.tick();
  EXPECT_EQ(marked(), 0U) << "what the mouse is over";
  tools_.leave();
  EXPECT_FALSE(session().stage().marked_part());
}

TEST_F(PartToolTest, CtrlTurnsIt) {
  session().select({left_});
  // The block, by its upper edge, an eighth turn about its middle: its corner comes to where nothing was.
  EXPECT_TRUE(goes_through(0.0, 0.12));
  const QPointF grip = pixel(Vector3(0.0, 0.1, 0.02)), to = pixel(Vector3(-0.1, 0.1, 0.02));
  mouse(QEvent::MouseButtonPress, grip, Qt::LeftButton, Qt::ControlModifier);
  mouse(QEvent::MouseMove, to, Qt::LeftButton, Qt::ControlModifier);
  mouse(QEvent::MouseButtonRelease, to, Qt::LeftButton, Qt::ControlModifier);
  EXPECT_FALSE(goes_through(0.0, 0.12));
  EXPECT_TRUE(goes_through(0.09, 0.09));
  EXPECT_EQ(session().history().undo_name(), "Move operand 0 of left");
  EXPECT_EQ(refused_, "");
}

}  // namespace
}  // namespace icome::ui
