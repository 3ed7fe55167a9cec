#include "study/records/allocation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "study/definition/study_reader.h"
#include "study/definition/templates.h"

namespace icome::study {
namespace {

/// Sex, class of age and experience of the people of section 6.6.1: twenty men and four women of about 30.
std::vector<Classes> thesis_people(std::uint64_t seed) {
  base::Random random(seed);
  std::vector<Classes> people;
  for (std::size_t i = 0; i < 24; ++i) people.push_back({i < 4 ? 0U : 1U, random.index(4), random.index(3)});
  for (std::size_t left = people.size(); left > 1; --left)
    std::swap(people[left - 1], people[random.index(left)]);
  return people;
}

AllocationPlan thesis_plan() { return {2, {{3, 3.0}, {4, 1.0}, {3, 1.0}}, 2, 12, 66}; }

std::vector<Allocated> allocated(const AllocationPlan& plan, const std::vector<Classes>& people) {
  std::vector<Allocated> already;
  for (const Classes& person : people) already.push_back({person, allocate(plan, already, person)});
  return already;
}

std::size_t count_in(const std::vector<Allocated>& people, std::size_t group) {
  return std::size_t(std::ranges::count(people, group, &Allocated::group));
}

std::size_t count_of(const std::vector<Allocated>& people, std::size_t group, std::size_t factor,
                     std::size_t level) {
  return std::size_t(std::ranges::count_if(people, [&](const Allocated& person) {
    return person.group == group && person.classes[factor] == level;
  }));
}

/// By how many people the two groups differ, over all classes of all factors.
double difference(const std::vector<Allocated>& people) {
  double sum = 0.0;
  for (std::size_t factor = 0; factor < 3; ++factor)
    for (std::size_t level = 0; level < 4; ++level)
      sum +=
          std::abs(double(count_of(people, 0, factor, level)) - double(count_of(people, 1, factor, level)));
  return sum;
}

/// Groups of equal size by lot, as it would be done without looking at anybody.
std::vector<Allocated> drawn(const std::vector<Classes>& people, base::Random& random) {
  std::vector<std::size_t> groups;
  for (std::size_t i = 0; i < people.size(); ++i) groups.push_back(i % 2);
  for (std::size_t left = groups.size(); left > 1; --left)
    std::swap(groups[left - 1], groups[random.index(left)]);
  std::vector<Allocated> result;
  for (std::size_t i = 0; i < people.size(); ++i) result.push_back({people[i], groups[i]});
  return result;
}

TEST(Allocation, PeopleOfTheThesisAreSpreadEvenly) {
  int women_parted = 0;
  double minimised = 0.0, by_lot = 0.0;
  base::Random random(5);
  constexpr int kArrivals = 500;
  for (int seed = 0; seed < kArrivals; ++seed) {
    const std::vector<Classes> people = thesis_people(std::uint64_t(seed));
    const std::vector<Allocated> groups = allocated(thesis_plan(), people);
    ASSERT_EQ(count_in(groups, 0), 12U) << seed;
    women_parted += count_of(groups, 0, 0, 0) == 2 ? 1 : 0;
    minimised += difference(groups);
    by_lot += difference(drawn(people, random));
  }
  EXPECT_EQ(women_parted, kArrivals);  // two in each group, as they count three times
  EXPECT_LT(minimised, 0.5 * by_lot);
}

TEST(Allocation, IsTheSameAgain) {
  const std::vector<Classes> people = thesis_people(3);
  const auto once = allocated(thesis_plan(), people), again = allocated(thesis_plan(), people);
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i].group, again[i].group);
}

TEST(Allocation, WithoutFactorsGroupsFillInTurn) {
  const AllocationPlan plan{3, {}, 1, 0, 1};
  std::vector<Allocated> already;
  for (std::size_t i = 0; i < 30; ++i) {
    already.push_back({{}, allocate(plan, already, {})});
    for (std::size_t group = 0; group < 3; ++group) {
      EXPECT_GE(count_in(already, group), (i + 1) / 3);
      EXPECT_LE(count_in(already, group), i / 3 + 1);
    }
  }
}

TEST(Allocation, TheSeedDrawsAmongEquals) {
  int zeros = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed)
    zeros += allocate({2, {}, 1, 0, seed}, {}, {}) == 0 ? 1 : 0;
  EXPECT_NEAR(zeros, 500, 80);  // 5 standard deviations
}

TEST(Allocation, WhoIsAloneGoesWhereNobodyIsLikeThem) {
  const AllocationPlan plan{2, {{2, 1.0}}, 2, 0, 1};
  const std::vector<Allocated> already = {{{0}, 0}, {{1}, 1}};
  EXPECT_EQ(allocate(plan, already, {0}), 1U);
  EXPECT_EQ(allocate(plan, already, {1}), 0U);
}

/// Against a rule that is written down independently: the least sum over factors of |difference|.
TEST(Allocation, TwoGroupsAgreeWithTheDefinition) {
  base::Random random(11);
  for (int round = 0; round < 300; ++round) {
    const AllocationPlan plan{2, {{2, 1.5}, {3, 1.0}}, 1000, 0, 7};
    std::vector<Allocated> already;
    for (std::size_t i = 0; i < random.index(12); ++i)
      already.push_back({{random.index(2), random.index(3)}, random.index(2)});
    const Classes person = {random.index(2), random.index(3)};
    double cost[2] = {0.0, 0.0};
    for (std::size_t group = 0; group < 2; ++group)
      for (std::size_t factor = 0; factor < 2; ++factor) {
        const double there = double(count_of(already, group, factor, person[factor])) + 1.0;
        const double elsewhere = double(count_of(already, 1 - group, factor, person[factor]));
        cost[group] += plan.factors[factor].weight * std::abs(there - elsewhere);
      }
    const std::size_t chosen = allocate(plan, already, person);
    EXPECT_LE(cost[chosen], cost[1 - chosen]);
  }
}

TEST(Allocation, PlanAndClassesComeFromTheStudy) {
  const auto study = read_study(*study_template("menu", "menu"), "menu.toml");
  ASSERT_TRUE(study) << study.error().message;
  const AllocationPlan plan = allocation_plan(*study);
  EXPECT_EQ(plan.groups, 2U);
  EXPECT_EQ(plan.group_size, 12U);
  ASSERT_EQ(plan.factors.size(), 3U);
  EXPECT_EQ(plan.factors[0].classes, 3U);
  EXPECT_EQ(plan.factors[0].weight, 3.0);
  EXPECT_EQ(plan.factors[1].classes, 4U);  // split at three ages
  EXPECT_EQ(*classes_of(*study, {"male", "30", "much"}), (Classes{1, 1, 2}));
  EXPECT_EQ(*classes_of(*study, {"female", "25", "little"}), (Classes{0, 1, 0}));
  EXPECT_EQ(*classes_of(*study, {"female", "24.9", "little"}), (Classes{0, 0, 0}));
  EXPECT_EQ(classes_of(*study, {"male", "thirty", "much"}).error().message,
            "'age' is a number, and 'thirty' is none.");
  EXPECT_EQ(classes_of(*study, {"men", "30", "much"}).error().message, "'sex' has no level 'men'.");
  EXPECT_FALSE(classes_of(*study, {"male", "nan", "much"}));
  EXPECT_FALSE(classes_of(*study, {"male"}));
}

}  // namespace
}  // namespace icome::study
