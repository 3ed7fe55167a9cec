// Measures the cost of analyses of variance: ours, the sums of textbooks and R, on the same files in the same
// run; and the number of digits of NIST's certified F that each of them gets right.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "measure.h"
#include "places.h"
#include "stats/models/anova.h"
#include "stats/models/repeated_measures.h"
#include "stats_peer.h"
#include "stats_samples.h"
#include "textbook_sums.h"

namespace icome::benchmarks {
namespace {

namespace fs = std::filesystem;

struct StatsExtent {
  int rows = 1'000'000;
  int subjects = 1000;
  int stratum_subjects = 100;  // what R's strata of error can do in a few seconds
  int repeats = 5;
};

/// An analysis to be measured: its sample, and the ways to compute it.
struct StatsFigure {
  std::string title;
  StatsSample sample;
  std::function<FValues(const StatsSample&)> ours, textbook;
  std::string peer;       // R's analysis, as in stats_peer.R
  std::string peer_call;  // its name for a reader
};

/// The value of a result that cannot fail, unless the benchmark is wrong.
template <typename Value>
Value stats_must(base::Result<Value> result) {
  if (!result) std::abort();
  return std::move(*result);
}

template <typename Terms>
FValues f_of(const Terms& terms) {
  FValues f;
  for (const auto& term : terms) f[term.term] = term.f;
  return f;
}

FValues our_one_way(const StatsSample& sample) {
  return f_of(stats_must(stats::one_way_anova(sample.values, sample.factors[0])).terms);
}

FValues our_factorial(const StatsSample& sample) {
  return f_of(stats_must(stats::factorial_anova(sample.values, sample.factors)).terms);
}

FValues our_repeated(const StatsSample& sample) {
  const std::span<const stats::Factor> factors = sample.factors;
  const auto analysis =
      stats_must(stats::repeated_measures_anova(sample.values, factors.front(), factors.subspan(1)));
  return f_of(analysis.terms);
}

/// Number of digits to which two numbers agree; 15 at most, the precision of a double.
double common_digits(double value, double expected) {
  const double error = std::abs(value - expected) / std::abs(expected);
  if (!(error > 1e-15)) return 15.0;
  return std::max(0.0, -std::log10(error));
}

/// The least number of common digits over all terms.
double common_digits(const FValues& values, const FValues& expected) {
  double digits = 15.0;
  for (const auto& [term, f] : expected) {
    const auto found = values.find(term);
    digits = std::min(digits, found == values.end() ? 0.0 : common_digits(found->second, f));
  }
  return digits;
}

std::string beside_peer(double seconds, double peer) { return fmt::format("{:.2g} of R", seconds / peer); }

std::string digits_as_ours(const FValues& f, const FValues& ours) {
  return fmt::format("F as ours to {:.0f} digits", std::floor(common_digits(f, ours)));
}

void print_row(const std::string& name, double seconds, const std::vector<std::string>& notes) {
  fmt::print("{:<44} {:>10.1f} ms", name, seconds * 1e3);
  for (const std::string& note : notes) fmt::print("{}{}", &note == &notes.front() ? "  " : ", ", note);
  fmt::print("\n");
}

void print_figure(const StatsFigure& figure, const fs::path& file, int repeats) {
  write_sample(figure.sample, file);
  StatsSample read;
  FValues ours, textbook;
  const double reading = median_seconds(repeats, [&] { read = read_sample(file); });
  const double computing = median_seconds(repeats, [&] { ours = figure.ours(read); });
  const double plain = median_seconds(repeats, [&] { textbook = figure.textbook(read); });
  const auto peer = ask_peer(figure.peer, file, repeats);

  fmt::print("-- {}\n", figure.title);
  const std::string beside_textbook = fmt::format("{:.1f} of textbook sums", computing / plain);
  if (!peer) {
    print_row("reading CSV, ours", reading, {});
    print_row("analysis, ours", computing, {beside_textbook});
    print_row("analysis, textbook sums", plain, {digits_as_ours(textbook, ours)});
    fmt::print("{:<44} {}\n", "R",
               has_peer() ? "failed; its message is above"
                          : "not compared: R is not installed (package r-base-core)");
    return;
  }
  print_row("reading CSV, ours", reading, {beside_peer(reading, peer->read)});
  print_row("reading CSV, R's read.csv", peer->read, {});
  print_row("analysis, ours", computing, {beside_peer(computing, peer->compute), beside_textbook});
  print_row("analysis, textbook sums", plain,
            {beside_peer(plain, peer->compute), digits_as_ours(textbook, ours)});
  print_row(fmt::format("analysis, R's {}", figure.peer_call), peer->compute,
            {digits_as_ours(peer->f, ours)});
}

void print_figures(const StatsExtent& extent, const fs::path& file) {
  const std::vector<StatsFigure> figures = {
      {fmt::format("one-way, {} rows, 10 levels", extent.rows), one_way_sample(extent.rows), our_one_way,
       textbook_one_way, "one", "aov"},
      {fmt::format("3 x 4 design, {} rows in unequal cells, type II", extent.rows),
       factorial_sample(extent.rows), our_factorial, textbook_factorial, "two", "lm, twice"},
      {fmt::format("repeated measures, {} subjects x 3 x 4 conditions", extent.subjects),
       repeated_sample(extent.subjects), our_repeated, textbook_repeated, "wide", "anova of a wide lm"},
      {fmt::format("repeated measures, {} subjects x 3 x 4 conditions", extent.stratum_subjects),
       repeated_sample(extent.stratum_subjects), our_repeated, textbook_repeated, "strata", "aov with Error"},
  };
  for (const StatsFigure& figure : figures) print_figure(figure, file, extent.repeats);
}

/// Prints digits of NIST's certified F; in its harder sets, squares of values are filled by shared digits.
void print_certified_digits() {
  const fs::path folder = places::shared_data() / "stats" / "nist-strd-anova";
  if (!fs::exists(folder)) {
    fmt::print("-- digits of NIST's certified F: its data sets are not beside the project\n");
    return;
  }
  const std::pair<const char*, double> sets[] = {{"SiRstv", 1.18046237440255},
                                                 {"SmLs01", 21.0},
                                                 {"SmLs02", 201.0},
                                                 {"SmLs03", 2001.0},
                                                 {"SmLs04", 21.0}};
  fmt::print("-- digits of NIST's certified F\n{:<10} {:>8} {:>10} {:>16} {:>8}\n", "", "rows", "ours",
             "textbook sums", "R's aov");
  for (const auto& [name, certified] : sets) {
    const fs::path file = folder / fmt::format("{}.dat", name);
    const StatsSample sample = read_sample(file);
    const auto digits = [&](const FValues& f) { return common_digits(f.begin()->second, certified); };
    const auto peer = ask_peer("nist", file, 1);
    fmt::print("{:<10} {:>8} {:>10.1f} {:>16.1f} {:>8}\n", name, sample.values.size(),
               digits(our_one_way(sample)), digits(textbook_one_way(sample)),
               peer ? fmt::format("{:.1f}", digits(peer->f)) : "-");
  }
}

}  // namespace
}  // namespace icome::benchmarks

int main(int argc, char** argv) {
  using namespace icome::benchmarks;
  StatsExtent extent;
  CLI::App app("Measures what analyses of variance cost");
  bool quick = false;
  app.add_flag("--quick", quick, "Small samples, to see that it runs");
  app.add_option("--repeats", extent.repeats, "Of which the median is told")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  if (quick) extent = {.rows = 2000, .subjects = 20, .stratum_subjects = 10, .repeats = 1};
  const fs::path file = fs::temp_directory_path() / fmt::format("icome-stats-benchmark-{}.csv", ::getpid());
  print_figures(extent, file);
  fs::remove(file);
  print_certified_digits();
  return 0;
}
