// The servo's tick: what it takes from the machine, and what it does when device or scene come and go.
#include "haptics/servo/servo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geometry/mesh/geodesic_sphere.h"
#include "haptics/contact_world.h"
#include "haptics/servo/servo_fixture.h"
#include "haptics/thesis/thesis_shapes.h"
#include "realtime/guard/guard.h"

namespace icome::haptics {
namespace {

std::shared_ptr<const Shape> thesis_shape(const geometry::Primitive& primitive) {
  geometry::CsgTree tree;
  tree.add_leaf(primitive);
  return *ThesisCsgShape::create(tree);
}

void press(Servo& servo, ScriptedDevice& device, double depth) {
  for (int i = 0; i <= 2000; ++i) {
    device.position = {0.0, 0.0, 0.051 - (0.001 + depth) * std::min(1.0, i / 50.0)};
    servo.tick(1e-3);
  }
}

TEST(Servo, PushesOutOfASurface) {
  ScriptedDevice device;
  Servo servo(device, {});
  servo.publish(box_scene());
  press(servo, device, 0.0005);
  EXPECT_TRUE(servo.last().contact.touching);
  EXPECT_EQ(servo.last().object, (base::ObjectId{1, 1}));
  EXPECT_NEAR(device.force.z(), 1000.0 * 0.0005, 1e-6);  // the nominal stiffness, at rest
  EXPECT_NEAR(device.force.head<2>().norm(), 0.0, 1e-9);
}

TEST(Servo, TellsThatASurfaceIsFeltSofterThanItWasMade) {
  HapticObject box = object(1, shape_of(primitive("box:0.1x0.1x0.1")));
  for (const double made : {700.0, 50000.0}) {
    box.surface.stiffness = made;
    ScriptedDevice device;
    Servo servo(device, {});
    servo.publish(HapticScene::compile({box}));
    press(servo, device, 0.0001);
    ASSERT_TRUE(servo.last().contact.touching);
    EXPECT_EQ(servo.last().asked_stiffness, made);
    EXPECT_NEAR(servo.last().stiffness, std::min(made, 1e4), 1e-6) << "100 g at 1 kHz: K dt^2/m <= 0.1";
  }
}

TEST(Servo, IsQuietWithoutASceneAndAboveTheSurface) {
  ScriptedDevice device;
  Servo servo(device, {});
  servo.tick(1e-3);
  EXPECT_EQ(device.force, Vector3::Zero());
  servo.publish(box_scene());
  device.position = {0.0, 0.0, 0.06};
  servo.tick(1e-3);
  EXPECT_EQ(device.force, Vector3::Zero());
}

TEST(Servo, LetsGoOfALostDeviceAndOfNumbersThatAreNone) {
  ScriptedDevice device;
  Servo servo(device, {});
  servo.publish(box_scene());
  press(servo, device, 0.0005);
  ASSERT_GT(device.force.z(), 0.1);
  device.status = DeviceStatus::Lost;
  servo.tick(1e-3);
  EXPECT_EQ(device.force, Vector3::Zero());
  device.status = DeviceStatus::Ok;
  device.position.x() = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 200; ++i) {
    servo.tick(1e-3);
    ASSERT_TRUE(device.force.allFinite());
  }
  EXPECT_EQ(device.force, Vector3::Zero());
}

TEST(Servo, LetsGoWhenTheTouchedObjectGoes) {
  ScriptedDevice device;
  Servo servo(device, {});
  servo.publish(box_scene());
  press(servo, device, 0.0005);
  servo.publish(HapticScene::compile({}));
  for (int i = 0; i < 50; ++i) servo.tick(1e-3);
  EXPECT_FALSE(servo.last().contact.touching);
  EXPECT_EQ(device.force, Vector3::Zero());
}

TEST(Servo, TouchesNothingWhileItHoldsSomething) {
  ScriptedDevice device;
  Servo servo(device, {});
  servo.publish(box_scene());
  press(servo, device, 0.0005);
  GripFeel feel;
  feel.holds = true;
  feel.start = device.position;
  feel.weight = {0.0, 0.0, -0.5};
  servo.grip(feel);
  for (int i = 0; i < 500; ++i) servo.tick(1e-3);
  EXPECT_FALSE(servo.last().contact.touching);
  EXPECT_NEAR((device.force - feel.weight).norm(), 0.0, 1e-9) << device.force.transpose();
  // The way that it was taken is felt as well: 0.2 N and more.
  device.position.x() += 0.01;
  for (int i = 0; i < 500; ++i) servo.tick(1e-3);
  EXPECT_NEAR(device.force.x(), -pull_back(feel, 0.01), 1e-9);
  device.position = {0.0, 0.0, 0.06};
  servo.grip({});
  for (int i = 0; i < 500; ++i) servo.tick(1e-3);
  EXPECT_EQ(device.force, Vector3::Zero());
  press(servo, device, 0.0005);
  EXPECT_TRUE(servo.last().contact.touching) << "it feels again what it does not hold";
}

TEST(Servo, TellsButtonsAndHowTheStylusIsHeld) {
  ScriptedDevice device;
  ServoSettings settings;
  settings.world_from_device = Pose(Eigen::AngleAxisd(0.5, Vector3::UnitY()));
  Servo servo(device, settings);
  device.buttons = 5;
  device.orientation = devices::Quaternion(Eigen::AngleAxisd(0.25, Vector3::UnitY()));
  servo.tick(1e-3);
  EXPECT_EQ(servo.last().buttons, 5U);
  EXPECT_NEAR(Eigen::AngleAxisd(servo.last().orientation).angle(), 0.75, 1e-12);
}

TEST(Servo, KnowsTheObjectInTheSceneThatItHasTaken) {
  for (const Renderer renderer : {Renderer::Exact, Renderer::Thesis}) {
    ScriptedDevice device;
    ServoSettings settings;
    settings.renderer = renderer;
    Servo servo(device, settings);
    const auto box = primitive("box:0.1x0.1x0.1");
    const auto shape = renderer == Renderer::Exact ? shape_of(box) : thesis_shape(box);
    std::vector<HapticObject> objects;
    for (std::uint32_t i = 0; i < 50; ++i) objects.push_back(object(2 + i, shape, translation(1 + i, 0, 0)));
    objects.push_back(object(1, shape));
    servo.publish(HapticScene::compile(objects));
    press(servo, device, 0.0005);
    ASSERT_TRUE(servo.last().contact.touching);
    ASSERT_EQ(servo.last().contact.object, 50u);
    // The device is silent just when the object becomes the only one.
    device.status = DeviceStatus::Stalled;
    servo.publish(HapticScene::compile({objects.back()}));
    servo.tick(1e-3);
    EXPECT_TRUE(servo.last().contact.touching);
    EXPECT_EQ(servo.last().contact.object, 0u);
    servo.publish(HapticScene::compile({}));
    servo.tick(1e-3);
    EXPECT_FALSE(servo.last().contact.touching);
  }
}

TEST(Servo, TakesNoMemoryAndNoLocks) {
  if (!realtime::RealtimeGuard::available()) GTEST_SKIP() << "the sanitizer needs malloc for itself";
  for (const double radius : {0.0, 0.001}) {
    ScriptedDevice device;
    ServoSettings settings;
    settings.scp.tip_radius = radius;
    Servo servo(device, settings);
    const MeshPointer mesh = shared(geometry::bumpy_geodesic_sphere(40, 0.05, 0.05, 8));
    const auto shape = shape_of(mesh, true, radius);
    HapticObject moving = object(2, shape_of(primitive("torus:0.06x0.005")));
    moving.motion.angular = {1.0, 0.0, 0.0};
    Random random(1);
    Vector3 goal(0.06, 0.0, 0.0);
    device.position = goal;
    for (int part = 0; part < 10; ++part) {
      servo.publish(HapticScene::compile({object(1, shape, translation(1e-3 * part, 0, 0)), moving}));
      const realtime::RealtimeGuard watched = [&] {
        realtime::RealtimeGuard guard;
        for (int i = 0; i < 200; ++i) {
          if ((goal - device.position).norm() < 1e-3) goal = 0.055 * random.direction();
          device.position += 5e-4 * (goal - device.position).normalized();
          servo.tick(1e-3);
        }
        guard.stop();
        return guard;
      }();
      EXPECT_EQ(watched.allocations(), 0u);
      EXPECT_EQ(watched.frees(), 0u);
      EXPECT_EQ(watched.locks(), 0u);
    }
  }
}

/// The rounded cube with a hole of thesis figure 5.6 and a ball that bites into it.
std::shared_ptr<const Shape> thesis_tree() {
  using geometry::CsgOperator;
  geometry::CsgTree tree;
  auto all = tree.add_leaf(primitive("box:0.1x0.1x0.1"));
  all = tree.add(CsgOperator::Intersection, all, tree.add_leaf(primitive("sphere:0.065")));
  all = tree.add(CsgOperator::Difference, all, tree.add_leaf(primitive("cylinder:0.025x0.14")));
  const auto ball = tree.add_leaf(primitive("sphere:0.02"), base::Affine3(Eigen::Translation3d(0.05, 0, 0)));
  tree.add(CsgOperator::Union, all, ball);
  return *ThesisCsgShape::create(tree);
}

TEST(Servo, TheThesisTakesNoMemoryAndNoLocks) {
  if (!realtime::RealtimeGuard::available()) GTEST_SKIP() << "the sanitizer needs malloc for itself";
  ScriptedDevice device;
  ServoSettings settings;
  settings.renderer = Renderer::Thesis;
  Servo servo(device, settings);
  const auto tree = thesis_tree();
  const std::shared_ptr<const Shape> loop = *ThesisLoopShape::create(*geometry::LoopLevels::create(
      {geometry::bumpy_geodesic_sphere(3, 0.05, 0.2, 4), {}, {}}, {.finest = 3}));
  HapticObject moving = object(2, loop, translation(0.03, 0.0, 0.0));
  moving.motion.angular = {1.0, 0.0, 0.0};
  Random random(1);
  Vector3 goal(0.06, 0.0, 0.0);
  device.position = goal;
  int touched = 0;
  for (int part = 0; part < 10; ++part) {
    servo.publish(HapticScene::compile({object(1, tree, translation(1e-3 * part, 0, 0)), moving}));
    realtime::RealtimeGuard guard;
    for (int i = 0; i < 200; ++i) {
      if ((goal - device.position).norm() < 1e-3) goal = 0.055 * random.direction();
      device.position += 5e-4 * (goal - device.position).normalized();
      touched += servo.tick(1e-3).contact.touching;
    }
    guard.stop();
    EXPECT_EQ(guard.allocations(), 0u);
    EXPECT_EQ(guard.frees(), 0u);
    EXPECT_EQ(guard.locks(), 0u);
  }
  EXPECT_GT(touched, 500);
}

}  // namespace
}  // namespace icome::haptics
