#include "haptics/effects/panel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.h"
#include "devices/device_profiles.h"
#include "devices/simulated/simulated_device.h"
#include "repeats.h"

namespace icome::haptics {
namespace {

constexpr double kPanelTick = 0.001;  // s

/// A panel with targets of all kinds, side by side and over each other.
PanelSettings random_panel(base::Random& random) {
  PanelSettings panel;
  panel.half = {random.uniform(0.02, 0.06), random.uniform(0.02, 0.06)};
  panel.stiffness = random.uniform(300.0, 1200.0);
  panel.sides = random.index(2) == 0 ? TouchableSides::Front : TouchableSides::Both;
  for (std::uint64_t i = random.index(12); i-- > 0;) {
    PanelTarget target;
    target.half = {random.uniform(0.002, 0.02), random.uniform(0.002, 0.01)};
    target.centre = {random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03)};
    target.well = random.uniform(0.0, 0.8);
    target.recess = random.uniform(-0.001, 0.001);
    target.ridge = random.uniform(-0.0005, 0.0005);
    target.rings = random.uniform(0.0, 0.0002);
    target.ring_spacing = random.uniform(0.002, 0.005);
    target.detent = random.uniform(0.0, 0.5);
    target.push_depth = 0.003;
    target.shape = PanelTarget::Shape(random.index(3));
    if (target.shape != PanelTarget::Shape::Rectangle) {
      target.half = Vector2::Constant(random.uniform(0.006, 0.025));
      target.inner = random.uniform(0.5, 0.8) * target.half.x();
    }
    if (target.shape == PanelTarget::Shape::Triangle) target.well = 0.0;
    panel.targets.push_back(target);
  }
  return panel;
}

EffectInput input_at(const Vector3& place, double dt = kPanelTick) {
  EffectInput input;
  input.dt = dt;
  input.position = place;
  return input;
}

/// Opens a panel with the tip far in front of it.
void open(Panel& panel) {
  for (int i = 0; i < 400; ++i) panel.force(input_at({0.0, 0.0, 0.5}));
}

Vector3 random_place(base::Random& random, const PanelSettings& panel) {
  return {random.uniform(-1.2, 1.2) * panel.half.x(), random.uniform(-1.2, 1.2) * panel.half.y(),
          random.uniform(-0.008, 0.015)};
}

TEST(Panel, SlopesOfTheGroundAreThoseOfItsHeights) {
  base::Random random(1);
  for (int i = 0; i < 300; ++i) {
    const Panel panel(random_panel(random));
    const Vector2 place = random_place(random, panel.settings()).head<2>();
    constexpr double kStep = 1e-8;
    const auto at = [&](double x, double y) { return panel.ground_at(place + kStep * Vector2(x, y)); };
    const Panel::Ground here = panel.ground_at(place);
    for (int axis = 0; axis < 2; ++axis) {
      const auto ahead = axis == 0 ? at(1, 0) : at(0, 1), behind = axis == 0 ? at(-1, 0) : at(0, -1);
      EXPECT_NEAR(here.slope[axis], (ahead.height - behind.height) / (2.0 * kStep), 1e-4);
      EXPECT_NEAR(here.detent_slope[axis], (ahead.detent - behind.detent) / (2.0 * kStep), 0.02);
      EXPECT_NEAR(here.well_slope[axis], (ahead.well - behind.well) / (2.0 * kStep), 1e-4);
    }
  }
}

// By the distance to the border, measured along many ways: floors are flat but for their flanks.
TEST(Panel, RingsAndTrianglesAreWhereTheirBordersAre) {
  base::Random random(11);
  for (int i = 0; i < 200; ++i) {
    PanelTarget target;
    target.shape = i % 2 == 0 ? PanelTarget::Shape::Ring : PanelTarget::Shape::Triangle;
    target.centre = {random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01)};
    target.half = Vector2::Constant(random.uniform(0.015, 0.03));
    target.inner = 0.7 * target.half.x();
    target.recess = 0.0006;
    PanelSettings settings;
    settings.targets = {target};
    const Panel panel(settings);
    const auto is_inside = [&](const Vector2& place) {
      const Vector2 offset = place - target.centre;
      const double r = offset.norm(), outer = target.half.x();
      if (target.shape == PanelTarget::Shape::Ring) return r > target.inner && r < outer;
      // Its lower side is level; the other two run from there to the top at 60 degrees.
      const double up = offset.y() + 0.5 * outer;
      return up > 0.0 && up < 1.5 * outer - std::sqrt(3.0) * std::abs(offset.x());
    };
    for (int k = 0; k < 300; ++k) {
      const Vector2 place = target.centre + 1.1 * target.half.x() *
                                                Vector2(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
      constexpr double kFlanks = 0.00151;  // m
      bool all = true, none = true;
      for (int way = 0; way < 64; ++way) {
        const double angle = 0.0982 * way;
        const bool inside = is_inside(place + kFlanks * Vector2(std::cos(angle), std::sin(angle)));
        all = all && inside;
        none = none && !inside;
      }
      const double height = panel.ground_at(place).height;
      if (all && is_inside(place)) {
        EXPECT_NEAR(height, -target.recess, 1e-6);
      }
      if (!is_inside(place)) {
        EXPECT_EQ(height, 0.0);
      }
    }
  }
}

TEST(Panel, TheWellOfARingDrawsToTheCircleInItsMiddle) {
  PanelTarget ring;
  ring.shape = PanelTarget::Shape::Ring;
  ring.half = {0.03, 0.03};
  ring.inner = 0.022;
  ring.well = 0.4;
  PanelSettings settings;
  settings.targets = {ring};
  const Panel panel(settings);
  double strongest = 0.0;
  for (double angle = 0.0; angle < 6.28; angle += 0.1) {
    const Vector2 out(std::cos(angle), std::sin(angle));
    EXPECT_NEAR(panel.ground_at(0.026 * out).well_slope.norm(), 0.0, 1e-12);
    for (double r = 0.021; r < 0.031; r += 0.0001) {
      const double outward = panel.ground_at(r * out).well_slope.dot(out);
      EXPECT_LE((r - 0.026) * outward, 0.0);
      strongest = std::max(strongest, std::abs(outward));
    }
  }
  EXPECT_NEAR(strongest, ring.well, 0.01);
}

// Without friction and with a tip that creeps, all its force is that of a potential: what a way round gives
// back is what it took.
TEST(Panel, GivesNothingOnAWayRound) {
  base::Random random(2);
  for (int loop = 0; loop < 20; ++loop) {
    Panel panel(random_panel(random));
    open(panel);
    std::vector<Vector3> corners;
    for (int i = 0; i < 5; ++i) corners.push_back(random_place(random, panel.settings()));
    // Every corner is in front of the relief, so that the tip is on the front wherever it presses.
    const Vector3 start(0.0, 0.0, 0.02);
    corners.insert(corners.begin(), start);
    corners.push_back(start);
    double work = 0.0, most = 0.0;
    Vector3 last = start, force = panel.force(input_at(start));
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      // A way over the panel keeps its side; round the edge it may change, which costs nothing.
      constexpr int kSteps = 4000;
      for (int step = 1; step <= kSteps; ++step) {
        Vector3 place = corners[i] + (corners[i + 1] - corners[i]) * (double(step) / kSteps);
        const Vector2 limit = panel.settings().half * 0.999;
        place.head<2>() = place.head<2>().cwiseMax(-limit).cwiseMin(limit);
        const Vector3 next = panel.force(input_at(place));
        work += 0.5 * (force + next).dot(place - last);
        most = std::max(most, std::abs(work));
        force = next;
        last = place;
      }
    }
    EXPECT_LT(std::abs(work), 2e-3 * most + 1e-9) << loop;
  }
}

// 1 um a tick: what the ground and its widgets change in that, and nothing more.
TEST(Panel, IsContinuousAlongEveryWay) {
  base::Random random(3);
  for (int way = 0; way < repeats(4000); ++way) {
    Panel panel(random_panel(random));
    open(panel);
    const double stiffest = 40.0 * panel.settings().stiffness;
    Vector3 place = random_place(random, panel.settings());
    const Vector3 goal = random_place(random, panel.settings());
    const Vector3 step = (goal - place).normalized() * 1e-6;
    Vector3 last = panel.force(input_at(place));
    EXPECT_LT(last.norm(), Panel::kMostChange * kPanelTick + 1e-12);
    // The tip may come out of nothing; from there on it moves.
    for (int i = 0; i < 100; ++i) last = panel.force(input_at(place));
    for (int i = 0; i < 60; ++i) {
      place += step;
      const Vector3 force = panel.force(input_at(place));
      EXPECT_LT((force - last).norm(), stiffest * 1e-6 + 1e-9) << way;
      last = force;
    }
  }
}

TEST(Panel, ForcesChangeByNoMoreThanTheLimitHoweverTheHandMoves) {
  base::Random random(4);
  for (int way = 0; way < repeats(20000); ++way) {
    Panel panel(random_panel(random));
    if (way % 2 == 0) open(panel);  // the others open onto the tip
    Vector3 last = Vector3::Zero(), place = random_place(random, panel.settings());
    const Vector3 goal = random_place(random, panel.settings());
    for (int i = 0; i <= 20; ++i) {
      const Vector3 force = panel.force(input_at(place + (goal - place) * (i / 20.0)));
      ASSERT_TRUE(force.allFinite());
      EXPECT_LE((force - last).norm(), Panel::kMostChange * kPanelTick * (1.0 + 1e-9));
      last = force;
    }
  }
}

TEST(Panel, LetsAHandPassFromBehindAndCarriesItFromTheFront) {
  PanelSettings settings;
  Panel panel(settings);
  open(panel);
  panel.force(input_at({0.3, 0.0, 0.0}));  // beside it
  for (double z = -0.03; z < 0.0; z += 0.0001)
    EXPECT_EQ(panel.force(input_at({0.0, 0.0, z})), Vector3::Zero()) << z;
  EXPECT_EQ(panel.side(), PanelSide::Behind);
  // One that trembles in the plane has not come out of it.
  for (double z = 0.0015; z > -0.01; z -= 0.0001)
    EXPECT_EQ(panel.force(input_at({0.0, 0.0, z})), Vector3::Zero()) << z;
  panel.force(input_at({0.0, 0.0, 0.0021}));
  for (double z = 0.001; z > -0.002; z -= 0.00001) panel.force(input_at({0.0, 0.0, z}));
  EXPECT_NEAR(panel.force(input_at({0.0, 0.0, -0.002})).z(), 0.002 * settings.stiffness, 1e-6);
}

TEST(Panel, CarriesAHandFromBothSidesWhereItIsTold) {
  PanelSettings settings;
  settings.sides = TouchableSides::Both;
  Panel panel(settings);
  open(panel);
  panel.force(input_at({0.3, 0.0, -0.01}));
  for (double z = -0.01; z < 0.002; z += 0.00001) panel.force(input_at({0.0, 0.0, z}));
  EXPECT_NEAR(panel.force(input_at({0.0, 0.0, 0.002})).z(), -0.002 * settings.stiffness, 1e-3);
}

TEST(Panel, LetsGoOfAHandThatIsFarThrough) {
  Panel panel(PanelSettings{});
  open(panel);
  double most = 0.0;
  for (double z = 0.001; z > -0.03; z -= 0.00002)
    most = std::max(most, panel.force(input_at({0.0, 0.0, z})).z());
  EXPECT_NEAR(most, panel.settings().most_force, 1e-6);
  EXPECT_EQ(panel.side(), PanelSide::Behind);
  EXPECT_EQ(panel.force(input_at({0.0, 0.0, -0.03})), Vector3::Zero());
}

// A hand that comes from behind into the recess, and goes back, was never in front.
TEST(Panel, ARecessCatchesNobodyFromBehind) {
  PanelSettings settings;
  settings.targets.push_back({.half = {0.02, 0.02}, .recess = 0.0006});
  Panel panel(settings);
  open(panel);
  panel.force(input_at({0.3, 0.0, 0.0}));
  for (double z = -0.03; z < -0.0002; z += 0.00005) panel.force(input_at({0.0, 0.0, z}));
  for (double z = -0.0002; z > -0.01; z -= 0.00005)
    EXPECT_EQ(panel.force(input_at({0.0, 0.0, z})), Vector3::Zero()) << z;
}

// Relief that no device renders is felt lower; the ground stays what it is.
TEST(Panel, SteepReliefDoesNotTakeTheGroundAway) {
  for (const double most : {3.0, 30.0})
    for (const double border : {0.0, 0.005}) {
      PanelSettings settings;
      settings.most_force = most;
      settings.targets.push_back({.half = settings.half, .ridge = border});
      settings.targets.push_back({.half = {0.02, 0.01}, .rings = 0.001, .ring_spacing = 0.0005});
      Panel panel(settings);
      open(panel);
      const Vector3 plain(0.03, 0.03, 0.0);
      for (double z = 0.001; z > -0.003; z -= 0.00001) panel.force(input_at(plain + z * Vector3::UnitZ()));
      EXPECT_NEAR(panel.force(input_at(plain - 0.003 * Vector3::UnitZ())).z(), 1.8, 1e-3);
      EXPECT_NE(panel.capped(0.1, kPanelTick).find("ridges and recesses"), std::string::npos);
    }
}

TEST(Panel, IsPassedOverOnlyWhereATickWouldDoNothing) {
  base::Random random(41);
  std::size_t idle = 0;
  for (int i = 0; i < 200; ++i) {
    const PanelSettings settings = random_panel(random);
    Panel whole(settings), passed(settings);
    Vector3 from(0.0, 0.0, 0.2);
    for (int way = 0; way < 20; ++way) {
      const Vector3 to(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.08, 0.08));
      for (int tick = 1; tick <= 50; ++tick) {
        const EffectInput input = input_at(from + (to - from) * (tick / 50.0));
        const Vector3 force = whole.force(input);
        if (passed.is_idle_at(input.position)) {
          ++idle;
          EXPECT_EQ(force, Vector3::Zero().eval());
        } else {
          EXPECT_EQ(force, passed.force(input));
        }
      }
      from = to;
    }
  }
  EXPECT_GT(idle, 10'000U);
}

TEST(Panel, ClosesAsSoftlyAsItOpens) {
  PanelSettings settings;
  Panel before(settings);
  open(before);
  const Vector3 place(0.0, 0.0, -0.004);
  before.force(input_at({0.0, 0.0, 0.001}));
  Vector3 last = Vector3::Zero();
  for (int i = 0; i < 100; ++i) last = before.force(input_at(place));
  EXPECT_NEAR(last.z(), 2.4, 1e-9);
  settings.closes = true;
  Panel closing(settings);
  closing.continue_from(before);
  for (int i = 0; i < 400; ++i) {
    const Vector3 force = closing.force(input_at(place));
    EXPECT_LE((force - last).norm(), 0.02) << i;
    last = force;
  }
  EXPECT_EQ(last, Vector3::Zero());
}

TEST(Panel, ClickIsADropOfTheForce) {
  PanelSettings settings;
  settings.targets.push_back({.half = {0.02, 0.02}, .detent = 0.4});
  Panel panel(settings);
  open(panel);
  std::vector<double> forces;
  for (double z = 0.0; z > -0.005; z -= 0.00001) forces.push_back(panel.force(input_at({0.0, 0.0, z})).z());
  const auto peak = std::max_element(forces.begin(), forces.begin() + 330);
  const auto valley = std::min_element(peak, forces.end());
  EXPECT_GT(*peak - *valley, 0.1);
  EXPECT_NEAR(double(peak - forces.begin()) * 1e-5, settings.targets[0].push_depth, 2e-4);
}

// A hand that wanders over it, on each device and at each rate: the energy that has flown into it is never
// below nothing by more than the wells had to give.
TEST(Panel, GivesAHandNoEnergy) {
  base::Random random(5);
  for (const devices::DeviceInfo& device : devices::device_profiles()) {
    if (device.max_force == 0.0) continue;
    for (const double rate : {500.0, 1000.0, 4000.0}) {
      PanelSettings settings = random_panel(random);
      settings.friction = 0.3;
      double wells = 0.0;
      for (PanelTarget& target : settings.targets) wells += target.well * target.half.minCoeff();
      Panel panel(settings);
      devices::SimulatedSettings simulated;
      simulated.info = device;
      simulated.rate = rate;
      simulated.start = {0.0, 0.0, 0.03};
      Vector3 goal = simulated.start;
      devices::SimulatedDevice hand(simulated);
      hand.set_target(goal);
      devices::PointerState state;
      Vector3 last = hand.true_position(), held = Vector3::Zero();
      double energy = 0.0, least = 0.0;
      for (int tick = 0; tick < int(3.0 * rate); ++tick) {
        if (tick % int(0.2 * rate) == 0) {
          goal = random_place(random, settings);
          hand.set_target(goal);
        }
        hand.read(state);
        energy -= held.dot(hand.true_position() - last);
        last = hand.true_position();
        least = std::min(least, energy);
        EffectInput input = input_at(state.position, 1.0 / rate);
        input.velocity = state.velocity;
        input.device_mass = device.effective_mass;
        held = panel.force(input);
        hand.write(held);
      }
      EXPECT_GE(least, -wells - 1e-6) << device.name << " at " << rate;
    }
  }
}

}  // namespace
}  // namespace icome::haptics
