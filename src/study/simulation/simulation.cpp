#include "study/simulation/simulation.h"

#include <algorithm>

#include "study/definition/scene_reader.h"
#include "study/definition/trial_goal.h"
#include "study/run/session_run.h"
#include "study/simulation/simulated_person.h"

namespace icome::study {
namespace {

constexpr double kPageTime = 5.0;                       // s, for a page that a simulated person reads
constexpr double kQuestionTime = 4.0;                   // s, a question
constexpr const char* kBegan = "2000-01-01T00:00:00Z";  // any date would do

/// The time at which the last thing on record was over, s.
double time_so_far(const Progress& progress) {
  double time = 0.0;
  for (const EventRecord& event : progress.events) time = std::max(time, event.onset + event.duration);
  for (const TrialRecord& trial : progress.trials) time = std::max(time, trial.onset + trial.measures.time);
  return time;
}

/// One person's session, from its present step to its end; go() returns false if told to end early.
class SimulatedSession {
 public:
  SimulatedSession(const Study& study, SceneReader& scenes, const std::function<bool(double)>& tell)
      : study_(study), scenes_(scenes), tell_(tell) {}

  base::Result<bool> go(SessionLog log) {
    const SimulatedPerson person(study_, log.participant().number);
    time_ = time_so_far(log.progress());
    auto run = SessionRun::begin(study_, std::move(log), [this] { return time_; }, {kBegan, "simulated"});
    if (!run) return tl::unexpected(run.error());
    while (run->step().kind != Step::Kind::Over) {
      if (!tell_(run->share())) return false;
      if (const auto done = step(*run, person); !done) return tl::unexpected(done.error());
    }
    return true;
  }

 private:
  base::Result<void> step(SessionRun& run, const SimulatedPerson& person) {
    const Step& now = run.step();
    if (now.kind == Step::Kind::Page) {
      time_ += now.page == PageKind::Rest ? std::max(kPageTime, study_.trials.rest) : kPageTime;
      return run.page_read();
    }
    if (now.kind == Step::Kind::Questions) {
      const Questionnaire& questionnaire = study_.questionnaires[now.questionnaire];
      time_ += kQuestionTime * double(questionnaire.items.size());
      return run.answered(person.answers(questionnaire, now.position));
    }
    const auto world = scenes_.in_trial(now.trial);
    if (!world) return tl::unexpected(world.error());
    const auto element = scenes_.element_in(now.trial);
    if (!element) return tl::unexpected(element.error());
    const auto goal = trial_goal(study_, run.participant(), now.trial, *world, *element);
    if (!goal) return tl::unexpected(goal.error());
    session::HapticRepresentation felt;
    felt.open(*world);
    const auto trial = person.trial(now.trial, *goal, {felt.scene(), felt.names()});
    time_ += study_.trials.hold + trial.measures.time;
    return run.trial_done(trial.measures, trial.trace);
  }

  const Study& study_;
  SceneReader& scenes_;
  const std::function<bool(double)>& tell_;
  double time_ = 0.0;  // s, of the person's session
};

}  // namespace

base::Result<void> simulate(const Study& study, const std::filesystem::path& study_folder, DataFolder& data,
                            std::size_t people, const std::function<bool(double)>& tell) {
  SceneReader scenes(study, study_folder);
  for (std::size_t number = 0; number < people; ++number) {
    while (data.participants().size() <= number) {
      const auto enrolled = data.enrol({}, 0, SimulatedPerson::control(study, data.participants().size()));
      if (!enrolled) return tl::unexpected(enrolled.error());
    }
    auto log = data.open_log(data.participants()[number]);
    if (!log) return tl::unexpected(log.error());
    const auto share = [&](double part) { return tell((double(number) + part) / double(people)); };
    const auto through = SimulatedSession(study, scenes, share).go(std::move(*log));
    if (!through) return tl::unexpected(through.error());
    if (!*through) return {};
  }
  return {};
}

}  // namespace icome::study
