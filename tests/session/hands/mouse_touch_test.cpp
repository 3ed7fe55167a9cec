// The mouse's hand on things: what is picked, the hand's spring and the surface contact point together.
#include <gtest/gtest.h>

#include <cmath>

#include "devices/simulated/simulated_device.h"
#include "geometry/csg/csg_solid.h"
#include "haptics/servo/servo.h"
#include "haptics/shapes/primitive_shape.h"
#include "haptics/shapes/smooth_shape.h"
#include "repeats.h"
#include "session/display/picking.h"

namespace icome::session {
namespace {

using base::Pose;
using base::Vector3;
using haptics::HapticObject;
using haptics::HapticScene;

HapticObject thing(std::uint32_t id, const char* primitive, const Pose& pose, double friction) {
  HapticObject object;
  object.id = {id, 1};
  object.shape = std::make_shared<haptics::PrimitiveShape>(*geometry::parse_primitive(primitive));
  object.world_from_object = pose;
  object.surface.static_friction = object.surface.dynamic_friction = friction;
  return object;
}

/// A person with a mouse: 60 pictures a second, the servo in between.
class MousePerson {
 public:
  MousePerson(std::shared_ptr<const HapticScene> scene, const interaction::View& view)
      : scene_(std::move(scene)),
        view_(view),
        device_(starting_at(view.world_from_eye.translation())),
        servo_(device_, {}) {
    servo_.publish(scene_);
  }

  /// Looks, aims, and lets the hand follow for one picture.
  void frame(double x, double y, double pressure, double wheel = 0.0) {
    interaction::MouseHand::Input input;
    input.ray = interaction::ray_through(view_, x, y, 1.5);
    input.view_width = 2.0 * interaction::half_picture(view_, 1.5).x();
    input.distance = view_.distance;
    if (const auto picked = pick(*scene_, input.ray)) input.picked = picked->place;
    input.pressure = pressure;
    input.wheel = wheel;
    input.hand = scp();
    picked_ = input.picked;
    device_.set_target(hand_.target(input));
    for (int tick = 0; tick < 16; ++tick) servo_.tick(1e-3);
  }
  void frames(int count, double x, double y, double pressure) {
    for (int i = 0; i < count; ++i) frame(x, y, pressure);
  }

  bool touching() const { return servo_.last().contact.touching; }
  Vector3 scp() const { return touching() ? servo_.last().contact.scp : servo_.last().tip; }
  std::uint32_t touched() const { return servo_.last().object.index; }
  double force() const { return servo_.last().force.norm(); }
  const std::optional<interaction::PickedPoint>& picked() const { return picked_; }

 private:
  static devices::SimulatedSettings starting_at(const Vector3& place) {
    devices::SimulatedSettings settings;
    settings.start = place;
    return settings;
  }

  std::shared_ptr<const HapticScene> scene_;
  interaction::View view_;
  devices::SimulatedDevice device_;
  haptics::Servo servo_;
  interaction::MouseHand hand_;
  std::optional<interaction::PickedPoint> picked_;
};

interaction::View from_above() {
  interaction::View view;
  base::Bounds bounds(Vector3(-0.2, 0.0, -0.2), Vector3(0.2, 0.1, 0.2));
  return interaction::fitted(view, bounds, Vector3(0.0, 1.0, 1.2), Vector3::UnitY(), 1.5);
}

std::shared_ptr<const HapticScene> block_on_floor(double friction) {
  Pose floor = Pose::Identity();
  floor.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;  // its front towards +y
  return HapticScene::compile(
      {thing(1, "plane", floor, friction),
       thing(2, "box:0.12x0.1x0.12", Pose(Eigen::Translation3d(0.0, 0.05, 0.0)), friction)});
}

TEST(MouseTouch, HoversWithoutTouchingAndTouchesUnderTheMouse) {
  MousePerson person(block_on_floor(0.3), from_above());
  for (const double x : {-0.6, 0.0, 0.5}) {
    person.frames(40, x, 0.1, 0.0);
    EXPECT_FALSE(person.touching()) << x;
    person.frames(40, x, 0.1, 0.5);
    ASSERT_TRUE(person.touching()) << x;
    EXPECT_LT((person.scp() - person.picked()->point).norm(), 4e-3) << x;  // friction holds it there
    EXPECT_GT(person.force(), 0.3);
    person.frames(40, x, 0.1, 0.0);
    EXPECT_FALSE(person.touching()) << x;
  }
}

TEST(MouseTouch, HarderIsHarder) {
  MousePerson person(block_on_floor(0.0), from_above());
  double last = 0.0;
  for (const double pressure : {0.1, 0.3, 0.6}) {
    person.frames(60, -0.6, 0.0, pressure);
    EXPECT_GT(person.force(), 1.2 * last);
    last = person.force();
  }
}

TEST(MouseTouch, SlidesUnderTheMouse) {
  for (const double friction : {0.0, 0.4}) {
    MousePerson person(block_on_floor(friction), from_above());
    person.frames(40, -0.7, -0.4, 0.5);
    double farthest = 0.0;
    for (int i = 0; i < 90; ++i) {
      person.frame(-0.7 + i * 0.01, -0.4, 0.5);
      EXPECT_TRUE(person.touching()) << friction << " " << i;
      farthest = std::max(farthest, (person.scp() - person.picked()->point).norm());
    }
    EXPECT_LT(farthest, 0.03) << friction;
    person.frames(20, 0.2, -0.4, 0.5);
    EXPECT_LT((person.scp() - person.picked()->point).norm(), friction > 0.0 ? 0.01 : 1e-3) << friction;
  }
}

TEST(MouseTouch, GetsOverWhatStandsInTheWay) {
  for (const double step : {0.003, 0.01, 0.05, 0.3}) {  // of half the picture, each frame
    for (const double friction : {0.0, 0.3}) {
      MousePerson person(block_on_floor(friction), from_above());
      double x = -0.8;
      person.frames(40, x, 0.15, 0.5);
      EXPECT_EQ(person.touched(), 1U);
      for (; x < 0.0; x += step) person.frame(x, 0.15, 0.5);
      person.frames(60, 0.0, 0.15, 0.5);
      ASSERT_TRUE(person.touching()) << step << " " << friction;
      EXPECT_EQ(person.touched(), 2U);
      EXPECT_NEAR(person.scp().y(), 0.1, 1e-6)
          << step << " " << friction;  // on the top, not hung at the side
      for (; x < 0.8; x += step) person.frame(x, 0.15, 0.5);
      person.frames(60, 0.8, 0.15, 0.5);
      EXPECT_EQ(person.touched(), 1U);  // and down again
      EXPECT_NEAR(person.scp().y(), 0.0, 1e-6) << step << " " << friction;
    }
  }
}

/// A cube rounded by a ball, with a hole along each axis and a ball in its middle, as in the demo.
std::shared_ptr<const HapticScene> hollow_solid(double friction) {
  geometry::CsgTree tree;
  const auto leaf = [&](const char* text, const Pose& pose = Pose::Identity()) {
    return tree.add_leaf(*geometry::parse_primitive(text), base::Affine3(pose));
  };
  const auto turned = [](const Vector3& axis) { return Pose(Eigen::AngleAxisd(1.5707963267948966, axis)); };
  using geometry::CsgOperator;
  auto root = tree.add(CsgOperator::Intersection, leaf("box:0.094x0.094x0.094"), leaf("sphere:0.061"));
  for (const Pose& hole : {Pose(Pose::Identity()), turned(Vector3::UnitX()), turned(Vector3::UnitY())})
    root = tree.add(CsgOperator::Difference, root, leaf("cylinder:0.0255x0.2", hole));
  root = tree.add(CsgOperator::Union, root, leaf("sphere:0.02"));
  HapticObject object;
  object.id = {1, 1};
  object.shape = std::make_shared<haptics::SmoothShape>(std::make_shared<geometry::CsgSolid>(tree));
  object.world_from_object =
      Pose(Eigen::Translation3d(0.0, 0.047, 0.0)) * Pose(Eigen::AngleAxisd(0.5, Vector3::UnitY()));
  object.surface.static_friction = object.surface.dynamic_friction = friction;
  return HapticScene::compile({object});
}

TEST(MouseTouch, HardlyEverChattersHoweverDeepTheWheelPresses) {
  constexpr int kApart = kSanitizerShare > 1 ? 2 : 1;  // fewer places where sanitizers make each slow
  interaction::View view;
  const base::Bounds bounds(Vector3(-0.25, -0.05, -0.15), Vector3(0.25, 0.15, 0.15));
  view = interaction::fitted(view, bounds, Vector3(0.4, 0.6, 1.0), Vector3::UnitY(), 1.5);
  int tried = 0, chattering = 0;
  for (const double friction : {0.0, 0.2}) {
    const auto scene = hollow_solid(friction);
    for (double x = -0.2; x <= 0.2; x += kApart * 0.025) {
      for (double y = -0.3; y <= 0.3; y += kApart * 0.04) {
        MousePerson person(scene, view);
        person.frames(30, x, y, 0.0);
        if (!person.picked()) continue;
        ++tried;
        person.frames(30, x, y, 0.5);
        for (int notch = 0; notch < 20; ++notch) person.frame(x, y, 0.5, 1.0);
        person.frames(120, x, y, 0.5);
        int lost = 0;
        double jumps = 0.0;  // N; what the motors' rating takes away falls slowly
        for (int i = 0; i < 120; ++i) {
          const bool before = person.touching();
          const double force = person.force();
          person.frame(x, y, 0.5);
          lost += int(before && !person.touching());
          jumps = std::max(jumps, std::abs(person.force() - force));
        }
        chattering += int(lost > 0 || jumps > 0.1);
      }
    }
  }
  EXPECT_GT(tried, 50 / (kApart * kApart));
  EXPECT_LT(chattering, tried / 10) << "where the hand slides off before it has arrived, it still does";
}

}  // namespace
}  // namespace icome::session
