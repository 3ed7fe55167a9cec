// The mouse over pictures of two eyes, and over a screen that is a window into the world.
#include "ui/tools/scene_input.h"

#include "devices/simulated/simulated_head.h"
#include "ui/desktop_test.h"
#include "ui/tools/scene_tools.h"

namespace icome::ui {
namespace {

using base::Vector3;
using interaction::Eye;
using interaction::StereoKind;

SceneInput over_scene(double x, double y) { return {.at = {x, y}, .size = {800.0, 600.0}}; }

TEST(SceneInput, EachHalfIsThePictureOfAnEye) {
  const interaction::StereoSettings beside = {StereoKind::SideBySide};
  const SceneInput left = in_eye(over_scene(100.0, 150.0), beside),
                   right = in_eye(over_scene(500.0, 150.0), beside);
  EXPECT_EQ(left.eye, Eye::Left);
  EXPECT_EQ(right.eye, Eye::Right);
  EXPECT_EQ(left.at, QPointF(100.0, 150.0));
  EXPECT_EQ(right.at, left.at);
  EXPECT_EQ(right.size, QSizeF(400.0, 600.0));
  EXPECT_EQ(right.in_window, QPointF(500.0, 150.0));
  const SceneInput below = in_eye(over_scene(100.0, 450.0), {StereoKind::TopBottom});
  EXPECT_EQ(below.eye, Eye::Right);
  EXPECT_EQ(below.at, QPointF(100.0, 150.0));
  EXPECT_EQ(below.size, QSizeF(800.0, 300.0));
  EXPECT_EQ(in_eye(over_scene(500.0, 450.0), {StereoKind::Anaglyph}).eye, Eye::Middle);
  EXPECT_EQ(in_eye(over_scene(500.0, 450.0), {}).at, QPointF(500.0, 450.0));
}

TEST(SceneInput, AHeldButtonStaysWithItsEye) {
  const SceneInput dragged = in_eye(over_scene(500.0, 150.0), {StereoKind::SideBySide}, Eye::Left);
  EXPECT_EQ(dragged.eye, Eye::Left);
  EXPECT_EQ(dragged.at, QPointF(500.0, 150.0)) << "beyond its edge, without a leap";
}

TEST(SceneInput, SqueezedHalvesCountAsTheyAreStretched) {
  const SceneInput input = in_eye(over_scene(500.0, 150.0), {StereoKind::SideBySide, 0.063, true});
  EXPECT_EQ(input.at, QPointF(200.0, 150.0));
  EXPECT_EQ(input.size, QSizeF(800.0, 600.0));
}

/// A session with a head and a box of 0.2 m at the middle, 2 m off.
class EyesTest : public DesktopTest {
 protected:
  EyesTest() : EyesTest(new devices::SimulatedHead) {}

  /// The place in the whole window where an eye sees a point, by similar triangles on the screen; shares.
  static base::Vector2 seen_at(const Vector3& point, const Vector3& eye, const base::Vector2& half) {
    const double part = eye.z() / (eye.z() - point.z());
    const base::Vector2 on_screen = eye.head<2>() + part * (point.head<2>() - eye.head<2>());
    return on_screen.cwiseQuotient(half);
  }

  devices::SimulatedHead* head_;

 private:
  explicit EyesTest(devices::SimulatedHead* head) : DesktopTest(settings(head)), head_(head) {
    const auto shape = session().ids().next<world::GeometryId>();
    const auto id = session().ids().next<world::ObjectId>();
    world::PhysicalObject object{.name = "box", .geometry = shape};
    object.parent_from_object.translation() = Vector3(0.5, 0.1, -1.0);
    const auto box = std::make_shared<world::PrimitiveGeometry>(geometry::Box{Vector3::Constant(0.1)});
    perform(world::EditGroup{{world::CreateGeometry{shape, box}, world::CreateObject{id, 0, object}}});
    interaction::View view;
    view.world_from_eye.translation() = Vector3(0.0, 0.0, 2.0);
    view.distance = 2.0;
    session().view().set(view);
    session().settle();
    session().update();
  }
  /// Takes the head.
  static session::SessionSettings settings(devices::SimulatedHead* head) {
    session::SessionSettings settings;
    settings.head.reset(head);
    return settings;
  }
};

TEST_F(EyesTest, TheMouseMeetsWhatTheEyeSeesThroughTheWindow) {
  // A screen of 0.4 m by 0.3 m, 0.6 m off, of which the world at the screen is 2 m / 0.6 m times as large.
  session().view().set_screen({0.4, 0.3});
  session().view().set_fish_tank(true);
  session().update();
  const interaction::View rest = session().view().now();
  const double scale = rest.distance / 0.6;
  const base::Vector2 half = 0.5 * scale * base::Vector2(0.4, 0.3);
  EXPECT_NEAR(rest.distance * std::tan(0.5 * rest.field), half.y(), 1e-9);
  head_->put(base::Pose(Eigen::Translation3d(0.15, -0.1, -0.1)));
  for (int i = 0; i < 8; ++i) session().update();
  const Vector3 eye = scale * Vector3(0.15, -0.1, 0.5);
  const Vector3 face(0.5, 0.1, -0.9);
  const auto mouse = [&](const Vector3& from, const SceneInput& before) {
    const base::Vector2 place = seen_at(face, from, half);
    SceneInput input = before;
    input.at = {0.5 * (1.0 + place.x()) * input.size.width(), 0.5 * (1.0 - place.y()) * input.size.height()};
    return input;
  };
  const SceneInput middle = mouse(eye, over_scene(0.0, 0.0));
  const auto picked = session().stage().pick_seen(middle.ray(session().view()));
  ASSERT_TRUE(picked);
  EXPECT_LT((picked->place.point - face).norm(), 1e-3);
  EXPECT_FALSE(session().stage().pick_seen(middle.ray(session().view().now())))
      << "from the eye at rest it is not";
  // Each eye with its own half, which is the whole screen squeezed.
  session().view().set_stereo({StereoKind::SideBySide, 0.1, true});
  session().update();
  const SceneInput left = in_eye(over_scene(10.0, 10.0), session().view().stereo());
  const auto by_left =
      session().stage().pick_seen(mouse(eye - scale * Vector3(0.05, 0.0, 0.0), left).ray(session().view()));
  ASSERT_TRUE(by_left);
  EXPECT_LT((by_left->place.point - face).norm(), 1e-3);
}

TEST_F(EyesTest, ATrialsWishForStereoComesBeforeWhatWasChosen) {
  session::SessionView& view = session().view();
  EXPECT_EQ(view.stereo().kind, StereoKind::Off);
  view.ask_for_stereo(true);
  EXPECT_EQ(view.stereo().kind, StereoKind::Anaglyph);
  view.set_stereo({StereoKind::TopBottom});
  EXPECT_EQ(view.stereo().kind, StereoKind::TopBottom);
  view.ask_for_stereo(false);
  EXPECT_EQ(view.stereo().kind, StereoKind::Off);
  view.ask_for_stereo(std::nullopt);
  EXPECT_EQ(view.stereo().kind, StereoKind::TopBottom);
}

TEST_F(EyesTest, ThePictureOfAnEyeHasTheShapeOfItsHalf) {
  SceneTools tools(session(), {});
  tools.resize({800.0, 600.0});
  EXPECT_NEAR(tools.aspect(), 4.0 / 3.0, 1e-12);
  session().view().set_stereo({StereoKind::SideBySide});
  tools.tick();
  EXPECT_NEAR(tools.aspect(), 2.0 / 3.0, 1e-12);
}

}  // namespace
}  // namespace icome::ui
