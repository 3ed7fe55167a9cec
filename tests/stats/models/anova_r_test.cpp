// Every shared data set, and random designs, through R itself where it is installed.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

#include "places.h"
#include "stats/anova_test_data.h"
#include "stats/models/anova.h"
#include "stats/models/repeated_measures.h"
#include "stats/tables/descriptives.h"

namespace icome::stats {
namespace {

namespace fs = std::filesystem;

bool has_r_for_anova() { return std::system("Rscript --version > /dev/null 2>&1") == 0; }

/// A folder of sets, each run through R in one go.
class AnovaInR : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_r_for_anova()) GTEST_SKIP() << "R is not installed (package r-base-core)";
    folder_ = fs::path(testing::TempDir()) / fmt::format("icome-anova-r-{}", ::getpid());
    fs::create_directories(folder_);
  }
  void TearDown() override {
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  /// Writes a set as set<index>.csv and has R call `call` on it.
  void add(const std::vector<double>& values, const std::vector<Factor>& factors, const std::string& call) {
    std::ofstream file(folder_ / fmt::format("set{}.csv", sets_));
    file << "y";
    for (const Factor& factor : factors) file << ',' << factor.name;
    for (std::size_t i = 0; i < values.size(); ++i) {
      file << '\n' << (std::isnan(values[i]) ? std::string("NA") : fmt::format("{:.17g}", values[i]));
      for (const Factor& factor : factors) {
        if (factor.of[i] == kNoLevel) {
          file << ",NA";
        } else {
          file << ",l" << factor.of[i];
        }
      }
    }
    file << '\n';
    calls_ +=
        fmt::format("cat('set {}\\n'); {}\n", sets_,
                    fmt::format(fmt::runtime(call), fmt::format("file.path(folder, 'set{}.csv')", sets_)));
    ++sets_;
  }

  /// What R says: by set and key.
  std::vector<std::map<std::string, std::vector<double>>> answers() {
    std::ofstream(folder_ / "sets.R") << calls_;
    const std::string command =
        fmt::format("Rscript '{0}/tests/stats/anova_in_r.R' '{1}' > '{1}/out.txt' 2> '{1}/errors.txt'",
                    places::project_folder().string(), folder_.string());
    EXPECT_EQ(std::system(command.c_str()), 0) << std::ifstream(folder_ / "errors.txt").rdbuf();
    std::vector<std::map<std::string, std::vector<double>>> result;
    std::ifstream file(folder_ / "out.txt");
    std::string line, key, number;
    while (std::getline(file, line)) {
      std::istringstream words(line);
      words >> key;
      if (key == "set") {
        result.emplace_back();
        continue;
      }
      std::vector<double>& numbers = result.back()[key];
      while (words >> number) {
        numbers.push_back(number == "NaN" || number == "NA" ? NAN
                          : number == "Inf"                 ? INFINITY
                                                            : std::stod(number));
      }
    }
    return result;
  }

 private:
  fs::path folder_;
  std::string calls_;
  int sets_ = 0;
};

/// What analyses are made of.
struct DesignedData {
  std::string name;
  std::vector<double> values;
  std::vector<Factor> factors;
  int highest = 9;      // interaction
  double error = 1e-8;  // relative; R's own where values have many digits in common
};

void expect_like_r(double actual, double expected, double error, double scale = 0.0) {
  if (std::isnan(expected)) {
    EXPECT_TRUE(std::isnan(actual)) << actual;
  } else {
    EXPECT_NEAR(actual, expected, error * std::max(std::abs(expected), scale));
  }
}

void expect_table(const DesignedData& data, const std::map<std::string, std::vector<double>>& answer) {
  int number = 0;
  for (const auto type : {SumsOfSquares::TypeI, SumsOfSquares::TypeII, SumsOfSquares::TypeIII}) {
    const auto anova = factorial_anova(data.values, data.factors, {type, data.highest});
    ASSERT_TRUE(anova) << anova.error().message;
    ++number;
    EXPECT_EQ(anova->residual.df, answer.at("residual")[0]);
    expect_like_r(anova->residual.ss, answer.at("residual")[1], data.error, 1e-6 * anova->total_ss);
    for (const AnovaTerm& term : anova->terms) {
      SCOPED_TRACE(fmt::format("type {}, {}", number, term.term));
      const std::vector<double>& row = answer.at(fmt::format("{}/{}", number, term.term));
      ASSERT_EQ(term.df, row[0]);
      if (term.df == 0) continue;
      // R's are differences of larger ones.
      expect_like_r(term.ss, row[1], data.error, 1e-4 * anova->total_ss);
      if (anova->residual.df == 0) continue;
      expect_like_r(term.f, row[2], data.error, 1e-4 * anova->total_ss / anova->residual.ms);
      expect_like_r(term.p, row[3], data.error, 1e-2);
    }
  }
  const std::vector<double>& described = answer.at("described");
  const auto cases = complete_cases(data.values, data.factors);
  const auto all = describe(cases->values);
  const double of_all[] = {all->mean,           all->standard_deviation, all->lower_quartile, all->median,
                           all->upper_quartile, all->mean_low,           all->mean_high};
  for (std::size_t i = 0; i < 7; ++i) expect_like_r(of_all[i], described[i], data.error);
  if (!answer.count("welch")) return;
  const auto welch = welch_anova(data.values, data.factors[0]);
  ASSERT_TRUE(welch) << welch.error().message;
  expect_like_r(welch->f, answer.at("welch")[0], data.error);
  expect_like_r(welch->error_df, answer.at("welch")[1], data.error);
  expect_like_r(welch->p, answer.at("welch")[2], data.error);
}

/// The columns of a shared CSV file; nothing where it is not there.
DesignedData shared_design(const std::string& file, const std::string& values,
                           const std::vector<std::string>& factors, int highest = 9) {
  auto columns = anova_data::csv_columns(anova_data::shared_file(file));
  DesignedData data{file, {}, {}, highest};
  if (columns.empty()) return data;
  data.values = anova_data::numbers(columns.at(values));
  for (std::size_t i = 0; i < factors.size(); ++i) {
    data.factors.push_back(factor_of(std::string(1, static_cast<char>('a' + i)), columns.at(factors[i])));
  }
  return data;
}

DesignedData nist_design(const std::string& name, double error) {
  std::ifstream file(anova_data::shared_file(fmt::format("nist-strd-anova/{}.dat", name)));
  std::string line, level;
  for (int i = 0; i < 60; ++i) std::getline(file, line);
  DesignedData data{name, {}, {}, 9, error};
  std::vector<std::string> levels;
  double value = 0.0;
  while (file >> level >> value) {
    levels.push_back(level);
    data.values.push_back(value);
  }
  data.factors = {factor_of("a", levels)};
  return data;
}

/// Values of every `step`th row gone, and those of one cell.
DesignedData with_gaps(DesignedData data, std::size_t step, bool cell_too) {
  data.name += cell_too ? ", without every few rows and a cell" : ", without every few rows";
  for (std::size_t i = 0; i < data.values.size(); ++i) {
    bool first_cell = cell_too;
    for (const Factor& factor : data.factors) first_cell = first_cell && factor.of[i] == 0;
    if (i % step == 1 || first_cell) data.values[i] = NAN;
  }
  return data;
}

TEST_F(AnovaInR, AgreesOnSharedData) {
  std::vector<DesignedData> sets = {
      nist_design("SiRstv", 1e-8),
      nist_design("SmLs01", 1e-8),
      nist_design("SmLs02", 1e-8),
      nist_design("SmLs03", 1e-8),
      nist_design("SmLs04", 1e-7),
      shared_design("r-datasets/PlantGrowth.csv", "weight", {"group"}),
      shared_design("r-datasets/sleep.csv", "extra", {"group"}),
      shared_design("r-datasets/sleep.csv", "extra", {"group", "ID"}, 1),
      shared_design("r-datasets/morley.csv", "Speed", {"Expt"}),
      shared_design("r-datasets/morley.csv", "Speed", {"Expt", "Run"}, 1),
      shared_design("r-datasets/MASS_immer.csv", "Y1", {"Loc", "Var"}, 1),
      shared_design("r-datasets/mtcars.csv", "mpg", {"cyl", "am", "gear"}),
      shared_design("r-datasets/mtcars.csv", "qsec", {"vs", "carb", "am"}, 2),
      shared_design("r-datasets/HairEyeColor.csv", "Freq", {"Hair", "Eye", "Sex"}, 2),
      shared_design("pingouin/anova.csv", "Pain threshold", {"Hair color"}),
      shared_design("pingouin/anova2.csv", "Yield", {"Blend", "Crop"}),
      shared_design("pingouin/rm_anova.csv", "DesireToKill", {"Gender", "Region"}),
      shared_design("pingouin/chi2_independence.csv", "chol", {"sex", "cp", "thal"})};
  for (const char* file : {"r-datasets/ToothGrowth.csv", "r-datasets/warpbreaks.csv"}) {
    const bool teeth = std::string(file).find("Tooth") != std::string::npos;
    const DesignedData data = teeth ? shared_design(file, "len", {"supp", "dose"})
                                    : shared_design(file, "breaks", {"wool", "tension"});
    sets.insert(sets.end(), {data, with_gaps(data, 7, false), with_gaps(data, 5, true)});
  }
  if (sets[0].values.empty()) GTEST_SKIP() << "no shared data";
  for (const DesignedData& data : sets) {
    add(data.values, data.factors, fmt::format("between({{}}, {})", data.highest));
  }
  const auto results = answers();
  ASSERT_EQ(results.size(), sets.size());
  for (std::size_t i = 0; i < sets.size(); ++i) {
    SCOPED_TRACE(sets[i].name);
    expect_table(sets[i], results[i]);
  }
}

TEST_F(AnovaInR, AgreesOnRandomDesigns) {
  base::Random random(20267);
  std::vector<DesignedData> sets;
  for (int k = 0; k < 30; ++k) {
    DesignedData data{fmt::format("design {}", k), {}, {}, k % 3 + 1};
    const std::size_t n = 12 + random.index(60);
    const std::size_t factors = 2 + random.index(2);
    for (std::size_t f = 0; f < factors; ++f) {
      std::vector<int> of = {0, 1};
      const std::uint64_t levels = 2 + random.index(3);
      while (of.size() < n)
        of.push_back(random.index(20) == 0 ? kNoLevel : static_cast<int>(random.index(levels)));
      data.factors.push_back(anova_data::numbered(std::string(1, static_cast<char>('a' + f)), of));
    }
    for (std::size_t i = 0; i < n; ++i) {
      data.values.push_back(1000.0 + anova_data::normal_value(random) + data.factors[0].of[i]);
    }
    sets.push_back(data);
    add(data.values, data.factors, fmt::format("between({{}}, {})", data.highest));
  }
  const auto results = answers();
  ASSERT_EQ(results.size(), sets.size());
  for (std::size_t i = 0; i < sets.size(); ++i) {
    SCOPED_TRACE(sets[i].name);
    expect_table(sets[i], results[i]);
  }
}

/// The first factor is the subject, then so many within and the rest between.
struct RepeatedDesign {
  DesignedData data;
  std::size_t within = 1;
};

void expect_repeated(const RepeatedDesign& design, const std::map<std::string, std::vector<double>>& answer) {
  const std::span<const Factor> factors = design.data.factors;
  const auto table =
      repeated_measures_anova(design.data.values, factors[0], factors.subspan(1, design.within),
                              factors.subspan(1 + design.within), SumsOfSquares::TypeI);
  ASSERT_TRUE(table) << table.error().message;
  double total = 0.0;
  for (const auto& row : table->terms) total += row.ss + row.error_ss;
  for (const auto& row : table->terms) {
    SCOPED_TRACE(row.term);
    const std::vector<double>& expected = answer.at("rm/" + row.term);
    EXPECT_EQ(row.df, expected[0]);
    expect_like_r(row.ss, expected[1], 1e-8, 1e-4 * total);
    expect_like_r(row.f, expected[2], 1e-8, 1e-4);
    expect_like_r(row.p, expected[3], 1e-8, 1e-4);
    if (!answer.count("mauchly/" + row.term)) continue;
    const std::vector<double>& mauchly = answer.at("mauchly/" + row.term);
    expect_like_r(row.sphericity->mauchly_w, mauchly[0], 1e-8);
    expect_like_r(row.sphericity->p, mauchly[1], 1e-8);
  }
}

TEST_F(AnovaInR, AgreesOnRepeatedMeasures) {
  std::vector<RepeatedDesign> designs = {
      {shared_design("anova-rm-test-data.csv", "DV", {"id", "A", "B", "D"}), 3},
      {shared_design("pingouin/rm_anova.csv", "DesireToKill",
                     {"Subject", "Disgustingness", "Frighteningness", "Gender"}),
       2},
      {shared_design("r-datasets/sleep.csv", "extra", {"ID", "group"}), 1},
      {shared_design("r-datasets/morley.csv", "Speed", {"Run", "Expt"}), 1},
      {shared_design("r-datasets/MASS_immer.csv", "Y1", {"Loc", "Var"}), 1}};
  if (designs[0].data.values.empty()) GTEST_SKIP() << "no shared data";
  base::Random random(20268);
  for (int k = 0; k < 10; ++k) {
    RepeatedDesign design{{fmt::format("design {}", k), {}, {}}, 2};
    std::vector<int> who, fast, slow, group;
    for (int s = 0; s < 9 + k; ++s) {
      for (int cell = 0; cell < 12; ++cell) {
        for (std::uint64_t again = random.index(3) / 2; again <= 1; ++again) {
          who.push_back(s);
          slow.push_back(cell / 4);
          fast.push_back(cell % 4);
          group.push_back(s < 4 ? 0 : s % 3);
          design.data.values.push_back(anova_data::normal_value(random) + s % 4 + cell / 4);
        }
      }
    }
    design.data.values[5 + static_cast<std::size_t>(k)] = NAN;
    for (const auto& [name, of] : {std::pair{"a", who}, {"b", slow}, {"c", fast}, {"d", group}}) {
      design.data.factors.push_back(anova_data::numbered(name, of));
    }
    designs.push_back(design);
  }
  for (RepeatedDesign& design : designs) {
    std::vector<Factor> factors = design.data.factors;
    factors[0].name = "s";
    std::string within, groups;
    for (std::size_t i = 1; i < factors.size(); ++i) {
      std::string& list = i <= design.within ? within : groups;
      list += fmt::format("{}'{}'", list.empty() ? "" : ", ", factors[i].name);
    }
    add(design.data.values, factors, fmt::format("within_subjects({{}}, c({}), c({}))", within, groups));
  }
  const auto results = answers();
  ASSERT_EQ(results.size(), designs.size());
  for (std::size_t i = 0; i < designs.size(); ++i) {
    SCOPED_TRACE(designs[i].data.name);
    expect_repeated(designs[i], results[i]);
  }
}

}  // namespace
}  // namespace icome::stats
