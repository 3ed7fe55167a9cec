#include "study/simulation/simulated_person.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>

#include "study/box_menu.h"
#include "study/definition/scene_reader.h"
#include "study/run/session_run.h"
#include "study/small_study.h"
#include "study/trial_scenes.h"

namespace icome::study {
namespace {

/// A trial of a person who is in that group, in that condition.
std::pair<Participant, TrialPlan> planned(const Study& study, std::uint64_t who, std::size_t group,
                                          std::size_t condition, std::size_t number) {
  Participant person;
  person.number = who;
  person.group = group;
  TrialPlan plan = measured_trial(study, person, 0, number);
  plan.condition = condition;
  return {person, plan};
}

SimulatedPerson::Run run_of(const TemplateFolder& folder, const std::string& file, std::uint64_t who,
                            std::size_t group, std::size_t condition, std::size_t number) {
  const Study& study = folder.study();
  const auto [person, plan] = planned(study, who, group, condition, number);
  const world::World world = folder.scene(file);
  session::HapticRepresentation felt;
  felt.open(world);
  return SimulatedPerson(study, who)
      .trial(plan, trial_goal(study, person, plan, world).value(), {felt.scene(), felt.names()});
}

TEST(SimulatedPerson, ReachesTheTargetInEveryRoom) {
  const TemplateFolder folder("head-tracking");
  for (std::size_t number = 0; number < 4; ++number) {
    const auto run = run_of(folder, "room-" + std::to_string(number + 1) + ".wrl", 5, 0, 0, number);
    EXPECT_TRUE(run.measures.completed) << number;
    EXPECT_GT(run.measures.time, 0.2);
    EXPECT_LT(run.measures.time, 20.0);
    EXPECT_GT(run.measures.distance, 0.1);  // the target is that far away
    EXPECT_LT(run.measures.distance, 2.0);
    EXPECT_EQ(run.trace.things[std::size_t(run.trace.samples.back().touched)], "target");
  }
}

/// A trial of the menu study, whose menu is an element.
SimulatedPerson::Run menu_run(const TemplateFolder& folder, std::uint64_t who, std::size_t group,
                              std::size_t condition, std::size_t number) {
  const Study& study = folder.study();
  const auto [person, plan] = planned(study, who, group, condition, number);
  SceneReader scenes(study, folder.path());
  const world::World world = scenes.in_trial(plan).value();
  session::HapticRepresentation felt;
  felt.open(world);
  const TrialGoal goal = trial_goal(study, person, plan, world, scenes.element_in(plan).value()).value();
  return SimulatedPerson(study, who).trial(plan, goal, {felt.scene(), felt.names()});
}

void expect_clicks_and_pushes(const SimulatedPerson::Run& run, std::size_t group, std::size_t condition) {
  EXPECT_TRUE(run.measures.completed) << group << condition;
  double strongest = 0.0;
  bool clicked = false;
  for (const Sample& sample : run.trace.samples) {
    strongest = std::max(strongest, sample.force.norm());
    clicked = clicked || sample.buttons != 0;
  }
  if (condition == 1) {
    EXPECT_EQ(strongest, 0.0);
  } else if (group == 1) {
    EXPECT_GT(strongest, 0.5);  // a push of 3 mm
  }
  EXPECT_EQ(clicked, group == 0);
}

TEST(SimulatedPerson, ClicksAndPushesBoxesWithForcesAndWithout) {
  const BoxMenuFolder folder;
  for (const std::size_t group : {0U, 1U})
    for (const std::size_t condition : {0U, 1U}) {
      Participant person;
      person.group = group;
      TrialPlan plan = measured_trial(folder.study, person, 0, 1);
      plan.condition = condition;
      const world::World world = folder.scene();
      session::HapticRepresentation felt;
      felt.open(world);
      const TrialGoal goal = trial_goal(folder.study, person, plan, world).value();
      const auto run = SimulatedPerson(folder.study, 2).trial(plan, goal, {felt.scene(), felt.names()});
      expect_clicks_and_pushes(run, group, condition);
    }
}

TEST(SimulatedPerson, ChoosesFromAnElementWithForcesAndWithout) {
  const TemplateFolder folder("menu");
  for (const std::size_t group : {0U, 1U})
    for (const std::size_t condition : {0U, 1U})
      for (std::uint64_t who = 0; who < 6; ++who) {
        const auto run = menu_run(folder, who, group, condition, std::size_t(who));
        expect_clicks_and_pushes(run, group, condition);
        const Sample& last = run.trace.samples.back();
        ASSERT_GE(last.chosen, 0);
        EXPECT_TRUE(run.trace.things[std::size_t(last.chosen)].starts_with("menu/"));
        EXPECT_GT(run.measures.approach_time, 0.2);
        EXPECT_GT(run.measures.homing_time, 0.0);
      }
}

TEST(SimulatedPerson, GoesThroughTheMenuThatHoldsTheTarget) {
  const TemplateFolder folder("menu");
  std::ofstream menu(folder.path() / "scenes/colour-menu.toml", std::ios::trunc);
  menu << "languages = [\"en\", \"nl\"]\ntext_m = 0.007\n[[item]]\nname = \"more\"\ntext = { en = \"More\", "
          "nl = "
          "\"Meer\" }\n";
  for (const Level& colour : folder.study().trials.variables[0].values)
    menu << "[[item.item]]\nname = \"" << colour.id << "\"\ntext = { en = \"x\", nl = \"x\" }\n";
  menu.close();
  for (const std::size_t group : {0U, 1U}) {
    const auto run = menu_run(folder, 3, group, 0, 1);
    EXPECT_TRUE(run.measures.completed);
    std::vector<std::string> chosen;
    for (const Sample& sample : run.trace.samples)
      if (sample.chosen >= 0) chosen.push_back(run.trace.things[std::size_t(sample.chosen)]);
    ASSERT_GE(chosen.size(), 2U);
    EXPECT_EQ(chosen.front(), "menu/more");
    EXPECT_NE(chosen.back(), "menu/more");
  }
}

/// The sinusoid that fits best by least squares, of frequencies from 5 to 15 Hz.
struct Sinusoid {
  double frequency = 0.0, amplitude = 0.0;  // Hz, m
};
Sinusoid fitted(const std::vector<double>& times, const std::vector<double>& values) {
  Sinusoid best;
  double least = std::numeric_limits<double>::infinity();
  for (double frequency = 5.0; frequency <= 15.0; frequency += 0.05) {
    Eigen::MatrixXd basis(Eigen::Index(times.size()), 3);
    Eigen::VectorXd seen(Eigen::Index(times.size()));
    for (Eigen::Index i = 0; i < seen.size(); ++i) {
      const double phase = 2.0 * std::numbers::pi * frequency * times[std::size_t(i)];
      basis.row(i) << 1.0, std::cos(phase), std::sin(phase);
      seen(i) = values[std::size_t(i)];
    }
    const Eigen::Vector3d found = (basis.transpose() * basis).ldlt().solve(basis.transpose() * seen);
    const double rest = (seen - basis * found).squaredNorm();
    if (rest >= least) continue;
    least = rest;
    best = {frequency, std::hypot(found(1), found(2))};
  }
  return best;
}

// The model: along each axis a tremor of that root mean square, of 9 Hz give or take a tenth.
TEST(SimulatedPerson, TremblesWhileItHoldsStillAsItsModelSays) {
  const TemplateFolder folder("menu");
  double sum = 0.0, frequencies = 0.0;
  int count = 0;
  for (std::uint64_t who = 0; who < 8; ++who) {
    const interaction::PersonModel model = SimulatedPerson(folder.study(), who).model();
    for (std::size_t number = 0; number < 3; ++number) {
      const auto run = menu_run(folder, who, 0, 1, number);
      for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> times, values;
        // The hand's swing from the first tick has nearly died away by the start; it moves after its reaction
        // time.
        for (const Sample& sample : run.trace.samples) {
          if (sample.time < 0.0 || sample.time >= 0.98 * model.reaction) continue;
          times.push_back(sample.time);
          values.push_back(sample.tip[axis]);
        }
        const Sinusoid tremor = fitted(times, values);
        EXPECT_GT(tremor.frequency, 0.8 * model.tremor_hz) << who << number << axis;
        EXPECT_LT(tremor.frequency, 1.2 * model.tremor_hz) << who << number << axis;
        const double ratio = tremor.amplitude / std::numbers::sqrt2 / model.arm.tremor;
        EXPECT_NEAR(ratio, 1.0, 0.2) << who << number << axis;
        sum += ratio;
        frequencies += tremor.frequency / model.tremor_hz;
        ++count;
      }
    }
  }
  EXPECT_NEAR(sum / count, 1.0, 0.05);
  EXPECT_NEAR(frequencies / count, 1.0, 0.05);
}

/// The end of a person's first movement of 20 cm to the right: across and aside, m off the goal. The goal is
/// a plate that is too wide to be missed, so that nothing is corrected.
base::Vector2 first_landing(std::uint64_t seed) {
  Study study = read_study(study_template("blank", "b").value(), "b").value();
  study.seed = seed;
  TrialGoal goal;
  goal.things.resize(1);
  goal.things[0].name = "target";
  goal.things[0].target = true;
  goal.things[0].bounds = {base::Vector3(-0.3, -0.3, -0.002), base::Vector3(0.3, 0.3, 0.002)};
  goal.start = base::Vector3(-0.2, 0.0, 0.010);  // as far from the plate as the hand comes before a touch
  goal.choosing = Choosing::Click;
  goal.forces = false;
  session::HapticRepresentation felt;
  felt.open(world::World());
  const SimulatedPerson person(study, 0);
  const auto run = person.trial(measured_trial(study, {}, 0, 0), goal, {felt.scene(), felt.names()});
  const interaction::PersonModel& model = person.model();
  const double duration = interaction::planned_duration(model.arm, model, 0.2, 0.006);
  const double from = model.reaction + duration + 0.08;  // the tip has come after the hand
  base::Vector2 mean = base::Vector2::Zero();
  int count = 0;
  for (const Sample& sample : run.trace.samples) {
    if (sample.time < from || sample.time > from + 0.2) continue;  // before the button jolts it
    mean += sample.tip.head<2>();
    ++count;
  }
  // As shares of the deviation that the model states for such a movement.
  return mean / count / (model.arm.noise * 0.2 / duration);
}

TEST(SimulatedPerson, FirstMovementsEndOffTheGoalAsTheModelSays) {
  constexpr int kPeople = 600;
  base::Vector2 sum = base::Vector2::Zero(), squares = base::Vector2::Zero();
  int beyond = 0, far = 0;
  for (std::uint64_t seed = 1; seed <= kPeople; ++seed) {
    const base::Vector2 off = first_landing(seed);
    sum += off;
    squares += off.cwiseAbs2();
    beyond += off.x() > 0.0 ? 1 : 0;
    far += std::abs(off.x()) > 1.0 ? 1 : 0;
  }
  const double aside = interaction::PersonModel{}.aside;
  // Five standard errors of means, deviations and shares of so many normal numbers.
  const double of_mean = 5.0 / std::sqrt(kPeople), of_deviation = 5.0 / std::sqrt(2.0 * kPeople);
  EXPECT_NEAR(sum.x() / kPeople, 0.0, of_mean);
  EXPECT_NEAR(sum.y() / kPeople, 0.0, aside * of_mean);
  EXPECT_NEAR(std::sqrt(squares.x() / kPeople), 1.0, of_deviation);
  EXPECT_NEAR(std::sqrt(squares.y() / kPeople) / aside, 1.0, of_deviation);
  EXPECT_NEAR(double(beyond) / kPeople, 0.5, 2.5 / std::sqrt(kPeople));  // overshoots half of the time
  EXPECT_NEAR(double(far) / kPeople, 0.3173, 5.0 * std::sqrt(0.2166 / kPeople));  // as a normal number is
}

TEST(SimulatedPerson, DoesTheSameTrialTheSameToTheBit) {
  const TemplateFolder folder("blank");
  const auto one = run_of(folder, "pointing-room.wrl", 1, 0, 0, 3);
  const auto other = run_of(folder, "pointing-room.wrl", 1, 0, 0, 3);
  ASSERT_EQ(one.trace.samples.size(), other.trace.samples.size());
  for (std::size_t i = 0; i < one.trace.samples.size(); ++i)
    EXPECT_EQ(one.trace.samples[i].tip, other.trace.samples[i].tip);
  const auto another = run_of(folder, "pointing-room.wrl", 2, 0, 0, 3);
  EXPECT_NE(one.measures.distance, another.measures.distance);
}

TEST(SimulatedPerson, TracesAreWholeAndEvenlySpaced) {
  const TemplateFolder folder("blank");
  const auto run = run_of(folder, "pointing-room.wrl", 4, 0, 1, 0);
  const auto& samples = run.trace.samples;
  EXPECT_LT(samples.front().time, -0.05);  // held before the start
  EXPECT_NEAR(samples.back().time, run.measures.time, 1e-9);
  for (std::size_t i = 1; i < samples.size(); ++i)
    EXPECT_NEAR(samples[i].time - samples[i - 1].time, 0.001, 1e-9);
  double way = 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i)
    if (samples[i].time > 0.0005) way += (samples[i].tip - samples[i - 1].tip).norm();
  EXPECT_NEAR(way, run.measures.distance, 2e-6);
}

TEST(SimulatedPerson, AnswersEveryQuestionOfTheTemplates) {
  for (const std::string& name : template_names()) {
    const Study study = read_study(study_template(name, "s").value(), name).value();
    for (std::uint64_t who = 0; who < 20; ++who)
      for (const Questionnaire& questionnaire : study.questionnaires) {
        const auto answers = SimulatedPerson(study, who).answers(questionnaire, 0);
        ASSERT_EQ(answers.size(), questionnaire.items.size());
        for (std::size_t i = 0; i < answers.size(); ++i)
          EXPECT_EQ(why_no_answer(questionnaire.items[i], answers[i]), "") << questionnaire.items[i].id;
      }
    EXPECT_EQ(SimulatedPerson::control(study, 3).size(), study.control.size());
  }
}

}  // namespace
}  // namespace icome::study
