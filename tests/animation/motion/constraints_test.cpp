#include "animation/motion/constraints.h"

#include <gtest/gtest.h>

#include "animation/motion/cell_point.h"
#include "animation/motion/scenes.h"

namespace icome::animation {
namespace {

using namespace scenes;

constexpr double kQuarter = M_PI / 2;

CellStates at_rest(const Project& project) { return states_at(project, 0); }

TEST(Constraints, TellWhereAPointOfACellIs) {
  Cell wheel = cell(2, {100, 50}, kQuarter);
  wheel.pivot = {10, 0};
  wheel.rest.scale = 2;
  // 5 px to the right of the pivot, a quarter turned counter-clockwise: 10 px up.
  EXPECT_LT((on_stage(wheel, wheel.rest, {15, 0}) - Vector2(100, 40)).norm(), 1e-12);
  EXPECT_LT((seen_at(wheel, wheel.rest, {15, 0}) - Vector2(100, 40)).norm(), 1e-12);
  EXPECT_LT((on_cell(wheel, wheel.rest, {100, 40}) - Vector2(15, 0)).norm(), 1e-12);
}

TEST(Constraints, LeaveAProjectWithoutThemAlone) {
  const Project project = project_of(3);
  CellStates states = at_rest(project);
  states[id_of(1)].place = {7, 8};
  EXPECT_EQ(solved(project, states, std::span<const CellId>()).states, states);
}

TEST(Constraints, KeepAChildsPinAtItsParents) {
  Project project = project_of(2);
  constrain(project, Joint{id_of(0), id_of(1), {30, 10}, {-5, 2}, {}});
  CellStates states = at_rest(project);
  states[id_of(0)].angle = 0.7;
  states[id_of(1)].angle = -1.1;
  const Solution solution = solved(project, states, std::span<const CellId>());
  EXPECT_LT(worst_violation(project, solution.states), 1e-12);
  EXPECT_EQ(solution.states.at(id_of(0)), states.at(id_of(0)));
  EXPECT_NEAR(solution.states.at(id_of(1)).angle, -1.1, 1e-12);
}

TEST(Constraints, TurnAHeldChildWithinItsLimitsAndTakeAlongWhatHangsOnIt) {
  Project project = limb({100, 80, 60}, false);
  std::get<Joint>(project.constraints[0].what).limits = AngleLimits{-0.5, 1.0};
  const CellStates before = at_rest(project);
  CellStates wished = before;
  wished[id_of(1)].angle = 2.0;
  wished[id_of(1)].place += Vector2(40, 40);
  const Solution solution = solved(project, wished, std::array{id_of(1)}, &before);
  EXPECT_NEAR(solution.states.at(id_of(1)).angle, 1.0, 1e-12);
  EXPECT_NEAR(solution.states.at(id_of(2)).angle, 1.0, 1e-12) << "comes along";
  EXPECT_LT(worst_violation(project, solution.states), 1e-9);
  EXPECT_EQ(solution.states.at(id_of(0)), before.at(id_of(0)));
}

TEST(Constraints, TurnAPulledChildTowardsTheHand) {
  const Project project = limb({100, 80}, false);
  const CellStates before = at_rest(project);
  CellState wish = before.at(id_of(1));
  wish.place += Vector2(-8, -24);  // the point at 140 goes to (132, -24)
  const Hold hold = {id_of(1), wish, Vector2(40, 0)};
  const Solution solution = solved(project, before, std::span(&hold, 1), &before);
  EXPECT_NEAR(solution.states.at(id_of(1)).angle, std::atan2(24, 32), 1e-9);
  EXPECT_LT(worst_violation(project, solution.states), 1e-9);
}

/// The two poses of a limb of two bones whose end is at a target, by the law of cosines.
double elbow_turn(double one, double other, double distance) {
  return M_PI - std::acos((one * one + other * other - distance * distance) / (2 * one * other));
}

TEST(Constraints, BendALimbOfTwoBonesAsTheLawOfCosinesSays) {
  const Project project = limb({10, 100, 80}, true);
  base::Random random(1);
  for (int k = 0; k < 500; ++k) {
    const double distance = random.uniform(30, 178), direction = random.uniform(-M_PI, M_PI);
    const Vector2 target(10 + distance * std::cos(direction), -distance * std::sin(direction));
    const CellStates before = at_rest(project);
    CellState wish = before.at(id_of(2));
    wish.place += target - Vector2(190, 0);
    const Hold hold = {id_of(2), wish, Vector2(80, 0)};
    const Solution solution = solved(project, before, std::span(&hold, 1), nullptr);
    const CellStates& states = solution.states;
    EXPECT_LT(
        (seen_at(cell_of(const_cast<Project&>(project), 2), states.at(id_of(2)), {80, 0}) - target).norm(),
        1e-8);
    EXPECT_NEAR(std::abs(std::remainder(states.at(id_of(2)).angle - states.at(id_of(1)).angle, 2 * M_PI)),
                elbow_turn(100, 80, distance), 1e-7);
    EXPECT_EQ(states.at(id_of(0)), before.at(id_of(0)));
    EXPECT_LT(worst_violation(project, states), 1e-9);
  }
}

TEST(Constraints, BendAChainFromItsFirstCell) {
  Project project = limb({100, 100, 100}, false);
  constrain(project, Chain{{id_of(0), id_of(1), id_of(2)}});
  const CellStates before = at_rest(project);
  const Vector2 target(120, -130);  // within 200 px, and not with a straight first cell
  CellState wish = before.at(id_of(2));
  wish.place = target;
  CellStates states = before;
  for (int k = 0; k < 40; ++k) {
    const Hold hold = {id_of(2), wish};
    const CellStates last = states;
    states = solved(project, last, std::span(&hold, 1), &last).states;
  }
  EXPECT_LT((states.at(id_of(2)).place - target).norm(), 0.5);
  EXPECT_GT(std::abs(states.at(id_of(0)).angle - before.at(id_of(0)).angle), 0.05);
  EXPECT_EQ(states.at(id_of(0)).place, before.at(id_of(0)).place);
}

}  // namespace
}  // namespace icome::animation
