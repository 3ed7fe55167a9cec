#include <gtest/gtest.h>

#include "stats/anova_test_data.h"
#include "stats/models/anova.h"
#include "stats/models/repeated_measures.h"
#include "stats/tables/descriptives.h"

namespace icome::stats {
namespace {

/// A value that someone's file may hold.
double any_value(base::Random& random, std::uint64_t kind) {
  const double plain = anova_data::normal_value(random);
  switch (kind) {
    case 0:
      return plain;
    case 1:
      return static_cast<double>(random.index(2));
    case 2:
      return random.index(4) == 0 ? NAN : plain;
    case 3:
      return 1e149 * plain;
    case 4:
      return 1e-139 * plain;
    case 5:
      return random.index(9) == 0 ? 1e140 : plain;
    case 6:
      return 1e15 + static_cast<double>(random.index(3));
    case 7:
      return random.index(30) == 0 ? INFINITY : plain;
    default:
      return 0.1;
  }
}

void expect_chance(double p) { EXPECT_TRUE(std::isnan(p) || (p >= 0.0 && p <= 1.0)) << p; }

/// Between 0 and 1, or nothing.
void expect_share(double share) {
  EXPECT_TRUE(std::isnan(share) || (share >= 0.0 && share <= 1.0 + 1e-12)) << share;
}

void expect_sound(const base::Result<Anova>& anova) {
  if (!anova) {
    EXPECT_FALSE(anova.error().message.empty());
    return;
  }
  for (const AnovaTerm& term : anova->terms) {
    EXPECT_GE(term.ss, 0.0);
    EXPECT_TRUE(std::isfinite(term.ss));
    expect_chance(term.p);
    expect_share(term.eta_sq);
    expect_share(term.partial_eta_sq);
    expect_share(term.generalised_eta_sq);
    EXPECT_TRUE(!std::isnan(term.f) || !anova->warnings.empty());
  }
}

TEST(HostileAnova, WhateverTheInputThereIsATableOrASentence) {
  base::Random random(20269);
  int tables = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::size_t n = random.index(25);
    const std::uint64_t kind = random.index(9);
    std::vector<double> values;
    for (std::size_t k = 0; k < n; ++k) values.push_back(any_value(random, kind));
    std::vector<Factor> factors;
    for (std::size_t f = 0; f < 3; ++f) {
      std::vector<int> of;
      const std::uint64_t levels = 1 + random.index(f == 0 ? 8 : 4);
      for (std::size_t k = 0; k < n; ++k) {
        of.push_back(random.index(15) == 0 ? kNoLevel : static_cast<int>(random.index(levels)));
      }
      factors.push_back(anova_data::numbered(std::string(1, static_cast<char>('a' + f)), of));
      factors.back().measured = random.index(2) == 0;
    }
    const auto type = static_cast<SumsOfSquares>(random.index(3));
    const std::span<const Factor> some = std::span(factors).first(1 + random.index(3));
    const auto anova = factorial_anova(values, some, {type, 1 + static_cast<int>(random.index(3))});
    tables += anova ? 1 : 0;
    expect_sound(anova);
    expect_sound(one_way_anova(values, factors[0]));
    if (const auto welch = welch_anova(values, factors[0])) expect_chance(welch->p);
    const auto repeated =
        repeated_measures_anova(values, factors[0], std::span(factors).subspan(1, 1), {}, type);
    if (repeated) {
      for (const auto& row : repeated->terms) {
        expect_chance(row.p);
        expect_chance(row.p_greenhouse_geisser);
        expect_chance(row.p_huynh_feldt);
        expect_share(row.generalised_eta_sq);
      }
    }
    const auto outliers = describe_outliers(values);
    EXPECT_TRUE(!outliers || std::isfinite(outliers->with.mean));
    describe_cells(values, factors);
  }
  EXPECT_GT(tables, 1000);
}

}  // namespace
}  // namespace icome::stats
