// CSG solids under the servo: what a tick takes from the machine, and edits of a solid that is being touched.
#include <gtest/gtest.h>

#include "haptics/csg_touch.h"
#include "haptics/servo/servo.h"
#include "realtime/guard/guard.h"

namespace icome::haptics {
namespace {

/// A device that stands where the test says.
class PlacedDevice final : public devices::PointerDevice {
 public:
  const devices::DeviceInfo& info() const override { return info_; }
  devices::DeviceStatus read(devices::PointerState& state) override {
    state.position = position;
    return devices::DeviceStatus::Ok;
  }
  devices::DeviceStatus write(const Vector3& written) override {
    force = written;
    return devices::DeviceStatus::Ok;
  }

  Vector3 position = Vector3::Zero();
  Vector3 force = Vector3::Zero();

 private:
  devices::DeviceInfo info_;
};

ScenePointer scene_with(const CsgTree& tree) { return HapticScene::compile({object(1, shape_of(tree))}); }

/// Figure 5.6 with its cylinder somewhere else, and with another operator.
CsgTree edited(const Vector3& shift, CsgOperator op = CsgOperator::Difference) {
  return TreeChain(box_shape(0.1, 0.1, 0.1))
      .keep(ball_shape(0.065))
      .add(op, rod_shape(0.025, 0.2), moved(shift.x(), shift.y(), shift.z()))
      .tree();
}

TEST(ServoOnCsg, TakesNoMemoryAndNoLocks) {
  if (!realtime::RealtimeGuard::available()) GTEST_SKIP() << "the sanitizer needs malloc for itself";
  for (const NamedTree& it : {NamedTree{"Figure", figure_5_6()}, nasty::deep_chain(), nasty::mesh_operand(),
                              nasty::stretched_shapes(), NamedTree{"Random", random_tree(1, 100)}}) {
    PlacedDevice device;
    Servo servo(device, {});
    const auto path = random_touch(BruteSolid(it.tree), 3, 3000);
    device.position = path.front();
    servo.publish(scene_with(it.tree));
    int touching = 0;
    realtime::RealtimeGuard guard;
    for (const Vector3& tip : path) {
      device.position = tip;
      touching += servo.tick(1e-3).contact.touching;
    }
    guard.stop();
    EXPECT_EQ(guard.allocations() + guard.frees() + guard.locks(), 0u) << it;
    EXPECT_GT(touching, 0) << it;
  }
}

/// Ticks while the solid is edited every few ticks: the SCP is never inside, and the force changes as slowly
/// as the limiter promises.
void expect_gentle_edits(const Vector3& tip, const std::vector<CsgTree>& versions, int ticks_each) {
  PlacedDevice device;
  ServoSettings settings;
  settings.limiter.max_rate = 2000.0;  // N/s
  Servo servo(device, settings);
  device.position = tip;
  Vector3 last = Vector3::Zero();
  int touching = 0;
  for (const CsgTree& tree : versions) {
    servo.publish(scene_with(tree));
    const BruteSolid solid(tree);
    for (int i = 0; i < ticks_each; ++i) {
      const TickReport& report = servo.tick(1e-3);
      EXPECT_GT(solid.bound(report.contact.scp), -1e-9);
      EXPECT_LE((device.force - last).norm(), 2000.0 * 1e-3 * (1.0 + 1e-9));
      last = device.force;
      touching += report.contact.touching;
    }
  }
  EXPECT_GT(touching, 0);
}

TEST(ServoOnCsg, FollowsAnOperandThatIsMovedUnderTheHand) {
  std::vector<CsgTree> versions;
  for (int i = 0; i <= 100; ++i) versions.push_back(edited({0.0005 * i, 0.0, 0.0}));  // over the tip and on
  expect_gentle_edits({0.03, 0.002, 0.047}, versions, 5);
}

TEST(ServoOnCsg, SurvivesAnOperatorThatIsChangedUnderTheHand) {
  std::vector<CsgTree> versions;
  for (int i = 0; i < 12; ++i) {
    constexpr std::array<CsgOperator, 3> kOperators{CsgOperator::Difference, CsgOperator::Union,
                                                    CsgOperator::Intersection};
    versions.push_back(edited({0.01, 0.0, 0.0}, kOperators[std::size_t(i % 3)]));
  }
  expect_gentle_edits({0.012, 0.004, 0.045}, versions, 40);
  expect_gentle_edits({0.04, 0.004, 0.047}, versions, 40);
}

TEST(ServoOnCsg, KeepsTheContactWhenSomethingElsewhereIsEdited) {
  PlacedDevice device;
  Servo servo(device, {});
  device.position = {0.04, 0.0, 0.051};
  servo.publish(scene_with(edited(Vector3::Zero())));
  servo.tick(1e-3);
  for (int i = 0; i < 200; ++i) {
    device.position.z() = std::max(0.0495, 0.051 - 1e-5 * i);
    if (i % 10 == 0) servo.publish(scene_with(edited({-1e-5 * i, 0.0, 0.0})));
    const TickReport& report = servo.tick(1e-3);
    if (device.position.z() > 0.05) continue;
    EXPECT_LT((report.contact.scp - Vector3(0.04, 0.0, 0.05)).norm(), 1e-9) << i;
    EXPECT_FALSE(report.contact.started_inside) << i;
  }
}

}  // namespace
}  // namespace icome::haptics
