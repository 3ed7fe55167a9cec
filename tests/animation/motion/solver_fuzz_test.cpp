// Thousands of random projects: sensible ones whose constraints are measured, and absurd ones that must end.
#include <gtest/gtest.h>

#include "animation/motion/constraints.h"
#include "animation/motion/scenes.h"
#include "repeats.h"

namespace icome::animation {
namespace {

using namespace scenes;

struct Scene {
  Project project;
  CellStates wished;
  std::vector<CellId> held;
};

double absurd(base::Random& random) {
  switch (random.index(8)) {
    case 0:
      return 0;
    case 1:
      return random.uniform(-1e6, 1e6);
    case 2:
      return random.uniform(-1e-12, 1e-12);
    case 3:
      return double(random.index(3)) * 100 - 100;
    default:
      return random.uniform(-300, 300);
  }
}

/// Any constraints on any cells: rings of joints, contradictions, places that are one, scales of 0.
Scene absurd_scene(std::uint64_t seed) {
  base::Random random(seed);
  const int count = 1 + int(random.index(8));
  Scene scene{project_of(count), {}, {}};
  const auto any = [&] {
    return id_of(int(random.index(std::uint64_t(count) + 1)));
  };  // or one that is not there
  const auto point = [&] { return Vector2(absurd(random), absurd(random)); };
  for (int k = 0; k < count; ++k) {
    CellState& state = scene.wished[id_of(k)];
    state.place = point();
    state.angle = absurd(random) / 50;
    state.scale = random.index(4) == 0 ? 0 : random.uniform(-2, 3);
    cell_of(scene.project, k).pivot = point();
    if (random.index(3) == 0) scene.held.push_back(id_of(k));
  }
  for (std::uint64_t k = random.index(12); k > 0; --k) {
    switch (random.index(5)) {
      case 0:
        constrain(scene.project,
                  DistanceLimit{any(), any(), point(), point(), absurd(random), absurd(random)});
        break;
      case 1: {
        Joint joint{any(), any(), point(), point(), {}};
        if (random.index(2)) joint.limits = AngleLimits{absurd(random) / 100, absurd(random) / 100};
        constrain(scene.project, joint);
        break;
      }
      case 2: {
        Chain chain;
        for (const Constraint& constraint : scene.project.constraints)
          if (const auto* joint = std::get_if<Joint>(&constraint.what))
            if (chain.cells.empty() || chain.cells.back() == joint->parent) {
              if (chain.cells.empty()) chain.cells.push_back(joint->parent);
              chain.cells.push_back(joint->child);
            }
        if (random.index(4) == 0) chain.cells.push_back(any());
        constrain(scene.project, chain);
        break;
      }
      case 3: {
        PathGuide guide{any(), point(), {}, random.index(2) == 0, random.index(2) == 0};
        for (std::uint64_t n = random.index(7); n > 0; --n) guide.way.push_back(point());
        constrain(scene.project, guide);
        break;
      }
      default:
        constrain(scene.project, AxisGuide{any(), point(), point(), absurd(random)});
    }
  }
  return scene;
}

class Absurd : public testing::TestWithParam<int> {};

TEST_P(Absurd, ProjectsEndInFiniteStatesTheSameEachTime) {
  for (int k = 0; k < repeats(2000); ++k) {
    const auto seed = std::uint64_t(GetParam()) * 100000 + std::uint64_t(k);
    const Scene scene = absurd_scene(seed);
    const Solution first = solved(scene.project, scene.wished, scene.held);
    ASSERT_TRUE(is_finite(first.states)) << seed;
    ASSERT_TRUE(std::isfinite(first.residual)) << seed;
    ASSERT_EQ(first.states, solved(scene.project, scene.wished, scene.held).states) << seed;
    const Solution next = solved(scene.project, scene.wished, scene.held, &first.states);
    ASSERT_TRUE(is_finite(next.states)) << seed;
    std::vector<Hold> holds;
    for (const CellId id : scene.held) holds.push_back({id, scene.wished.at(id), Vector2(3, 4)});
    ASSERT_TRUE(is_finite(solved(scene.project, first.states, holds, &first.states).states)) << seed;
    ASSERT_TRUE(is_finite(states_at(scene.project, 3.5))) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Parts, Absurd, testing::Range(0, 4));

/// Cells with joints, distances that leave some play, paths and axes through where cells are: all can be
/// kept.
Scene sensible_scene(std::uint64_t seed) {
  base::Random random(seed);
  const int count = 3 + int(random.index(8));
  Scene scene{project_of(count), {}, {}};
  const auto on_cell = [&] { return Vector2(random.uniform(-30, 30), random.uniform(-30, 30)); };
  Project& project = scene.project;
  for (int k = 0; k < count; ++k) {
    cell_of(project, k).rest.place = {random.uniform(0, 600), random.uniform(0, 400)};
    cell_of(project, k).rest.angle = random.uniform(-1, 1);
    cell_of(project, k).rest.scale = random.uniform(0.5, 1.5);
    if (k > 0 && random.index(3) > 0) {
      constrain(project, Joint{id_of(int(random.index(std::uint64_t(k)))), id_of(k), on_cell(), on_cell(),
                               AngleLimits{-2.5, 2.5}});
    }
  }
  scene.wished = states_at(project, 0);
  const auto where = [&](CellId id, const Vector2& point) {
    return seen_at(*project.find(id), scene.wished.at(id), point);
  };
  const auto any = [&] { return id_of(int(random.index(std::uint64_t(count)))); };
  for (int k = 0; k < count / 3; ++k) {
    DistanceLimit limit{any(), any(), on_cell(), on_cell(), 0, 0};
    const double now = (where(limit.one, limit.on_one) - where(limit.other, limit.on_other)).norm();
    limit.least = 0.8 * now;
    limit.greatest = 1.2 * now;
    if (limit.one != limit.other) constrain(project, limit);
  }
  PathGuide guide{any(), on_cell(), {}, false, random.index(2) == 0};
  const Vector2 through = where(guide.cell, guide.on_cell);
  for (int k = -3; k <= 3; ++k) guide.way.push_back(through + Vector2(40.0 * k, 10 * std::sin(k)));
  constrain(project, guide);
  scene.held.push_back(any());
  return scene;
}

TEST(SolverFuzz, KeepsAllThatCanBeKeptUnderAHand) {
  int frames = 0, unkept = 0;
  for (int k = 0; k < repeats(300); ++k) {
    Scene scene = sensible_scene(std::uint64_t(k));
    const Solution first = solved(scene.project, scene.wished, std::span<const CellId>());
    if (first.residual > 1e-6) continue;  // a path that turns its cell may take along what cannot follow
    CellStates states = first.states;
    base::Random random(std::uint64_t(k) + 5000);
    Vector2 speed = Vector2::Zero();
    for (int frame = 0; frame < 60; ++frame) {
      speed = 0.9 * speed + Vector2(random.uniform(-1, 1), random.uniform(-1, 1));
      CellStates wished = states;
      wished[scene.held[0]].place += speed;
      wished[scene.held[0]].angle += random.uniform(-0.03, 0.03);
      const Solution solution = solved(scene.project, wished, scene.held, &states);
      const double violation = worst_violation(scene.project, solution.states);
      EXPECT_NEAR(violation, solution.residual, 1e-6) << "seed " << k << " frame " << frame;
      ++frames;
      if (violation > 1e-6) ++unkept;
      EXPECT_LT(largest_step(states, solution.states), 60) << "seed " << k << " frame " << frame;
      states = solution.states;
    }
  }
  EXPECT_GT(frames, repeats(300) * 40);
  EXPECT_LT(unkept, frames / 200);
}

}  // namespace
}  // namespace icome::animation
