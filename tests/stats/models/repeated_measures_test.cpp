#include "stats/models/repeated_measures.h"

#include <gtest/gtest.h>

#include <array>

#include "stats/anova_test_data.h"

namespace icome::stats {
namespace {

using anova_data::expect_digits;
using anova_data::row_of;

/// Observations with who was observed, and in what.
struct RepeatedData {
  std::vector<double> values;
  Factor subject;
  std::vector<Factor> within, between;
};

base::Result<RepeatedMeasures> analysed(const RepeatedData& data,
                                        SumsOfSquares type = SumsOfSquares::TypeII) {
  return repeated_measures_anova(data.values, data.subject, data.within, data.between, type);
}

/// A row against Df, Sum Sq, F value, Pr(>F).
void expect_repeated_row(const RepeatedMeasures& table, const char* name, int df, double ss, double f,
                         double p) {
  SCOPED_TRACE(name);
  const RepeatedMeasuresTerm& row = row_of(table.terms, name);
  EXPECT_EQ(row.df, df);
  expect_digits(row.ss, ss, 11);
  expect_digits(row.f, f, 10);
  expect_digits(row.p, p, 8);
}

/// The first rows of shared/data/stats/anova-rm-test-data.csv; no values where it is not there.
RepeatedData three_within(std::size_t rows, const std::vector<std::string>& within) {
  auto columns = anova_data::csv_columns(anova_data::shared_file("anova-rm-test-data.csv"));
  if (columns.empty()) return {};
  for (auto& [name, column] : columns) column.resize(rows);
  RepeatedData data{anova_data::numbers(columns["DV"]), factor_of("id", columns["id"]), {}, {}};
  for (const std::string& name : within) data.within.push_back(factor_of(name, columns[name]));
  return data;
}

struct EzRow {
  const char* term;
  int df, error_df;
  double f, p;
};

void expect_ez(const RepeatedMeasures& table, const std::vector<EzRow>& rows) {
  ASSERT_EQ(table.terms.size(), rows.size());
  for (const EzRow& expected : rows) {
    SCOPED_TRACE(expected.term);
    const RepeatedMeasuresTerm& row = row_of(table.terms, expected.term);
    EXPECT_EQ(row.df, expected.df);
    EXPECT_EQ(row.error_df, expected.error_df);
    expect_digits(row.f, expected.f, 6);  // as many as are printed
    expect_digits(row.p, expected.p, 6);
  }
}

TEST(RepeatedMeasures, EzAnovaOneFactor) {
  const RepeatedData data = three_within(16, {"B"});
  if (data.values.empty()) GTEST_SKIP() << "no shared data: anova-rm-test-data.csv";
  // R's ezANOVA by way of statsmodels' tests (DATA.md, section 4), here and in the two that follow.
  expect_ez(*analysed(data), {{"B", 1, 7, 22.4, 0.002125452}});
}

TEST(RepeatedMeasures, EzAnovaTwoFactors) {
  const RepeatedData data = three_within(48, {"A", "B"});
  if (data.values.empty()) GTEST_SKIP() << "no shared data: anova-rm-test-data.csv";
  expect_ez(*analysed(data), {{"A", 1, 7, 40.14159, 3.905263e-04},
                              {"B", 2, 14, 29.21739, 1.007549e-05},
                              {"A:B", 2, 14, 17.10545, 1.741322e-04}});
}

TEST(RepeatedMeasures, EzAnovaThreeFactors) {
  const RepeatedData data = three_within(96, {"A", "B", "D"});
  if (data.values.empty()) GTEST_SKIP() << "no shared data: anova-rm-test-data.csv";
  const auto table = analysed(data);
  expect_ez(*table, {{"A", 1, 7, 8.7650709, 0.021087505},
                     {"B", 2, 14, 8.4985785, 0.003833921},
                     {"D", 1, 7, 20.5076546, 0.002704428},
                     {"A:B", 2, 14, 0.8457797, 0.450021759},
                     {"A:D", 1, 7, 21.7593382, 0.002301792},
                     {"B:D", 2, 14, 6.2416695, 0.011536846},
                     {"A:B:D", 2, 14, 5.4253359, 0.018010647}});
  // R 4.2: summary(aov(DV ~ A * B * D + Error(id / (A * B * D))))
  expect_repeated_row(*table, "A:B:D", 2, 294.4375, 5.4253358925144, 0.0180106470504284);
  // mauchly.test and anova(lm(DV ~ 1), X, M, idata, test = "Spherical") on the columns by cell
  const RepeatedMeasuresTerm& b = row_of(table->terms, "B");
  expect_digits(b.sphericity->mauchly_w, 0.8877654061883, 12);
  expect_digits(b.sphericity->p, 0.69967225597, 10);
  EXPECT_NEAR(b.sphericity->greenhouse_geisser, 0.8991, 5e-5);
  EXPECT_NEAR(b.sphericity->huynh_feldt, 1.1905, 5e-5);
  expect_digits(b.p_greenhouse_geisser, 0.005451171655148, 9);
  EXPECT_EQ(b.p_huynh_feldt, b.p);
  const RepeatedMeasuresTerm& ab = row_of(table->terms, "A:B");
  expect_digits(ab.sphericity->mauchly_w, 0.7638370975794, 12);
  expect_digits(ab.sphericity->p, 0.445658548345, 10);
  expect_digits(ab.p_greenhouse_geisser, 0.43163627815, 10);
  EXPECT_FALSE(row_of(table->terms, "A").sphericity);
  // Olejnik and Algina (2003), table 2: SS / (SS + the sum of all error SS), which aov prints.
  const double errors = 68.7395833333333 + 194.739583333334 + 315.104166666666 + 119.072916666667 +
                        351.229166666666 + 61.0729166666667 + 435.770833333333 + 379.895833333333;
  expect_digits(b.generalised_eta_sq, 382.5625 / (382.5625 + errors), 12);
}

/// Everyone in every cell of the within factors, the last one's levels running fastest.
RepeatedData every_cell(std::vector<double> values, const std::vector<int>& levels,
                        const std::vector<std::vector<int>>& groups = {}) {
  RepeatedData data;
  std::size_t cells = 1;
  for (const int count : levels) cells *= static_cast<std::size_t>(count);
  std::vector<int> subject(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) subject[i] = static_cast<int>(i / cells);
  std::size_t below = cells;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    below /= static_cast<std::size_t>(levels[k]);
    std::vector<int> of(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      of[i] = static_cast<int>(i / below % static_cast<std::size_t>(levels[k]));
    }
    data.within.push_back(anova_data::numbered(std::string(1, "STU"[k]), of));
  }
  for (std::size_t k = 0; k < groups.size(); ++k) {
    std::vector<int> of;
    for (const int who : subject) of.push_back(groups[k][static_cast<std::size_t>(who)]);
    data.between.push_back(anova_data::numbered(std::string(1, "gh"[k]), of));
  }
  data.values = std::move(values);
  data.subject = anova_data::numbered("s", subject);
  return data;
}

TEST(RepeatedMeasures, SharesOfAllVariance) {
  // Rows are subjects. By hand: df 3 of subjects, 2 of conditions and 6 of the error.
  const auto table = analysed(every_cell({1, 2, 5, 3, 4, 6, 4, 6, 7, 6, 6, 8}, {3}));
  ASSERT_TRUE(table);
  const double subjects = 27.0, conditions = 56.0 / 3.0, error = 2.0;
  const double total = subjects + conditions + error;
  expect_digits(table->total_ss, total, 13);
  EXPECT_EQ(table->between_subjects.df, 3);
  expect_digits(table->between_subjects.ss, subjects, 13);
  const RepeatedMeasuresTerm& row = table->terms[0];
  expect_digits(row.eta_sq, conditions / total, 13);
  // Lakens (2013) and R's MOTE (omega.partial.SS.rm), which agree for one factor.
  const double omega = (conditions - 2.0 * error / 6.0) / (total + subjects / 3.0);
  expect_digits(row.omega_sq, omega, 13);
  expect_digits(row.partial_omega_sq, omega, 13);
}

TEST(RepeatedMeasures, SharesOfNothingAreNone) {
  const auto table = analysed(every_cell({5, 5, 5, 5, 5, 5}, {2}));
  ASSERT_TRUE(table);
  EXPECT_EQ(table->total_ss, 0.0);
  EXPECT_TRUE(std::isnan(table->terms[0].eta_sq));
  EXPECT_TRUE(std::isnan(table->terms[0].omega_sq));
  EXPECT_TRUE(std::isnan(table->terms[0].partial_omega_sq));
}

TEST(Sphericity, PStaysAProbability) {
  // Hardly more subjects than contrasts, where the second term of Box's series is as large as the first.
  base::Random random(7);
  for (int round = 0; round < 200; ++round) {
    Eigen::MatrixXd residuals(11, 10);
    for (Eigen::Index i = 0; i < residuals.size(); ++i) {
      residuals.data()[i] = anova_data::normal_value(random);
    }
    residuals.rowwise() -= residuals.colwise().mean().eval();
    const Sphericity it = sphericity_of(residuals, 10);
    EXPECT_GE(it.p, 0.0);
    EXPECT_LE(it.p, 1.0);
  }
}

// 9 people, 2 x 3 cells each.
const std::vector<double> kMixed = {12, 15, 19, 11, 14, 23, 10, 13, 14, 9,  15, 18, 14, 14, 20, 15, 13, 25,
                                    11, 16, 17, 12, 17, 20, 9,  10, 12, 8,  12, 11, 7,  11, 10, 9,  10, 14,
                                    10, 9,  13, 10, 12, 12, 15, 20, 28, 13, 22, 25, 13, 17, 24, 16, 18, 29};
const std::vector<int> kMixedGroups = {0, 0, 0, 0, 1, 1, 1, 2, 2};
const std::vector<int> kMixedOtherGroups = {0, 1, 1, 0, 0, 1, 0, 1, 0};

TEST(RepeatedMeasures, PartialOmegaAsMoteHasIt) {
  // df (MS - error MS) / (SS + error SS + subjects' SS and MS); between subjects these are the error.
  const auto table = analysed(every_cell(kMixed, {2, 3}, {kMixedGroups}));
  ASSERT_TRUE(table);
  const AnovaResidual& people = table->between_subjects;
  const RepeatedMeasuresTerm& within = row_of(table->terms, "T");
  expect_digits(
      within.partial_omega_sq,
      within.df * (within.ms - within.error_ms) / (within.ss + within.error_ss + people.ss + people.ms), 13);
  const RepeatedMeasuresTerm& between = row_of(table->terms, "g");
  EXPECT_EQ(between.error_ss, people.ss);
  expect_digits(between.partial_omega_sq,
                between.df * (between.ms - people.ms) / (between.ss + people.ss + people.ms), 13);
}

TEST(RepeatedMeasures, MixedWithUnequalGroups) {
  const auto table = analysed(every_cell(kMixed, {2, 3}, {kMixedGroups}), SumsOfSquares::TypeI);
  ASSERT_TRUE(table) << table.error().message;
  // R 4.2: summary(aov(y ~ g * S * T + Error(s / (S * T))))
  expect_repeated_row(*table, "g", 2, 662.912037037037, 41.6126126126126, 0.000304082055627679);
  expect_repeated_row(*table, "S", 1, 16.6666666666667, 6.563354603464, 0.0427987973940665);
  expect_repeated_row(*table, "g:S", 2, 1.09722222222223, 0.216043755697358, 0.811704432433866);
  expect_repeated_row(*table, "T", 2, 473.925925925926, 51.4670688788336, 1.29536817763879e-06);
  expect_repeated_row(*table, "g:T", 4, 105.490740740741, 5.72800402212168, 0.0081425458096989);
  expect_repeated_row(*table, "S:T", 2, 9.33333333333334, 1.95538312318138, 0.18405215393414);
  expect_repeated_row(*table, "g:S:T", 4, 12.0277777777778, 1.25994180407372, 0.338457680404657);
  expect_digits(row_of(table->terms, "g").error_ss, 47.7916666666667, 12);
  expect_digits(row_of(table->terms, "g:T").error_ss, 55.25, 12);
  EXPECT_EQ(row_of(table->terms, "g:T").error_df, 12);
  EXPECT_EQ(table->subjects, 9u);
  EXPECT_TRUE(table->warnings.empty());
}

TEST(RepeatedMeasures, SphericityOfMixed) {
  const auto table = analysed(every_cell(kMixed, {2, 3}, {kMixedGroups}));
  ASSERT_TRUE(table);
  // R 4.2: mauchly.test(lm(M ~ g), M = ~ S + T, X = ~ S), anova(..., test = "Spherical"); with M = ~ S * T, X
  // = ~ S + T
  const RepeatedMeasuresTerm& t = row_of(table->terms, "T");
  expect_digits(t.sphericity->mauchly_w, 0.368219778920144, 11);
  expect_digits(t.sphericity->p, 0.0822749794119786, 10);
  expect_digits(t.sphericity->greenhouse_geisser, 0.612827626589337, 12);
  expect_digits(t.sphericity->huynh_feldt, 0.689056522010826, 12);  // R prints 0.6891
  EXPECT_EQ(t.sphericity->lower_bound, 0.5);
  expect_digits(t.p_greenhouse_geisser, 1.02114790446234e-04, 9);
  expect_digits(t.p_huynh_feldt, 4.29635780972652e-05, 9);
  const RepeatedMeasuresTerm& st = row_of(table->terms, "g:S:T");
  expect_digits(st.sphericity->mauchly_w, 0.233432835258743, 11);
  expect_digits(st.sphericity->p, 0.0263272115049548, 10);
  expect_digits(st.p_greenhouse_geisser, 0.348618952347999, 10);
  expect_digits(st.p_huynh_feldt, 0.347988406142461, 10);
}

TEST(RepeatedMeasures, TypeIIIWeighsGroupsAlike) {
  const auto table = analysed(every_cell(kMixed, {2, 3}, {kMixedGroups}), SumsOfSquares::TypeIII);
  ASSERT_TRUE(table);
  // R 4.2, contr.sum: the squared t of the intercept of lm(M %*% contrast ~ g), times its mean square, summed
  expect_digits(row_of(table->terms, "S").ss, 14.1292735042735, 11);
  expect_digits(row_of(table->terms, "T").ss, 499.737179487179, 11);
  expect_digits(row_of(table->terms, "S:T").ss, 5.39957264957265, 11);
}

TEST(RepeatedMeasures, TwoBetweenFactorsOfUnequalGroups) {
  const RepeatedData data = every_cell(kMixed, {2, 3}, {kMixedGroups, kMixedOtherGroups});
  const auto second = analysed(data, SumsOfSquares::TypeII), third = analysed(data, SumsOfSquares::TypeIII);
  ASSERT_TRUE(second && third);
  // R 4.2, Z <- rowSums(M) / sqrt(6): anova(lm(Z ~ h), lm(Z ~ g + h), lm(Z ~ g * h)), row 2, and likewise for
  // h
  expect_repeated_row(*second, "g", 2, 655.555769230769, 23.5529018885306, 0.0146504117977853);
  expect_repeated_row(*second, "h", 1, 0.480769230769248, 0.0345462920313232, 0.86440685592049);
  // contr.sum: drop1(lm(Z ~ g * h), . ~ ., test = "F")
  expect_repeated_row(*third, "g", 2, 637.38141025641, 22.8999309074159, 0.0152424224371623);
  expect_repeated_row(*third, "h", 1, 0.00925925925925242, 0.00066533599467682, 0.981041420347522);
  expect_repeated_row(*third, "g:h", 2, 5.56089743589742, 0.199792722247811, 0.828977876524229);
  // The same on both contrasts of T, summed.
  expect_digits(row_of(second->terms, "g:T").ss, 103.573076923077, 11);
  expect_digits(row_of(third->terms, "g:T").ss, 95.2628205128205, 11);
}

TEST(RepeatedMeasures, FourLevels) {
  const auto table = analysed(every_cell(
      {30, 28, 16, 34, 14, 18, 10, 22, 24, 20, 18, 30, 38, 34, 20, 44, 26, 28, 14, 30, 21, 25, 13, 36}, {4}));
  ASSERT_TRUE(table);
  const RepeatedMeasuresTerm& row = table->terms[0];
  // R 4.2, M the same numbers, Z = M %*% orthonormal Helmert contrasts: mauchly.test(lm(Z ~ 1)). (From
  // mauchly.test(lm(M ~ 1), X = ~ 1) p = 0.974355: it has M's 4 columns in the second-order term, not Z's 3.)
  expect_digits(row.sphericity->mauchly_w, 0.794988022152683, 11);
  expect_digits(row.sphericity->p, 0.974332765562177, 10);
  // The rest from anova(lm(M ~ 1), X = ~ 1, test = "Spherical") and its formulas.
  expect_digits(row.f, 30.7252536331231, 11);
  expect_digits(row.p, 1.19427611737191e-06, 8);
  expect_digits(row.p_greenhouse_geisser, 5.71851850558572e-06, 8);
  expect_digits(row.p_huynh_feldt, 1.19427611737191e-06, 8);
  expect_digits(row.sphericity->greenhouse_geisser, 0.8622602904595, 11);
  expect_digits(row.sphericity->huynh_feldt, 1.86758633836323, 11);
}

TEST(RepeatedMeasures, PeopleWithMissingCellsAreLeftOutByName) {
  auto columns = anova_data::csv_columns(anova_data::shared_file("pingouin/rm_anova.csv"));
  if (columns.empty()) GTEST_SKIP() << "no shared data: rm_anova.csv";
  const RepeatedData data{
      anova_data::numbers(columns["DesireToKill"]),
      factor_of("Subject", columns["Subject"]),
      {factor_of("D", columns["Disgustingness"]), factor_of("F", columns["Frighteningness"])},
      {factor_of("Gender", columns["Gender"])}};
  const auto first = analysed(data, SumsOfSquares::TypeI), third = analysed(data, SumsOfSquares::TypeIII);
  ASSERT_TRUE(first && third) << first.error().message;
  // Subject 40 has no gender, the others lack a rating.
  EXPECT_EQ(first->left_out, (std::vector<std::string>{"2", "10", "42", "64", "80"}));
  EXPECT_EQ(first->subjects, 87u);
  EXPECT_EQ(first->missing, 24u);
  // R 4.2 on the other 87: summary(aov(DesireToKill ~ Gender * D * F + Error(Subject / (D * F))))
  expect_repeated_row(*first, "Gender", 1, 18.3462643678163, 0.995882927223161, 0.321141255812505);
  expect_repeated_row(*first, "D", 1, 48.5632183908049, 11.9112769485904, 0.000871400346571591);
  expect_repeated_row(*first, "Gender:D", 1, 1.7600574712644, 0.431695688225545, 0.51293318690906);
  expect_repeated_row(*first, "F", 1, 176.735632183908, 41.1163412572014, 7.71031649003743e-09);
  expect_repeated_row(*first, "Gender:D:F", 1, 13.7988505747124, 4.68829505579379, 0.0331712024813387);
  // contr.sum: the intercept of lm(M %*% c(1, 1, -1, -1) / 2 ~ Gender)
  expect_repeated_row(*third, "D", 1, 49.1738505747127, 12.0610489220564, 0.000812201211107592);
}

TEST(RepeatedMeasures, SeveralObservationsACellAreAveraged) {
  RepeatedData data = every_cell({1, 4, 2, 6, 3, 9, 2, 5}, {2});
  const auto once = analysed(data);
  // Each again, half above and half below; their order does not matter.
  for (std::size_t i = 8; i-- > 0;) {
    data.values.push_back(data.values[i] + 0.5);
    data.values[i] -= 0.5;
    data.subject.of.push_back(data.subject.of[i]);
    data.within[0].of.push_back(data.within[0].of[i]);
  }
  const auto twice = analysed(data);
  ASSERT_TRUE(once && twice);
  expect_digits(twice->terms[0].f, once->terms[0].f, 12);
  EXPECT_EQ(twice->observations, 16u);
  EXPECT_EQ(anova_data::warnings_with(twice->warnings, "16 observations are averaged to 8"), 1);
}

TEST(RepeatedMeasures, AGroupOfIncompletePeopleIsGone) {
  std::vector<double> values = kMixed;
  values[7 * 6] = values[8 * 6 + 3] = NAN;
  const auto table = analysed(every_cell(values, {2, 3}, {kMixedGroups}));
  ASSERT_TRUE(table);
  EXPECT_EQ(row_of(table->terms, "g").df, 1);
  EXPECT_EQ(anova_data::warnings_with(table->warnings,
                                      "2 subjects without an observation in every cell left out: 7, 8"),
            1);
  EXPECT_EQ(anova_data::warnings_with(table->warnings, "'2' of 'g' has no observation"), 1);
}

TEST(RepeatedMeasures, GroupsWithoutPeopleAreSaid) {
  // Nobody is in group 2 of g and 1 of h.
  const RepeatedData data = every_cell(kMixed, {2, 3}, {kMixedGroups, {0, 1, 1, 0, 0, 1, 0, 0, 0}});
  const auto second = analysed(data), third = analysed(data, SumsOfSquares::TypeIII);
  ASSERT_TRUE(second && third);
  EXPECT_EQ(row_of(second->terms, "g").df, 2);
  EXPECT_EQ(row_of(second->terms, "g:h").df, 1);
  EXPECT_EQ(row_of(second->terms, "g:h").error_df, 4);
  EXPECT_EQ(anova_data::warnings_with(second->warnings, "Groups without subjects leave 'g:h' 1 of its 2"), 1);
  EXPECT_EQ(anova_data::warnings_with(second->warnings, "prefer type II"), 0);
  EXPECT_GT(anova_data::warnings_with(third->warnings, "prefer type II"), 0);
}

TEST(RepeatedMeasures, WhatCannotBeDoneIsSaid) {
  const auto error = [](const RepeatedData& data) {
    const auto table = analysed(data);
    return table ? std::string("none") : table.error().message;
  };
  RepeatedData data = every_cell({1, 2, 3, 4, 5, 7}, {2});
  EXPECT_EQ(error(data), "none");
  data.between = {anova_data::numbered("g", {0, 1, 0, 0, 1, 1})};
  EXPECT_EQ(
      error(data),
      "'0' of 's' is both '0' and '1' of 'g': give each subject its own name, or 'g' as a within factor");
  data.between = {anova_data::numbered("g", {0, 0, 1, 1, 2, 2})};
  EXPECT_EQ(error(data), "3 subjects in 3 groups leave nothing for the error: measure more subjects");
  data.between.clear();
  data.values[1] = data.values[2] = NAN;
  EXPECT_EQ(error(data), "1 of 3 subjects have an observation in each of 2 cells: two are needed");
  data.within.clear();
  EXPECT_EQ(error(data), "there is no within-subjects factor: give one, or leave out the subject");
  EXPECT_EQ(error(every_cell({1, 2, 3}, {3})), "factor 's' has only the level '0': a comparison needs two");
}

TEST(RepeatedMeasures, PeopleWhoDifferByAConstantOnly) {
  const auto table = analysed(every_cell({0.1, 0.2, 0.4, 1.1, 1.2, 1.4, 3.1, 3.2, 3.4}, {3}));
  ASSERT_TRUE(table);
  EXPECT_EQ(table->terms[0].error_ss, 0.0);
  EXPECT_EQ(table->terms[0].f, INFINITY);
  EXPECT_FALSE(table->terms[0].sphericity);
  EXPECT_EQ(anova_data::warnings_with(table->warnings, "The error of 'S' is zero"), 1);
}

TEST(RepeatedMeasures, TooFewPeopleForMauchly) {
  const auto table = analysed(every_cell({1, 3, 2, 5, 4, 4, 7, 9, 2, 8, 6, 1}, {4}));
  ASSERT_TRUE(table);
  EXPECT_TRUE(std::isnan(table->terms[0].sphericity->mauchly_w));
  EXPECT_GE(table->terms[0].sphericity->greenhouse_geisser, 1.0 / 3.0);
  EXPECT_EQ(anova_data::warnings_with(table->warnings, "Mauchly"), 1);
}

TEST(RepeatedMeasures, ErrsAsOftenAsItSays) {
  base::Random random(20265);
  // In a spherical world, and in one where the last two conditions vary more.
  std::map<std::string, int> below, corrected;
  int not_spherical = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<double> values, skewed;
    for (int who = 0; who < 12; ++who) {
      const double person = 2.0 * anova_data::normal_value(random);
      for (int cell = 0; cell < 4; ++cell) {
        const double noise = anova_data::normal_value(random);
        values.push_back(person + noise);
        skewed.push_back(person + (cell < 2 ? 0.3 : 2.0) * noise);
      }
    }
    const std::vector<int> groups = {0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2};
    const auto table = analysed(every_cell(values, {4}, {groups}), SumsOfSquares::TypeIII);
    for (const auto& row : table->terms) below[row.term] += row.p < 0.05 ? 1 : 0;
    not_spherical += row_of(table->terms, "S").sphericity->p < 0.05 ? 1 : 0;
    const auto uneven = analysed(every_cell(skewed, {4}));
    corrected["p"] += uneven->terms[0].p < 0.05 ? 1 : 0;
    corrected["gg"] += uneven->terms[0].p_greenhouse_geisser < 0.05 ? 1 : 0;
    corrected["hf"] += uneven->terms[0].p_huynh_feldt < 0.05 ? 1 : 0;
  }
  for (const auto& [term, count] : below) {
    SCOPED_TRACE(term);
    anova_data::expect_level(count);
  }
  anova_data::expect_level(not_spherical);
  EXPECT_GT(corrected["p"], 0.06 * 2000);  // too often, which is what the corrections are for
  EXPECT_NEAR(corrected["gg"] / 2000.0, 0.05, 0.02);
  EXPECT_NEAR(corrected["hf"] / 2000.0, 0.05, 0.02);
}

}  // namespace
}  // namespace icome::stats
