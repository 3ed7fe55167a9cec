#pragma once
#include <string>
#include <vector>

#include "geometry/implicit/formula_pieces.h"

namespace icome::geometry {

/// A formula f without choices, which abs, min, max, if and atan2 make, and asin, acos and atan of what they
/// undo or of a quotient, as asin(sin(a)) and atan(a/b): the solid f <= 0 is the union of ways, and each way
/// is where none of some smooth functions is positive. Where f rises with what is chosen from, as z - max(x,
/// -2*x) falls with it, min joins solids and max cuts them with each other. Otherwise each combination of
/// choices is a way, bounded also by where it is made.
struct FormulaWays {
  /// sign * formula <= 0
  struct Term {
    std::size_t formula;
    double sign;
  };
  std::vector<Formula> formulas;
  std::vector<std::vector<Term>> ways;

  /// Fails with a sentence on what cannot be read, and with a clause where there are too many combinations.
  static base::Result<FormulaWays> parse(const std::string& text);
};

}  // namespace icome::geometry
