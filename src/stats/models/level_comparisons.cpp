#include "stats/models/level_comparisons.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "stats/models/anova.h"
#include "stats/models/post_hoc.h"
#include "stats/models/repeated_measures.h"
#include "stats/tables/sample_check.h"
#include "stats/tables/subject_table.h"
#include "stats/tables/sums.h"
#include "stats/tests/t_tests.h"

namespace icome::stats {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kMostTests = 10000.0;

/// The place of a factor in a table.
struct Role {
  bool within = false;
  std::size_t place = 0;
};

const Factor& factor_at(const SubjectTable& table, Role role) {
  return role.within ? table.within[role.place] : table.between[role.place];
}

/// The levels of the within factors in a column; the last factor's run fastest over the columns.
std::vector<int> levels_of_column(const SubjectTable& table, Eigen::Index column) {
  std::vector<int> levels(table.within.size());
  for (std::size_t i = levels.size(); i-- > 0;) {
    const auto count = static_cast<Eigen::Index>(table.within[i].levels.size());
    levels[i] = static_cast<int>(column % count);
    column /= count;
  }
  return levels;
}

/// A table seen from one factor: its levels in slices by the other factors.
class SlicedTable {
 public:
  SlicedTable(const SubjectTable& table, Role factor, double largest)
      : table_(table), factor_(factor), rounding_(1e-13 * largest) {
    for (std::size_t i = 0; i < table.within.size(); ++i)
      if (!factor.within || i != factor.place) others_.push_back({true, i});
    for (std::size_t i = 0; i < table.between.size(); ++i)
      if (factor.within || i != factor.place) others_.push_back({false, i});
    for (Eigen::Index column = 0; column < table.means.cols(); ++column)
      columns_.push_back(levels_of_column(table, column));
  }

  const std::vector<Role>& others() const { return others_; }

  /// All combinations of levels of the other factors.
  std::vector<std::vector<int>> combinations() const {
    std::vector<std::vector<int>> all = {{}};
    for (const Role& role : others_) {
      std::vector<std::vector<int>> longer;
      for (const std::vector<int>& levels : all) {
        for (std::size_t level = 0; level < factor_at(table_, role).levels.size(); ++level) {
          longer.push_back(levels);
          longer.back().push_back(static_cast<int>(level));
        }
      }
      all = std::move(longer);
    }
    return all;
  }

  /// For each level of the factor, the means of the people who are in the slice; for a within factor the
  /// same people in the same order.
  std::vector<std::vector<double>> samples(const std::vector<int>& at) const {
    std::vector<std::vector<double>> result(factor_at(table_, factor_).levels.size());
    for (std::size_t level = 0; level < result.size(); ++level) {
      const std::vector<Eigen::Index> columns = columns_at(at, static_cast<int>(level));
      for (Eigen::Index row = 0; row < table_.means.rows(); ++row) {
        if (!is_row_at(row, at, static_cast<int>(level))) continue;
        std::vector<double> cells;
        for (const Eigen::Index column : columns) cells.push_back(table_.means(row, column));
        result[level].push_back(mean(cells));
      }
    }
    return result;
  }

  /// Do the values differ by no more than their rounding?
  bool is_constant(const std::vector<double>& values) const {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return values.empty() || *most - *least <= rounding_;
  }

 private:
  std::vector<Eigen::Index> columns_at(const std::vector<int>& at, int level) const {
    std::vector<Eigen::Index> columns;
    for (std::size_t column = 0; column < columns_.size(); ++column) {
      bool fits = !factor_.within || columns_[column][factor_.place] == level;
      for (std::size_t i = 0; i < at.size(); ++i)
        if (others_[i].within) fits = fits && columns_[column][others_[i].place] == at[i];
      if (fits) columns.push_back(static_cast<Eigen::Index>(column));
    }
    return columns;
  }

  bool is_row_at(Eigen::Index row, const std::vector<int>& at, int level) const {
    const auto of = static_cast<std::size_t>(row);
    bool fits = factor_.within || table_.between[factor_.place].of[of] == level;
    for (std::size_t i = 0; i < at.size(); ++i)
      if (!others_[i].within) fits = fits && table_.between[others_[i].place].of[of] == at[i];
    return fits;
  }

  const SubjectTable& table_;
  Role factor_;
  double rounding_;
  std::vector<Role> others_;
  std::vector<std::vector<int>> columns_;
};

LevelPair pair_of(const SlicedTable& table, const std::vector<std::vector<double>>& samples,
                  std::size_t first, std::size_t second, bool within, double confidence) {
  LevelPair pair{first, second, kNaN, kNaN, kNaN, kNaN, kNaN, {kNaN, kNaN}, kNaN, {kNaN, kNaN}, {}};
  const std::vector<double>&one = samples[first], &other = samples[second];
  if (!one.empty() && !other.empty()) pair.difference = mean(other) - mean(one);
  std::vector<double> differences;
  for (std::size_t i = 0; within && i < one.size(); ++i) differences.push_back(other[i] - one[i]);
  if (one.size() < 2 || other.size() < 2) {
    pair.why = "fewer than two people";
  } else if (within ? table.is_constant(differences) : table.is_constant(one) && table.is_constant(other)) {
    pair.why = within ? "everybody differs by the same" : "people do not vary";
  }
  if (!pair.why.empty()) return pair;
  TTestSettings settings;
  settings.confidence = confidence;
  const auto test = within ? paired_t_test(other, one, settings) : welch_t_test(other, one, settings);
  if (!test) {
    pair.why = test.error().message;
    return pair;
  }
  pair.difference = test->difference;
  pair.t = test->t;
  pair.df = test->df;
  pair.p = test->p;
  pair.interval = test->interval;
  pair.d = test->d;
  pair.d_interval = test->d_interval;
  return pair;
}

/// The samples as one column, with the level of each value.
struct LongSamples {
  std::vector<double> values;
  Factor factor{"factor", {}, {}, false}, subject{"subject", {}, {}, false};
};

LongSamples long_samples(const std::vector<std::vector<double>>& samples) {
  LongSamples all;
  for (std::size_t level = 0; level < samples.size(); ++level) {
    all.factor.levels.push_back(std::to_string(level));
    for (std::size_t i = 0; i < samples[level].size(); ++i) {
      all.values.push_back(samples[level][i]);
      all.factor.of.push_back(static_cast<int>(level));
      all.subject.of.push_back(static_cast<int>(i));
      if (level == 0) all.subject.levels.push_back(std::to_string(i));
    }
  }
  return all;
}

void test_same_people(LevelSlice& slice, const std::vector<std::vector<double>>& samples) {
  const LongSamples all = long_samples(samples);
  const auto anova = repeated_measures_anova(all.values, all.subject, std::span(&all.factor, 1));
  if (!anova) {
    slice.why = "fewer than two people";
    return;
  }
  const RepeatedMeasuresTerm& term = anova->terms.front();
  if (term.error_ss == 0.0) {
    slice.why = "everybody differs by the same";
    return;
  }
  if (term.sphericity) slice.epsilon = term.sphericity->greenhouse_geisser;
  slice.f = term.f;
  slice.df = slice.epsilon * term.df;
  slice.error_df = slice.epsilon * term.error_df;
  slice.p = term.p_greenhouse_geisser;
  slice.eta_sq = term.partial_eta_sq;
}

void test_different_people(const SlicedTable& table, LevelSlice& slice,
                           const std::vector<std::vector<double>>& samples) {
  for (const std::vector<double>& sample : samples) {
    if (sample.size() < 2) slice.why = "fewer than two people of a level";
    if (slice.why.empty() && table.is_constant(sample)) slice.why = "people of a level do not vary";
  }
  if (!slice.why.empty()) return;
  const LongSamples all = long_samples(samples);
  const auto welch = welch_anova(all.values, all.factor);
  const auto shares = one_way_anova(all.values, all.factor);
  if (!welch || !shares) {
    slice.why = (welch ? shares.error() : welch.error()).message;
    return;
  }
  slice.f = welch->f;
  slice.df = welch->df;
  slice.error_df = welch->error_df;
  slice.p = welch->p;
  slice.eta_sq = shares->terms.front().eta_sq;
}

void adjust_all(std::vector<LevelSlice>& slices) {
  std::vector<double> effects, pairs;
  for (const LevelSlice& slice : slices) {
    effects.push_back(slice.p);
    for (const LevelPair& pair : slice.pairs) pairs.push_back(pair.p);
  }
  const std::vector<double> of_effects = holm(effects), of_pairs = holm(pairs);
  std::size_t at = 0;
  for (std::size_t i = 0; i < slices.size(); ++i) {
    slices[i].p_holm = of_effects[i];
    for (LevelPair& pair : slices[i].pairs) pair.p_holm = of_pairs[at++];
  }
}

Factor named_only(const Factor& factor) { return {factor.name, factor.levels, {}, factor.measured}; }

base::Result<Role> role_of(const SubjectTable& table, const std::string& name) {
  for (std::size_t i = 0; i < table.within.size(); ++i)
    if (table.within[i].name == name) return Role{true, i};
  for (std::size_t i = 0; i < table.between.size(); ++i)
    if (table.between[i].name == name) return Role{false, i};
  return base::fail(fmt::format("'{}' is no factor of this analysis: name one of its factors", name));
}

}  // namespace

base::Result<LevelComparisons> compare_levels(std::span<const double> values, const Factor& subject,
                                              std::span<const Factor> within, std::span<const Factor> between,
                                              const std::string& name, Slicing slicing, double confidence) {
  if (const auto bad = confidence_complaint("comparisons of levels", confidence)) return tl::unexpected(*bad);
  const auto people = subject_table(values, subject, within, between);
  if (!people) return tl::unexpected(people.error());
  const auto role = role_of(*people, name);
  if (!role) return tl::unexpected(role.error());
  double largest = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  const SlicedTable table(*people, *role, largest);
  LevelComparisons result;
  result.factor = named_only(factor_at(*people, *role));
  result.within = role->within;
  result.warnings = people->warnings;
  const std::size_t levels = result.factor.levels.size();
  double slices = 1.0;
  for (const Role& other : table.others()) {
    result.others.push_back(named_only(factor_at(*people, other)));
    if (slicing == Slicing::EveryOther) slices *= static_cast<double>(result.others.back().levels.size());
  }
  const double pairs = 0.5 * static_cast<double>(levels) * static_cast<double>(levels - 1);
  if (slices * (1.0 + pairs) > kMostTests)
    return base::fail(fmt::format("'{}' would be compared {} times, which is too many: leave out factors",
                                  name, slices * (1.0 + pairs)));
  const std::vector<std::vector<int>> all =
      slicing == Slicing::None ? std::vector<std::vector<int>>{{}} : table.combinations();
  for (const std::vector<int>& at : all) {
    const std::vector<std::vector<double>> samples = table.samples(at);
    LevelSlice slice{at, 0, kNaN, kNaN, kNaN, 1.0, kNaN, kNaN, kNaN, {}, {}};
    for (const std::vector<double>& sample : samples)
      slice.subjects = role->within ? sample.size() : slice.subjects + sample.size();
    if (role->within)
      test_same_people(slice, samples);
    else
      test_different_people(table, slice, samples);
    for (std::size_t first = 0; first < levels; ++first)
      for (std::size_t second = first + 1; second < levels; ++second)
        slice.pairs.push_back(pair_of(table, samples, first, second, role->within, confidence));
    result.slices.push_back(std::move(slice));
  }
  adjust_all(result.slices);
  return result;
}

}  // namespace icome::stats
