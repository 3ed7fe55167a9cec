#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "stats/tables/factor.h"
#include "stats/tests/hypothesis.h"

namespace icome::stats {

/// Two levels of a factor, compared by a paired t-test of the same people or by Welch's of different
/// people. Without a test its numbers are NaN and `why` gives the reason.
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

/// The simple effect of a factor: its levels where the other factors have the levels `at`. Numbers are
/// NaN if it cannot be tested, and `why` gives the reason.
struct LevelSlice {
  std::vector<int> at;       // a level of each of LevelComparisons::others; empty: averaged over all of them
  std::size_t subjects = 0;  // used
  double f = 0.0;            // within factor: repeated measures of this slice alone; otherwise Welch's
  double df = 0.0,
         error_df = 0.0;  // within factors of more than two levels: corrected after Greenhouse and Geisser
  double epsilon = 1.0;   // Greenhouse and Geisser's; 1 where there is nothing to correct
  double p = 1.0;
  double p_holm = 1.0;  // adjusted over all slices
  double eta_sq = 0.0;  // SS / (SS + error SS) in this slice
  std::string why;
  std::vector<LevelPair> pairs;
};

/// The comparisons of the levels of one factor.
struct LevelComparisons {
  Factor factor;               // without its observations
  bool within = false;         // of the same people
  std::vector<Factor> others;  // within factors first; without their observations
  std::vector<LevelSlice> slices;
  std::vector<std::string> warnings;
};

enum class Slicing : std::uint8_t {
  None,        // people's means over all other factors: post-hoc comparisons
  EveryOther,  // at each combination of levels of the other factors: simple effects
};

/// Compares the levels of the factor `name` for the people whom repeated_measures_anova() would analyse (it
/// takes the same arguments). Pairs, and the effects of slices, are adjusted after Holm (1979), each over
/// all slices. Fails as subject_table() does, when no factor has the name, when the confidence is not
/// between 0 and 1, and when there are more than 10,000 slices and pairs in all.
base::Result<LevelComparisons> compare_levels(std::span<const double> values, const Factor& subject,
                                              std::span<const Factor> within, std::span<const Factor> between,
                                              const std::string& name, Slicing slicing,
                                              double confidence = 0.95);

}  // namespace icome::stats
