#pragma once
#include <span>

#include "stats/models/anova.h"
#include "stats/tables/cells.h"

namespace icome::stats {

/// What factorial and one-way analysis begin with: n, cells, the sum of squares within them and in all. The
/// means of the cells are left less the grand mean.
struct AnovaStart {
  Anova anova;
  Cells cells;
  double within_ss = 0.0;
};
AnovaStart started_anova(const CompleteCases& cases, SumsOfSquares type);

/// From the sums of squares and degrees of freedom of terms and residual: everything else in their rows, with
/// warnings where F means nothing. Factors as they were given, for what is measured.
void complete_table(Anova& anova, std::span<const Factor> factors);

}  // namespace icome::stats
