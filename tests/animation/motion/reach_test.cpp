#include "animation/motion/reach.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>

#include "animation/motion/cell_point.h"
#include "animation/motion/scenes.h"
#include "repeats.h"

namespace icome::animation {
namespace {

using namespace scenes;

/// A hand that pulls at the end of a limb, frame by frame.
class Pull {
 public:
  Pull(Project project, double end) : project_(std::move(project)), end_(end, 0) {
    states_ = states_at(project_, 0);
    const auto& cells = project_.layers[0].cells;
    last_ = cells.back().id;
  }

  const CellStates& states() const { return states_; }
  Vector2 end() const { return seen_at(*project_.find(last_), states_.at(last_), end_); }
  double turn(int number) const {
    return states_.at(id_of(number)).angle - states_.at(id_of(number - 1)).angle;
  }

  /// px, that any cell's pivot or the end moved.
  double to(const Vector2& hand) {
    const CellStates before = states_;
    const Vector2 end_before = end();
    Hold hold = {last_, before.at(last_), end_};
    hold.wish.place += hand - end();
    states_ = solved(project_, before, std::span(&hold, 1), &before).states;
    EXPECT_TRUE(is_finite(states_));
    EXPECT_LT(worst_violation(project_, states_), 1e-9);
    return std::max(largest_step(before, states_), (end() - end_before).norm());
  }

 private:
  Project project_;
  Vector2 end_;
  CellId last_;
  CellStates states_;
};

/// A smooth random way of a hand about a point, `far` px wide.
struct Wander {
  explicit Wander(std::uint64_t seed) {
    base::Random random(seed);
    for (Vector2& wave : waves) wave = {random.uniform(0.3, 1), random.uniform(0, 6)};
  }
  Vector2 at(double time, double far) const {
    Vector2 place = Vector2::Zero();
    for (std::size_t k = 0; k < waves.size(); ++k)
      place[int(k % 2)] += far / 2 * std::sin(waves[k].x() * (k < 2 ? 1.0 : 2.3) * time + waves[k].y());
    return place;
  }
  std::array<Vector2, 4> waves;
};

void approach(Pull& pull, const Vector2& hand) {
  const Vector2 from = pull.end();
  for (int k = 1; k <= 300; ++k) pull.to(from + k / 300.0 * (hand - from));
  for (int k = 0; k < 20; ++k) pull.to(hand);
}

/// The largest step of a limb, in steps of the hand, which goes straight on.
double straight_gain(Pull& pull, const Vector2& from, const Vector2& to, double step) {
  approach(pull, from);
  const int steps = int(std::ceil((to - from).norm() / step));
  double largest = 0;
  for (int k = 1; k <= steps; ++k)
    largest = std::max(largest, pull.to(from + double(k) / steps * (to - from)));
  return largest / step;
}

const double kSteps3[] = {0.05, 0.5, 5.0};

TEST(Reach, GoesSmoothlyThroughFullReachAndBeyond) {
  for (const double step : kSteps3) {
    Pull pull(limb({0, 110, 90}, true), 90);
    EXPECT_LT(straight_gain(pull, {150, 0}, {320, 0}, step), 6);
    const double side = pull.turn(2);
    EXPECT_LT((pull.end() - Vector2(200, 0)).norm(), 0.1) << "nearly straight";
    EXPECT_LT(straight_gain(pull, {320, 0}, {120, 0}, step), 6);
    EXPECT_LT((pull.end() - Vector2(120, 0)).norm(), 1e-6);
    EXPECT_GT(side * pull.turn(2), 0) << "bends to the side that it was bent to";
    EXPECT_LT(straight_gain(pull, {150, -200}, {150, 200}, step), 4) << "in and out of reach across";
  }
}

TEST(Reach, IsWithTheHandExceptForTheLastHundredth) {
  Pull pull(limb({0, 110, 90}, true), 90);
  straight_gain(pull, {150, 0}, {198, 0}, 0.5);
  EXPECT_LT((pull.end() - Vector2(198, 0)).norm(), 1e-6);
  straight_gain(pull, {198, 0}, {200, 0}, 0.5);
  EXPECT_LT((pull.end() - Vector2(200, 0)).norm(), 1.0 + 1e-6) << "half a hundredth of 200";
}

TEST(Reach, DoesNotMoveWhenItIsTaken) {
  Pull pull(limb({0, 110, 90}, true), 90);  // quite straight, where a chain is never drawn to
  EXPECT_LT(pull.to({200, 0}), 1e-12);
  EXPECT_LT(pull.to({200.01, 0}), 0.07) << "nor jumps then";
}

TEST(Reach, PassesItsRoot) {
  for (const double step : kSteps3) {
    Pull equal(limb({0, 100, 100}, true), 100);
    EXPECT_LT(straight_gain(equal, {150, 0}, {-150, 0}, step), 2) << "folds and unfolds";
    EXPECT_LT((equal.end() - Vector2(-150, 0)).norm(), 1e-6);
    EXPECT_LT(straight_gain(equal, {150, 20}, {-150, 20}, step), 10);
    Pull unequal(limb({0, 110, 90}, true), 90);
    EXPECT_LT(straight_gain(unequal, {150, 20}, {-150, 20}, step), 10) << "cannot come nearer than 20";
    EXPECT_LT(straight_gain(unequal, {150, 0}, {-150, 0}, step) * step, 140) << "lags, then swings round";
    EXPECT_LT((unequal.end() - Vector2(-150, 0)).norm(), 1e-6);
  }
}

TEST(Reach, TurnsASingleCellRoundItsJointWithoutFlipping) {
  for (const double step : kSteps3) {
    Pull pull(limb({0, 200}, false), 200);
    EXPECT_LT(straight_gain(pull, {150, 2}, {-150, 2}, step) * step, 150) << "less than half a turn at once";
    for (int k = 0; k < 20; ++k) pull.to({-150, 2});
    EXPECT_LT((pull.end() - 200 * Vector2(-150, 2).normalized()).norm(), 1e-6);
  }
}

TEST(Reach, StopsAtItsLimits) {
  Project project = limb({0, 200}, false);
  std::get<Joint>(project.constraints[0].what).limits = AngleLimits{-0.5, 0.5};
  Pull pull(project, 200);
  double last = 0;
  for (int k = 0; k <= 628; ++k) {
    const double direction = k * 0.01;
    const double step = pull.to(Vector2(150 * std::cos(direction), -150 * std::sin(direction)));
    EXPECT_LT(step, 150) << direction;
    last = pull.turn(1);
    if (direction < 3) {
      EXPECT_NEAR(last, std::min(direction, 0.5), 1e-9);
    }
  }
  EXPECT_NEAR(last, -0.0032, 1e-3) << "once round, and the hand is where it was";
}

TEST(Reach, FollowsAWanderingHand) {
  // Ways that keep off the root, at which any chain turns fast, by a quarter of the reach.
  for (int seed = 0; seed < repeats(12); ++seed) {
    const Project limbs[] = {limb({0, 100, 100}, true), limb({0, 110, 90}, true),
                             limb({0, 50, 40, 40, 40, 30}, true)};
    const double ends[] = {100, 90, 30};
    for (int which = 0; which < 3; ++which) {
      Pull pull(limbs[which], ends[which]);
      const Wander wander{std::uint64_t(seed)};
      const auto hand_at = [&](int frame) {
        const Vector2 way = wander.at(frame * 0.002, 300);
        return Vector2(way + 50 * way.normalized());
      };
      approach(pull, hand_at(0));
      for (int k = 1; k < 4000; ++k) {
        const double hand = (hand_at(k) - hand_at(k - 1)).norm();
        if (hand > 2) {  // it jumped over the root
          approach(pull, hand_at(k));
          continue;
        }
        const double moved = pull.to(hand_at(k));
        const double distance = hand_at(k).norm();
        ASSERT_LT(moved, 9 * hand + 0.2)
            << "seed " << seed << " limb " << which << " frame " << k << " at " << distance;
        if (distance < 196 && distance > 55) {
          ASSERT_LT((pull.end() - hand_at(k)).norm(), 1.5)
              << "seed " << seed << " limb " << which << " frame " << k;
        }
      }
    }
  }
}

}  // namespace
}  // namespace icome::animation
