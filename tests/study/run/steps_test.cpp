#include "study/run/steps.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "study/run/session_run.h"
#include "study/small_study.h"

namespace icome::study {
namespace {

/// Does what comes next, and tells what that was.
class Walk {
 public:
  explicit Walk(Study study) : study_(std::move(study)) {}

  std::string next(double trial_time = 1.0) {
    const Step step = next_step(study_, person_, progress_);
    switch (step.kind) {
      case Step::Kind::Over:
        return "over";
      case Step::Kind::Page:
        return page(step);
      case Step::Kind::Questions:
        return questions(step);
      case Step::Kind::Trial:
        break;
    }
    TrialRecord record;
    record.plan = step.trial;
    record.measures.time = trial_time;
    progress_.trials.push_back(record);
    return fmt::format("{} {}.{}", step.trial.practice ? "practice" : "trial", step.position,
                       step.trial.number);
  }

  std::string all() {
    std::string said;
    for (std::string one = next(); one != "over"; one = next()) said += one + "; ";
    return said;
  }

  const Study& study() const { return study_; }
  Progress& progress() { return progress_; }
  double share() const { return share_done(study_, person_, progress_); }

 private:
  std::string page(const Step& step) {
    EventRecord event;
    event.name = page_name(step.page);
    event.position = step.position;
    progress_.events.push_back(event);
    return fmt::format("{} {}", event.name, event.position);
  }

  std::string questions(const Step& step) {
    const Questionnaire& questionnaire = study_.questionnaires[step.questionnaire];
    for (const Item& item : questionnaire.items) {
      EventRecord event;
      event.kind = EventKind::Answer;
      event.name = fmt::format("{}.{}", questionnaire.id, item.id);
      event.position = step.position;
      progress_.events.push_back(event);
    }
    return fmt::format("{} {}", questionnaire.id, step.position);
  }

  Study study_;
  Participant person_;
  Progress progress_;
};

TEST(Steps, GoThroughTheProtocolInItsOrder) {
  Study study = small_study();
  study.trials.scenes.resize(1);
  Walk walk(std::move(study));
  EXPECT_EQ(
      walk.all(),
      "consent 0; instructions 0; "
      "condition 0; practice 0.0; practice 0.1; measured 0; trial 0.0; trial 0.1; trial 0.2; after 0; "
      "rest 0; "
      "condition 1; practice 1.0; practice 1.1; measured 1; trial 1.0; trial 1.1; trial 1.2; after 1; ");
  EXPECT_EQ(walk.share(), 1.0);
}

TEST(Steps, PracticeGoesOnUntilTheCriterionIsMetOrAttemptsAreUsedUp) {
  Walk walk(small_study());
  for (int i = 0; i < 3; ++i) walk.next();    // the pages
  EXPECT_EQ(walk.next(9.0), "practice 0.0");  // too slow
  EXPECT_EQ(walk.next(1.0), "practice 0.1");
  EXPECT_EQ(walk.next(9.0), "practice 0.2");
  EXPECT_FALSE(is_practised(walk.study(), walk.progress(), 0));
  EXPECT_EQ(walk.next(9.0), "practice 0.3");  // the last attempt
  EXPECT_EQ(walk.next(), "measured 0");
  EXPECT_FALSE(is_practised(walk.study(), walk.progress(), 0));
}

TEST(Steps, TrialsThatWereNotCompletedAreNoSuccess) {
  Walk walk(small_study());
  for (int i = 0; i < 5; ++i) walk.next();
  EXPECT_TRUE(is_practised(walk.study(), walk.progress(), 0));
  walk.progress().trials[0].measures.completed = false;
  EXPECT_FALSE(is_practised(walk.study(), walk.progress(), 0));
}

TEST(Steps, AnAnswerThatIsMissingBringsTheQuestionnaireBack) {
  Walk walk(small_study());
  std::string said;
  while (said != "after 0") said = walk.next();
  walk.progress().events.pop_back();
  EXPECT_EQ(walk.next(), "after 0");
  EXPECT_EQ(walk.next(), "rest 0");
}

TEST(Steps, WhatTheStudyDoesNotSayIsPassedOver) {
  Study study = small_study();
  study.consent.clear();
  study.instructions.clear();
  study.trials.criterion.reset();
  study.trials.practice = 0;
  study.trials.rest = 0.0;
  Walk walk(std::move(study));
  EXPECT_EQ(walk.next(), "condition 0");
  EXPECT_EQ(walk.next(), "trial 0.0");
}

TEST(Steps, TheShareDoneRises) {
  Walk walk(small_study());
  double last = walk.share();
  EXPECT_EQ(last, 0.0);
  for (std::string said = walk.next(); said != "over"; said = walk.next()) {
    EXPECT_GE(walk.share(), last);
    last = walk.share();
  }
  EXPECT_EQ(last, 1.0);
}

TEST(Answers, AreCheckedByKind) {
  Item item;
  item.required = true;
  EXPECT_EQ(why_no_answer(item, ""), "answer this question");
  EXPECT_EQ(why_no_answer(item, "Because, well"), "");
  item.kind = ItemKind::Rating;
  item.points = 5;
  EXPECT_EQ(why_no_answer(item, "5"), "");
  EXPECT_EQ(why_no_answer(item, "6"), "choose from 1 to 5");
  EXPECT_EQ(why_no_answer(item, "2.5"), "choose from 1 to 5");
  EXPECT_EQ(why_no_answer(item, "1e300"), "choose from 1 to 5");
  item.kind = ItemKind::Number;
  item.least = 0.0;
  item.most = 10.0;
  EXPECT_EQ(why_no_answer(item, "-1"), "write a number from 0 on");
  EXPECT_EQ(why_no_answer(item, "11"), "write a number up to 10");
  EXPECT_EQ(why_no_answer(item, "many"), "write a number");
  item.kind = ItemKind::Choice;
  item.choices = {{.id = "a", .name = {}, .needs = {}}, {.id = "b", .name = {}, .needs = {}}};
  EXPECT_EQ(why_no_answer(item, "a"), "");
  EXPECT_EQ(why_no_answer(item, "a,b"), "choose one answer only");
  EXPECT_EQ(why_no_answer(item, "c"), "choose one of the answers");
  item.kind = ItemKind::Choices;
  EXPECT_EQ(why_no_answer(item, "a,b"), "");
  item.required = false;
  EXPECT_EQ(why_no_answer(item, ""), "");
}

}  // namespace
}  // namespace icome::study
