#include "animation/record/posing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace icome::animation {
namespace {

constexpr CellId kBoat{3}, kSea{5};

/// Cells "boat" on layer 2 and "sea" on layer 4, both at rest in the corner.
Project two_layers() {
  Project project;
  Cell boat, sea;
  boat.id = kBoat, boat.name = "boat";
  sea.id = kSea, sea.name = "sea";
  EXPECT_TRUE(apply_edit(project, {PutLayer{LayerId{2}, 0, {.name = "a"}}, PutCell{LayerId{2}, 0, boat},
                                   PutLayer{LayerId{4}, 1, {.name = "b"}}, PutCell{LayerId{4}, 0, sea}}));
  return project;
}

CellState at(double x, double y = 0) {
  CellState state;
  state.place = {x, y};
  return state;
}

const Track& track_of_x(const Project& project, CellId cell) {
  return project.find(cell)->tracks[std::size_t(Channel::X)];
}

TEST(Posing, KeysOnlyWhatWasChanged) {
  Project project = two_layers();
  const ProjectEdit edit = keyed_pose(project, 7, {{kBoat, at(5)}, {kSea, at(0)}}, Ease::Eased);
  ASSERT_TRUE(apply_edit(project, edit));
  EXPECT_EQ(edit.size(), 1U);
  EXPECT_EQ(track_of_x(project, kBoat), (Track{{7, 5, Ease::Eased}}));
}

TEST(Posing, LeavesLockedLayersAlone) {
  Project project = two_layers();
  ASSERT_TRUE(apply_edit(project, {ChangeLayer{LayerId{2}, {.name = "a", .locked = true}}}));
  EXPECT_TRUE(keyed_pose(project, 7, {{kBoat, at(5)}}).empty());
}

TEST(Recording, TakesDownEachFrameAndThoseThatWerePassedOver) {
  Project project = two_layers();
  Recording recording(project, std::nullopt);
  recording.take(2, {{kBoat, at(10)}});
  recording.take(3, {{kBoat, at(99)}});
  recording.take(3, {{kBoat, at(20)}});
  recording.take(6, {{kBoat, at(50)}});
  ASSERT_TRUE(apply_edit(project, recording.finish(0)));
  EXPECT_EQ(track_of_x(project, kBoat), (Track{{2, 10}, {3, 20}, {4, 30}, {5, 40}, {6, 50}}));
  EXPECT_TRUE(project.find(kBoat)->tracks[std::size_t(Channel::Y)].empty());
}

TEST(Recording, ThinsTurnsByWhatTheyMoveARimBy) {
  Project project = two_layers();
  Recording recording(project, std::nullopt);
  const auto turn = [](int frame) { return 0.6 * std::sin(0.3 * frame); };
  for (int frame = 0; frame < 60; ++frame) {
    CellState state = at(0);
    state.angle = turn(frame);
    recording.take(frame, {{kBoat, state}});
  }
  ASSERT_TRUE(apply_edit(project, recording.finish(0.25)));
  EXPECT_LT(project.find(kBoat)->tracks[std::size_t(Channel::Angle)].size(), 60U);
  for (int frame = 0; frame < 60; ++frame)
    EXPECT_LE(300 * std::abs(state_at(*project.find(kBoat), frame).angle - turn(frame)), 0.2501) << frame;
}

TEST(Recording, GoesOverOneLayerOnly) {
  Project project = two_layers();
  Recording recording(project, LayerId{4});
  recording.take(0, {{kBoat, at(1)}, {kSea, at(2)}});
  ASSERT_TRUE(apply_edit(project, recording.finish(0)));
  EXPECT_TRUE(track_of_x(project, kBoat).empty());
  EXPECT_EQ(track_of_x(project, kSea), (Track{{0, 2}}));
}

TEST(Recording, LeavesWhatWasBeforeAndAfterAsItWas) {
  Project project = two_layers();
  ASSERT_TRUE(apply_edit(project, {ChangeKeys{kBoat, Channel::X, 0, 20, {{0, 0}, {20, 200}}}}));
  const Project before = project;
  Recording recording(project, std::nullopt);
  for (int frame = 8; frame <= 12; ++frame) recording.take(frame, {{kBoat, at(-5)}});
  ASSERT_TRUE(apply_edit(project, recording.finish(0)));
  for (int frame = 0; frame <= 20; ++frame) {
    const double old = state_at(*before.find(kBoat), frame).place.x();
    const bool over = frame >= 8 && frame <= 12;
    EXPECT_DOUBLE_EQ(state_at(*project.find(kBoat), frame).place.x(), over ? -5 : old) << frame;
  }
}

/// Cells that are held now and then, on tracks that may have keys already.
TEST(Recording, PartsMoveCellsAsTheWholeDoes) {
  base::Random random(11);
  for (int round = 0; round < 200; ++round) {
    Project project = two_layers();
    if (random.index(2) == 0) {
      ASSERT_TRUE(apply_edit(project, {ChangeKeys{kBoat, Channel::X, 0, 90, {{0, 0}, {40, 70}, {90, 200}}}}));
    }
    Project in_parts = project;
    Recording recording(project, std::nullopt);
    std::size_t parts = 0;
    for (int frame = int(random.index(30)); frame < 80; frame += 1 + int(random.index(3))) {
      if (random.index(3) > 0) recording.take(frame, {{kBoat, at(random.uniform(-9, 9), 4)}});
      if (random.index(4) == 0) recording.take(frame, {{kSea, at(0, random.uniform(-9, 9))}});
      if (random.index(10) > 0) continue;
      const ProjectEdit part = recording.next_part();
      parts += part.empty() ? 0 : 1;
      ASSERT_TRUE(apply_edit(in_parts, part));
      EXPECT_TRUE(recording.next_part().empty()) << "nothing was taken down since";
    }
    ASSERT_TRUE(apply_edit(in_parts, recording.next_part()));
    ASSERT_TRUE(apply_edit(project, recording.finish(0)));
    for (int frame = 0; frame < 100; ++frame)
      for (const CellId cell : {kBoat, kSea}) {
        const CellState part = state_at(*in_parts.find(cell), frame),
                        whole = state_at(*project.find(cell), frame);
        ASSERT_LE((part.place - whole.place).norm(), 1e-12) << "round " << round << ", frame " << frame;
      }
    EXPECT_LE(parts, 20U);
  }
}

TEST(Thinned, StaysWithinItsToleranceAtEveryFrame) {
  base::Random random(2);
  for (int round = 0; round < 300; ++round) {
    Track track;
    double value = 0;
    int frame = 0;
    for (int i = 0; i < 60; ++i) {
      const Ease ease = random.index(6) == 0 ? Ease(random.index(3)) : Ease::Straight;
      track.push_back({frame += 1 + int(random.index(3)), value += random.uniform(-1, 1), ease});
    }
    const double tolerance = random.uniform(0, 3);
    const Track thin = thinned(track, tolerance);
    EXPECT_LE(thin.size(), track.size());
    for (double t = 0; t <= frame + 2; t += 0.25)
      ASSERT_NEAR(value_at(thin, Channel::X, t, 0), value_at(track, Channel::X, t, 0), tolerance + 1e-9);
  }
}

TEST(Thinned, NeedsTwoKeysForAStraightWay) {
  Track track;
  for (int frame = 0; frame < 100'000; ++frame) track.push_back({frame, 0.5 * frame});
  EXPECT_EQ(thinned(track, 1e-6), (Track{track.front(), track.back()}));
}

}  // namespace
}  // namespace icome::animation
