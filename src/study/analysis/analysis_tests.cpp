#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stats/models/effect_sizes.h"
#include "stats/models/repeated_measures.h"
#include "stats/tests/contingency.h"
#include "stats/tests/rank_tests.h"
#include "stats/tests/tails.h"
#include "study/analysis/analysis_parts.h"

namespace icome::study {
namespace {

constexpr double kShareConfidence = 0.90;  // of a share of variance: leaves out 0 just where p < .05
constexpr double kConfidence = 0.95;

/// A factor's level in each of some crossings, which have the factor at a place.
stats::Factor factor_over(const IndependentVariable& factor, const std::vector<Crossing>& crossings,
                          std::size_t place) {
  stats::Factor column;
  column.name = factor.id;
  for (const Level& level : factor.levels) column.levels.push_back(level.id);
  for (const Crossing& crossing : crossings) column.of.push_back(int(crossing[place]));
  return column;
}

bool varies(const std::vector<int>& levels) {
  return std::ranges::any_of(levels, [&](int level) { return level != levels.front(); });
}

/// A table as columns of observations, one for each person and condition.
struct Observations {
  std::vector<double> values;
  stats::Factor subject;
  std::vector<stats::Factor> within, between;
};

Observations observations_of(const PersonTable& table) {
  Observations all;
  all.subject.name = " person";  // no id of a variable
  std::vector<Crossing> groups, columns;
  for (std::size_t row = 0; row < table.values.size(); ++row) {
    all.subject.levels.push_back(fmt::format("{}", row));
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
      all.values.push_back(table.values[row][column]);
      all.subject.of.push_back(int(row));
      groups.push_back(table.groups[row]);
      columns.push_back(table.columns[column]);
    }
  }
  for (std::size_t i = 0; i < table.within.size(); ++i)
    all.within.push_back(factor_over(*table.within[i], columns, i));
  // A factor with people of only one level so far says nothing yet.
  for (std::size_t i = 0; i < table.between.size(); ++i)
    if (stats::Factor factor = factor_over(*table.between[i], groups, i); varies(factor.of))
      all.between.push_back(std::move(factor));
  std::erase_if(all.within, [](const stats::Factor& factor) { return factor.levels.size() < 2; });
  return all;
}

void add_share(TestResult& result, double share) {
  result.effect = "partial η²";
  result.effect_size = share;
  result.confidence = kShareConfidence;
  const auto interval =
      stats::partial_eta_sq_interval(result.value, result.df[0], result.df[1], kShareConfidence);
  if (interval) result.effect_interval = stats::ConfidenceInterval{interval->low, interval->high};
}

/// A term of an analysis of variance.
struct Effect {
  std::vector<std::string> factors;  // ids
  Tested test;
  std::optional<stats::Sphericity> sphericity;
};

Tested with_share(TestResult result, double share) {
  if (!std::isfinite(result.value) || !std::isfinite(result.p) || !std::isfinite(share))
    return {{}, "people do not differ in how they differ, so there is nothing to compare with."};
  add_share(result, share);
  return {std::move(result), {}};
}

base::Result<std::vector<Effect>> between_effects(const Observations& observations) {
  const auto anova = stats::factorial_anova(observations.values, observations.between);
  if (!anova) return tl::unexpected(anova.error());
  if (anova->residual.df < 1) return base::fail("there are too few people to compare.");
  std::vector<Effect> effects;
  for (const stats::AnovaTerm& term : anova->terms) {
    Effect effect;
    for (const int factor : term.factors)
      effect.factors.push_back(observations.between[std::size_t(factor)].name);
    TestResult result =
        plain_result(observations.between.size() > 1 ? "factorial ANOVA" : "one-way ANOVA", "F", term.f,
                     {double(term.df), double(anova->residual.df)}, term.p, anova->n);
    result.notes = anova->warnings;
    effect.test = with_share(std::move(result), term.partial_eta_sq);
    effects.push_back(std::move(effect));
  }
  return effects;
}

/// Sets Greenhouse and Geisser's p, and shrinks both degrees of freedom to those that belong to it.
void correct_for_sphericity(TestResult& result, const stats::RepeatedMeasuresTerm& term) {
  const double epsilon = term.sphericity->greenhouse_geisser;
  result.p = term.p_greenhouse_geisser;
  for (double& df : result.df) df *= epsilon;
  result.notes.push_back(fmt::format("P, with its df, is Greenhouse and Geisser's (ε = {:.3f}).", epsilon));
}

base::Result<std::vector<Effect>> repeated_effects(const Observations& observations) {
  const auto anova = stats::repeated_measures_anova(observations.values, observations.subject,
                                                    observations.within, observations.between);
  if (!anova) return tl::unexpected(anova.error());
  std::vector<Effect> effects;
  for (const stats::RepeatedMeasuresTerm& term : anova->terms) {
    Effect effect;
    for (const int factor : term.between)
      effect.factors.push_back(observations.between[std::size_t(factor)].name);
    for (const int factor : term.within)
      effect.factors.push_back(observations.within[std::size_t(factor)].name);
    TestResult result =
        plain_result(observations.between.empty() ? "repeated measures ANOVA" : "mixed ANOVA", "F", term.f,
                     {double(term.df), double(term.error_df)}, term.p, anova->subjects);
    result.notes = anova->warnings;
    if (term.sphericity && std::isfinite(term.p_greenhouse_geisser)) {
      effect.sphericity = term.sphericity;
      correct_for_sphericity(result, term);
    }
    effect.test = with_share(std::move(result), term.partial_eta_sq);
    effects.push_back(std::move(effect));
  }
  return effects;
}

/// All terms of an analysis of variance, of the people who have a number in every condition.
base::Result<std::vector<Effect>> effects_of(const Observations& observations) {
  return observations.within.empty() ? between_effects(observations) : repeated_effects(observations);
}

base::Result<PersonTable> comparable_people(const PersonTable& table) {
  PersonTable complete = complete_rows(table);
  if (complete.people.size() < 2)
    return base::fail(fmt::format("{} a number in every condition; at least two people must have.",
                                  complete.people.empty() ? "nobody has" : "one person has"));
  return complete;
}

}  // namespace

TestResult plain_result(std::string test, std::string statistic, double value, std::vector<double> df,
                        double p, std::size_t people) {
  TestResult result;
  result.test = std::move(test);
  result.statistic = std::move(statistic);
  result.value = value;
  result.df = std::move(df);
  result.p = p;
  result.people = people;
  return result;
}

Tested tested(base::Result<TestResult> result) {
  if (result) return {std::move(*result), {}};
  return {std::nullopt, result.error().message};
}

base::Result<MainEffect> main_effect_with_sphericity(const PersonTable& table,
                                                     const IndependentVariable& factor) {
  const auto complete = comparable_people(table);
  if (!complete) return tl::unexpected(complete.error());
  const Observations observations = observations_of(*complete);
  const auto has = [&](const std::vector<stats::Factor>& factors) {
    return std::ranges::find(factors, factor.id, &stats::Factor::name) != factors.end();
  };
  if (!has(observations.within) && !has(observations.between))
    return base::fail(fmt::format("there are people of one level of {} only.", plain_name(factor)));
  const auto effects = effects_of(observations);
  if (!effects) return tl::unexpected(effects.error());
  const auto effect = std::ranges::find(*effects, std::vector{factor.id}, &Effect::factors);
  if (effect == effects->end()) return base::fail("there are too few people to compare.");
  if (!effect->test.result) return base::fail(effect->test.why);
  return MainEffect{*effect->test.result, effect->sphericity};
}

VarianceAnalysis analyse_variance(const Study& study, const PersonTable& table, std::size_t variable) {
  VarianceAnalysis analysis{variable, {}, {}};
  const auto complete = comparable_people(table);
  if (!complete) {
    analysis.why = complete.error().message;
    return analysis;
  }
  const Observations observations = observations_of(*complete);
  if (observations.within.empty() && observations.between.empty()) {
    analysis.why = "there are people of one group only.";
    return analysis;
  }
  const auto effects = effects_of(observations);
  if (!effects) {
    analysis.why = effects.error().message;
    return analysis;
  }
  for (const Effect& effect : *effects) {
    AnalysisTerm term;
    for (const std::string& id : effect.factors)
      term.factors.push_back(std::size_t(std::ranges::find(study.independent, id, &IndependentVariable::id) -
                                         study.independent.begin()));
    term.test = effect.test;
    analysis.terms.push_back(std::move(term));
  }
  return analysis;
}

std::vector<Interaction> interactions_of(const PersonTable& table, const IndependentVariable& factor) {
  const auto complete = comparable_people(table);
  if (!complete) return {};
  const Observations observations = observations_of(*complete);
  if (observations.within.size() + observations.between.size() < 2) return {};
  const auto effects = effects_of(observations);
  if (!effects) return {};
  std::vector<Interaction> found;
  for (const Effect& effect : *effects) {
    if (effect.factors.size() < 2 || !effect.test.result) continue;
    if (std::ranges::find(effect.factors, factor.id) != effect.factors.end())
      found.push_back({effect.factors, *effect.test.result});
  }
  return found;
}

base::Result<TestResult> main_effect(const PersonTable& table, const IndependentVariable& factor) {
  auto effect = main_effect_with_sphericity(table, factor);
  if (!effect) return tl::unexpected(effect.error());
  return std::move(effect->result);
}

base::Result<TestResult> friedman_of(const std::vector<std::vector<double>>& levels) {
  std::vector<std::vector<double>> rows(levels.empty() ? 0 : levels.front().size());
  for (const std::vector<double>& level : levels)
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].push_back(level[i]);
  const auto test = stats::friedman(rows);
  if (!test) return tl::unexpected(test.error());
  TestResult result =
      plain_result("Friedman's test", "χ²", test->chi_squared, {test->df}, test->p, rows.size());
  result.effect = "Kendall's W";
  result.effect_size = test->kendall_w;
  if (levels.size() == 2) result.direction = test->mean_ranks[0] - test->mean_ranks[1];
  return result;
}

base::Result<TestResult> signed_ranks_of(const std::vector<double>& first, const std::vector<double>& second,
                                         stats::Alternative alternative) {
  stats::RankTestSettings settings;
  settings.alternative = alternative;
  const auto test = stats::signed_rank_test(first, second, settings);
  if (!test) return tl::unexpected(test.error());
  TestResult result =
      plain_result("Wilcoxon's signed rank test", "V", test->statistic, {}, test->p, first.size());
  result.effect = "rank-biserial r";
  result.effect_size = test->rank_biserial;
  result.direction = test->rank_biserial;
  return result;
}

stats::ConfidenceInterval w_interval(double chi_squared, double df, double n) {
  const auto noncentrality = [&](double above) {
    if (stats::chi_squared_above(chi_squared, df) >= above) return 0.0;
    double low = 0.0, high = 4.0 * (chi_squared + df + 10.0);
    for (int i = 0; i < 80; ++i) {
      const double middle = 0.5 * (low + high);
      (stats::noncentral_chi_squared_above(chi_squared, df, middle) < above ? low : high) = middle;
    }
    return 0.5 * (low + high);
  };
  return {std::sqrt(noncentrality(0.5 - 0.5 * kConfidence) / n),
          std::sqrt(noncentrality(0.5 + 0.5 * kConfidence) / n)};
}

base::Result<TestResult> even_shares(const std::vector<std::size_t>& counts) {
  const std::vector<double> numbers(counts.begin(), counts.end());
  double n = 0.0;
  for (const double count : numbers) n += count;
  if (n == 0.0) return base::fail("nobody has answered.");
  const auto test = stats::goodness_of_fit(numbers);
  if (!test) return tl::unexpected(test.error());
  TestResult result =
      plain_result("χ² goodness of fit", "χ²", test->chi_squared, {test->df}, test->p, std::size_t(n));
  result.effect = "Cohen's w";
  result.effect_size = test->w;
  result.effect_interval = w_interval(test->chi_squared, test->df, n);
  if (!test->warning.empty()) result.doubts.push_back(test->warning);
  return result;
}

}  // namespace icome::study
