#include "study/run/session_run.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "study/data_samples.h"
#include "study/small_study.h"

namespace icome::study {
namespace {

/// A person in the small study, whose clock is set by hand.
class SmallSession {
 public:
  SmallSession() : study_(small_study()) {
    auto data = DataFolder::open(study_, kSmallStudy, scratch_.data(), false);
    EXPECT_TRUE(data) << data.error().message;
    data_ = std::make_unique<DataFolder>(std::move(*data));
    person_ = *data_->enrol({}, 0, {});
    begin("2026-11-22T10:00:00.000Z");
  }

  /// As another program would, after the one before has ended.
  void begin(const std::string& now) {
    run_.reset();
    auto run = SessionRun::begin(study_, log_of(*data_, person_), [this] { return time; }, {now, "Touch"});
    ASSERT_TRUE(run) << run.error().message;
    run_ = std::make_unique<SessionRun>(std::move(*run));
  }

  std::string begin_error() {
    run_.reset();
    const auto run =
        SessionRun::begin(study_, log_of(*data_, person_), [this] { return time; }, {"now", "mouse"});
    return run ? "begun" : run.error().message;
  }

  /// Does the step, whatever it is, in a second; trials take `trial_time`.
  void step(double trial_time = 1.0) {
    time += 1.0;
    switch (run().step().kind) {
      case Step::Kind::Page:
        EXPECT_TRUE(run().page_read());
        break;
      case Step::Kind::Questions:
        EXPECT_TRUE(run().answered({"4", "So\tso"}));
        break;
      case Step::Kind::Trial: {
        TrialMeasures measures;
        measures.time = trial_time;
        EXPECT_TRUE(run().trial_done(measures, {}));
        break;
      }
      case Step::Kind::Over:
        break;
    }
  }

  SessionRun& run() { return *run_; }
  std::size_t count(EventKind kind) {
    return std::size_t(std::ranges::count(run().progress().events, kind, &EventRecord::kind));
  }

  double time = 0.0;  // s

 private:
  Study study_;
  StudyScratch scratch_;
  std::unique_ptr<DataFolder> data_;
  Participant person_;
  std::unique_ptr<SessionRun> run_;
};

TEST(SessionRun, GoesToTheEndAndSaysSo) {
  SmallSession session;
  for (int i = 0; i < 100 && session.run().step().kind != Step::Kind::Over; ++i) session.step();
  EXPECT_EQ(session.run().step().kind, Step::Kind::Over);
  EXPECT_EQ(session.run().share(), 1.0);
  EXPECT_EQ(session.count(EventKind::Session), 1U);
  EXPECT_EQ(session.count(EventKind::Over), 1U);
  EXPECT_EQ(session.run().progress().events.front().name, "Touch") << "the device it was done with";
  EXPECT_EQ(session.run().progress().trials.size(), 2U * (2U + 2U * 3U));  // practice; scenes
}

TEST(SessionRun, StepsHaveTheirTimes) {
  SmallSession session;
  session.step();  // consent
  session.step();  // instructions
  const EventRecord& instructions = session.run().progress().events.back();
  EXPECT_EQ(instructions.name, "instructions");
  EXPECT_EQ(instructions.onset, 1.0);
  EXPECT_EQ(instructions.duration, 1.0);
  session.step();      // the condition's page
  session.step(0.25);  // a trial, over after 4 s of the session
  EXPECT_EQ(session.run().progress().trials.back().onset, 3.75);
}

TEST(SessionRun, WhatIsSaidInATrialIsOnRecord) {
  SmallSession session;
  while (session.run().step().kind != Step::Kind::Trial) session.step();
  session.time += 5.0;
  TrialMeasures measures;
  measures.time = 2.0;
  Trace trace;
  trace.things = {"box", "ball"};
  ASSERT_TRUE(session.run().trial_done(measures, trace,
                                       {{0.5, 0.9, "the box", -3.0, 0}, {1.25, 1.75, "a\ttab", -3.0, -1}}));
  ASSERT_EQ(session.count(EventKind::Said), 2U);
  const double onset = session.run().progress().trials.back().onset;
  session.begin("2026-11-22T11:00:00.000Z");  // from the files
  ASSERT_EQ(session.count(EventKind::Said), 2U);
  std::vector<EventRecord> said;
  for (const EventRecord& event : session.run().progress().events)
    if (event.kind == EventKind::Said) said.push_back(event);
  EXPECT_EQ(said[0].name, "the box");
  EXPECT_EQ(said[0].value, "box");
  EXPECT_NEAR(said[0].onset, onset + 0.5, 1e-6);
  EXPECT_NEAR(said[0].duration, 0.4, 1e-6);
  EXPECT_EQ(said[1].value, "");
  EXPECT_EQ(said[1].position, said[0].position);
}

TEST(SessionRun, AnotherProgramGoesOnWithTheSameStep) {
  SmallSession session;
  for (int i = 0; i < 7; ++i) session.step();
  for (int i = 0; i < 100 && session.run().step().kind != Step::Kind::Over; ++i) {
    const Step before = session.run().step();
    session.begin("2026-11-22T11:00:00.000Z");
    EXPECT_EQ(session.run().step().kind, before.kind);
    EXPECT_EQ(session.run().step().trial, before.trial);
    EXPECT_EQ(session.run().step().position, before.position);
    session.step();
  }
  const std::size_t resumed = session.count(EventKind::Resumed);
  EXPECT_GT(resumed, 10U);
  session.begin("2026-11-22T12:00:00.000Z");  // to look at it
  EXPECT_EQ(session.count(EventKind::Resumed), resumed);
  EXPECT_EQ(session.count(EventKind::Over), 1U);
}

TEST(SessionRun, WhoDoesNotMeetTheCriterionIsNoted) {
  SmallSession session;
  while (session.run().step().kind != Step::Kind::Trial) session.step();
  for (int i = 0; i < 4; ++i) session.step(9.0);  // slower than 5 s, four attempts
  EXPECT_EQ(session.count(EventKind::Unpractised), 1U);
  EXPECT_EQ(session.run().step().page, PageKind::Measured);
}

TEST(SessionRun, AnswersThatDoNotFitAreRefusedAndNothingIsKept) {
  SmallSession session;
  while (session.run().step().kind != Step::Kind::Questions) session.step();
  const std::size_t before = session.run().progress().events.size();
  const auto refused = session.run().answered({"9", ""});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "Easy?: choose from 1 to 5.");
  EXPECT_FALSE(session.run().answered({"4"}));
  EXPECT_EQ(session.run().progress().events.size(), before);
  EXPECT_TRUE(session.run().answered({"4", ""}));
  EXPECT_EQ(session.run().step().page, PageKind::Rest);
  EXPECT_EQ(*answer_of(session.run().progress(), "after.ease", 0), "4");
}

TEST(SessionRun, WhoDeclinesIsNotAskedAgain) {
  SmallSession session;
  EXPECT_TRUE(session.run().declined());
  EXPECT_EQ(session.begin_error(), "001 did not agree to take part; nobody is asked twice.");
}

TEST(SessionRun, ATrialThatIsBrokenOffIsNotedAndStays) {
  SmallSession session;
  while (session.run().step().kind != Step::Kind::Trial) session.step();
  const TrialPlan plan = session.run().step().trial;
  EXPECT_TRUE(session.run().trial_broken_off("The device was lost."));
  EXPECT_EQ(session.run().step().trial, plan);
  EXPECT_EQ(session.count(EventKind::BrokenOff), 1U);
  EXPECT_EQ(session.run().progress().events.back().value, "The device was lost.");
}

TEST(SessionRun, PagesSayWhatTheStudySays) {
  Study study = small_study();
  study.goal = {"We look."};
  Step step;
  step.kind = Step::Kind::Page;
  step.page = PageKind::Instructions;
  EXPECT_EQ(page_text(study, {}, step).body, "We look.\n\nTouch it.");
  step.page = PageKind::Consent;
  EXPECT_EQ(page_text(study, {}, step).body, "Yes?");
  step.page = PageKind::Condition;
  EXPECT_EQ(page_text(study, {}, step).body, "");
}

}  // namespace
}  // namespace icome::study
