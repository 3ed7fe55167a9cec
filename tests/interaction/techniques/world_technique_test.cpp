#include "interaction/techniques/world_technique.h"

#include "interaction/techniques/technique_cases.h"
#include "interaction/techniques/technique_recording.h"
#include "world/sample_world.h"

namespace icome::interaction {
namespace {

/// Some boxes, some of them below others.
struct BoxWorld {
  explicit BoxWorld(int count, std::uint64_t seed = 4) : random(seed) {
    const auto shape = ids.next<world::GeometryId>();
    EXPECT_TRUE(apply(world, world::CreateGeometry{shape, world::box(0.2)}));
    for (int i = 0; i < count; ++i) {
      world::PhysicalObject made;
      if (i % 3 == 2) made.parent = boxes.back();
      if (i % 5 != 4) made.geometry = shape;
      made.parent_from_object = random_pose(random, 2.0);
      boxes.push_back(ids.next<world::ObjectId>());
      EXPECT_TRUE(apply(world, world::CreateObject{boxes.back(), 0, made}));
    }
  }

  world::World world;
  world::IdSource ids{1};
  base::Random random;
  std::vector<world::ObjectId> boxes;
};

void expect_same_targets(const TechniqueScene& scene, const TechniqueScene& other) {
  ASSERT_EQ(scene.targets().size(), other.targets().size());
  for (std::size_t i = 0; i < scene.targets().size(); ++i) {
    EXPECT_EQ(scene.targets()[i].id, other.targets()[i].id);
    EXPECT_EQ(scene.targets()[i].world_from_target.matrix(), other.targets()[i].world_from_target.matrix());
    EXPECT_EQ(scene.ball(i).centre, other.ball(i).centre);
  }
}

TEST(WorldTargetsKept, AreWhatTheyWouldBeIfMadeAnew) {
  BoxWorld it(12);
  WorldTargets targets;
  expect_same_targets(targets.of(it.world), targets_of(it.world));
  const TechniqueScene& scene = targets.of(it.world);
  for (int i = 0; i < 200; ++i) {
    const world::ObjectId id = it.boxes[it.random.index(it.boxes.size())];
    if (!it.world.find(id)) continue;
    world::Edit edit = world::PlaceObject{id, base::Affine3(random_pose(it.random, 2.0))};
    if (i % 80 == 79) edit = delete_subtree(it.world, it.world.roots().front());
    if (i % 40 == 20) edit = world::ChooseGeometry{id, {}};
    if (!apply(it.world, edit)) continue;
    const world::Changes changes = changes_of(edit);
    targets.changed(&changes);
    if (i % 2 == 0) expect_same_targets(targets.of(it.world), targets_of(it.world));
  }
  EXPECT_EQ(&scene, &targets.of(it.world));
  targets.changed(nullptr);
  const BoxWorld other(3, 9);
  expect_same_targets(targets.of(other.world), targets_of(other.world));
}

Technique any_technique() {
  Technique technique;
  technique.selecting = Selecting::LookAt;
  technique.holding = Holding::ScaledWorld;
  technique.travelling = Travelling::Miniature;
  technique.selecting_settings.spotlight = 0.1 + 0.2;
  technique.holding_settings.two_hands.turns = false;
  technique.travel_settings.floor = -1.0 / 3.0;
  technique.selecting_settings.miniature.shown = {Vector3(-1.0, 0.0, 0.1), Vector3(1.0, 2.0, 0.3)};
  return technique;
}

TechniqueRecording some_recording() {
  TechniqueRecording recording{any_technique(), base::Affine3(Eigen::Scaling(1.7)), {}};
  base::Random random(5);
  for (int i = 0; i < 4; ++i) recording.stream.push_back(person_with(random_pose(random), 0.1 * i));
  return recording;
}

TEST(TechniqueRecording, IsReadBackToTheLastBit) {
  const TechniqueRecording recording = some_recording();
  const std::string text = recording_to_text(recording);
  const auto read = recording_from_text(text);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(recording_to_text(*read), text);
  EXPECT_EQ(read->technique.selecting, Selecting::LookAt);
  EXPECT_EQ(read->technique.holding, Holding::ScaledWorld);
  EXPECT_EQ(read->technique.travelling, Travelling::Miniature);
  EXPECT_EQ(read->technique.selecting_settings.spotlight, 0.1 + 0.2);
  EXPECT_FALSE(read->technique.holding_settings.two_hands.turns);
  EXPECT_TRUE(read->technique.holding_settings.two_hands.moves);
  EXPECT_EQ(read->technique.selecting_settings.miniature.shown.max(), Vector3(1.0, 2.0, 0.3));
  EXPECT_EQ(read->world_from_room.matrix(), recording.world_from_room.matrix());
  EXPECT_EQ(read->stream.size(), 4U);
  TechniqueRecording plain;
  const auto empty = recording_from_text(recording_to_text(plain));
  ASSERT_TRUE(empty) << empty.error().message;
  EXPECT_TRUE(empty->technique.selecting_settings.miniature.shown.isEmpty());
}

TEST(TechniqueRecording, RefusesWhatIsNone) {
  const std::string text = recording_to_text(some_recording());
  // Cut off anywhere but at the end of a step.
  for (std::size_t length = 0; length < text.size(); length += 7) {
    if (length == 0 || text[length - 1] != '\n') {
      EXPECT_FALSE(recording_from_text(text.substr(0, length)));
    }
  }
  const auto with = [&](const std::string& what, const std::string& instead) {
    std::string changed = text;
    const std::size_t at = changed.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return changed.replace(at, what.size(), instead);
  };
  EXPECT_FALSE(recording_from_text(with("look-at", "look")));
  EXPECT_FALSE(recording_from_text(with("look-at,", "look-at,,")));
  EXPECT_FALSE(recording_from_text(with("world in miniature\n", "world in miniature,none\n")));
  EXPECT_FALSE(recording_from_text(with("0.30000000000000004", "nan")));
  EXPECT_FALSE(recording_from_text(with("0.30000000000000004", "7"))) << "no angle of a spotlight";
  EXPECT_FALSE(recording_from_text(with("1.7 0 0", "-1.7 0 0"))) << "a mirrored room";
  EXPECT_FALSE(recording_from_text(with("1.7 0 0", "inf 0 0")));
}

TEST(WorldTechnique, WhatCannotBeMovedIsLetGo) {
  BoxWorld it(1);
  ASSERT_TRUE(apply(it.world, world::PlaceObject{it.boxes[0], world::at(0.0, 1.0, -2.0)}));
  Technique technique;
  technique.selecting = Selecting::RayPointer;
  WorldTechnique at_work(technique);
  TechniqueInput input = person_with(pose_at({0.0, 1.0, 0.0}), 0.0);
  input.hands[0].grab = true;
  EXPECT_FALSE(at_work.step(it.world, input).edit);
  EXPECT_TRUE(at_work.holds());
  EXPECT_FALSE(at_work.resting());
  input.time = 0.1;
  input.hands[0].room_from_hand.translation().x() = 0.0005;
  EXPECT_FALSE(at_work.step(it.world, input).edit) << "half a millimetre: only pressed";
  input.time = 0.2;
  input.hands[0].room_from_hand.translation().x() = 0.1;
  const auto first = at_work.step(it.world, input);
  ASSERT_TRUE(first.edit);
  EXPECT_TRUE(first.is_first);
  input.time = 0.3;
  input.hands[0].room_from_hand.translation().x() = 0.1005;
  const auto next = at_work.step(it.world, input);
  ASSERT_TRUE(next.edit) << "it is moving now";
  EXPECT_FALSE(next.is_first);
  at_work.let_go();
  input.time = 0.4;
  input.hands[0].room_from_hand.translation().x() = 0.2;
  EXPECT_FALSE(at_work.step(it.world, input).edit);
  EXPECT_FALSE(at_work.holds()) << "until the button is pressed anew";
}

}  // namespace
}  // namespace icome::interaction
