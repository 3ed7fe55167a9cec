#pragma once
#include <string>
#include <vector>

#include "geometry/implicit/formula_pieces.h"

namespace icome::geometry {

/// A formula f without its choices, which abs, min, max, if and atan2 make, and asin, acos and atan of their
/// inverses or of a quotient, as asin(sin(a)) and atan(a/b): the solid f <= 0 is the union of ways, each the
/// space in which none of some smooth functions is positive. Where f rises or falls with a choice, as
/// z - max(x, -2*x) falls, a min in it joins solids and a max intersects them (where f falls, the reverse).
/// Otherwise each combination of choices is a way, bounded also by the functions of its choices.
struct FormulaWays {
  /// sign * formula <= 0
  struct Term {
    std::size_t formula;
    double sign;
  };
  std::vector<Formula> formulas;
  std::vector<std::vector<Term>> ways;

  /// Fails with a sentence on text that cannot be read, and with a clause if there are too many combinations.
  static base::Result<FormulaWays> parse(const std::string& text);
};

}  // namespace icome::geometry
