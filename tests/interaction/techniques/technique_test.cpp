#include "interaction/techniques/technique.h"

#include <cmath>
#include <limits>

#include "interaction/techniques/similarity.h"
#include "interaction/techniques/technique_cases.h"
#include "interaction/techniques/technique_stream.h"

namespace icome::interaction {
namespace {

TechniqueScene table_of_balls() {
  TechniqueScene scene;
  base::Random random(21);
  for (TargetId id = 1; id <= 40; ++id)
    EXPECT_TRUE(
        scene.add(ball_target(id, Vector3(0.0, 1.3, -0.8) + random.uniform(0.1, 0.9) * random.direction(),
                              random.uniform(0.03, 0.12))));
  return scene;
}

/// A person who does a bit of everything.
std::vector<TechniqueInput> lively_session(std::uint64_t seed, int steps) {
  base::Random random(seed);
  std::vector<TechniqueInput> stream;
  TechniqueInput input = person_with(pose_at({0.2, 1.3, -0.4}));
  input.hands[1].tracked = true;
  input.hands[1].room_from_hand = pose_at({-0.2, 1.2, -0.4});
  for (int i = 0; i < steps; ++i) {
    input.time += random.uniform(0.005, 0.02);
    for (HandInput& hand : input.hands) {
      hand.room_from_hand.translation() += 0.03 * random.direction();
      hand.room_from_hand.rotate(Eigen::AngleAxisd(0.05, random.direction()));
      if (random.index(20) == 0) hand.grab = !hand.grab;
      if (random.index(30) == 0) hand.travel = !hand.travel;
      if (random.index(40) == 0) hand.tracked = !hand.tracked;
      hand.reel = random.uniform(-1.0, 1.0);
    }
    input.room_from_head.rotate(Eigen::AngleAxisd(0.02, random.direction()));
    stream.push_back(input);
  }
  return stream;
}

TEST(Technique, AnySelectionGoesWithAnyHoldingAndTravelling) {
  for (const Selecting selecting : kAllSelecting) {
    for (const Holding holding : kAllHolding) {
      for (const Travelling travelling : kAllTravelling) {
        Technique technique;
        technique.selecting = selecting;
        technique.holding = holding;
        technique.travelling = travelling;
        TechniqueScene scene = table_of_balls();
        int picked = 0, moved = 0;
        for (const TechniqueOutcome& it : replay(technique, lively_session(3, 400), scene)) {
          picked += it.picked ? 1 : 0;
          moved += it.moved ? 1 : 0;
          ASSERT_TRUE(it.world_from_room.matrix().allFinite());
          ASSERT_NEAR(scale_of(it.world_from_room) * (it.selected == 0 ? 1.0 : 0.0),
                      it.selected == 0 ? 1.0 : 0.0, 1e-6);
        }
        EXPECT_GT(picked, 3) << name_of(selecting) << ", " << name_of(holding);
        // What a small hand touches by chance is little.
        if (selecting == Selecting::Spotlight) {
          EXPECT_GT(moved, 10) << name_of(holding);
        }
      }
    }
  }
}

TEST(Technique, AReplayGivesTheSameBits) {
  const std::vector<TechniqueInput> stream = lively_session(8, 2000);
  const std::string text = stream_to_text(stream);
  const auto read = stream_from_text(text);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(stream_to_text(*read), text);
  std::uint64_t before = 0;
  for (const Travelling travelling : kAllTravelling) {
    Technique technique;
    technique.selecting = Selecting::Spotlight;
    technique.holding = Holding::TwoHands;
    technique.travelling = travelling;
    TechniqueScene one = table_of_balls(), other = table_of_balls();
    const std::uint64_t live = hash(replay(technique, stream, one));
    EXPECT_EQ(hash(replay(technique, *read, other)), live);
    EXPECT_NE(live, before);
    for (std::size_t i = 0; i < one.targets().size(); ++i)
      EXPECT_EQ(one.targets()[i].world_from_target.matrix(), other.targets()[i].world_from_target.matrix());
    before = live;
    std::vector<TechniqueInput> changed = stream;
    std::size_t place = 100;
    while (!changed[place].hands[0].tracked) ++place;
    double& one_bit = changed[place].hands[0].room_from_hand.translation().x();
    one_bit = std::nextafter(one_bit, 10.0);
    TechniqueScene third = table_of_balls();
    EXPECT_NE(hash(replay(technique, changed, third)), live);
  }
}

TEST(Technique, StreamsThatWereDamagedAreRefused) {
  const std::string good = stream_to_text(lively_session(1, 3));
  ASSERT_TRUE(stream_from_text(good));
  const auto empty = stream_from_text(stream_to_text({}));
  ASSERT_TRUE(empty);
  EXPECT_TRUE(empty->empty());
  const auto refused = [](const std::string& text, const std::string& saying) {
    const auto read = stream_from_text(text);
    ASSERT_FALSE(read) << text;
    EXPECT_NE(read.error().message.find(saying), std::string::npos) << read.error().message;
  };
  refused("", "line 1");
  refused("something else\n", "line 1");
  refused(good.substr(0, good.size() - 1), "line 4: it is cut off");
  refused(good + "\n", "line 5");
  refused(good + "1 2 3\n", "line 5");
  std::string damaged = good;
  damaged.replace(damaged.find("\n") + 1, 1, "x");
  refused(damaged, "line 2");
  std::string endless = good;
  endless.insert(endless.find("\n") + 1, "inf ");
  refused(endless, "line 2");
  for (std::size_t cut = 0; cut < good.size(); cut += 7) {
    const auto read = stream_from_text(std::string_view(good).substr(0, cut));
    if (read) {
      EXPECT_EQ(good[cut - 1], '\n');
    }
  }
}

TEST(Technique, InputThatMakesNoSenseIsLeftAlone) {
  const double nan = std::nan(""), huge = std::numeric_limits<double>::infinity();
  std::vector<TechniqueInput> bad(7, person_with(pose_at({0.2, 1.3, -0.4}), 2.0));
  bad[0].time = nan;
  bad[1].time = 0.5;  // before the last
  bad[2].hands[0].room_from_hand.translation().x() = huge;
  bad[3].room_from_head.linear().setZero();
  bad[4].hands[0].room_from_hand.linear() = -base::Matrix3::Identity();
  bad[5].hands[0].reel = nan;
  bad[6].room_from_head.translation().y() = 1e300;
  const TechniqueScene scene = table_of_balls();
  for (const Holding holding : kAllHolding) {
    Technique technique;
    technique.holding = holding;
    technique.selecting = Selecting::Spotlight;
    TechniqueInput good = person_with(pose_at({0.0, 1.3, 0.4}), 1.0);
    good.hands[0].grab = true;
    const TechniqueStep start = step(technique, begun(technique), good, scene);
    ASSERT_NE(start.outcome.selected, 0u);
    for (std::size_t i = 0; i < bad.size(); ++i) {
      const TechniqueStep after = step(technique, start.state, bad[i], scene);
      EXPECT_TRUE(after.outcome.ignored) << i;
      EXPECT_FALSE(after.outcome.moved);
      EXPECT_EQ(after.state.world_from_room.matrix(), start.state.world_from_room.matrix());
      EXPECT_EQ(after.outcome.selected, start.outcome.selected);
    }
    // A hand that is not tracked may say anything.
    good.time = 3.0;
    good.hands[1].room_from_hand.matrix().setConstant(nan);
    EXPECT_FALSE(step(technique, start.state, good, scene).outcome.ignored);
  }
}

TEST(Technique, SizesThatCannotBeAreTold) {
  EXPECT_TRUE(check(Technique()));
  Technique technique;
  technique.selecting_settings.spotlight = 2.0;
  ASSERT_FALSE(check(technique));
  EXPECT_NE(check(technique).error().message.find("spotlight"), std::string::npos);
  technique = {};
  technique.holding_settings.farthest = std::nan("");
  EXPECT_FALSE(check(technique));
}

}  // namespace
}  // namespace icome::interaction
