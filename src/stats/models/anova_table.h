#pragma once
#include <span>

#include "stats/models/anova.h"
#include "stats/tables/cells.h"

namespace icome::stats {

/// The start of factorial and one-way analysis: n, the cells, and the sums of squares within them and in
/// all. The means of the cells are less the grand mean.
struct AnovaStart {
  Anova anova;
  Cells cells;
  double within_ss = 0.0;
};
AnovaStart started_anova(const CompleteCases& cases, SumsOfSquares type);

/// Computes the rest of the rows from the sums of squares and degrees of freedom of terms and residual, and
/// warns where F means nothing. `factors` tell which terms are measured.
void complete_table(Anova& anova, std::span<const Factor> factors);

}  // namespace icome::stats
