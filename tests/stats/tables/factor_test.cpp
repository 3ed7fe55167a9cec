#include "stats/tables/factor.h"

#include <gtest/gtest.h>

#include "stats/anova_test_data.h"

namespace icome::stats {
namespace {

TEST(Factors, LevelsInOrderOfAppearance) {
  const Factor factor = factor_of("x", std::vector<std::string>{"b", "", "a", "b"});
  EXPECT_EQ(factor.levels, (std::vector<std::string>{"b", "a"}));
  EXPECT_EQ(factor.of, (std::vector{0, kNoLevel, 1, 0}));
}

TEST(Factors, CompleteCasesKeepOnlyLevelsThatOccur) {
  const std::vector<Factor> factors = {{"x", {"p", "q", "r"}, {0, 1, 2, 2}, true}};
  const auto cases = complete_cases(std::vector<double>{1, NAN, 3, 4}, factors);
  ASSERT_TRUE(cases);
  EXPECT_EQ(cases->values, (std::vector<double>{1, 3, 4}));
  EXPECT_EQ(cases->factors[0].levels, (std::vector<std::string>{"p", "r"}));
  EXPECT_EQ(cases->factors[0].of, (std::vector{0, 1, 1}));
  EXPECT_TRUE(cases->factors[0].measured);
  EXPECT_EQ(cases->missing, 1u);
}

TEST(Factors, TooManyCombinationsAreRefused) {
  std::vector<Factor> factors;
  for (int i = 0; i < 70; ++i) factors.push_back(anova_data::numbered(std::to_string(i), {0, 1}));
  EXPECT_EQ(complete_cases(std::vector<double>{1, 2}, factors).error().message,
            "the factors' levels have too many combinations: leave out factors");
}

}  // namespace
}  // namespace icome::stats
