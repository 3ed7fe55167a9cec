#include "animation/motion/relations.h"

#include <gtest/gtest.h>

#include <array>

#include "animation/motion/cell_point.h"
#include "animation/motion/scenes.h"
#include "repeats.h"

namespace icome::animation {
namespace {

using namespace scenes;

constexpr std::span<const CellId> kNobody;

Project pair_of(double least, double greatest) {
  Project project = project_of(2);
  cell_of(project, 1).rest.place = {100, 0};
  constrain(project, DistanceLimit{id_of(0), id_of(1), {0, 0}, {0, 0}, least, greatest});
  return project;
}

/// States by keys alone, before constraints.
CellStates keyed(const Project& project) {
  CellStates states;
  for (const Cell& cell : project.layers[0].cells) states[cell.id] = state_at(cell, 0);
  return states;
}

TEST(Relations, LetBothEndsOfADistanceGiveHalf) {
  const Project project = pair_of(0, 60);
  const Solution solution = solved(project, keyed(project), kNobody);
  EXPECT_LT((solution.states.at(id_of(0)).place - Vector2(20, 0)).norm(), 1e-6);
  EXPECT_LT((solution.states.at(id_of(1)).place - Vector2(80, 0)).norm(), 1e-6);
  EXPECT_LT(solution.residual, 1e-6);
  const std::array both = {id_of(0), id_of(1)};
  CellStates wished;
  wished[id_of(0)].place = {0, 0};
  wished[id_of(1)].place = {100, 0};
  EXPECT_LT((solved(project, wished, both).states.at(id_of(1)).place - Vector2(80, 0)).norm(), 1e-6);
}

TEST(Relations, LetTheFreeEndGiveWayToTheHeldOne) {
  for (const auto& [least, greatest, x] : {std::array{0.0, 60.0, 60.0}, std::array{150.0, 200.0, 150.0}}) {
    const Project project = pair_of(least, greatest);
    const Solution solution = solved(project, keyed(project), std::array{id_of(0)});
    EXPECT_EQ(solution.states.at(id_of(0)).place, Vector2(0, 0));
    EXPECT_LT((solution.states.at(id_of(1)).place - Vector2(x, 0)).norm(), 1e-6);
  }
}

TEST(Relations, MakeAHeldCellGiveWayToWhatCannot) {
  // The other end cannot leave its axis, x = 100.
  Project project = pair_of(0, 60);
  constrain(project, AxisGuide{id_of(1), {0, 0}, {100, 0}, M_PI / 2});
  CellStates wished = keyed(project);
  wished[id_of(0)].place = {0, -30};
  const Solution solution = solved(project, wished, std::array{id_of(0)});
  EXPECT_LT(solution.residual, 1e-6);
  EXPECT_LT((solution.states.at(id_of(1)).place - Vector2(100, -30)).norm(), 0.5);
  EXPECT_LT((solution.states.at(id_of(0)).place - Vector2(40, -30)).norm(), 0.5);
}

TEST(Relations, PutACellOnItsAxis) {
  Project project = project_of(1);
  const double direction = M_PI / 6;  // up to the right
  constrain(project, AxisGuide{id_of(0), {5, 0}, {10, 20}, direction});
  CellStates wished = keyed(project);
  wished[id_of(0)].place = {200, 100};
  wished[id_of(0)].angle = 0.3;
  const CellStates states = solved(project, wished, std::array{id_of(0)}).states;
  EXPECT_LT(worst_violation(project, states), 1e-9);
  const Vector2 moved = states.at(id_of(0)).place - Vector2(200, 100);
  EXPECT_NEAR(moved.dot(Vector2(std::cos(direction), -std::sin(direction))), 0, 1e-9) << "straight to it";
  EXPECT_EQ(states.at(id_of(0)).angle, 0.3);
}

TEST(Relations, PutACellOnTheNearestPlaceOfItsPath) {
  base::Random random(5);
  for (int k = 0; k < repeats(500); ++k) {
    Project project = project_of(1);
    PathGuide guide{id_of(0), {random.uniform(-9, 9), 3}, {}, k % 2 == 0, false};
    for (int n = 0; n < 8; ++n) guide.way.emplace_back(random.uniform(0, 300), random.uniform(0, 300));
    constrain(project, guide);
    CellStates wished = keyed(project);
    wished[id_of(0)].place = {random.uniform(0, 300), random.uniform(0, 300)};
    wished[id_of(0)].angle = random.uniform(-3, 3);
    const CellStates states = solved(project, wished, std::array{id_of(0)}).states;
    EXPECT_LT(worst_violation(project, states), 1e-9);
    const Vector2 was = seen_at(cell_of(project, 0), wished.at(id_of(0)), guide.on_cell);
    EXPECT_NEAR((states.at(id_of(0)).place - wished.at(id_of(0)).place).norm(),
                distance_from(guide.way, guide.closed, was), 1e-9);
  }
}

TEST(Relations, KeepACellOnItsBranchOfAPath) {
  Project project = project_of(1);
  constrain(project, PathGuide{id_of(0), {0, 0}, {{0, 0}, {300, 0}, {300, 20}, {0, 20}}, false, false});
  CellStates states = keyed(project);
  // The hand goes along between the branches, ever nearer to the one that the cell is not on; round the end
  // it comes.
  for (int k = 0; k <= 600; ++k) {
    const CellStates before = states;
    states[id_of(0)].place = {k / 2.0 + 5, 19};
    states = solved(project, states, std::array{id_of(0)}, &before).states;
    EXPECT_LT(largest_step(before, states), 25) << k;
    if (k < 550) {
      EXPECT_NEAR(states.at(id_of(0)).place.y(), 0, 1e-6) << k;
    }
  }
  EXPECT_GT(states.at(id_of(0)).place.y(), 15);
}

TEST(Relations, TurnACellAlongItsPathAboutTheGuidedPoint) {
  Project project = project_of(1);
  constrain(project, PathGuide{id_of(0), {30, 0}, {{0, 0}, {200, 0}, {200, -200}}, false, true});
  CellStates wished = keyed(project);
  wished[id_of(0)].place = {70, 5};
  CellStates states = solved(project, wished, kNobody).states;
  EXPECT_NEAR(states.at(id_of(0)).angle, 0, 1e-9);
  EXPECT_LT((states.at(id_of(0)).place - Vector2(70, 0)).norm(), 1e-9);
  for (int k = 0; k < 300; ++k) {
    const CellStates before = states;
    const Vector2 along = k < 100 ? Vector2(1, 0) : Vector2(0, -1);
    states[id_of(0)].place += along;
    states = solved(project, states, std::array{id_of(0)}, &before).states;
    EXPECT_LT(std::abs(states.at(id_of(0)).angle - before.at(id_of(0)).angle), 0.25) << k;
    EXPECT_LT(largest_step(before, states), 5) << k;
  }
  EXPECT_NEAR(states.at(id_of(0)).angle, M_PI / 2, 1e-9);
  EXPECT_NEAR(states.at(id_of(0)).place.x(), 200, 1e-9);
  EXPECT_EQ(solved(project, states, kNobody, &states).states, states) << "what is kept stays";
}

TEST(Relations, TurnALimbRatherThanMoveWhatItHangsOn) {
  // A limb's end is tied to a ball, which is taken away: the limb turns towards it.
  Project project = limb({0, 100}, false);
  for (int k = 0; k < 8; ++k) {  // a heavy body
    project.layers[0].cells.push_back(cell(std::uint64_t(k) + 10));
    constrain(project, Joint{id_of(0), CellId{std::uint64_t(k) + 10}, {0, 0}, {0, 0}, {}});
  }
  project.layers[0].cells.push_back(cell(50, {110, 0}));
  constrain(project, DistanceLimit{id_of(1), CellId{50}, {100, 0}, {0, 0}, 0, 20});
  CellStates states = keyed(project);
  for (int k = 0; k < 100; ++k) {
    const CellStates before = states;
    states[CellId{50}].place = {110 - 0.2 * k, -0.8 * k};
    const Solution solution = solved(project, states, std::array{CellId{50}}, &before);
    EXPECT_LT(solution.residual, 1e-6);
    states = solution.states;
  }
  EXPECT_GT(states.at(id_of(1)).angle, 0.4);
  EXPECT_LT(states.at(id_of(0)).place.norm(), 10);
}

TEST(Relations, EndInACompromiseWhereTheyContradict) {
  Project project = pair_of(0, 50);
  constrain(project, DistanceLimit{id_of(0), id_of(1), {0, 0}, {0, 0}, 80, 90});
  const Solution solution = solved(project, keyed(project), kNobody);
  EXPECT_TRUE(is_finite(solution.states));
  EXPECT_NEAR(solution.residual, 15, 0.1) << "half of the 30 px between 50 and 80";
  EXPECT_NEAR(solution.residual, worst_violation(project, solution.states), 1e-9);
}

TEST(Relations, SeparateCellsThatCoincide) {
  Project project = project_of(2);
  constrain(project, DistanceLimit{id_of(0), id_of(1), {0, 0}, {0, 0}, 30, 40});
  const Solution solution = solved(project, keyed(project), kNobody);
  EXPECT_LT(solution.residual, 1e-6);
  EXPECT_LT(worst_violation(project, solution.states), 1e-6);
}

}  // namespace
}  // namespace icome::animation
