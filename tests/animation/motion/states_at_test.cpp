#include <gtest/gtest.h>

#include "animation/motion/constraints.h"
#include "animation/motion/scenes.h"
#include "repeats.h"

namespace icome::animation {
namespace {

using namespace scenes;

void key(Project& project, int number, Channel channel, Track track) {
  cell_of(project, number).tracks[std::size_t(channel)] = std::move(track);
}

/// The largest step of a cell, and of an angle times 50, between frames as little apart as that.
double roughness(const Project& project, double first, double last, double apart) {
  CellStates before = states_at(project, first);
  double most = 0;
  for (double frame = first + apart; frame <= last; frame += apart) {
    const CellStates now = states_at(project, frame);
    most = std::max(most, largest_step(before, now));
    for (const auto& [id, state] : now)
      most = std::max(most, 50 * std::abs(std::remainder(state.angle - before.at(id).angle, 2 * M_PI)));
    before = now;
  }
  return most;
}

/// As a function of the frame has no jump: at ever shorter steps its largest step shrinks likewise.
void expect_continuous(const Project& project, double frames) {
  const double last = frames / kSanitizerShare;
  const double coarse = roughness(project, 0, last, 2e-2);
  EXPECT_LT(roughness(project, 0, last, 2e-3), 0.2 * coarse + 1e-6);
}

TEST(StatesAt, AreThoseOfTheKeysWithoutConstraints) {
  Project project = project_of(2);
  key(project, 1, Channel::X, {{0, 0.0}, {10, 100.0}});
  const CellStates states = states_at(project, 2.5);
  EXPECT_EQ(states.size(), 3u);
  EXPECT_EQ(states.at(kCamera), state_at(project.camera, 2.5));
  EXPECT_EQ(states.at(id_of(1)).place, Vector2(25, 0));
}

TEST(StatesAt, ShowPinnedThingsPinned) {
  Project project = limb({60, 50, 40}, true);
  std::get<Joint>(project.constraints[1].what).limits = AngleLimits{-0.5, 0.5};
  key(project, 0, Channel::X, {{0, 0.0, Ease::Eased}, {40, 300.0}});
  key(project, 0, Channel::Angle, {{0, 0.0}, {40, 3.0}});
  key(project, 1, Channel::Angle, {{0, 0.0, Ease::Eased}, {20, -2.0}, {40, 5.0}});
  key(project, 2, Channel::Angle, {{0, 0.0}, {40, 2.0}});
  for (double frame = 0; frame < 40; frame += 0.37)
    EXPECT_LT(worst_violation(project, states_at(project, frame)), 1e-9);
  EXPECT_NEAR(states_at(project, 20).at(id_of(1)).angle, -2, 1e-12) << "angles are those of the keys";
  expect_continuous(project, 40);
}

TEST(StatesAt, GoAlongAPathBetweenKeys) {
  Project project = project_of(1);
  constrain(project, PathGuide{id_of(0), {0, 0}, {{0, 0}, {100, 0}, {100, 100}, {0, 100}}, false, true});
  key(project, 0, Channel::X, {{0, 0.0}, {30, 0.0}});
  key(project, 0, Channel::Y, {{0, 0.0}, {30, 100.0}});
  for (int frame = 0; frame <= 30; ++frame) {
    const double s = 10.0 * frame;
    const Vector2 place = s < 100 ? Vector2(s, 0) : s < 200 ? Vector2(100, s - 100) : Vector2(300 - s, 100);
    EXPECT_LT((states_at(project, frame).at(id_of(0)).place - place).norm(), 1e-9) << frame;
  }
  expect_continuous(project, 30);
}

TEST(StatesAt, GoTheShorterWayRoundAClosedPath) {
  Project project = project_of(1);
  constrain(project, PathGuide{id_of(0), {0, 0}, {{0, 0}, {100, 0}, {100, 100}, {0, 100}}, true, false});
  key(project, 0, Channel::X, {{0, 30.0}, {10, 0.0}});
  key(project, 0, Channel::Y, {{0, 0.0}, {10, 30.0}});
  EXPECT_LT(states_at(project, 5).at(id_of(0)).place.norm(), 1e-9)
      << "round the corner where the path begins";
  expect_continuous(project, 10);
}

TEST(StatesAt, StayOnTheBranchOfACrossing) {
  // An eight, with a key in every frame as after recording, each rounded to a hundredth of a px.
  PathGuide eight{id_of(0), {0, 0}, {}, true, true};
  const auto at = [](double t) { return Vector2(300 * std::sin(t), 150 * std::sin(2 * t)); };
  for (int k = 0; k < 400; ++k) eight.way.push_back(at(2 * M_PI * (k + 0.5) / 400));
  Project project = project_of(1);
  constrain(project, eight);
  Track x, y;
  for (int k = 0; k <= 100; ++k) {
    const Vector2 place = at(2 * M_PI * k / 100);
    x.push_back({k, std::round(100 * place.x()) / 100});
    y.push_back({k, std::round(100 * place.y()) / 100});
  }
  key(project, 0, Channel::X, x);
  key(project, 0, Channel::Y, y);
  for (double frame = 0; frame < 100; frame += 0.05)
    EXPECT_LT((states_at(project, frame).at(id_of(0)).place - at(2 * M_PI * frame / 100)).norm(), 2.5)
        << frame;
  expect_continuous(project, 100);
}

TEST(StatesAt, AreContinuousUnderRandomConstraints) {
  for (int seed = 0; seed < repeats(10); ++seed) {
    base::Random random(std::uint64_t(seed) + 100);
    Project project = project_of(6);
    for (int k = 0; k < 6; ++k) {
      cell_of(project, k).rest.place = {150.0 * k, random.uniform(0, 100)};
      for (const Channel channel : {Channel::X, Channel::Y, Channel::Angle}) {
        const double about = channel_of(cell_of(project, k).rest, channel);
        const double far = channel == Channel::Angle ? 1.0 : 40.0;
        Track track;
        for (int frame = 0; frame <= 20; frame += 5)
          track.push_back(
              {frame, about + random.uniform(-far, far), random.index(2) ? Ease::Eased : Ease::Straight});
        key(project, k, channel, track);
      }
    }
    constrain(project, Joint{id_of(0), id_of(1), {60, 0}, {-20, 0}, AngleLimits{-0.6, 0.6}});
    constrain(project, Joint{id_of(1), id_of(2), {60, 0}, {-20, 0}, {}});
    constrain(project, DistanceLimit{id_of(3), id_of(4), {0, 0}, {0, 0}, 100, 140});
    constrain(project, DistanceLimit{id_of(0), id_of(3), {20, 0}, {0, 0}, 380, 450});
    constrain(project, AxisGuide{id_of(4), {10, 10}, {600, 50}, random.uniform(-0.5, 0.5)});
    constrain(project,
              PathGuide{id_of(5), {5, 0}, {{650, 0}, {700, 90}, {800, 60}, {900, 120}}, false, true});
    for (double frame = 0; frame <= 20; frame += 0.5)
      EXPECT_LT(worst_violation(project, states_at(project, frame)), 1e-6)
          << "seed " << seed << " frame " << frame;
    SCOPED_TRACE(seed);
    expect_continuous(project, 20);
  }
}

}  // namespace
}  // namespace icome::animation
