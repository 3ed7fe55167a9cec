#include <CLI/CLI.hpp>

#include "apps/stats/stats_command.h"
#include "apps/stats/stats_help.h"

namespace icome::apps {
namespace {

/// Adds an option that may be given several times, each time with one value.
void add_names(CLI::App& command, const char* name, std::vector<std::string>& into, const char* help) {
  command.add_option(name, into, help)->type_name("COLUMN")->expected(1)->take_all()->allow_extra_args(false);
}

void add_data(CLI::App& command, StatsOptions& options) {
  command.add_option("DATA", options.data, "A table: .csv, .tsv, or .dat as NIST's reference datasets are")
      ->required()
      ->type_name("");
}

void add_output(CLI::App& command, StatsOptions& options, const char* kinds) {
  command.add_option("--plot", options.plot, "Draw it: .svg, or .png of 1920x1280 pixels")
      ->type_name("OUT.svg|png");
  command.add_option("--plot-kind", options.plot_kind, "How it is drawn (default: the first)")
      ->type_name(kinds);
  command.add_flag("--json", options.json, "Print the result as JSON (fields: icome stats --help)");
}

void add_levels(CLI::App& command, StatsOptions& options) {
  command
      .add_option(
          "--levels", options.levels,
          "The order of a factor's levels, each named: dose=low,mid,high; or dose alone: as they come "
          "in the data (default: numbers ascending, texts as they come)")
      ->type_name("COLUMN=A,B,...")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
}

void add_confidence(CLI::App& command, StatsOptions& options) {
  command.add_option("--confidence", options.confidence, "Of intervals (default 0.95)")->type_name("SHARE");
}

void add_alternative(CLI::App& command, StatsOptions& options) {
  command
      .add_option("--alternative", options.alternative,
                  "What is held against \"no difference\": that the first is less or greater (default "
                  "two-sided)")
      ->type_name("two-sided|less|greater")
      ->check(CLI::IsMember({"two-sided", "less", "greater"}));
}

/// Adds options for a response by the levels of a factor, or for one column a group.
void add_groups(CLI::App& command, StatsOptions& options, bool matched) {
  command.add_option("--response", options.response, "What was measured")->type_name("COLUMN");
  add_names(command, "--factor", options.factors, "Whose levels are the groups");
  add_names(command, "--column", options.columns,
            "In place of both: columns that are the groups, each of them");
  add_levels(command, options);
  if (!matched) return;
  command.add_option("--subject", options.subject, "Whose values belong together, with --response")
      ->type_name("COLUMN");
}

CLI::App& add_test(CLI::App& stats, StatsOptions& options, const char* name, const char* summary) {
  CLI::App& command = *stats.add_subcommand(name, summary);
  command.callback([&options, name] { options.test = name; });
  command.footer("Examples, fields of JSON and exit codes: icome stats --help. Method: docs/statistics.md.");
  return command;
}

void add_describe(CLI::App& stats, StatsOptions& options) {
  CLI::App& command = add_test(stats, options, "describe", kDescribeSummary);
  add_data(command, options);
  add_names(command, "--column", options.columns,
            "What to describe; several times (default: all of numbers)");
  command.add_option("--response", options.response, "The same")->type_name("COLUMN");
  add_names(command, "--factor", options.factors, "Describe each of its levels");
  add_levels(command, options);
  command
      .add_option(
          "--z", options.z_table,
          "Write the table with a column of z scores beside it for each that is described: how many SD "
          "a value is from the mean (of its level, with --factor)")
      ->type_name("OUT.csv|tsv");
  add_confidence(command, options);
  add_output(command, options, "box|bars");
}

void add_anova(CLI::App& stats, StatsOptions& options) {
  CLI::App& command = add_test(stats, options, "anova", kAnovaSummary);
  add_data(command, options);
  command.add_option("--response", options.response, "What was measured")->type_name("COLUMN");
  add_names(command, "--factor", options.factors, "A factor between subjects; several times for several");
  add_names(command, "--within", options.within,
            "A factor within subjects (repeated measures); several times for several");
  command.add_option("--subject", options.subject, "Who was measured repeatedly")->type_name("COLUMN");
  add_names(command, "--measured", options.measured,
            "Of the factors between subjects, one that people have (gender) and nobody set");
  command.add_option("--type", options.type, "Of the sums of squares where cells are unequal (default 2)")
      ->type_name("1|2|3")
      ->check(CLI::IsMember({1, 2, 3}));
  add_names(command, "--post-hoc", options.post_hoc,
            "With --within: which levels of this factor differ, averaged over all else, by t-tests of pairs "
            "(paired for --within, Welch's for --factor) after Holm");
  add_names(command, "--simple", options.simple,
            "With --within: the simple effects of this factor, alone at each combination of levels of the "
            "others, and its pairs there, each after Holm. For a factor in a significant interaction");
  add_levels(command, options);
  command.add_flag("--no-interactions", options.no_interactions, "Main effects of --factor only");
  command.add_flag("--welch", options.welch, "Of one factor: Welch's test beside it, for unequal variances");
  add_confidence(command, options);
  add_output(command, options, "box|interaction|bars");
}

void add_t_test(CLI::App& stats, StatsOptions& options) {
  CLI::App& command = add_test(stats, options, "ttest", kTTestSummary);
  add_data(command, options);
  add_groups(command, options, true);
  command.add_flag("--paired", options.paired, "The two values of a --subject, or of a row, belong together");
  command.add_flag("--pooled", options.pooled, "Take the variances as equal (default: Welch's test)");
  command.add_option("--mean", options.mean, "Test against this mean, or difference (default 0)")
      ->type_name("VALUE");
  add_alternative(command, options);
  add_confidence(command, options);
  add_output(command, options, "box|bars");
}

void add_rank_tests(CLI::App& stats, StatsOptions& options) {
  CLI::App& wilcoxon = add_test(stats, options, "wilcoxon", kWilcoxonSummary);
  add_data(wilcoxon, options);
  add_groups(wilcoxon, options, true);
  wilcoxon.add_flag("--paired", options.paired, "Signed ranks: the two values of a --subject, or of a row");
  wilcoxon.add_option("--mean", options.mean, "Test against this difference (default 0)")->type_name("VALUE");
  add_alternative(wilcoxon, options);
  add_output(wilcoxon, options, "box|bars");
  CLI::App& kruskal = add_test(stats, options, "kruskal", kKruskalSummary);
  add_data(kruskal, options);
  add_groups(kruskal, options, false);
  add_output(kruskal, options, "box|bars");
  CLI::App& friedman = add_test(stats, options, "friedman", kFriedmanSummary);
  add_data(friedman, options);
  add_groups(friedman, options, true);
  add_output(friedman, options, "box|bars");
}

void add_counts(CLI::App& command, StatsOptions& options) {
  command.add_option("DATA", options.data, "A table: .csv, .tsv; or --counts in its place")->type_name("");
  add_names(command, "--factor", options.factors, "What is counted; a second one is told by columns");
  command.add_option("--weight", options.weight, "How often a row counts (default: once)")
      ->type_name("COLUMN");
  add_levels(command, options);
  command.add_option("--counts", options.counts, "The counts themselves, rows parted by /")
      ->type_name("63,180/16,180");
}

void add_count_tests(CLI::App& stats, StatsOptions& options) {
  CLI::App& chi_squared = add_test(stats, options, "chisq", kChiSquaredSummary);
  add_counts(chi_squared, options);
  chi_squared.add_option("--expected", options.expected, "Of one factor: shares, such as 0.5,0.25,0.25")
      ->type_name("SHARES")
      ->delimiter(',');
  chi_squared.add_flag("--yates", options.yates, "Yates's correction of 2 x 2 counts");
  add_output(chi_squared, options, "shares");
  CLI::App& fisher = add_test(stats, options, "fisher", kFisherSummary);
  add_counts(fisher, options);
  add_alternative(fisher, options);
  add_confidence(fisher, options);
  add_output(fisher, options, "shares");
  CLI::App& binomial = add_test(stats, options, "binomial", kBinomialSummary);
  add_counts(binomial, options);
  binomial
      .add_option("--share", options.share,
                  "What the share of the first kind is tested against (default 0.5)")
      ->type_name("SHARE");
  add_alternative(binomial, options);
  add_confidence(binomial, options);
  add_output(binomial, options, "shares");
  CLI::App& mcnemar = add_test(stats, options, "mcnemar", kMcNemarSummary);
  add_counts(mcnemar, options);
  mcnemar.add_flag("--yates", options.yates,
                   "Yates's correction of 2 x 2 counts, as R's default is; the exact p is told either way");
  add_output(mcnemar, options, "shares");
}

void add_correlations(CLI::App& stats, StatsOptions& options) {
  for (const auto& [name, summary] :
       {std::pair("pearson", kPearsonSummary), {"spearman", kSpearmanSummary}}) {
    CLI::App& command = add_test(stats, options, name, summary);
    add_data(command, options);
    add_names(command, "--column", options.columns,
              "Two, or more for a matrix (default: all columns of numbers)");
    add_alternative(command, options);
    add_confidence(command, options);
    add_output(command, options, "scatter|matrix");
  }
}

void add_post_hoc(CLI::App& stats, StatsOptions& options) {
  CLI::App& command = add_test(stats, options, "tukey", kTukeySummary);
  add_data(command, options);
  add_groups(command, options, true);
  command.add_option("--method", options.method, "Tukey's test, or t-tests after Holm (default tukey)")
      ->type_name("tukey|holm")
      ->check(CLI::IsMember({"tukey", "holm"}));
  command.add_flag("--paired", options.paired,
                   "With holm: the values of a --subject, or of a row, belong together");
  add_confidence(command, options);
  add_output(command, options, "bars|box");
}

void add_power(CLI::App& stats, StatsOptions& options) {
  CLI::App& command = add_test(stats, options, "power", kPowerSummary);
  command.add_option("TEST", options.of, "ttest (two groups), paired, one, anova or chisq")
      ->required()
      ->type_name("")
      ->check(CLI::IsMember({"ttest", "paired", "one", "anova", "chisq"}));
  command
      .add_option("--effect", options.effect,
                  "Cohen's d (of pairs d_z), of anova f, of chisq w; for instance 0.5, 0.25, 0.3: medium")
      ->required()
      ->type_name("SIZE");
  command.add_option("--n", options.count, "How many: in each group, pairs, or counts in all")
      ->type_name("COUNT");
  command.add_option("--power", options.power, "In place of --n: tells how many are needed for it")
      ->type_name("SHARE");
  command.add_option("--alpha", options.alpha, "Level of significance (default 0.05)")->type_name("SHARE");
  command.add_option("--groups", options.groups, "Of anova (default 2)")->type_name("COUNT");
  command.add_option("--df", options.df, "Of chisq (default 1)")->type_name("COUNT");
  add_alternative(command, options);
  add_output(command, options, "curve");
}

}  // namespace

void add_stats_options(CLI::App& stats, StatsOptions& options) {
  stats.require_subcommand(1);
  stats.footer(kStatsExamples);
  add_describe(stats, options);
  add_anova(stats, options);
  add_t_test(stats, options);
  add_rank_tests(stats, options);
  add_count_tests(stats, options);
  add_correlations(stats, options);
  add_post_hoc(stats, options);
  add_power(stats, options);
}

}  // namespace icome::apps
