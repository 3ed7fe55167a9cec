#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "apps/stats/stats_data.h"
#include "apps/stats/stats_report.h"
#include "apps/stats/stats_text.h"
#include "stats/models/power.h"

namespace icome::apps {
namespace {

/// A test whose power is asked for.
struct PowerQuestion {
  std::string name;
  std::string effect_name;  // "d"
  std::string count_name;   // "values in each group"
  double least = 2.0;       // count
  std::function<base::Result<double>(double count)> power;
  std::function<base::Result<std::size_t>(double power)> count;
};

PowerQuestion t_question(stats::TDesign design, const StatsOptions& options) {
  stats::PowerSettings settings;
  settings.alpha = options.alpha;
  settings.alternative = options.alternative == "less"      ? stats::Alternative::Less
                         : options.alternative == "greater" ? stats::Alternative::Greater
                                                            : stats::Alternative::TwoSided;
  PowerQuestion question;
  const bool paired = design == stats::TDesign::Paired, two = design == stats::TDesign::TwoSample;
  question.name = paired ? "Paired t-test" : two ? "T-test of two groups" : "One-sample t-test";
  question.effect_name = paired ? "d_z" : "d";
  question.count_name = paired ? "pairs" : two ? "values in each group" : "values";
  question.power = [=](double n) { return stats::t_test_power(design, n, options.effect, settings); };
  question.count = [=](double power) { return stats::t_test_count(design, options.effect, power, settings); };
  return question;
}

PowerQuestion anova_question(const StatsOptions& options) {
  PowerQuestion question;
  const auto groups = std::size_t(std::max(0.0, options.groups));
  question.name = fmt::format("One-way analysis of variance of {} groups", groups);
  question.effect_name = "f";
  question.count_name = "values in each group";
  question.power = [=](double n) { return stats::anova_power(groups, n, options.effect, options.alpha); };
  question.count = [=](double power) {
    return stats::anova_count(groups, options.effect, power, options.alpha);
  };
  return question;
}

PowerQuestion chi_squared_question(const StatsOptions& options) {
  PowerQuestion question;
  question.name = fmt::format("Chi-squared test, df = {:g}", options.df);
  question.effect_name = "w";
  question.count_name = "counts in all";
  question.power = [=](double n) {
    return stats::chi_squared_power(options.df, n, options.effect, options.alpha);
  };
  question.count = [=](double power) {
    return stats::chi_squared_count(options.df, options.effect, power, options.alpha);
  };
  return question;
}

PowerQuestion question_of(const StatsOptions& options) {
  if (options.of == "anova") return anova_question(options);
  if (options.of == "chisq") return chi_squared_question(options);
  return t_question(options.of == "paired" ? stats::TDesign::Paired
                    : options.of == "one"  ? stats::TDesign::OneSample
                                           : stats::TDesign::TwoSample,
                    options);
}

/// Power over sample size, up to twice the size asked about.
StatsChart power_curve(const PowerQuestion& question, double count, double power) {
  StatsChart chart;
  chart.kind = ChartKind::Curve;
  chart.x_label = question.count_name;
  chart.y_label = "power";
  chart.marks = {{count, power}};
  const double last = std::max(2.0 * count, question.least + 8.0);
  constexpr int kSteps = 160;
  for (int i = 0; i <= kSteps; ++i) {
    const double n = question.least + (last - question.least) * i / kSteps;
    if (const auto value = question.power(n)) chart.points.emplace_back(n, *value);
  }
  return chart;
}

}  // namespace

base::Result<StatsReport> report_power(const StatsOptions& options) {
  if ((options.count > 0.0) == (options.power > 0.0))
    return base::fail("give either --n, to learn the power, or --power, to learn how many are needed.");
  if (!(options.groups >= 0.0 && options.groups <= 1e9) || options.groups != std::floor(options.groups))
    return base::fail(fmt::format("--groups {:g} is no number of groups; give 2 to 1000.", options.groups));
  const PowerQuestion question = question_of(options);
  double count = options.count;
  if (options.power > 0.0) {
    const auto needed = question.count(options.power);
    if (!needed) return tl::unexpected(needed.error());
    count = double(*needed);
  }
  const auto power = question.power(count);
  if (!power) return tl::unexpected(power.error());
  StatsReport report;
  report.json = {{"test", options.of}, {"effect", options.effect}, {"alpha", options.alpha}};
  if (options.of == "anova") report.json["groups"] = options.groups;
  if (options.of == "chisq") report.json["df"] = options.df;
  report.json["n"] = count;
  report.json["power"] = *power;
  const std::string sentence =
      fmt::format("{} = {:g}, \u03b1 = {}, {:g} {}: power {}", question.effect_name, options.effect,
                  share_text(options.alpha, decimals_for(options.alpha, 1)), count, question.count_name,
                  share_text(*power, 3));
  report.text = fmt::format("{}\n\n  {}\n", question.name, sentence);
  if (options.plot.empty()) return report;
  const auto kind = chart_kind(options, {ChartKind::Curve});
  if (!kind) return tl::unexpected(kind.error());
  report.chart = power_curve(question, count, *power);
  report.chart->title = fmt::format("{}: {}", question.name, sentence);
  return report;
}

}  // namespace icome::apps
