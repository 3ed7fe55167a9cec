#include "study/run/steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "study/definition/session_length.h"
#include "study/records/data_folder.h"

namespace icome::study {
namespace {

constexpr std::array<std::string_view, 5> kPageNames = {"consent", "instructions", "condition", "measured",
                                                        "rest"};

std::size_t count_trials(const Progress& progress, std::size_t position, bool practice) {
  return std::size_t(std::ranges::count_if(progress.trials, [&](const TrialRecord& trial) {
    return trial.plan.position == position && trial.plan.practice == practice;
  }));
}

std::size_t wanted_practice(const Trials& trials) {
  return std::size_t(std::max(trials.practice, trials.criterion ? trials.criterion->successes : 0));
}

/// Is practice over: was it enough, or are no attempts left?
bool practice_is_over(const Study& study, const Progress& progress, std::size_t position) {
  const std::size_t done = count_trials(progress, position, true);
  if (done < std::size_t(study.trials.practice)) return false;
  if (is_practised(study, progress, position)) return true;
  const std::size_t most = std::size_t(study.trials.criterion->most_attempts);
  return done >= std::max(most, wanted_practice(study.trials));
}

/// Goes through the protocol until something is not done yet.
class Protocol {
 public:
  Protocol(const Study& study, const Participant& participant, const Progress& progress)
      : study_(study), participant_(participant), progress_(progress) {}

  Step next() {
    const bool found = (!study_.consent.empty() && page(PageKind::Consent, 0)) || asked(AskWhen::Before, 0) ||
                       (tells_task() && page(PageKind::Instructions, 0)) || conditions() ||
                       asked(AskWhen::AfterLast, last_position()) || asked(AskWhen::End, last_position());
    if (!found) step_.kind = Step::Kind::Over;
    return step_;
  }

 private:
  bool tells_task() const { return !study_.goal.empty() || !study_.instructions.empty(); }

  std::size_t last_position() const { return conditions_of(study_, participant_).size() - 1; }

  // Each returns true, with step_ set, if the next step is one of its own.

  bool page(PageKind kind, std::size_t position) {
    const std::string_view name = page_name(kind);
    const bool read = std::ranges::any_of(progress_.events, [&](const EventRecord& event) {
      return event.kind == EventKind::Page && event.name == name && event.position == position;
    });
    step_.kind = Step::Kind::Page;
    step_.page = kind;
    step_.position = position;
    return !read;
  }

  bool asked(AskWhen when, std::size_t position) {
    for (std::size_t i = 0; i < study_.questionnaires.size(); ++i) {
      const Questionnaire& questionnaire = study_.questionnaires[i];
      if (questionnaire.when != when) continue;
      step_.kind = Step::Kind::Questions;
      step_.questionnaire = i;
      step_.position = position;
      if (!is_answered(questionnaire, position)) return true;
    }
    return false;
  }

  bool is_answered(const Questionnaire& questionnaire, std::size_t position) const {
    return std::ranges::all_of(questionnaire.items, [&](const Item& item) {
      return answer_of(progress_, fmt::format("{}.{}", questionnaire.id, item.id), position) != nullptr;
    });
  }

  bool conditions() {
    const std::size_t count = last_position() + 1;
    for (std::size_t position = 0; position < count; ++position) {
      if (condition(position)) return true;
      const bool more = position + 1 < count;
      if (more && study_.trials.rest > 0.0 && page(PageKind::Rest, position)) return true;
    }
    return false;
  }

  bool condition(std::size_t position) {
    const bool practises = wanted_practice(study_.trials) > 0;
    return page(PageKind::Condition, position) || practice(position) ||
           (practises && page(PageKind::Measured, position)) || measured(position) ||
           asked(AskWhen::AfterCondition, position);
  }

  bool practice(std::size_t position) {
    if (practice_is_over(study_, progress_, position)) return false;
    trial(practice_trial(study_, participant_, position, count_trials(progress_, position, true)));
    return true;
  }

  bool measured(std::size_t position) {
    const std::size_t done = count_trials(progress_, position, false);
    if (done >= trials_a_condition(study_.trials)) return false;
    trial(measured_trial(study_, participant_, position, done));
    return true;
  }

  void trial(TrialPlan plan) {
    step_.kind = Step::Kind::Trial;
    step_.position = plan.position;
    step_.trial = std::move(plan);
  }

  const Study& study_;
  const Participant& participant_;
  const Progress& progress_;
  Step step_;
};

}  // namespace

std::string_view page_name(PageKind page) { return kPageNames[std::size_t(page)]; }

Step next_step(const Study& study, const Participant& participant, const Progress& progress) {
  return Protocol(study, participant, progress).next();
}

bool is_practised(const Study& study, const Progress& progress, std::size_t position) {
  const auto& criterion = study.trials.criterion;
  if (!criterion) return true;
  const auto successes = std::ranges::count_if(progress.trials, [&](const TrialRecord& trial) {
    return trial.plan.practice && trial.plan.position == position && trial.measures.completed &&
           trial.measures.time <= criterion->within;
  });
  return successes >= criterion->successes;
}

double share_done(const Study& study, const Participant& participant, const Progress& progress) {
  const std::size_t conditions = conditions_of(study, participant).size();
  const std::size_t practice = wanted_practice(study.trials);
  double done = 0.0;
  for (std::size_t position = 0; position < conditions; ++position)
    done += double(std::min(count_trials(progress, position, true), practice) +
                   count_trials(progress, position, false));
  const double all = double(conditions * (practice + trials_a_condition(study.trials)));
  const bool over = next_step(study, participant, progress).kind == Step::Kind::Over;
  return over ? 1.0 : std::min(done / all, 1.0);
}

}  // namespace icome::study
