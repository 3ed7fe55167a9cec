#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "stats/tables/factor.h"
#include "stats/tests/hypothesis.h"

namespace icome::stats {

/// Two levels of a factor, by a paired t-test of the same people, or by Welch's of different ones. Where
/// there is none, numbers are NaN and `why` says why.
struct LevelPair {
  std::size_t first = 0, second = 0;  // levels
  double difference = 0.0;            // mean of the second less mean of the first
  double t = 0.0, df = 0.0;
  double p = 1.0;
  double p_holm = 1.0;          // adjusted over all pairs of LevelComparisons
  ConfidenceInterval interval;  // of this difference alone, not adjusted
  double d = 0.0;               // Cohen's d_z of the same people, d_s of different ones
  ConfidenceInterval d_interval;
  std::string why;
};

/// A factor's levels where the other factors have the levels `at`: the simple effect of the factor there.
/// Numbers are NaN if it cannot be tested, and `why` says why.
struct LevelSlice {
  std::vector<int> at;       // a level of each of LevelComparisons::others; empty: averaged over all of them
  std::size_t subjects = 0;  // that count
  double f = 0.0;            // of a within factor by repeated measures of this slice alone, of others Welch's
  double df = 0.0,
         error_df = 0.0;  // within factors of more than two levels: as Greenhouse and Geisser have it
  double epsilon = 1.0;   // theirs; 1 where there is nothing to correct
  double p = 1.0;
  double p_holm = 1.0;  // adjusted over all slices
  double eta_sq = 0.0;  // SS / (SS + error SS) in this slice
  std::string why;
  std::vector<LevelPair> pairs;
};

/// How the levels of one factor differ.
struct LevelComparisons {
  Factor factor;               // without its observations
  bool within = false;         // of the same people
  std::vector<Factor> others;  // within factors first; without their observations
  std::vector<LevelSlice> slices;
  std::vector<std::string> warnings;
};

enum class Slicing : std::uint8_t {
  None,        // over the means of people over all other factors: post-hoc comparisons
  EveryOther,  // at each combination of levels of the other factors: simple effects
};

/// Compares the levels of the factor that is named, of people whom repeated_measures_anova() would analyse
/// (the arguments are the same). Pairs, and the effects of slices, are adjusted after Holm (1979), each over
/// all slices. Fails as that does, when no factor has the name, and when there are more than 10,000 slices
/// and pairs in all.
base::Result<LevelComparisons> compare_levels(std::span<const double> values, const Factor& subject,
                                              std::span<const Factor> within, std::span<const Factor> between,
                                              const std::string& name, Slicing slicing,
                                              double confidence = 0.95);

}  // namespace icome::stats
