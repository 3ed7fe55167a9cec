#pragma once
#include "apps/stats/stats_json.h"

namespace icome::apps {

/// Confidence of intervals of shares of variance: they leave out 0 just where p < .05 (Steiger 2004).
inline constexpr double kEffectConfidence = 0.90;

/// {"df", "ss", "ms"}.
inline StatsJson squares_json(int df, double ss, double ms) { return {{"df", df}, {"ss", ss}, {"ms", ms}}; }

/// The members of every row of a table of analysis of variance, between subjects or within.
template <typename Term>
StatsJson effect_json(const Term& term) {
  return {{"term", term.term},
          {"df", term.df},
          {"ss", term.ss},
          {"ms", term.ms},
          {"f", term.f},
          {"p", term.p},
          {"eta_sq", term.eta_sq},
          {"partial_eta_sq", term.partial_eta_sq},
          {"generalised_eta_sq", term.generalised_eta_sq},
          {"omega_sq", term.omega_sq},
          {"partial_omega_sq", term.partial_omega_sq}};
}

}  // namespace icome::apps
