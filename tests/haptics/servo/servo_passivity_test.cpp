// Energy through the whole servo: solver, mesh, friction, shading, texture, effects and limiter, with a
// simulated hand on every device profile. The port is the tip: what flows into what is touched in a tick is
// -F . (x[n+1] - x[n]), exact because F is held over the tick. It is passive when the sum, less what the
// effects store in closed form, never falls below zero.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "base/random.h"
#include "devices/device_profiles.h"
#include "devices/simulated/simulated_device.h"
#include "geometry/mesh/geodesic_sphere.h"
#include "haptics/contact_world.h"
#include "haptics/effects/texture_text.h"
#include "haptics/servo/servo.h"
#include "haptics/servo/servo_fixture.h"

namespace icome::haptics {
namespace {

using devices::DeviceInfo;
using devices::SimulatedDevice;
using devices::SimulatedSettings;

constexpr double kBallRadius = 0.05;    // m
constexpr double kNoEnergyLost = 1e-9;  // J

// Energy (J) that an effect holds with the tip there.
using Potential = std::function<double(const Vector3& tip)>;

/// A device that counts the energy which the hand gives through it.
class Port final : public devices::PointerDevice {
 public:
  explicit Port(const SimulatedSettings& settings) : device_(settings), last_(device_.true_position()) {}

  const DeviceInfo& info() const override { return device_.info(); }
  DeviceStatus read(devices::PointerState& state) override {
    const DeviceStatus status = device_.read(state);
    energy_ -= held_.dot(device_.true_position() - last_);
    last_ = device_.true_position();
    return status;
  }
  DeviceStatus write(const Vector3& force) override {
    held_ = force;
    return device_.write(force);
  }

  double energy() const { return energy_; }  // J
  const Vector3& tip() const { return last_; }
  const Vector3& force() const { return held_; }

 private:
  SimulatedDevice device_;
  Vector3 last_;                    // m
  Vector3 held_ = Vector3::Zero();  // N
  double energy_ = 0.0;
};

struct Felt {
  const char* name;
  bool shading = false;
  double friction = 0.0;
  const char* texture = nullptr;
  std::vector<const char*> effects = {};
  Potential stored = [](const Vector3&) { return 0.0; };
  double slack = kNoEnergyLost;  // J
};

ScenePointer coarse_ball(const Felt& felt) {
  MeshShapeSettings settings;
  settings.closed = true;
  settings.interpolate_normals = true;
  const auto mesh = shared(geometry::bumpy_geodesic_sphere(3, kBallRadius, 0.1, 3));
  HapticObject ball = object(1, std::make_shared<MeshShape>(mesh, settings));
  ball.surface.static_friction = felt.friction;
  ball.surface.dynamic_friction = 0.8 * felt.friction;
  if (felt.texture != nullptr) ball.surface.texture = make_texture(felt.texture).value();
  return HapticScene::compile({ball});
}

// Taps, presses and slides about the top of the ball: a new target every 50 ms.
SimulatedSettings restless_hand(const DeviceInfo& device, double rate) {
  SimulatedSettings settings;
  settings.info = device;
  settings.rate = rate;
  settings.start = Vector3(0, 0, kBallRadius + 0.02);
  settings.trajectory = [](double t) -> Vector3 {
    base::Random random(static_cast<std::uint64_t>(t / 0.05) + 17);
    const Vector3 aside(random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7), 1.0);
    return (kBallRadius + random.uniform(-0.008, 0.008)) * aside.normalized();
  };
  return settings;
}

struct Balance {
  double least = 0.0;       // J, of what was taken in and is neither stored nor gone
  double dissipated = 0.0;  // J, at the end
  double strongest = 0.0;   // N
};

enum class Where { OnTheBall, InTheAir };

Balance balance_of(const Felt& felt, Where where, const SimulatedSettings& hand, double seconds) {
  Port port(hand);
  ServoSettings settings;
  settings.rate_hz = hand.rate;
  settings.force_shading = felt.shading;
  settings.limiter.ramp_seconds = 0.0;  // a wall that fades in around the tip does give energy
  Servo servo(port, settings);
  std::vector<PlacedEffect> effects;
  for (const char* const text : felt.effects) effects.push_back({.text = text});
  servo.publish_effects(effects);
  if (where == Where::OnTheBall) servo.publish(coarse_ball(felt));
  Balance balance;
  const double stored_first = felt.stored(port.tip());
  for (int tick = 0; tick < int(seconds * hand.rate); ++tick) {
    servo.tick(1.0 / hand.rate);
    balance.dissipated = port.energy() - (felt.stored(port.tip()) - stored_first);
    balance.least = std::min(balance.least, balance.dissipated);
    balance.strongest = std::max(balance.strongest, port.force().norm());
  }
  return balance;
}

double well_energy(const Vector3& tip) {
  const double radius = 0.02, stiffness = 1.5 * 25.0 * std::sqrt(5.0) / (16.0 * radius);
  const double s = (tip - Vector3(0, 0, 0.055)).squaredNorm() / (radius * radius);
  return s < 1.0 ? -stiffness * radius * radius / 6.0 * std::pow(1.0 - s, 3) : 0.0;
}

double recess_energy(const Vector3& tip) {
  const double width = 0.01, a = std::clamp((tip.head<2>().norm() - 0.008) / width, 0.0, 1.0);
  return 0.5 * width * (a - std::sin(2.0 * std::numbers::pi * a) / (2.0 * std::numbers::pi));
}

double point_energy(const Vector3& tip) { return 30.0 * (tip - Vector3(0, 0, 0.055)).squaredNorm(); }
double line_energy(const Vector3& tip) { return 30.0 * Vector3(0, tip.y(), tip.z() - 0.055).squaredNorm(); }
double plane_energy(const Vector3& tip) { return 30.0 * (tip.z() - 0.055) * (tip.z() - 0.055); }
double weight_energy(const Vector3& tip) { return 0.5 * tip.z(); }

const std::vector<Felt>& felts() {
  static const std::vector<Felt> kFelts = {
      {.name = "Mesh"},
      {.name = "Friction", .friction = 0.5},
      {.name = "Shading", .shading = true},
      {.name = "Texture", .texture = "bumps"},
      {.name = "FrictionShadingTexture", .shading = true, .friction = 0.5, .texture = "grain"},
      {.name = "PointSpring", .effects = {"point:0,0,0.055,60"}, .stored = point_energy},
      {.name = "LineSpring", .effects = {"line:0,0,0.055,1,0,0,60"}, .stored = line_energy},
      {.name = "PlaneSpring", .effects = {"plane:0,0,0.055,0,0,1,60"}, .stored = plane_energy},
      {.name = "CurveSpring", .effects = {"curve:-0.1,0,0.055;0.1,0,0.055;60"}, .stored = line_energy},
      {.name = "Viscous", .effects = {"viscous:2"}},
      {.name = "DryFriction", .effects = {"friction:0.5,0.4"}},
      {.name = "Inertia", .effects = {"inertia:0.1"}},
      {.name = "Well", .effects = {"well:0,0,0.055,0.02,1.5"}, .stored = well_energy},
      // In the tick in which the tip leaves the floor it climbs for nothing: at 500 Hz a hand of 0.6 m/s some
      // d = 1.2 mm, worth pi^2/3 F d^3/w^2 = 57 uJ. Damping on the slope pays for it afterwards.
      {.name = "Recess",
       .effects = {"recess:0,0,0,0,0,1,0.008,0.018,1"},
       .stored = recess_energy,
       .slack = 6e-5},
      // Each alone takes all that the device can render stably.
      {.name = "StrongTogether",
       .effects = {"viscous:50", "viscous:50", "viscous:50", "viscous:50", "friction:2,1,9000",
                   "friction:2,1,9000", "inertia:1", "inertia:1"}},
      {.name = "Constant", .effects = {"constant:0,0,-0.5"}, .stored = weight_energy},
      {.name = "Everything",
       .shading = true,
       .friction = 0.5,
       .texture = "ridges",
       .effects = {"viscous:1", "friction:0.3,0.2", "inertia:0.05", "well:0,0,0.055,0.02,1.5",
                   "plane:0,0,0.055,0,0,1,60", "constant:0,0,-0.5"},
       .stored =
           [](const Vector3& tip) { return well_energy(tip) + plane_energy(tip) + weight_energy(tip); }},
  };
  return kFelts;
}

class ServoPassivity : public testing::TestWithParam<std::size_t> {
 protected:
  // Every profile at every rate, in a usual hand and in one that takes no energy out itself. Under
  // sanitizers, which look for other faults, every profile at one rate and every rate with some profiles.
  static void expect_passive(const Felt& felt, Where where) {
    constexpr std::array kRates = {500.0, 1000.0, 4000.0, 10000.0};
    const auto profiles = devices::device_profiles();
    for (std::size_t k = 0; k < kRates.size(); ++k) {
      for (std::size_t i = 0; i < profiles.size(); ++i) {
        if (kSanitizerShare > 1 && (i + k) % kRates.size() != 0) continue;
        const double rate = kRates[k];
        const DeviceInfo& device = profiles[i];
        for (const bool bare : {false, true}) {
          SCOPED_TRACE(device.name + " at " + std::to_string(int(rate)) + " Hz" + (bare ? ", bare" : ""));
          SimulatedSettings hand = restless_hand(device, rate);
          if (bare) hand.hand.mass = hand.hand.damping = 0.0;
          const Balance balance = balance_of(felt, where, hand, 0.6);
          EXPECT_GE(balance.least, -felt.slack);
          EXPECT_GT(balance.strongest, 0.1) << "something was felt";
        }
      }
    }
  }
};

TEST_P(ServoPassivity, RestlessHandGetsNoEnergyFromTheBall) {
  expect_passive(felts()[GetParam()], Where::OnTheBall);
}

class EffectPassivity : public ServoPassivity {};

TEST_P(EffectPassivity, NorFromEffectsAlone) { expect_passive(felts()[GetParam()], Where::InTheAir); }

std::string felt_name(const testing::TestParamInfo<std::size_t>& info) { return felts()[info.param].name; }

std::vector<std::size_t> felts_with_effects() {
  std::vector<std::size_t> with;
  for (std::size_t i = 0; i < felts().size(); ++i)
    if (!felts()[i].effects.empty()) with.push_back(i);
  return with;
}

INSTANTIATE_TEST_SUITE_P(Feels, ServoPassivity, testing::Range(std::size_t{0}, felts().size()), felt_name);
INSTANTIATE_TEST_SUITE_P(Feels, EffectPassivity, testing::ValuesIn(felts_with_effects()), felt_name);

struct Rest {
  double farthest = 0.0;  // m, from where it was let go, at any time
  double speed = 0.0;     // m/s, the highest of the last tenth
};

/// A hand that pulls to where the effects hold, from 20 mm beside.
Rest let_go(const DeviceInfo& device, double rate, bool bare, const std::vector<PlacedEffect>& effects,
            double seconds) {
  SimulatedSettings hand;
  hand.info = device;
  hand.rate = rate;
  hand.start = Vector3(0.02, 0, 0);
  hand.trajectory = [](double t) { return Vector3(t < 0.1 ? 0.02 : 0.0, 0, 0); };
  if (bare) hand.hand.mass = hand.hand.damping = 0.0;
  SimulatedDevice simulated(hand);
  ServoSettings settings;
  settings.rate_hz = rate;
  settings.limiter.ramp_seconds = 0.0;
  Servo servo(simulated, settings);
  servo.publish_effects(effects);
  Rest rest;
  const int ticks = int(seconds * rate);
  for (int tick = 0; tick < ticks; ++tick) {
    servo.tick(1.0 / rate);
    rest.farthest = std::max(rest.farthest, std::abs(simulated.true_position().x()));
    if (10 * tick > 9 * ticks) rest.speed = std::max(rest.speed, simulated.true_velocity().norm());
  }
  return rest;
}

// A third of a millimetre off, the limiter gives all that the device has, and it takes 2 ms to get there. A
// device that nobody holds is not brought to rest at 4 kHz and above.
TEST(EffectsTogether, SpringsFarHarderThanTheDeviceIsStrongHoldIt) {
  std::vector<PlacedEffect> springs;
  for (std::uint64_t id = 1; id <= 8; ++id) springs.push_back({id, "point:0,0,0,8000"});
  for (const double rate : {500.0, 1000.0, 4000.0, 10000.0}) {
    for (const DeviceInfo& device : devices::device_profiles()) {
      SCOPED_TRACE(device.name + " at " + std::to_string(int(rate)) + " Hz");
      const Rest rest = let_go(device, rate, false, springs, 1.0);
      EXPECT_LT(rest.speed, 1e-4);
      EXPECT_LT(rest.farthest, 0.021);
    }
  }
}

TEST(EffectsTogether, AHeavyMassOnASpringComesToRest) {
  const std::vector<PlacedEffect> heavy = {{1, "inertia:5,100"}, {2, "point:0,0,0,1000,5"}};
  for (const double rate : {500.0, 1000.0, 4000.0}) {
    for (const DeviceInfo& device : devices::device_profiles()) {
      SCOPED_TRACE(device.name + " at " + std::to_string(int(rate)) + " Hz");
      const Rest rest = let_go(device, rate, true, heavy, 4.0);
      EXPECT_LT(rest.speed, 5e-3);
      EXPECT_LT(rest.farthest, 0.021);
    }
  }
}

// Round and round a lumpy ball of few triangles, slowly and at one depth: the walk ends where it began, so
// what the hand gave is what was lost. The device reads places in steps of `encoder` (m), zero: exactly.
double energy_of_walk(bool shading, double direction, double encoder, int ticks_around) {
  ScriptedDevice device;
  ServoSettings settings;
  settings.force_shading = shading;
  settings.limiter.ramp_seconds = 0.0;
  Servo servo(device, settings);
  servo.publish(coarse_ball({.name = "walk"}));
  const auto at = [&](double angle, double radius) {
    const Vector3 tilted(0.8, 0.0, 0.6);
    return Vector3(radius * (std::cos(angle) * tilted + std::sin(angle) * Vector3::UnitY()));
  };
  double energy = 0.0;
  const auto go = [&](const Vector3& exact) {
    const Vector3 to = encoder > 0.0 ? Vector3(encoder * (exact / encoder).array().round()) : exact;
    energy -= device.force.dot(to - device.position);
    device.position = to;
    servo.tick(1e-3);
  };
  device.position = at(0.0, 1.2 * kBallRadius);
  servo.tick(1e-3);
  for (int i = 0; i <= 500; ++i) go(at(0.0, kBallRadius * (1.2 - 0.0006 * i)));
  for (int turn = 0; turn < 3; ++turn)
    for (int i = 0; i < ticks_around; ++i)
      go(at(direction * 2.0 * std::numbers::pi * i / ticks_around, 0.9 * kBallRadius));
  for (int i = 500; i >= 0; --i) go(at(0.0, kBallRadius * (1.2 - 0.0006 * i)));
  return energy;
}

TEST(ForceShading, GivesNoEnergyOnAWalkRoundACoarseBall) {
  for (const double direction : {1.0, -1.0}) {
    // The way of the SCP is the same: what differs is what shading took. Without the tank it gave
    // 24 mJ.
    const double taken =
        energy_of_walk(true, direction, 0.0, 4000) - energy_of_walk(false, direction, 0.0, 4000);
    EXPECT_GE(taken, -1e-6) << direction;
    EXPECT_LT(taken, 1e-3) << direction << ": most comes back";
  }
}

TEST(ForceShading, GivesHardlyAnyEnergyToASlowHandThatIsReadInSteps) {
  // So slow a tip stands still in most ticks: who looks at the last tick only lets 12 mJ and more through.
  for (const double direction : {1.0, -1.0}) {
    const double taken =
        energy_of_walk(true, direction, 6e-5, 16'000) - energy_of_walk(false, direction, 6e-5, 16'000);
    EXPECT_GE(taken, -2e-4) << direction;
  }
}

}  // namespace
}  // namespace icome::haptics
