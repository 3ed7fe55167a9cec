#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace icome::apps {

/// The options of `icome stats`, as the command line gives them; each test uses those that concern it.
struct StatsOptions {
  std::string test;  // the subcommand: "anova"
  std::filesystem::path data;
  std::string response;
  std::vector<std::string> factors, within, measured, columns;
  std::string subject, weight;
  std::string counts;                         // "63,180/16,180": in place of data
  std::vector<double> expected;               // shares
  std::vector<std::string> levels;            // "dose=low,high": the order of a factor's; "dose": of the data
  std::vector<std::string> post_hoc, simple;  // factors whose levels are compared
  std::filesystem::path z_table;              // of describe
  int type = 2;                               // of sums of squares
  bool no_interactions = false;
  bool paired = false;
  bool pooled = false;
  bool yates = false;
  bool welch = false;
  double share = 0.5;  // of the first kind, under the null hypothesis
  std::string method;  // "tukey", "holm"
  std::string alternative = "two-sided";
  double mean = 0.0;
  double confidence = 0.95;

  // For power.
  std::string of;
  double effect = 0.0;
  double count = 0.0;
  double power = 0.0;
  double alpha = 0.05;
  double groups = 2.0;
  double df = 1.0;

  std::filesystem::path plot;
  std::string plot_kind;
  bool json = false;
};

}  // namespace icome::apps
