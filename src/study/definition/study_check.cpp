#include "study/definition/study_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "stats/models/power.h"
#include "study/definition/conditions.h"
#include "study/definition/counterbalancing.h"
#include "study/definition/needs.h"
#include "study/definition/session_length.h"
#include "study/definition/untestable.h"
#include "study/records/trial_table.h"

namespace icome::study {
namespace {

constexpr double kMediumEffect = 0.5;  // Cohen's d
constexpr double kWantedPower = 0.8;
constexpr double kLongSession = 5400.0;  // s

const IndependentVariable* factor_named(const Study& study, const std::string& id) {
  const auto found = std::ranges::find(study.independent, id, &IndependentVariable::id);
  return found == study.independent.end() ? nullptr : &*found;
}

const DependentVariable* dependent_named(const Study& study, const std::string& id) {
  const auto found = std::ranges::find(study.dependent, id, &DependentVariable::id);
  return found == study.dependent.end() ? nullptr : &*found;
}

bool compares_means(Test test) { return test == Test::Anova || test == Test::TTest; }
bool compares_counts(Test test) {
  return test == Test::ChiSquared || test == Test::Fisher || test == Test::McNemar || test == Test::Binomial;
}

/// The reason why a hypothesis's test does not suit its variables; empty if it does.
std::string test_misfit(const Hypothesis& hypothesis, const DependentVariable& dependent,
                        const IndependentVariable* factor) {
  if (hypothesis.test == Test::None) return "has no test; write which one is to decide";
  const bool counted = dependent.scale == Scale::Nominal;
  if (counted && !compares_counts(hypothesis.test))
    return "is about a nominal variable, which has no order; its test should be binomial, chisq, fisher or "
           "mcnemar";
  if (dependent.scale == Scale::Ordinal && compares_means(hypothesis.test))
    return "compares means of an ordinal variable; its test should be one of ranks: wilcoxon, kruskal, "
           "friedman";
  const bool has_direction = hypothesis.direction != Direction::Differ && hypothesis.test != Test::Binomial;
  if (compares_counts(hypothesis.test) && has_direction)
    return "expects less or more of counts of answers, which have no direction; leave `expected` out";
  if (factor == nullptr)
    return hypothesis.test == Test::ChiSquared || hypothesis.test == Test::Binomial
               ? ""
               : "names no factor, which only chisq and binomial go without";
  const bool pairs = hypothesis.test == Test::TTest || hypothesis.test == Test::Wilcoxon;
  if (pairs && factor->levels.size() != 2 && hypothesis.direction == Direction::Differ)
    return fmt::format("compares two levels, and '{}' has {}; write which in `expected`", factor->id,
                       factor->levels.size());
  if (hypothesis.test == Test::Friedman && factor->between)
    return fmt::format("needs the same people under all levels, and '{}' is between; use kruskal",
                       factor->id);
  if (hypothesis.test == Test::Kruskal && !factor->between)
    return fmt::format("needs other people for each level, and '{}' is within; use friedman", factor->id);
  return {};
}

/// Is a hypothesis tested although test_misfit() objects to it?
bool is_tested_anyway(const Hypothesis& hypothesis, const DependentVariable& dependent) {
  return dependent.scale == Scale::Ordinal && compares_means(hypothesis.test);
}

/// The power of a hypothesis's test and the people that it needs; nothing where it is not simple to say.
std::optional<HypothesisPower> power_of(const Study& study, const Hypothesis& hypothesis) {
  const IndependentVariable* const factor = factor_named(study, hypothesis.factor);
  if (factor == nullptr || factor->levels.size() != 2 || !compares_means(hypothesis.test)) return {};
  // An F-test of two levels is a two-sided t-test.
  const bool one_sided = hypothesis.test == Test::TTest && hypothesis.direction != Direction::Differ;
  stats::PowerSettings settings;
  settings.alpha = hypothesis.alpha;
  settings.alternative = one_sided ? stats::Alternative::Greater : stats::Alternative::TwoSided;
  const auto design = factor->between ? stats::TDesign::TwoSample : stats::TDesign::Paired;
  const std::size_t groups = factor->between ? 2 : 1;
  const auto needed = stats::t_test_count(design, kMediumEffect, kWantedPower, settings);
  if (!needed) return {};
  HypothesisPower power{hypothesis.id, kMediumEffect, 0.0, *needed * groups};
  const double count = double(study.participants) / double(groups);
  if (const auto reached = stats::t_test_power(design, count, kMediumEffect, settings))
    power.power = *reached;
  return power;
}

/// Checks one part of a study after the other.
class Checker {
 public:
  explicit Checker(const Study& study) : study_(study) {}

  StudyCheck check() {
    count();
    check_needs();
    check_task();
    check_variables();
    check_hypotheses();
    check_people();
    check_protocol();
    check_questions();
    return std::move(result_);
  }

 private:
  void warn(Place place, std::string sentence) { result_.warnings.push_back({place, std::move(sentence)}); }

  void count() {
    result_.conditions = crossings(study_, false).size();
    result_.groups = crossings(study_, true).size();
    result_.orders = order_count(study_.order, result_.conditions);
    result_.balanced_by = result_.groups * result_.orders;
    result_.trials = result_.conditions * trials_a_condition(study_.trials);
    result_.session = session_length(study_);
  }

  void check_needs() {
    for (const UnmetNeed& need : unmet_needs(study_))
      result_.reasons.push_back(
          {need.place, fmt::format("{} needs {} ({}), which this program does not have yet.", need.of,
                                   need.id, need.what)});
  }

  void check_task() {
    const Trials& trials = study_.trials;
    if (!study_.task)
      result_.reasons.push_back(
          {{}, "there is no [task]: nothing says what is to be done in a trial, as target = \"target\"."});
    std::string bare;
    for (const TrialScene& scene : trials.scenes)
      if (scene.file.empty()) bare.append(bare.empty() ? "'" : ", '").append(scene.id).append("'");
    if (!bare.empty())
      result_.reasons.push_back(
          {trials.scenes.front().place, fmt::format("no file shows what these scenes are: {}.", bare)});
    if (trials.scenes.empty())
      result_.reasons.push_back({{},
                                 "there are no scenes: nothing says where trials take place, as scenes = "
                                 "[{ id = \"room\", file = \"room.wrl\" }]."});
  }

  void check_variables() {
    for (const DependentVariable& variable : study_.dependent) {
      if (variable.from.empty())
        warn(variable.place, fmt::format("nothing measures '{}': write from = \"time\", or the question that "
                                         "tells it, from = \"questionnaire.question\".",
                                         variable.id));
      if (std::ranges::find(study_.hypotheses, variable.id, &Hypothesis::dependent) ==
          study_.hypotheses.end())
        warn(variable.place,
             fmt::format("no hypothesis is about '{}', so nothing will test it.", variable.id));
    }
    if (result_.groups < 2) return;
    if (std::ranges::none_of(study_.control, &ControlVariable::balanced))
      warn({}, "people are spread over groups, and no control variable is balanced over these.");
  }

  void check_hypotheses() {
    if (study_.hypotheses.empty()) warn({}, "there is no hypothesis; they decide the analysis in advance.");
    for (const Hypothesis& hypothesis : study_.hypotheses) {
      const DependentVariable* const dependent = dependent_named(study_, hypothesis.dependent);
      if (dependent == nullptr) continue;
      if (dependent->from.empty())
        warn(hypothesis.place, fmt::format("hypothesis '{}' is about '{}', which nothing measures.",
                                           hypothesis.id, dependent->id));
      const std::string misfit = test_misfit(hypothesis, *dependent, factor_named(study_, hypothesis.factor));
      if (!misfit.empty()) warn(hypothesis.place, fmt::format("hypothesis '{}' {}.", hypothesis.id, misfit));
      const std::string never = why_untestable(study_, hypothesis);
      if (!never.empty() && (misfit.empty() || is_tested_anyway(hypothesis, *dependent)))
        warn(hypothesis.place, fmt::format("hypothesis '{}' cannot be tested: {}.", hypothesis.id, never));
      if (never.empty()) advise_on_shares(hypothesis, *dependent);
      if (const auto power = power_of(study_, hypothesis)) result_.powers.push_back(*power);
    }
  }

  /// Warns that a few people who give one of three answers are enough for unequal shares.
  void advise_on_shares(const Hypothesis& hypothesis, const DependentVariable& dependent) {
    ItemPlace place;
    if (hypothesis.test != Test::ChiSquared || !hypothesis.factor.empty()) return;
    if (!find_item(study_, dependent.from, place)) return;
    const Item& item = study_.questionnaires[place.questionnaire].items[place.item];
    if (item.choices.size() < 3) return;
    warn(hypothesis.place,
         fmt::format("hypothesis '{}' asks whether all {} answers are given equally often, which is refuted "
                     "where few give one of them; to hold two against each other write test = \"binomial\" "
                     "and answers = [\"{}\", \"{}\"].",
                     hypothesis.id, item.choices.size(), item.choices.front().id, item.choices.back().id));
  }

  void check_people() {
    if (study_.participants == 0)
      return warn({}, fmt::format("it is not said how many people take part; write participants = a multiple "
                                  "of {}.",
                                  result_.balanced_by));
    if (study_.participants % result_.balanced_by != 0)
      warn({}, fmt::format("{} people do not balance the design: choose a multiple of {} ({} group{}, {} "
                           "order{} each).",
                           study_.participants, result_.balanced_by, result_.groups,
                           result_.groups == 1 ? "" : "s", result_.orders, result_.orders == 1 ? "" : "s"));
    if (study_.order == OrderMethod::Fixed && result_.conditions > 1)
      warn({}, "everybody has the conditions in the same order, so learning looks like an effect of them.");
    for (const HypothesisPower& power : result_.powers)
      if (power.power < kWantedPower && is_first_of_its_power(power)) warn_of_power(power);
  }

  /// Hypotheses about the same factor mostly have the same power, which is reported once.
  bool is_first_of_its_power(const HypothesisPower& power) const {
    const auto first = std::ranges::find(result_.powers, power.needed, &HypothesisPower::needed);
    return &*first == &power;
  }

  void warn_of_power(const HypothesisPower& power) {
    std::string names;
    for (const HypothesisPower& other : result_.powers)
      if (other.needed == power.needed)
        names.append(names.empty() ? "'" : ", '").append(other.hypothesis).append("'");
    // A primary hypothesis is decided by its plain P, as is one that is alone beside it.
    const bool adjusted = std::ranges::count(study_.hypotheses, false, &Hypothesis::primary) > 1;
    warn({},
         fmt::format(
             "{} people find a medium effect (d = {:g}) with power {:.2f}, {} would with {:g}: "
             "{}.{}",
             study_.participants, power.effect, power.power, power.needed, kWantedPower, names,
             adjusted ? " That is by plain P; Holm's adjustment for several hypotheses asks for more." : ""));
  }

  void check_protocol() {
    if (study_.consent.empty()) warn({}, "there is no consent text; people must know what they agree to.");
    if (study_.goal.empty()) warn({}, "there is no goal that participants are told.");
    if (study_.instructions.empty())
      warn({}, "there are no written instructions, so not all people will be told the same.");
    if (study_.trials.practice == 0 && !study_.trials.criterion)
      warn({}, "nobody practises, so the first trials will measure how people learn the task.");
    if (result_.session > kLongSession)
      warn({},
           fmt::format("a session takes about {:.0f} minutes, which tires people.", result_.session / 60));
  }

  /// Closed questions can be analysed, open ones explain unexpected results (thesis 6.3.4).
  void check_questions() {
    bool open = false, closed = false;
    for (const Questionnaire& questionnaire : study_.questionnaires)
      for (const Item& item : questionnaire.items) (item.kind == ItemKind::OpenText ? open : closed) = true;
    if (!open) warn({}, "there is no open question, which could explain results that are not expected.");
    if (!closed) warn({}, "there is no closed question, whose answers could be analysed.");
  }

  const Study& study_;
  StudyCheck result_;
};

}  // namespace

StudyCheck check_study(const Study& study) { return Checker(study).check(); }

}  // namespace icome::study
