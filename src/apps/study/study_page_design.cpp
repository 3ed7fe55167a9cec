#include <fmt/format.h>

#include <algorithm>

#include "apps/stats/stats_text.h"
#include "apps/study/study_page_parts.h"
#include "apps/study/study_words.h"
#include "study/definition/conditions.h"
#include "study/definition/session_length.h"

namespace icome::apps {
namespace {

using study::Scale;

std::string level_list(const std::vector<study::Level>& levels) {
  std::string text;
  for (const study::Level& level : levels)
    text.append(text.empty() ? "" : ", ").append(name_of(level.name, level.id));
  return text;
}

std::string scale_text(Scale scale, bool discrete) {
  std::string text = scale_word(scale);
  if (scale == Scale::Interval || scale == Scale::Ratio)
    text.append(discrete ? ", discrete" : ", continuous");
  return text;
}

std::string control_values(const study::ControlVariable& variable) {
  std::string text = variable.levels.empty() ? variable.unit : level_list(variable.levels);
  if (variable.balanced) text.append(text.empty() ? "" : "; ").append("balanced over the groups");
  return text;
}

void write_variables(StudyPage& page) {
  const study::Study& study = page.data().study;
  PageTable table;
  table.caption = "Variables.";
  table.headings = {"Variable", "Kind", "Type", "What it is"};
  table.left_columns = 4;
  for (const study::IndependentVariable& factor : study.independent)
    table.rows.push_back({name_of(factor.name, factor.id), "independent",
                          factor.between ? "between people" : "within people", level_list(factor.levels)});
  for (const study::DependentVariable& variable : study.dependent)
    table.rows.push_back({quantity_name(variable), "dependent", scale_text(variable.scale, variable.discrete),
                          variable.from.empty()          ? "not measured"
                          : study::is_measured(variable) ? fmt::format("measured: {}", variable.from)
                                                         : fmt::format("asked: {}", variable.from)});
  for (const study::ControlVariable& variable : study.control)
    table.rows.push_back({name_of(variable.name, variable.id), "control",
                          scale_text(variable.scale, variable.discrete), control_values(variable)});
  page.table(table);
}

void write_expectations(StudyPage& page) {
  const study::Study& study = page.data().study;
  PageTable table;
  table.caption = "Hypotheses, as the study file had them before there were data.";
  table.headings = {"Hypothesis", "Expected", "Test", "\u03b1"};
  table.left_columns = 3;
  for (const study::Hypothesis& hypothesis : study.hypotheses)
    table.rows.push_back(
        {name_of(hypothesis.text, hypothesis.id), expectation_text(study, hypothesis),
         fmt::format("{}{}", test_word(hypothesis.test), hypothesis.primary ? ", primary" : ""),
         share_text(hypothesis.alpha)});
  page.table(table);
}

std::string order_sentence(const study::Study& study) {
  switch (study.order) {
    case study::OrderMethod::Full:
      return "All orders of conditions are used in turn.";
    case study::OrderMethod::LatinSquare:
      return "Orders follow Williams's Latin squares, in which every condition comes equally often at every "
             "place and after every other.";
    case study::OrderMethod::Random:
      return "Each person has the conditions in an order drawn by chance.";
    case study::OrderMethod::Fixed:
      return "Everybody has the conditions in the same order.";
  }
  return {};
}

void write_orders(StudyPage& page) {
  const study::Study& study = page.data().study;
  if (study::crossings(study, false).size() < 2) return;
  PageTable table;
  table.caption = "Orders of conditions that people had so far.";
  table.headings = {"Group", "Order", "People"};
  table.left_columns = 2;
  for (const study::OrderUse& use : page.analysis().participants.orders) {
    std::string order;
    for (const std::size_t condition : use.conditions)
      order.append(order.empty() ? "" : " \u2192 ").append(condition_name(study, false, condition));
    table.rows.push_back({condition_name(study, true, use.group), order, std::to_string(use.people)});
  }
  page.table(table);
}

void write_control(StudyPage& page) {
  PageTable table;
  table.caption = "What people brought along.";
  table.headings = {"Variable", "People", "Mean", "SD", "Range"};
  std::vector<std::string> lines;
  for (const study::ControlSummary& summary : page.analysis().participants.control) {
    const study::ControlVariable& control = page.data().study.control[summary.variable];
    std::string name = name_of(control.name, control.id);
    if (summary.numbers) {
      const stats::Description& it = *summary.numbers;
      if (!control.unit.empty()) name = fmt::format("{} ({})", name, control.unit);
      table.rows.push_back({name, std::to_string(it.n), fixed_text(it.mean, 1),
                            fixed_text(it.standard_deviation, 1),
                            fmt::format("{:g}\u2013{:g}", it.minimum, it.maximum)});
      continue;
    }
    std::string counts;
    for (const auto& [level, count] : summary.counts)
      counts.append(fmt::format("{}{} {}", counts.empty() ? "" : ", ", level, count));
    if (!counts.empty()) lines.push_back(fmt::format("{}: {}.", name, counts));
  }
  page.list(lines);
  page.table(table);
}

}  // namespace

void write_design(StudyPage& page) {
  const study::Study& study = page.data().study;
  page.heading("Design");
  const std::size_t groups = study::crossings(study, true).size();
  const std::size_t conditions = study::crossings(study, false).size();
  page.paragraph(fmt::format("{}; {} for each person; {} measured in each. {}",
                             groups == 1 ? "One group of people" : fmt::format("{} groups of people", groups),
                             count_text(conditions, "condition"),
                             count_text(study::trials_a_condition(study.trials), "trial"),
                             conditions > 1 ? order_sentence(study) : std::string()));
  write_variables(page);
  write_expectations(page);
}

void write_participants(StudyPage& page) {
  const study::Study& study = page.data().study;
  const study::ParticipantSummary& people = page.analysis().participants;
  page.heading("Participants");
  std::string text = people.people == 0
                         ? std::string("Nobody has taken part yet")
                         : fmt::format("{} took part", people_phrase(people.people, page.data().simulated));
  if (people.people == 1) text += people.complete == 1 ? ", to the end" : ", not to the end";
  if (people.people > 1) text += fmt::format(", {} of them to the end", people.complete);
  if (study.participants > 0)
    text += fmt::format("; {} planned", study.participants == 1 ? std::string("one was")
                                                                : fmt::format("{} were", study.participants));
  page.stamped_paragraph(text + ".");
  PageTable table;
  table.caption = "People by group.";
  table.headings = {"Group", "Enrolled", "Through"};
  for (std::size_t group = 0; group < people.by_group.size() && people.by_group.size() > 1; ++group)
    table.rows.push_back({condition_name(study, true, group), std::to_string(people.by_group[group]),
                          std::to_string(people.complete_by_group[group])});
  page.table(table);
  write_control(page);
  write_orders(page);
}

void write_scenes(StudyPage& page, const std::vector<ScenePicture>& scenes) {
  if (scenes.empty()) return;
  page.subheading("Scenes");
  for (const ScenePicture& scene : scenes) {
    if (scene.png.empty())
      page.paragraph(fmt::format("A picture of scene '{}' cannot be drawn: {}", scene.scene, scene.why));
    else
      page.picture(scene.png, fmt::format("As figure 6.1: scene '{}' at the start of a trial.", scene.scene));
  }
}

}  // namespace icome::apps
