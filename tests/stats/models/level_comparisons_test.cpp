#include "stats/models/level_comparisons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace icome::stats {
namespace {

/// Times of seven people, four novices and three experts, with three ways of pointing at two targets;
/// invented.
struct MixedSample {
  std::vector<double> values;
  Factor person{"person", {}, {}, false};
  std::vector<Factor> within{{"way", {"ray", "hand", "wim"}, {}, false},
                             {"target", {"near", "far"}, {}, false}};
  std::vector<Factor> between{{"group", {"novice", "expert"}, {}, false}};
};

MixedSample mixed_sample() {
  const std::vector<std::vector<double>> rows = {
      {1.2, 2.1, 1.9, 3.2, 1.4, 2.9}, {1.1, 1.8, 2.2, 3.0, 1.6, 2.5}, {1.5, 2.6, 2.4, 4.1, 1.9, 3.0},
      {0.9, 1.9, 1.7, 2.8, 1.2, 2.6}, {0.8, 1.2, 1.1, 1.9, 1.3, 1.4}, {0.7, 1.5, 1.4, 2.1, 0.9, 1.6},
      {1.0, 1.4, 1.3, 1.6, 1.2, 1.9}};
  MixedSample sample;
  for (std::size_t person = 0; person < rows.size(); ++person) {
    sample.person.levels.push_back(std::to_string(person + 1));
    for (std::size_t cell = 0; cell < rows[person].size(); ++cell) {
      sample.values.push_back(rows[person][cell]);
      sample.person.of.push_back(int(person));
      sample.within[0].of.push_back(int(cell / 2));
      sample.within[1].of.push_back(int(cell % 2));
      sample.between[0].of.push_back(person < 4 ? 0 : 1);
    }
  }
  return sample;
}

base::Result<LevelComparisons> compared(const MixedSample& sample, const char* name, Slicing slicing) {
  return compare_levels(sample.values, sample.person, sample.within, sample.between, name, slicing);
}

TEST(LevelComparisons, OfTheSamePeopleArePairedAndHolms) {
  const auto way = compared(mixed_sample(), "way", Slicing::None);
  ASSERT_TRUE(way) << way.error().message;
  EXPECT_TRUE(way->within);
  ASSERT_EQ(way->slices.size(), 1U);
  const std::vector<LevelPair>& pairs = way->slices[0].pairs;
  ASSERT_EQ(pairs.size(), 3U);
  // R 4.2.2: w <- tapply(t, list(person, way), mean); t.test(w[, 2], w[, 1], paired = TRUE); p.adjust(p,
  // "holm")
  EXPECT_NEAR(pairs[0].difference, 0.785714285714286, 1e-12);
  EXPECT_NEAR(pairs[0].t, 6.049193494630824, 1e-9);
  EXPECT_EQ(pairs[0].df, 6.0);
  EXPECT_NEAR(pairs[0].p, 0.000924042908472241, 1e-12);
  EXPECT_NEAR(pairs[0].p_holm, 0.001848085816944483, 1e-12);
  EXPECT_NEAR(pairs[1].p_holm, 0.000938390122969384, 1e-12);
  EXPECT_NEAR(pairs[2].t, -3.4548893793042743, 1e-9);
  EXPECT_NEAR(pairs[2].p_holm, 0.0135516923665595, 1e-12);
}

TEST(LevelComparisons, OfDifferentPeopleAreWelchs) {
  const auto group = compared(mixed_sample(), "group", Slicing::None);
  ASSERT_TRUE(group) << group.error().message;
  EXPECT_FALSE(group->within);
  // t.test(t ~ group) of people's means, expert less novice
  const LevelPair& pair = group->slices[0].pairs.at(0);
  EXPECT_NEAR(pair.t, -4.976591504301, 1e-9);
  EXPECT_NEAR(pair.df, 3.291639623885, 1e-9);
  EXPECT_NEAR(pair.p, 0.0124639764468, 1e-11);
  EXPECT_NEAR(pair.interval.low, -1.280173641137881, 1e-9);
  EXPECT_NEAR(pair.interval.high, -0.311493025528785, 1e-9);
}

TEST(SimpleEffects, OfTheSamePeopleAreGreenhouseAndGeissers) {
  const auto way = compared(mixed_sample(), "way", Slicing::EveryOther);
  ASSERT_TRUE(way) << way.error().message;
  ASSERT_EQ(way->others.size(), 2U);
  EXPECT_EQ(way->others[0].name, "target");
  ASSERT_EQ(way->slices.size(), 4U);
  // summary(aov(t ~ way + Error(person / way))) of each target and group, epsilon by cov(), p.adjust(p,
  // "holm")
  const auto at = [&](int target, int group) -> const LevelSlice& {
    for (const LevelSlice& slice : way->slices)
      if (slice.at == std::vector<int>{target, group}) return slice;
    throw std::runtime_error("no such slice");
  };
  EXPECT_EQ(at(0, 0).subjects, 4U);
  EXPECT_NEAR(at(0, 0).f, 96.3103448275859, 1e-8);
  EXPECT_NEAR(at(0, 0).epsilon, 0.522360248447205, 1e-10);
  EXPECT_NEAR(at(0, 0).df, 2.0 * 0.522360248447205, 1e-10);
  EXPECT_NEAR(at(0, 0).p, 0.00184078832820513, 1e-11);
  EXPECT_NEAR(at(0, 0).p_holm, 0.00736315331282053, 1e-10);
  EXPECT_NEAR(at(0, 0).eta_sq, 0.969791666666666, 1e-11);
  EXPECT_NEAR(at(1, 0).p_holm, 0.02648198340550009, 1e-10);
  EXPECT_EQ(at(1, 1).subjects, 3U);
  EXPECT_NEAR(at(1, 1).f, 3.44897959183674, 1e-9);
  EXPECT_NEAR(at(1, 1).p, 0.201634757585135, 1e-10);
  EXPECT_NEAR(at(1, 1).p_holm, 0.31027128494982809, 1e-10);
  // t.test() of pairs in each slice, p.adjust() over all twelve
  EXPECT_NEAR(at(0, 0).pairs[2].p, 0.000236199470936777, 1e-12);
  EXPECT_NEAR(at(0, 0).pairs[2].p_holm, 0.00283439365124133, 1e-11);
  EXPECT_NEAR(at(1, 1).pairs[2].p_holm, 0.94769556079603934, 1e-9);
}

TEST(SimpleEffects, OfDifferentPeopleAreWelchs) {
  const auto group = compared(mixed_sample(), "group", Slicing::EveryOther);
  ASSERT_TRUE(group) << group.error().message;
  ASSERT_EQ(group->slices.size(), 6U);
  // oneway.test(t ~ group) of each way and target, p.adjust(p, "holm")
  EXPECT_EQ(group->slices[1].at, (std::vector<int>{0, 1}));
  EXPECT_NEAR(group->slices[1].f, 13.6338028169014, 1e-9);
  EXPECT_NEAR(group->slices[1].error_df, 4.268416596105, 1e-9);
  EXPECT_NEAR(group->slices[1].p, 0.0187021231874055, 1e-11);
  EXPECT_NEAR(group->slices[1].p_holm, 0.0561063695622165, 1e-10);
  EXPECT_NEAR(group->slices[5].p_holm, 0.0191640859812814, 1e-10);
  EXPECT_NEAR(group->slices[5].pairs[0].p, group->slices[5].p, 1e-12) << "of two groups both are one test";
}

TEST(LevelComparisons, ThatCannotBeTestedSayWhyAndLeaveTheOthers) {
  MixedSample sample = mixed_sample();
  for (std::size_t i = 0; i < sample.values.size();
       ++i)  // who uses the hand takes 0.1 s more than with the ray
    if (sample.within[0].of[i] == 1) sample.values[i] = sample.values[i - 2] + 0.1;
  const auto way = compared(sample, "way", Slicing::None);
  ASSERT_TRUE(way);
  const std::vector<LevelPair>& pairs = way->slices[0].pairs;
  EXPECT_EQ(pairs[0].why, "everybody differs by the same");
  EXPECT_TRUE(std::isnan(pairs[0].p) && std::isnan(pairs[0].p_holm));
  EXPECT_NEAR(pairs[0].difference, 0.1, 1e-12);
  EXPECT_EQ(pairs[1].why, "");
  EXPECT_NEAR(std::max(pairs[1].p_holm, pairs[2].p_holm), std::min(1.0, std::max(pairs[1].p, pairs[2].p)),
              1e-12)
      << "Holm counts the two that were tested";
}

TEST(LevelComparisons, OfGroupsOfOnePersonSayWhy) {
  MixedSample sample = mixed_sample();
  for (std::size_t i = 0; i < sample.values.size(); ++i)
    sample.between[0].of[i] = sample.person.of[i] < 6 ? 0 : 1;
  const auto group = compared(sample, "group", Slicing::EveryOther);
  ASSERT_TRUE(group) << group.error().message;
  for (const LevelSlice& slice : group->slices) {
    EXPECT_EQ(slice.why, "fewer than two people of a level");
    EXPECT_EQ(slice.pairs[0].why, "fewer than two people");
  }
}

TEST(LevelComparisons, NeedAFactorOfTheAnalysis) {
  const auto none = compared(mixed_sample(), "person", Slicing::None);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message, "'person' is no factor of this analysis: name one of its factors");
}

}  // namespace
}  // namespace icome::stats
