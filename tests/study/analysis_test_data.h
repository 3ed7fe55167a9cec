#pragma once
// Data of studies, made up by hand or drawn, for the tests of analysis and of the page.
#include <cmath>
#include <string>
#include <vector>

#include "base/random.h"
#include "study/definition/conditions.h"
#include "study/definition/session_length.h"
#include "study/definition/study_reader.h"
#include "study/definition/templates.h"
#include "study/records/data_folder.h"

namespace icome::study {

/// The data of a study that nobody has taken part in.
inline StudyData data_of(const char* template_name) {
  StudyData data;
  data.study = read_study(study_template(template_name, "test").value(), template_name).value();
  return data;
}

/// The study measures so many trials in each condition, in no scenes.
inline void plan_trials(StudyData& data, int measured) {
  data.study.trials.measured = measured;
  data.study.trials.scenes.clear();
}

/// One more person of a group, who has done nothing yet.
inline StudyData::Person& add_person(StudyData& data, std::size_t group) {
  StudyData::Person person;
  person.participant.number = data.people.size();
  person.participant.id = std::to_string(data.people.size() + 1);
  person.participant.group = group;
  for (const StudyData::Person& other : data.people)
    if (other.participant.group == group) ++person.participant.order_row;
  for (const ControlVariable& control : data.study.control)
    person.participant.control.push_back(control.levels.empty() ? std::to_string(20 + data.people.size())
                                                                : control.levels[data.people.size() % 2].id);
  person.complete = true;
  data.people.push_back(person);
  return data.people.back();
}

/// A measured trial; times in s.
inline void add_trial(StudyData::Person& person, std::size_t condition, double time, int errors = 0,
                      bool completed = true) {
  TrialRecord trial;
  trial.plan.condition = condition;
  for (const TrialRecord& other : person.progress.trials)
    if (other.plan.condition == condition) ++trial.plan.number;
  trial.measures = {time, 0.4 * time, 0.6 * time, 0.02 * time, errors, completed};
  person.progress.trials.push_back(trial);
}

inline void add_answer(StudyData::Person& person, const std::string& name, const std::string& value,
                       std::size_t position = 0) {
  person.progress.events.push_back({EventKind::Answer, 0.0, 1.0, position, name, value});
}

/// The position of a condition in a person's order.
inline std::size_t position_of(const StudyData& data, const Participant& person, std::size_t condition) {
  const auto order = conditions_of(data.study, person);
  return std::size_t(std::find(order.begin(), order.end(), condition) - order.begin());
}

/// Answers every question, by chance.
inline void answer_all(const StudyData& data, StudyData::Person& person, base::Random& random) {
  const std::size_t conditions = crossings(data.study, false).size();
  for (const Questionnaire& questionnaire : data.study.questionnaires) {
    const std::size_t times = questionnaire.when == AskWhen::AfterCondition ? conditions : 1;
    for (std::size_t time = 0; time < times; ++time) {
      for (const Item& item : questionnaire.items) {
        std::string value = "Nothing to add.";
        if (!item.choices.empty()) value = item.choices[random.index(item.choices.size())].id;
        if (item.kind == ItemKind::Rating)
          value = std::to_string(1 + random.index(std::uint64_t(item.points)));
        if (item.kind == ItemKind::Number) value = std::to_string(random.index(10));
        add_answer(person, questionnaire.id + "." + item.id, value, time);
      }
    }
  }
}

/// People whose times differ between conditions and groups, the same again for the same seed.
inline StudyData drawn_data(const char* template_name, std::size_t people, std::uint64_t seed = 7) {
  StudyData data = data_of(template_name);
  base::Random random(seed);
  const std::size_t groups = crossings(data.study, true).size();
  const std::size_t conditions = crossings(data.study, false).size();
  const std::size_t trials = trials_a_condition(data.study.trials);
  for (std::size_t i = 0; i < people; ++i) {
    StudyData::Person& person = add_person(data, i % groups);
    const double speed = random.uniform(0.7, 1.5);
    for (std::size_t condition = 0; condition < conditions; ++condition)
      for (std::size_t trial = 0; trial < trials; ++trial)
        add_trial(person, condition,
                  speed * random.uniform(2.0, 4.0) + 0.5 * double(condition) + 1.5 * double(i % groups),
                  int(random.index(3)));
    answer_all(data, person, random);
  }
  return data;
}

}  // namespace icome::study
