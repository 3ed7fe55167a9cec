#include "interaction/techniques/bench/technique_bench.h"

#include <cmath>

#include "interaction/techniques/technique_cases.h"

namespace icome::interaction {
namespace {

TEST(FittsFigures, AreThoseOfAHandCalculation) {
  EXPECT_DOUBLE_EQ(index_of_difficulty(0.7, 0.1), 3.0);
  // Along x; errors of -2, 0 and 2 mm on ways of 100 mm; what is off to the side does not count.
  std::vector<FittsTrial> trials(3);
  for (int i = 0; i < 3; ++i) {
    trials[std::size_t(i)].target = Vector3(0.1, 0.0, 0.0);
    trials[std::size_t(i)].endpoint = Vector3(0.1 + 0.002 * (i - 1), 0.003 * i, 0.0);
    trials[std::size_t(i)].time = 0.5 + 0.1 * i;
  }
  const auto figures = effective_figures(trials);
  ASSERT_TRUE(figures);
  EXPECT_NEAR(figures->width, 4.133 * 0.002, 1e-15);
  EXPECT_NEAR(figures->amplitude, 0.1, 1e-15);
  EXPECT_NEAR(figures->throughput, std::log2(0.1 / 0.008266 + 1.0) / 0.6, 1e-12);
  trials[2].endpoint = trials[1].endpoint = trials[0].endpoint;
  EXPECT_FALSE(effective_figures(trials));  // no width
  EXPECT_FALSE(effective_figures({}));
}

TEST(FittsFigures, ALineIsFitted) {
  // y = 0.2 + 0.15 x.
  const std::vector<base::Vector2> exact = {{2.0, 0.5}, {3.0, 0.65}, {5.0, 0.95}};
  const auto line = fitted_line(exact);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->intercept, 0.2, 1e-12);
  EXPECT_NEAR(line->slope, 0.15, 1e-12);
  EXPECT_NEAR(line->r_squared, 1.0, 1e-12);
  // Anscombe's first data set: 3.0 + 0.5 x with r^2 = 0.67.
  const double x[] = {10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5};
  const double y[] = {8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68};
  std::vector<base::Vector2> anscombe;
  for (int i = 0; i < 11; ++i) anscombe.emplace_back(x[i], y[i]);
  const auto fitted = fitted_line(anscombe);
  ASSERT_TRUE(fitted);
  EXPECT_NEAR(fitted->intercept, 3.0000909, 1e-6);
  EXPECT_NEAR(fitted->slope, 0.5000909, 1e-6);
  EXPECT_NEAR(fitted->r_squared, 0.6665425, 1e-6);
  EXPECT_FALSE(fitted_line(std::vector<base::Vector2>{{1.0, 2.0}, {1.0, 3.0}}));
}

TEST(SimulatedPerson, DrawsNumbersOfTheNormalDistribution) {
  base::Random random(3);
  std::vector<double> numbers(100000);
  int within = 0;
  for (double& number : numbers) {
    number = normal_number(random);
    within += std::abs(number) < 1.0 ? 1 : 0;
  }
  const MeanAndDeviation figures = mean_and_deviation(numbers);
  EXPECT_NEAR(figures.mean, 0.0, 0.015);
  EXPECT_NEAR(figures.deviation, 1.0, 0.01);
  EXPECT_NEAR(within / 100000.0, 0.682689, 0.006);
}

TEST(SimulatedPerson, MovesWithMinimumJerk) {
  EXPECT_EQ(minimum_jerk(-1.0), 0.0);
  EXPECT_EQ(minimum_jerk(2.0), 1.0);
  EXPECT_DOUBLE_EQ(minimum_jerk(0.5), 0.5);
  constexpr double kStep = 1e-4;
  double peak = 0.0;
  for (double s = kStep; s < 1.0 - kStep; s += kStep)
    peak = std::max(
        peak, (minimum_jerk(s + kStep) - 2.0 * minimum_jerk(s) + minimum_jerk(s - kStep)) / (kStep * kStep));
  EXPECT_NEAR(peak, 10.0 / std::sqrt(3.0), 1e-3);
  EXPECT_NEAR((minimum_jerk(0.5 + kStep) - minimum_jerk(0.5 - kStep)) / (2.0 * kStep), 1.875, 1e-6);
  const PersonModel person;
  const double duration = shortest_duration(person.arm, person, 0.6);
  EXPECT_NEAR(peak * 0.6 / (duration * duration), person.arm.acceleration, 0.01);
}

TEST(SimulatedPerson, TakesMoreTimeForSmallerAndFartherTargets) {
  PersonModel person;
  person.correction = 2.0;  // to correct is dear, so it pays to be slow
  double last = 0.0;
  for (const double tolerance : {0.1, 0.05, 0.02, 0.01}) {
    const double duration = planned_duration(person.arm, person, 0.5, tolerance);
    EXPECT_GE(duration, last);
    last = duration;
  }
  EXPECT_GT(last, 1.5 * planned_duration(person.arm, person, 0.5, 0.1));
  EXPECT_LT(planned_duration(person.arm, PersonModel(), 0.5, 0.02),
            planned_duration(person.arm, person, 0.5, 0.02));
  EXPECT_GT(planned_duration(person.arm, person, 0.5, 0.02), planned_duration(person.arm, person, 0.1, 0.02));
  for (const double amplitude : {0.0, 1e-9, 1e3})
    EXPECT_GE(planned_duration(person.arm, person, amplitude, 1e-9), person.shortest);
}

TEST(FittsLayout, IsARingWithoutHiddenTargets) {
  for (const FittsCondition& condition :
       {FittsCondition{0.03, 0.45, 10}, FittsCondition{0.1, 0.45, 4}, FittsCondition{0.06, 4.0, 10}}) {
    base::Random random(5), again(5);
    const Vector3 eyes = Aiming::eyes(), hand = Aiming::pointing_hand();
    const FittsLayout layout = fitts_layout(condition, eyes, hand, random);
    EXPECT_EQ(layout.order.size(), std::size_t(kRingTargets));
    EXPECT_GT(layout.scene.targets().size(), std::size_t(kRingTargets));
    for (std::size_t i = 0; i < layout.order.size(); ++i) {
      const TargetBall from = ball_of(*layout.scene.find(layout.order[i]));
      const TargetBall to = ball_of(*layout.scene.find(layout.order[(i + 1) % layout.order.size()]));
      EXPECT_GT((to.centre - from.centre).norm(), 0.95 * kRingShare * condition.distance);  // across the ring
      EXPECT_DOUBLE_EQ(to.radius, 0.5 * condition.size);
      EXPECT_EQ(layout.scene.first_hit({eyes, (to.centre - eyes).normalized()})->id,
                layout.order[(i + 1) % layout.order.size()]);
    }
    const FittsLayout same = fitts_layout(condition, eyes, hand, again);
    ASSERT_EQ(same.scene.targets().size(), layout.scene.targets().size());
    for (std::size_t i = 0; i < same.scene.targets().size(); ++i)
      EXPECT_EQ(same.scene.ball(i).centre, layout.scene.ball(i).centre);
  }
}

TEST(Aiming, FindsWhatSelectsAndByHowMuchItMayBeOff) {
  const TechniqueScene scene = scene_of({ball_target(1, Vector3(0.1, 1.5, -0.5), 0.03)});
  const PersonModel person;
  for (const Selecting selecting : kAllSelecting) {
    Technique technique;
    technique.selecting = selecting;
    const Aiming aiming(technique, person);
    const auto goal = aiming.goal_for(scene, 1);
    ASSERT_TRUE(goal) << name_of(selecting);
    EXPECT_TRUE(
        aiming.reached(scene, goal->control, Vector3(0.1, 1.5, -0.5)).isApprox(Vector3(0.1, 1.5, -0.5), 1e-9))
        << name_of(selecting);
    if (selecting == Selecting::VirtualHand) {
      EXPECT_NEAR(goal->tolerance, 0.03 + technique.selecting_settings.hand_radius, 5e-4);
    }
    if (selecting == Selecting::RayPointer) {
      const double distance = (Vector3(0.1, 1.5, -0.5) - Aiming::pointing_hand()).norm();
      EXPECT_NEAR(goal->tolerance, std::asin(0.03 / distance), 0.02 * 0.03 / distance);
    }
  }
  Technique hand;
  hand.selecting = Selecting::VirtualHand;
  const TechniqueScene far = scene_of({ball_target(1, Vector3(0.1, 1.5, -2.0), 0.03)});
  EXPECT_FALSE(Aiming(hand, person).goal_for(far, 1));
}

/// People without noise, whose movements take a + b ID.
BenchSettings noiseless() {
  BenchSettings settings;
  settings.users = 2;
  settings.trials = 9;
  settings.distances = {0.4, 0.45};
  settings.sizes = {0.02, 0.04, 0.06};
  settings.distractors = {0};
  PersonModel& person = settings.person;
  for (LimbModel* limb : {&person.arm, &person.wrist, &person.head}) *limb = {0.0, 1e9, 0.0, 0.0};
  person.stereo_acuity = 0.0;
  person.spread = 0.0;
  person.known = KnownDuration{0.05, 0.12};
  return settings;
}

TEST(TechniqueBench, RecoversAKnownLaw) {
  const BenchSettings settings = noiseless();
  const auto result = run_bench(settings);
  ASSERT_TRUE(result) << result.error().message;
  for (const TechniqueResult& technique : result->techniques) {
    EXPECT_EQ(technique.error_rate, 0.0);
    EXPECT_EQ(technique.reached, 6u);
    if (technique.selecting != Selecting::VirtualHand) continue;
    // The tolerance of the hand is that of the target and its own size.
    std::vector<base::Vector2> points;
    for (const ConditionResult& it : technique.conditions) {
      const double width = it.condition.size + 2.0 * SelectingSettings().hand_radius;
      const double amplitude = it.condition.size * (std::exp2(it.id) - 1.0);
      points.emplace_back(std::log2(amplitude / width + 1.0), it.time.mean);
      EXPECT_EQ(it.movements, 1.0);
      EXPECT_FALSE(it.throughput);  // all end in the same place
    }
    const auto line = fitted_line(points);
    ASSERT_TRUE(line);
    const PersonModel& person = settings.person;
    EXPECT_NEAR(line->intercept, 0.05 + person.reaction + person.correction + person.press, 0.01);
    EXPECT_NEAR(line->slope, 0.12, 0.003);
    EXPECT_GT(line->r_squared, 0.999);
  }
}

BenchSettings short_bench() {
  BenchSettings settings;
  settings.users = 3;
  settings.trials = 9;
  settings.sizes = {0.03, 0.1};
  settings.distances = {0.45, 4.0};
  settings.distractors = {0, 6};
  return settings;
}

bool same_bits(const TechniqueResult& a, const TechniqueResult& b) {
  bool same = a.selecting == b.selecting && a.time.mean == b.time.mean && a.error_rate == b.error_rate &&
              a.throughput == b.throughput && a.score == b.score && a.reached == b.reached;
  for (std::size_t i = 0; same && i < a.conditions.size(); ++i)
    same = a.conditions[i].time.deviation == b.conditions[i].time.deviation &&
           a.conditions[i].throughput == b.conditions[i].throughput;
  return same;
}

TEST(TechniqueBench, IsTheSameEveryTimeAndAnotherForAnotherSeed) {
  BenchSettings settings = short_bench();
  const auto one = run_bench(settings), other = run_bench(settings);
  ASSERT_TRUE(one && other);
  ASSERT_EQ(one->techniques.size(), kAllSelecting.size());
  for (std::size_t i = 0; i < kAllSelecting.size(); ++i)
    EXPECT_TRUE(same_bits(one->techniques[i], other->techniques[i]));
  settings.seed = 2;
  EXPECT_NE(run_bench(settings)->techniques[0].time.mean, one->techniques[0].time.mean);
}

TEST(TechniqueBench, ShowsWhatTheTechniquesAreKnownFor) {
  const auto result = run_bench(short_bench());
  ASSERT_TRUE(result);
  std::array<const TechniqueResult*, kAllSelecting.size()> by{};
  for (const TechniqueResult& it : result->techniques) by[std::size_t(it.selecting)] = &it;
  const auto of = [&](Selecting selecting) { return *by[std::size_t(selecting)]; };
  // An arm is too short for 4 m, and Go-Go's too; pointing and the miniature get everywhere.
  EXPECT_EQ(of(Selecting::VirtualHand).reached, 4u);
  EXPECT_EQ(of(Selecting::GoGo).reached, 4u);
  EXPECT_EQ(of(Selecting::RayPointer).reached, 8u);
  EXPECT_EQ(of(Selecting::Miniature).reached, 8u);
  // Far away and small: the spotlight was made for what a ray hardly hits.
  const auto far_small = [&](Selecting selecting) {
    for (const ConditionResult& it : of(selecting).conditions)
      if (it.condition.distance == 4.0 && it.condition.size == 0.03 && it.condition.distractors == 0)
        return it;
    return ConditionResult{};
  };
  EXPECT_LT(far_small(Selecting::Spotlight).time.mean, far_small(Selecting::RayPointer).time.mean);
  for (const TechniqueResult& it : result->techniques) {
    EXPECT_GT(it.time.mean, 0.5) << name_of(it.selecting);
    EXPECT_LT(it.time.mean, 6.0) << name_of(it.selecting);
    ASSERT_TRUE(it.line);
    EXPECT_GE(it.throughput, it.score);
  }
  for (std::size_t i = 1; i < result->techniques.size(); ++i)
    EXPECT_LE(result->techniques[i].score, result->techniques[i - 1].score);
}

TEST(TechniqueBench, WhatATrialGaveTheTechniqueReplaysToTheSame) {
  const TechniqueScene scene = scene_of({ball_target(1, Vector3(0.1, 1.5, -0.5), 0.03)});
  const PersonModel person;
  for (const Selecting selecting : kAllSelecting) {
    Technique technique;
    technique.selecting = selecting;
    const Aiming aiming(technique, person);
    const auto goal = aiming.goal_for(scene, 1);
    ASSERT_TRUE(goal);
    const Vector3 start =
        aiming.goes() ? Vector3(goal->control + Vector3(-0.1, -0.05, 0.1)) : Vector3(-0.4, 0.1, 0.0);
    base::Random random(17);
    const TrialRun run =
        simulated_trial(technique, person, aiming, scene, {1, *goal, Vector3::Zero(), start}, random);
    EXPECT_EQ(run.trial.time, run.stream.back().time);
    TechniqueScene copy = scene;
    const auto outcomes = replay(technique, run.stream, copy);
    EXPECT_TRUE(outcomes.back().picked);
    EXPECT_EQ(outcomes.back().selected == 1u, run.trial.hit) << name_of(selecting);
  }
}

TEST(TechniqueBench, SaysWhatCannotBeDone) {
  const auto refused = [](const auto& change, const char* saying) {
    BenchSettings settings = short_bench();
    change(settings);
    const auto result = run_bench(settings);
    ASSERT_FALSE(result);
    EXPECT_NE(result.error().message.find(saying), std::string::npos) << result.error().message;
  };
  refused([](BenchSettings& it) { it.users = 0; }, "people");
  refused([](BenchSettings& it) { it.users = 100000; }, "people");
  refused([](BenchSettings& it) { it.trials = 1; }, "movements");
  refused([](BenchSettings& it) { it.users = it.trials = 1000; }, "fewer people");
  refused([](BenchSettings& it) { it.person.reaction = std::nan(""); }, "reaction");
  refused([](BenchSettings& it) { it.person.arm.acceleration = 0.0; }, "accelerations");
  refused([](BenchSettings& it) { it.sizes.clear(); }, "sizes");
  refused([](BenchSettings& it) { it.sizes = {std::nan("")}; }, "sizes");
  refused([](BenchSettings& it) { it.distances = {1e9}; }, "distances");
  refused([](BenchSettings& it) { it.distractors = {-1}; }, "distractors");
  const auto stopped = run_bench(short_bench(), [](double) { return false; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().message, "interrupted");
}

}  // namespace
}  // namespace icome::interaction
