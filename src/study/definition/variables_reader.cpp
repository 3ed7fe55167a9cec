#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/definition/needs.h"
#include "study/definition/study_parts.h"

namespace icome::study {
namespace {

constexpr double kLargestWeight = 1000.0;

const Words<Scale> kScales = {{"nominal", Scale::Nominal},
                              {"ordinal", Scale::Ordinal},
                              {"interval", Scale::Interval},
                              {"ratio", Scale::Ratio}};

const Words<bool> kValues = {{"discrete", true}, {"continuous", false}};

const Words<Test> kTests = {
    {"anova", Test::Anova},     {"ttest", Test::TTest},       {"wilcoxon", Test::Wilcoxon},
    {"kruskal", Test::Kruskal}, {"friedman", Test::Friedman}, {"chisq", Test::ChiSquared},
    {"fisher", Test::Fisher},   {"mcnemar", Test::McNemar},   {"binomial", Test::Binomial}};

const Words<Test> kBesideTests = {{"chisq", Test::ChiSquared}};

bool has_distances(Scale scale) { return scale == Scale::Interval || scale == Scale::Ratio; }

/// Only interval and ratio variables are discrete or continuous (thesis 6.3.1).
bool read_discrete(KeyReader& keys, Scale scale) {
  const bool discrete = keys.word<bool>("values", kValues, false);
  if (keys.has("values") && !has_distances(scale))
    keys.problems().add(keys.place_of("values"),
                        "values is said of interval and ratio variables only; leave it out.");
  return discrete;
}

Scale read_scale(KeyReader& keys) {
  keys.require("type", "nominal, ordinal, interval or ratio");
  return keys.word<Scale>("type", kScales, Scale::Ratio);
}

/// Reads the tables of an array as levels; `read_more` reads the keys that only some levels have.
template <typename ReadMore>
std::vector<Level> read_levels_with(KeyReader& keys, const std::string& key, const std::string& what,
                                    const ReadMore& read_more) {
  std::vector<Level> levels;
  for (KeyReader& level_keys : keys.tables(key, what)) {
    Level level;
    level.place = level_keys.place();
    level.id = level_keys.id();
    level.name = level_keys.text("name", true);
    level.needs = read_needs(level_keys);
    read_more(level_keys, level);
    level_keys.finish();
    levels.push_back(std::move(level));
  }
  return levels;
}

/// Reads the levels of a factor, which may change a trial.
std::vector<Level> read_factor_levels(KeyReader& keys) {
  return read_levels_with(keys, "levels", "level", [](KeyReader& level_keys, Level& level) {
    if (level_keys.has("select")) level.choosing = read_choosing(level_keys, Choosing::Touch);
    if (level_keys.has("forces")) level.forces = level_keys.flag("forces", true);
    if (level_keys.has("head")) level.head = level_keys.flag("head", true);
    if (level_keys.has("stereo")) level.stereo = level_keys.flag("stereo", true);
  });
}

IndependentVariable read_independent(KeyReader& keys) {
  IndependentVariable factor;
  factor.place = keys.place();
  factor.id = keys.id();
  factor.name = keys.text("name", true);
  keys.require("kind", "within or between");
  factor.between = keys.word<bool>("kind", {{"within", false}, {"between", true}}, false);
  factor.levels = read_factor_levels(keys);
  if (factor.levels.size() < 2)
    keys.problems().add(keys.place_of("levels"),
                        fmt::format("independent variable '{}': give at least two levels.", factor.id));
  keys.finish();
  return factor;
}

/// Reads the keys that all measured variables have, those of trials and those of people.
template <typename Variable>
void read_measured(KeyReader& keys, Variable& variable) {
  variable.place = keys.place();
  variable.id = keys.id();
  variable.name = keys.text("name", true);
  variable.scale = read_scale(keys);
  variable.discrete = read_discrete(keys, variable.scale);
  variable.unit = keys.plain("unit");
}

DependentVariable read_dependent(KeyReader& keys) {
  DependentVariable variable;
  read_measured(keys, variable);
  variable.better =
      keys.word<Better>("better", {{"lower", Better::Lower}, {"higher", Better::Higher}}, Better::Neither);
  variable.from = keys.plain("from");
  keys.finish();
  return variable;
}

ControlVariable read_control(KeyReader& keys) {
  ControlVariable variable;
  read_measured(keys, variable);
  variable.levels = read_levels(keys, "levels", "level");
  variable.balanced = keys.flag("balanced", false);
  variable.split = keys.rising_numbers("split");
  variable.weight = keys.number("weight", 1.0, 1.0 / kLargestWeight, kLargestWeight);
  keys.finish();
  const auto problem = [&](const char* key, const char* what) {
    keys.problems().add(keys.place_of(key), fmt::format("control variable '{}': {}", variable.id, what));
  };
  const bool by_number = has_distances(variable.scale);
  if (by_number && !variable.levels.empty()) problem("levels", "numbers have no levels; write split = [30].");
  if (!by_number && variable.levels.size() < 2) problem("levels", "give at least two levels.");
  if (!by_number && !variable.split.empty()) problem("split", "levels are not split; leave it out.");
  if (by_number && variable.balanced && variable.split.empty() && !keys.has("split"))
    problem("balanced", "to be balanced a number needs classes; write where they begin: split = [30].");
  return variable;
}

/// Reads "a < b", "a > b" or "differ".
void read_expected(KeyReader& keys, Hypothesis& hypothesis) {
  const std::string said = keys.plain("expected");
  if (said.empty() || said == "differ") return;
  const std::size_t sign = said.find_first_of("<>");
  const auto trimmed = [](const std::string& text) {
    const std::size_t first = text.find_first_not_of(' ');
    return first == std::string::npos ? text : text.substr(first, text.find_last_not_of(' ') - first + 1);
  };
  if (sign != std::string::npos) {
    hypothesis.direction = said[sign] == '<' ? Direction::Less : Direction::Greater;
    hypothesis.first = trimmed(said.substr(0, sign));
    hypothesis.second = trimmed(said.substr(sign + 1));
  }
  if (!is_id(hypothesis.first) || !is_id(hypothesis.second))
    keys.problems().add(
        keys.place_of("expected"),
        fmt::format("hypothesis '{}': expected is '{}'; write \"differ\", or two levels of the factor with "
                    "< or > between them.",
                    hypothesis.id, said));
}

Hypothesis read_hypothesis(KeyReader& keys) {
  Hypothesis hypothesis;
  hypothesis.place = keys.place();
  hypothesis.id = keys.id();
  hypothesis.text = keys.text("text", true);
  hypothesis.dependent = keys.id("dependent");
  hypothesis.factor = keys.reference("factor");
  read_expected(keys, hypothesis);
  hypothesis.alpha = keys.number("alpha", 0.05, std::nextafter(0.0, 1.0), std::nextafter(1.0, 0.0));
  hypothesis.test = keys.word<Test>("test", kTests, Test::None);
  hypothesis.beside = keys.word<Test>("beside", kBesideTests, Test::None);
  hypothesis.answers = keys.strings("answers");
  hypothesis.primary = keys.flag("primary", false);
  keys.finish();
  return hypothesis;
}

}  // namespace

std::vector<Level> read_levels(KeyReader& keys, const std::string& key, const std::string& what) {
  return read_levels_with(keys, key, what, [](KeyReader&, Level&) {});
}

std::vector<std::string> read_needs(KeyReader& keys) {
  std::vector<std::string> needs = keys.strings("needs"), known;
  for (const Capability& capability : capabilities()) known.emplace_back(capability.id);
  for (const std::string& need : needs) {
    if (std::ranges::find(known, need) != known.end()) continue;
    const std::string near = base::suggestion(need, known);
    keys.problems().add(keys.place_of("needs"), fmt::format("needs: nothing is called '{}'{}{}", need, near,
                                                            near.ends_with('?') ? "" : "."));
  }
  return needs;
}

void read_variables(KeyReader& keys, Study& study) {
  for (KeyReader& table : keys.tables("independent", "independent variable"))
    study.independent.push_back(read_independent(table));
  for (KeyReader& table : keys.tables("dependent", "dependent variable"))
    study.dependent.push_back(read_dependent(table));
  for (KeyReader& table : keys.tables("control", "control variable"))
    study.control.push_back(read_control(table));
  for (KeyReader& table : keys.tables("hypotheses", "hypothesis"))
    study.hypotheses.push_back(read_hypothesis(table));
}

}  // namespace icome::study
