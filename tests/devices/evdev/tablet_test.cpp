#include "devices/evdev/tablet.h"

#include <gtest/gtest.h>
#include <linux/input-event-codes.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "base/random.h"
#include "devices/evdev/evemu_recording.h"
#include "devices/evdev/input_finder.h"
#include "devices/fakes/fake_evdev.h"
#include "places.h"
#include "repeats.h"

namespace icome::devices {
namespace {

using fakes::tablet_abilities;

constexpr std::int64_t kTabletMillisecond = 1'000'000;  // ns

/// A tablet, a link behind it and a clock.
struct Pen {
  explicit Pen(const TabletSettings& settings = {}, const InputAbilities& abilities = tablet_abilities())
      : tablet(settings), info(tablet.begin(abilities)), link(info) {
    link.connect(info);
  }
  void at(int x, int y, int pressure = 0) {
    say(EV_ABS, ABS_X, x);
    say(EV_ABS, ABS_Y, y);
    say(EV_ABS, ABS_PRESSURE, pressure);
    say(EV_KEY, BTN_TOUCH, pressure > 0 ? 1 : 0);
  }
  void say(int type, int code, std::int32_t value) {
    tablet.take({now, std::uint16_t(type), std::uint16_t(code), value});
  }
  const PointerState& report(std::int64_t later = 5 * kTabletMillisecond) {
    now += later;
    tablet.frame(now);
    tablet.pass(link, now);
    return tablet.pointer();
  }
  Tablet tablet;
  DeviceInfo info;
  DriverLink link;
  std::int64_t now = 1000 * kTabletMillisecond;
};

void expect_at(const PointerState& state, const Vector3& place) {
  EXPECT_LT((state.position - place).norm(), 1e-9)
      << state.position.transpose() << " instead of " << place.transpose();
}

TEST(Tablet, ItsPlaneIsTheScreensAndPressingGoesIn) {
  Pen pen;
  EXPECT_NEAR(pen.info.workspace_radius, 0.5 * std::hypot(0.2, 0.1), 1e-12);
  EXPECT_EQ(pen.info.max_force, 0.0);
  pen.say(EV_KEY, BTN_TOOL_PEN, 1);
  pen.at(20000, 10000, 2000);
  expect_at(pen.report(), {0.0, 0.0, -0.005});
  pen.at(40000, 0, 1000);  // the right far corner
  expect_at(pen.report(), {0.1, 0.05, -0.0025});
  pen.at(0, 20000, 2);
  expect_at(pen.report(), {-0.1, -0.05, -0.000005});
}

TEST(Tablet, OnTheDeskPressingGoesDown) {
  TabletSettings settings;
  settings.lies_as_on_desk = true;
  settings.depth = 0.01;
  Pen pen(settings);
  pen.say(EV_KEY, BTN_TOOL_PEN, 1);
  pen.at(40000, 0, 1000);
  const PointerState& state = pen.report();
  expect_at(state, {0.1, -0.005, -0.05});
  EXPECT_TRUE((state.orientation * Vector3::UnitZ()).isApprox(Vector3::UnitY(), 1e-12))
      << "the pen is upright";
}

TEST(Tablet, HoversByItsDistance) {
  Pen pen;
  pen.say(EV_KEY, BTN_TOOL_PEN, 1);
  pen.at(20000, 10000);
  pen.say(EV_ABS, ABS_DISTANCE, 30);
  expect_at(pen.report(), {0.0, 0.0, 0.005});
  // Real pens are some way off when they touch; from there on that counts as the surface.
  pen.say(EV_ABS, ABS_DISTANCE, 12);
  pen.at(20000, 10000, 500);
  expect_at(pen.report(), {0.0, 0.0, -0.00125});
  pen.at(20000, 10000);
  expect_at(pen.report(), {0.0, 0.0, 0.0});
  pen.say(EV_ABS, ABS_DISTANCE, 24);
  expect_at(pen.report(), {0.0, 0.0, 0.002});
}

TEST(Tablet, DistanceByItsResolutionAndWithoutOne) {
  InputAbilities abilities = tablet_abilities();
  abilities.axes[ABS_DISTANCE]->resolution = 10;
  Pen fine({}, abilities);
  fine.say(EV_KEY, BTN_TOOL_PEN, 1);
  fine.at(20000, 10000);
  fine.say(EV_ABS, ABS_DISTANCE, 35);
  expect_at(fine.report(), {0.0, 0.0, 0.0035});

  abilities.axes[ABS_DISTANCE].reset();
  abilities.axes[ABS_PRESSURE].reset();
  Pen coarse({}, abilities);
  coarse.say(EV_KEY, BTN_TOOL_PEN, 1);
  coarse.at(20000, 10000);
  expect_at(coarse.report(), {0.0, 0.0, 0.002});
  coarse.say(EV_KEY, BTN_TOUCH, 1);
  expect_at(coarse.report(), {0.0, 0.0, -0.005});
}

TEST(Tablet, WithoutAResolutionTheSettingCounts) {
  InputAbilities abilities = tablet_abilities();
  abilities.axes[ABS_X]->resolution = abilities.axes[ABS_Y]->resolution = 0;
  TabletSettings settings;
  settings.resolution = 4e5;
  Pen pen(settings, abilities);
  EXPECT_NEAR(pen.info.workspace_radius, 0.25 * std::hypot(0.2, 0.1), 1e-12);
  pen.say(EV_KEY, BTN_TOOL_PEN, 1);
  pen.at(40000, 0, 2000);
  expect_at(pen.report(), {0.05, 0.025, -0.005});

  abilities.axes[ABS_Y]->resolution = 100;  // told for one axis only
  Pen half(settings, abilities);
  half.say(EV_KEY, BTN_TOOL_PEN, 1);
  half.at(40000, 0, 2000);
  expect_at(half.report(), {0.2, 0.1, -0.005});
}

TEST(Tablet, TiltTurnsThePen) {
  Pen pen;
  pen.say(EV_KEY, BTN_TOOL_PEN, 1);
  pen.at(20000, 10000, 1000);
  EXPECT_TRUE(pen.report().orientation.isApprox(Quaternion::Identity(), 1e-12));
  pen.say(EV_ABS, ABS_TILT_X, 30);  // to the right
  const double right = 30.0 / 57.0;
  EXPECT_TRUE((pen.report().orientation * Vector3::UnitZ())
                  .isApprox(Vector3(std::sin(right), 0.0, std::cos(right)), 1e-9));
  pen.say(EV_ABS, ABS_TILT_X, 0);
  pen.say(EV_ABS, ABS_TILT_Y, 40);  // towards the user, which is down on the screen
  const double near = 40.0 / 57.0;
  EXPECT_TRUE((pen.report().orientation * Vector3::UnitZ())
                  .isApprox(Vector3(0.0, -std::sin(near), std::cos(near)), 1e-9));
}

TEST(Tablet, TiltWithoutAUnitIsAShareOfItsRange) {
  InputAbilities abilities = tablet_abilities();
  abilities.axes[ABS_TILT_X] = abilities.axes[ABS_TILT_Y] = InputAxis{0, 127, 0, 0};
  abilities.state.axes[ABS_TILT_X] = 127;
  abilities.state.axes[ABS_TILT_Y] = 63;
  TabletSettings settings;
  settings.tilt = 1.0;
  Pen pen(settings, abilities);
  pen.say(EV_KEY, BTN_TOOL_PEN, 1);
  const Vector3 top = pen.report().orientation * Vector3::UnitZ();
  EXPECT_NEAR(std::atan2(top.x(), top.z()), 1.0, 1e-9);
  EXPECT_NEAR(std::atan2(top.y(), top.z()), 0.5 / 63.5, 1e-9) << "half a count above the middle";
}

TEST(Tablet, ButtonsAndEraser) {
  Pen pen;
  pen.say(EV_KEY, BTN_TOOL_PEN, 1);
  pen.at(0, 0, 1);
  EXPECT_EQ(pen.report().buttons, 0b1U);
  pen.say(EV_KEY, BTN_STYLUS, 1);
  EXPECT_EQ(pen.report().buttons, 0b11U);
  pen.say(EV_KEY, BTN_STYLUS, 0);
  pen.say(EV_KEY, BTN_STYLUS2, 1);
  EXPECT_EQ(pen.report().buttons, 0b101U);
  pen.say(EV_KEY, BTN_TOOL_PEN, 0);
  pen.say(EV_KEY, BTN_TOOL_RUBBER, 1);
  EXPECT_EQ(pen.report().buttons, 0b1101U);
  EXPECT_FALSE(pen.report().parked);
}

TEST(Tablet, OutOfProximityItIsParkedAndComesBackWithAJump) {
  Pen pen;
  EXPECT_TRUE(pen.report().parked);
  EXPECT_FALSE(pen.tablet.pointer().jumped);
  pen.say(EV_KEY, BTN_TOOL_PEN, 1);
  pen.at(20000, 10000, 1000);
  EXPECT_FALSE(pen.report().parked);
  EXPECT_TRUE(pen.tablet.pointer().jumped);
  EXPECT_FALSE(pen.report().jumped);
  // A pen that goes says 0 for its axes: it stays where it was.
  pen.say(EV_KEY, BTN_TOOL_PEN, 0);
  pen.at(0, 0, 0);
  EXPECT_TRUE(pen.report().parked);
  EXPECT_EQ(pen.tablet.pointer().buttons, 0U);
  EXPECT_TRUE(pen.tablet.pointer().velocity.isZero(0.0));
  expect_at(pen.tablet.pointer(), {0.0, 0.0, -0.0025});
  pen.say(EV_KEY, BTN_TOOL_PEN, 1);
  pen.at(40000, 0, 1000);
  EXPECT_TRUE(pen.report().jumped);
  EXPECT_TRUE(pen.tablet.pointer().velocity.isZero(0.0)) << "no hand moved there";
}

TEST(Tablet, AMissedWayIsAJump) {
  Pen pen;
  pen.say(EV_KEY, BTN_TOOL_PEN, 1);
  pen.at(20000, 10000, 1000);
  pen.report();
  EXPECT_FALSE(pen.report().jumped);
  pen.tablet.missed();
  pen.at(40000, 0, 1000);
  EXPECT_TRUE(pen.report().jumped);
  EXPECT_TRUE(pen.tablet.pointer().velocity.isZero(0.0));
}

TEST(Tablet, VelocityIsThePensAndNoneAtRest) {
  Pen pen;
  pen.say(EV_KEY, BTN_TOOL_PEN, 1);
  for (int i = 0; i < 40; ++i) {
    pen.at(10000 + 100 * i, 10000, 1000);  // 0.5 mm in 5 ms
    pen.report();
  }
  EXPECT_TRUE(pen.tablet.pointer().velocity.isApprox(Vector3(0.1, 0.0, 0.0), 1e-3))
      << pen.tablet.pointer().velocity.transpose();
  pen.now += 31 * kTabletMillisecond;
  pen.tablet.pass(pen.link, pen.now);
  EXPECT_TRUE(pen.tablet.pointer().velocity.isZero(0.0)) << "a pen at rest says nothing";
}

TEST(Tablet, SettingsOfTheEnvironment) {
  setenv("ICOME_TABLET", "depth=0.002  resolution=200000 desk=1", 1);
  const auto settings = tablet_settings_from_environment();
  ASSERT_TRUE(settings) << settings.error().message;
  EXPECT_EQ(settings->depth, 0.002);
  EXPECT_EQ(settings->resolution, 200000.0);
  EXPECT_TRUE(settings->lies_as_on_desk);
  EXPECT_EQ(settings->hover, TabletSettings{}.hover);
  setenv("ICOME_TABLET", "depht=0.002", 1);
  EXPECT_EQ(tablet_settings_from_environment().error().message,
            "ICOME_TABLET: \"depht=0.002\" is no setting; did you mean 'depth'?");
  for (const char* wrong : {"depth=1", "depth=nan", "depth=", "depth", "depth=0.001x", "resolution=0"}) {
    setenv("ICOME_TABLET", wrong, 1);
    const auto refused = tablet_settings_from_environment();
    ASSERT_FALSE(refused) << wrong;
    EXPECT_NE(refused.error().message.find("with a number from"), std::string::npos)
        << refused.error().message;
  }
  unsetenv("ICOME_TABLET");
  EXPECT_TRUE(tablet_settings_from_environment());
}

/// A number as a hostile device tells it.
std::int32_t hostile_number(base::Random& random) {
  constexpr std::array kEdges = {std::numeric_limits<std::int32_t>::min(),
                                 std::numeric_limits<std::int32_t>::max(),
                                 -1,
                                 0,
                                 1,
                                 100,
                                 40000};
  return kEdges[random.index(kEdges.size())];
}

// Ranges and values of any kind: only places near the workspace pass the link, whatever was told.
TEST(Tablet, HostileDevices) {
  base::Random random(20);
  for (int device = 0; device < repeats(2000); ++device) {
    InputAbilities abilities = tablet_abilities();
    for (auto& axis : abilities.axes) {
      if (!axis) continue;
      axis->least = hostile_number(random);
      axis->most = hostile_number(random);
      axis->resolution = hostile_number(random);
    }
    Pen pen({}, abilities);
    ASSERT_TRUE(pen.info.workspace_radius >= 0.01 && pen.info.workspace_radius <= 1.0);
    PointerState state;
    for (int i = 0; i < 20; ++i) {
      for (const int axis : {ABS_X, ABS_Y, ABS_PRESSURE, ABS_DISTANCE, ABS_TILT_X, ABS_TILT_Y, 0xffff})
        pen.say(EV_ABS, axis, hostile_number(random));
      pen.say(EV_KEY, BTN_TOOL_PEN, 1);
      pen.say(EV_KEY, BTN_TOUCH, i % 2);
      pen.say(EV_KEY, 0xffff, 1);
      pen.report(hostile_number(random));
      if (pen.link.read(state) != DeviceStatus::Ok) continue;
      ASSERT_TRUE(state.position.allFinite() && state.velocity.allFinite());
      ASSERT_LE(state.position.norm(), 11.0);
      ASSERT_LE(state.velocity.norm(), 20.001);
      ASSERT_NEAR(state.orientation.norm(), 1.0, 1e-9);
    }
  }
}

/// The outcome of a recording.
struct Replay {
  int strokes = 0;           // times that the pen was put down
  double fastest = 0.0;      // m/s
  double deepest = 0.0;      // m below the plane
  double highest = 0.0;      // m above it
  double steepest = 0.0;     // rad, of the pen
  std::vector<Vector3> way;  // m, by frame while the pen was near
  DeviceInfo info;
  LinkCounts counts;

  void add(const PointerState& pointer) {
    fastest = std::max(fastest, pointer.velocity.norm());
    deepest = std::max(deepest, -pointer.position.z());
    highest = std::max(highest, pointer.position.z());
    steepest = std::max(steepest, std::acos((pointer.orientation * Vector3::UnitZ()).z()));
    way.push_back(pointer.position);
  }
};

Replay replay(const EvemuRecording& recording, const TabletSettings& settings = {}) {
  Pen pen(settings, recording.abilities);
  Replay result;
  result.info = pen.info;
  std::uint32_t before = 0;
  for (const InputEvent& event : recording.events) {
    if (event.type != EV_SYN) pen.tablet.take(event);
    if (event.type != EV_SYN || event.code != SYN_REPORT) continue;
    pen.tablet.frame(event.time);
    pen.tablet.pass(pen.link, event.time);
    const PointerState& pointer = pen.tablet.pointer();
    if ((pointer.buttons & ~before & 1U) != 0) ++result.strokes;
    before = pointer.buttons;
    if (!pointer.parked) result.add(pointer);
  }
  result.counts = pen.link.counts();
  return result;
}

std::filesystem::path pen_recordings() { return places::shared_data() / "strokes" / "evemu"; }

TEST(Tablet, ARealPenOnACintiq) {
  const auto file = pen_recordings() / "Wacom_Cintiq_13HD_touch_Pen.events";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const EvemuRecording recording = read_evemu({file});
  EXPECT_TRUE(is_of_kind(recording.abilities, InputKind::Tablet));
  const Replay replayed = replay(recording);
  EXPECT_EQ(replayed.strokes, 2);
  ASSERT_FALSE(replayed.way.empty());
  // First report: x 27246 of 400 to 59152, y 10992 of 400 to 33448, 200 counts/mm; distance 31 of 63.
  EXPECT_TRUE(replayed.way[0].isApprox(Vector3(-0.01265, 0.02966, 0.01 * 31.0 / 63.0), 1e-9))
      << replayed.way[0].transpose();
  EXPECT_NEAR(replayed.info.workspace_radius, 0.5 * std::hypot(0.29376, 0.16524), 1e-9);
  EXPECT_LT(replayed.fastest, 1.0) << "m/s, more than a hand that writes";
  EXPECT_GT(replayed.deepest, 0.0002);
  EXPECT_LE(replayed.deepest, 0.005);
  EXPECT_GT(replayed.highest, 0.0);
  EXPECT_LE(replayed.highest, 0.01);
  EXPECT_GT(replayed.steepest, 0.3);
  EXPECT_LT(replayed.steepest, 1.0);
  EXPECT_EQ(replayed.counts.not_finite + replayed.counts.far_away, 0U);
}

TEST(Tablet, ARealPenOnATabletWithoutResolution) {
  const auto description = pen_recordings() / "Wacom_Intuos4_6x9.desc";
  const auto file = pen_recordings() / "Wacom_Intuos4_6x9.stylus-drag.events";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  TabletSettings settings;
  settings.resolution = 2e5;  // 5080 counts/inch, as the newer kernel's description of it says
  const Replay replayed = replay(read_evemu({description, file}), settings);
  EXPECT_EQ(replayed.strokes, 1);
  EXPECT_NEAR(replayed.info.workspace_radius, 0.5 * std::hypot(0.22352, 0.1397), 1e-9);
  ASSERT_FALSE(replayed.way.empty());
  // x 4488 of 44704, y 4680 of 27940, distance 58 of 63.
  EXPECT_TRUE(replayed.way[0].isApprox(Vector3(-0.08932, 0.04645, 0.01 * 58.0 / 63.0), 1e-9))
      << replayed.way[0].transpose();
  EXPECT_LT(replayed.fastest, 1.0);
  EXPECT_GT(replayed.deepest, 0.0005);
  EXPECT_GT(replayed.steepest, 0.3);
  EXPECT_EQ(replayed.counts.not_finite + replayed.counts.far_away, 0U);
}

TEST(Tablet, ARealPenThatNeverTouches) {
  const auto file = pen_recordings() / "Genius_EasyPen_i405X.events";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  EvemuRecording recording = read_evemu({file});
  // The file has no description; ranges that hold its values stand for it.
  recording.abilities.keys[BTN_TOOL_PEN] = recording.abilities.keys[BTN_TOUCH] = true;
  recording.abilities.axes[ABS_X] = InputAxis{0, 14080, 0, 0};
  recording.abilities.axes[ABS_Y] = InputAxis{0, 10240, 0, 0};
  const Replay replayed = replay(recording);
  EXPECT_EQ(replayed.strokes, 0);
  EXPECT_EQ(replayed.deepest, 0.0);
  EXPECT_EQ(replayed.highest, 0.002);
  EXPECT_LT(replayed.fastest, 1.0);
  EXPECT_GT(replayed.way.size(), 100U);
}

}  // namespace
}  // namespace icome::devices
