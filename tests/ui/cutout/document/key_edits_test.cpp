#include "ui/cutout/document/key_edits.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace icome::ui {
namespace {

class KeyEdits : public ::testing::Test {
 protected:
  KeyEdits() {
    animation::Cell arm;
    arm.id = kArm;
    arm.name = "arm";
    animation::Cell leg;
    leg.id = kLeg;
    leg.name = "leg";
    animation::Layer layer;
    layer.id = animation::LayerId{2};
    layer.name = "body";
    project_.next_id = 5;
    perform({animation::PutLayer{layer.id, 0, {.name = "body"}}, animation::PutCell{layer.id, 0, arm},
             animation::PutCell{layer.id, 1, leg}});
  }

  void perform(const animation::ProjectEdit& edit) {
    const auto done = animation::apply_edit(project_, edit);
    ASSERT_TRUE(done) << done.error().message;
  }
  void set(CellId cell, Channel channel, const animation::Track& track) {
    perform({animation::ChangeKeys{cell, channel, 0, 1000, track}});
  }
  const animation::Track& track(CellId cell, Channel channel) const {
    return project_.find(cell)->tracks[std::size_t(channel)];
  }

  static constexpr CellId kArm{3}, kLeg{4};
  animation::Project project_;
};

TEST_F(KeyEdits, KeysThatAreMovedLieOnOthersAndKeepTheirEase) {
  set(kArm, Channel::X,
      {{0, 1, animation::Ease::Hold}, {5, 2, animation::Ease::Eased}, {9, 3, animation::Ease::Straight}});
  perform(moved_keys(project_, {{kArm, Channel::X, 5}}, 4));
  EXPECT_EQ(track(kArm, Channel::X),
            (animation::Track{{0, 1, animation::Ease::Hold}, {9, 2, animation::Ease::Eased}}));
}

TEST_F(KeyEdits, NoKeyIsMovedBeforeTheFirstFrame) {
  set(kArm, Channel::X, {{2, 1}, {7, 2}});
  const KeyPlaces keys = {{kArm, Channel::X, 2}, {kArm, Channel::X, 7}};
  EXPECT_EQ(possible_move(keys, -5), -2);
  perform(moved_keys(project_, keys, -5));
  EXPECT_EQ(track(kArm, Channel::X), (animation::Track{{0, 1}, {5, 2}}));
  EXPECT_EQ(moved_places(keys, -5), (KeyPlaces{{kArm, Channel::X, 0}, {kArm, Channel::X, 5}}));
}

/// Against moving in a plain map of frames, where those that are moved win.
TEST_F(KeyEdits, MovingIsThatOfAMap) {
  std::mt19937 random(7);
  const auto below = [&](int count) { return int(random() % unsigned(count)); };
  for (int round = 0; round < 300; ++round) {
    std::map<int, double> keys;
    animation::Track start;
    for (int i = 0; i < 12; ++i) keys[below(30)] = below(100);
    for (const auto& [frame, value] : keys) start.push_back({frame, value});
    set(kArm, Channel::Angle, start);
    KeyPlaces chosen;
    for (const auto& [frame, value] : keys)
      if (below(2) == 0) chosen.insert({kArm, Channel::Angle, frame});
    const int by = below(21) - 10;
    int possible = by;
    for (const KeyPlace& key : chosen) possible = std::max(possible, -key.frame);
    std::map<int, double> expected;
    for (const auto& [frame, value] : keys)
      if (!chosen.contains({kArm, Channel::Angle, frame})) expected[frame] = value;
    for (const KeyPlace& key : chosen) expected[key.frame + possible] = keys.at(key.frame);
    perform(moved_keys(project_, chosen, by));
    std::map<int, double> moved;
    for (const animation::Key& key : track(kArm, Channel::Angle)) moved[key.frame] = key.value;
    EXPECT_EQ(moved, expected) << "round " << round;
  }
}

TEST_F(KeyEdits, CopiesOfOneCellArePastedToAnother) {
  set(kArm, Channel::X, {{3, 10}, {6, 20, animation::Ease::Eased}});
  const CopiedKeys copied = copied_keys(project_, {{kArm, Channel::X, 3}, {kArm, Channel::X, 6}});
  perform(pasted_keys(project_, copied, 50, {kLeg}));
  EXPECT_EQ(track(kLeg, Channel::X), (animation::Track{{50, 10}, {53, 20, animation::Ease::Eased}}));
  perform(pasted_keys(project_, copied, 20, {}));
  EXPECT_EQ(track(kArm, Channel::X).size(), 4U);
}

TEST_F(KeyEdits, TheCameraTakesNoOpacity) {
  set(kArm, Channel::Opacity, {{3, 0.5}});
  set(kArm, Channel::X, {{3, 5}});
  const CopiedKeys copied = copied_keys(project_, keys_at(project_, {kArm}, 3));
  EXPECT_EQ(copied.pieces.size(), 2U);
  perform(pasted_keys(project_, copied, 0, {animation::kCamera}));
  EXPECT_EQ(project_.camera.tracks[std::size_t(Channel::X)], (animation::Track{{0, 5}}));
  EXPECT_TRUE(project_.camera.tracks[std::size_t(Channel::Opacity)].empty());
}

TEST_F(KeyEdits, HeldKeysLeaveEveryFrameAsItWas) {
  set(kArm, Channel::X, {{0, 0, animation::Ease::Straight}, {10, 100}});
  set(kArm, Channel::Y, {{0, 7, animation::Ease::Hold}, {10, 9}});
  std::vector<animation::CellState> before;
  for (int frame = 0; frame < 20; ++frame) before.push_back(animation::state_at(*project_.find(kArm), frame));
  perform(held_keys(project_, {kArm}, channels_of(kArm), 4));
  EXPECT_EQ(track(kArm, Channel::X).size(), 3U);
  EXPECT_EQ(track(kArm, Channel::Opacity).size(), 1U);
  for (int frame = 0; frame < 20; ++frame) {
    const animation::CellState now = animation::state_at(*project_.find(kArm), frame);
    EXPECT_NEAR(now.place.x(), before[std::size_t(frame)].place.x(), 1e-9) << frame;
    EXPECT_EQ(now.place.y(), before[std::size_t(frame)].place.y()) << frame;
  }
}

TEST_F(KeyEdits, LockedLayersKeepTheirKeys) {
  set(kArm, Channel::X, {{3, 10}});
  perform({animation::ChangeLayer{animation::LayerId{2}, {.name = "body", .visible = true, .locked = true}}});
  EXPECT_TRUE(deleted_keys(project_, {{kArm, Channel::X, 3}}).empty());
  EXPECT_TRUE(one_key(project_, kArm, Channel::X, 5, 1.0).empty());
}

TEST_F(KeyEdits, KeysBeforeAndAfterAreFound) {
  set(kArm, Channel::X, {{3, 10}, {9, 1}});
  set(kLeg, Channel::Angle, {{5, 1}});
  EXPECT_EQ(next_key(project_, {}, 3), 5);
  EXPECT_EQ(next_key(project_, {kArm}, 3), 9);
  EXPECT_EQ(key_before(project_, {}, 9), 5);
  EXPECT_EQ(key_before(project_, {}, 3), std::nullopt);
  EXPECT_EQ(next_key(project_, {}, 9), std::nullopt);
}

TEST_F(KeyEdits, WhatChangesOfATrackIsAllThatIsWritten) {
  const animation::Track from = {{0, 1}, {5, 2}, {9, 3}}, to = {{0, 1}, {6, 2}, {9, 3}};
  const auto change = track_change(kArm, Channel::X, from, to);
  ASSERT_TRUE(change);
  EXPECT_EQ(change->from, 5);
  EXPECT_EQ(change->to, 6);
  EXPECT_EQ(change->keys, (animation::Track{{6, 2}}));
  EXPECT_FALSE(track_change(kArm, Channel::X, from, from));
}

}  // namespace
}  // namespace icome::ui
