// The same ways of a tip, sampled at the rates that a device may run at: whatever the rate, the judge finds
// nothing wrong, and the force stays within what the limiter promises.
#include <gtest/gtest.h>

#include <functional>

#include "geometry/implicit/implicit_surface.h"
#include "geometry/implicit/plain_formula.h"
#include "geometry/mesh/geodesic_sphere.h"
#include "haptics/csg_touch.h"
#include "haptics/judge/contact_judge.h"
#include "haptics/judge/plain_solid.h"
#include "haptics/servo/servo.h"
#include "haptics/servo/servo_fixture.h"
#include "repeats.h"

namespace icome::haptics {
namespace {

/// Something to touch, told to the servo and to the judge, and how the tip goes there.
struct RatedTouch {
  std::string name;
  std::shared_ptr<const Shape> shape;
  JudgedObject judged;
  std::function<Vector3(double time)> tip;  // m, s

  friend std::ostream& operator<<(std::ostream& out, const RatedTouch& it) { return out << it.name; }
};

/// Wavy strokes over something level at z = 0, up to 3 mm above and 9 mm below it: some 0.3 m/s.
Vector3 stroke(double time) {
  return {0.03 * std::sin(7.0 * time), 0.025 * std::cos(9.0 * time + 0.4),
          -0.003 + 0.006 * std::cos(11.0 * time)};
}

RatedTouch thin_plate() {
  const geometry::Primitive plate = primitive("box:0.1x0.1x0.0002");
  return {"ThinPlate", shape_of(plate), {plate}, stroke};
}

RatedTouch bumpy_mesh() {
  const MeshPointer mesh = shared(geometry::bumpy_geodesic_sphere(12, 0.05, 0.004, 3));
  return {"BumpyMesh", shape_of(mesh), {mesh}, [](double time) -> Vector3 {
            const Vector3 out(std::sin(5.0 * time), std::cos(4.0 * time), 1.2 + std::sin(3.0 * time));
            return (0.047 + 0.008 * std::cos(11.0 * time)) * out.normalized();
          }};
}

RatedTouch csg_figure() {
  const CsgTree tree = figure_5_6();
  return {"CsgFigure", shape_of(tree), {plain_solid(tree)}, [](double time) -> Vector3 {
            return stroke(time) + Vector3(0.01, 0.0, 0.05);
          }};
}

/// A furrowed plane and a ridge beyond a cliff, by a formula that chooses.
RatedTouch chosen_formula() {
  const std::string text = "if(x < 0.01, z - 0.003*sin(90*x), z + 0.2*abs(y) - 0.012)";
  const base::Bounds box(Vector3::Constant(-0.06), Vector3::Constant(0.06));
  const auto value = *geometry::plain_formula(text);
  const MembershipSolid solid{
      [=](const Vector3& p, double time) { return box.contains(p) && value(p, time) < 0.0; }, box};
  return {"ChosenFormula",
          std::make_shared<SmoothShape>(*geometry::ImplicitSurface::create(text, box)),
          {solid},
          stroke};
}

using RateCase = std::tuple<RatedTouch, double>;

class ServoAtRates : public testing::TestWithParam<RateCase> {};

INSTANTIATE_TEST_SUITE_P(
    Rates, ServoAtRates,
    testing::Combine(testing::Values(thin_plate(), bumpy_mesh(), csg_figure(), chosen_formula()),
                     testing::Values(500.0, 1000.0, 4000.0, 10000.0)),
    [](const auto& it) { return std::get<0>(it.param).name + std::to_string(int(std::get<1>(it.param))); });

TEST_P(ServoAtRates, NeitherPopsNorPushesHarderThanTheLimiterAllows) {
  const auto& [touch, rate] = GetParam();
  ScriptedDevice device;
  ServoSettings settings;
  settings.rate_hz = rate;
  settings.limiter.max_rate = 2000.0;  // N/s
  Servo servo(device, settings);
  device.position = touch.tip(0.0) + Vector3(0.0, 0.0, 0.03);
  servo.publish(HapticScene::compile({object(1, touch.shape)}));
  ContactJudge judge({touch.judged}, {});
  const double dt = 1.0 / rate, seconds = kSanitizerShare > 1 ? 0.3 : 0.6, lead = 0.05;
  Vector3 last = Vector3::Zero();
  std::uint64_t touching = 0, felt = 0;
  for (int i = 0; i < int(seconds * rate); ++i) {
    const double time = i * dt;
    // Down to the way first, from where nothing is.
    device.position = touch.tip(time) + Vector3(0.0, 0.0, 0.03 * std::max(0.0, 1.0 - time / lead));
    const TickReport& report = servo.tick(dt);
    ASSERT_TRUE(device.force.allFinite());
    EXPECT_LE(device.force.norm(), device.info().max_force * (1.0 + 1e-12)) << time;
    EXPECT_LE((device.force - last).norm(), 2000.0 * dt * (1.0 + 1e-9)) << time;
    last = device.force;
    touching += report.contact.touching;
    felt += device.force.norm() > 0.05;
    judge.judge({report.tip, report.contact.scp, report.contact.touching, report.time, report.force});
    if (HasFailure()) return;
  }
  EXPECT_GT(touching, judge.ticks() / 5);
  EXPECT_GT(felt, judge.ticks() / 10);
  EXPECT_EQ(judge.pops(), 0u);
  EXPECT_EQ(judge.sticks(), 0u);
  EXPECT_EQ(judge.silent(), 0u);
}

}  // namespace
}  // namespace icome::haptics
