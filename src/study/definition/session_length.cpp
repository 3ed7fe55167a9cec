#include "study/definition/session_length.h"

#include <algorithm>

#include "study/definition/conditions.h"

namespace icome::study {
namespace {

constexpr double kWordsASecond = 200.0 / 60.0;  // slow reading
constexpr double kClosedQuestion = 10.0;        // s
constexpr double kOpenQuestion = 45.0;          // s

double reading_time(const Text& text) {
  if (text.empty()) return 0.0;
  std::size_t words = 0;
  bool in_word = false;
  for (const char c : text.front()) {
    const bool blank = c == ' ' || c == '\n' || c == '\t' || c == '\r';
    words += !blank && !in_word ? 1U : 0U;
    in_word = !blank;
  }
  return double(words) / kWordsASecond;
}

double answering_time(const Questionnaire& questionnaire) {
  double time = 0.0;
  for (const Item& item : questionnaire.items)
    time += item.kind == ItemKind::OpenText ? kOpenQuestion : kClosedQuestion;
  return time;
}

/// The number of practice trials in a condition, at least the successes that a criterion requires.
std::size_t practice_a_condition(const Trials& trials) {
  const int wanted = trials.criterion ? trials.criterion->successes : 0;
  return std::size_t(std::max(wanted, trials.practice));
}

}  // namespace

std::size_t trials_a_condition(const Trials& trials) {
  return std::size_t(trials.measured) * std::max<std::size_t>(trials.scenes.size(), 1);
}

double session_length(const Study& study) {
  const Trials& trials = study.trials;
  const double conditions = double(crossings(study, false).size());
  const double count = double(trials_a_condition(trials) + practice_a_condition(trials));
  double time = conditions * count * (trials.hold + trials.seconds) + (conditions - 1.0) * trials.rest;
  time += reading_time(study.consent) + reading_time(study.goal) + reading_time(study.instructions);
  for (const Questionnaire& questionnaire : study.questionnaires)
    time +=
        answering_time(questionnaire) * (questionnaire.when == AskWhen::AfterCondition ? conditions : 1.0);
  return time;
}

}  // namespace icome::study
