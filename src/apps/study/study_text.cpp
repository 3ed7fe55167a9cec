#include <fmt/format.h>

#include <algorithm>

#include "apps/stats/stats_text.h"
#include "apps/study/study_report.h"
#include "apps/study/study_words.h"
#include "study/definition/conditions.h"
#include "study/definition/counterbalancing.h"

namespace icome::apps {
namespace {

constexpr std::size_t kMostOrdersShown = 8;

std::string level_names(const std::vector<study::Level>& levels) {
  std::string names;
  for (const study::Level& level : levels) names.append(names.empty() ? "" : ", ").append(level.id);
  return names;
}

/// "ratio, continuous, ms".
std::string kind_text(study::Scale scale, bool discrete, const std::string& unit) {
  std::string text = scale_word(scale);
  const bool has_distances = scale == study::Scale::Interval || scale == study::Scale::Ratio;
  if (has_distances) text += discrete ? ", discrete" : ", continuous";
  return unit.empty() ? text : text.append(", ").append(unit);
}

std::string variables_text(const study::Study& study) {
  std::string text = "\nIndependent variables\n";
  for (const study::IndependentVariable& factor : study.independent)
    text += fmt::format("  {}: {} of {}\n", factor.id, factor.between ? "each person one" : "each person all",
                        level_names(factor.levels));
  text += "\nDependent variables\n";
  for (const study::DependentVariable& variable : study.dependent) {
    const std::string from =
        variable.from.empty() ? ", not measured" : std::string(", from ").append(variable.from);
    const std::string better = variable.better == study::Better::Neither
                                   ? std::string()
                                   : fmt::format(", better {}", better_word(variable.better));
    text += fmt::format("  {}: {}{}{}\n", variable.id,
                        kind_text(variable.scale, variable.discrete, variable.unit), from, better);
  }
  if (!study.control.empty()) text += "\nControl variables\n";
  for (const study::ControlVariable& variable : study.control)
    text +=
        fmt::format("  {}: {}{}\n", variable.id, kind_text(variable.scale, variable.discrete, variable.unit),
                    variable.balanced ? ", balanced over the groups" : "");
  return text;
}

/// The comparison of the answers to a question: ": old > new".
std::string answers_compared(const study::Hypothesis& hypothesis) {
  if (hypothesis.direction != study::Direction::Differ)
    return fmt::format(": {} {} {}", hypothesis.first,
                       hypothesis.direction == study::Direction::Less ? "<" : ">", hypothesis.second);
  if (hypothesis.answers.empty()) return ": one answer more often than the other";
  return fmt::format(": {} and {} not equally often", hypothesis.answers.front(), hypothesis.answers.back());
}

std::string expectation(const study::Hypothesis& hypothesis) {
  if (hypothesis.test == study::Test::Binomial) return hypothesis.dependent + answers_compared(hypothesis);
  if (hypothesis.factor.empty()) return hypothesis.dependent + ": answers differ from equal shares";
  if (hypothesis.direction == study::Direction::Differ)
    return fmt::format("{} differs by {}", hypothesis.dependent, hypothesis.factor);
  return fmt::format("{} by {}: {} {} {}", hypothesis.dependent, hypothesis.factor, hypothesis.first,
                     hypothesis.direction == study::Direction::Less ? "<" : ">", hypothesis.second);
}

std::string hypotheses_text(const study::Study& study) {
  if (study.hypotheses.empty()) return {};
  std::string text = "\nHypotheses\n";
  for (const study::Hypothesis& hypothesis : study.hypotheses)
    text += fmt::format("  {}: {} ({}, \u03b1 = {:g}{})\n", hypothesis.id, expectation(hypothesis),
                        test_word(hypothesis.test), hypothesis.alpha, hypothesis.primary ? ", primary" : "");
  return text;
}

std::string orders_text(const study::Study& study, const study::StudyCheck& check) {
  const auto conditions = study::crossings(study, false);
  std::string text;
  // The orders of one group; they are the same in every group unless drawn at random.
  const bool drawn = study.order == study::OrderMethod::Random;
  const std::size_t shown = std::min(kMostOrdersShown, drawn ? kMostOrdersShown : check.orders);
  for (std::size_t person = 0; person < shown; ++person) {
    std::string order;
    for (const std::size_t condition :
         study::condition_order(study.order, conditions.size(), 0, person, study.seed))
      order.append(order.empty() ? "" : " | ")
          .append(study::crossing_name(study, false, conditions[condition]));
    text += fmt::format("  {}. person: {}\n", person + 1, order);
  }
  return text;
}

std::string design_text(const study::Study& study, const study::StudyCheck& check) {
  std::string text = fmt::format("\nDesign\n  {}:", count_text(check.groups, "group"));
  for (const study::Crossing& group : study::crossings(study, true))
    text += fmt::format(" [{}]", study::crossing_name(study, true, group));
  text += fmt::format("\n  {} for each person, {} order", count_text(check.conditions, "condition"),
                      order_word(study.order));
  if (study.order != study::OrderMethod::Random)
    text += fmt::format(", anew after {} of a group",
                        check.orders == 1 ? std::string("1 person") : fmt::format("{} people", check.orders));
  text += fmt::format("\n{}", orders_text(study, check));
  text += fmt::format("  balanced by a multiple of {} people; {} planned\n", check.balanced_by,
                      study.participants == 0 ? std::string("none") : std::to_string(study.participants));
  text += fmt::format("  {} measured of each person, a session of about {:.0f} minutes\n",
                      count_text(check.trials, "trial"), std::max(1.0, check.session / 60.0));
  return text;
}

std::string findings_text(const char* heading, const std::vector<study::Finding>& findings,
                          const std::string& source) {
  if (findings.empty()) return {};
  std::string text = fmt::format("\n{}\n", heading);
  for (const study::Finding& finding : findings)
    text += finding.place.line == 0 ? fmt::format("  {}\n", finding.sentence)
                                    : fmt::format("  {}:{}:{}: {}\n", source, finding.place.line,
                                                  finding.place.column, finding.sentence);
  return text;
}

}  // namespace

std::string study_text(const study::Study& study, const study::StudyCheck& check, const std::string& source) {
  std::string languages;
  for (const std::string& language : study.languages)
    languages.append(languages.empty() ? "" : ", ").append(language);
  std::string text = fmt::format("{}: {} ({})\n", study.name, study.title.front(), languages);
  text += variables_text(study) + hypotheses_text(study) + design_text(study, check);
  text += findings_text("To think about", check.warnings, source);
  text += findings_text("It cannot be run as it is", check.reasons, source);
  if (check.reasons.empty()) text += "\nIt can be run.\n";
  return without_control_characters(std::move(text));
}

}  // namespace icome::apps
