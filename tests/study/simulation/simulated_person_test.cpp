#include "study/simulation/simulated_person.h"

#include <gtest/gtest.h>

#include "study/run/session_run.h"
#include "study/small_study.h"
#include "study/trial_scenes.h"

namespace icome::study {
namespace {

SimulatedPerson::Run run_of(const TemplateFolder& folder, const std::string& file, std::uint64_t who,
                            std::size_t group, std::size_t condition, std::size_t number) {
  const Study& study = folder.study();
  Participant person;
  person.number = who;
  person.group = group;
  TrialPlan plan = measured_trial(study, person, 0, number);
  plan.condition = condition;
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

TEST(SimulatedPerson, ClicksAndPushesWithForcesAndWithout) {
  const TemplateFolder folder("menu");
  for (const std::size_t group : {0U, 1U})
    for (const std::size_t condition : {0U, 1U}) {
      const auto run = run_of(folder, "menu-room.wrl", 2, group, condition, 1);
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
