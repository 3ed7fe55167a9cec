#pragma once
#include <string>
#include <vector>

#include "geometry/implicit/formula_pieces.h"

namespace icome::geometry {

/// The solid f <= 0 of a formula, as a union of ways: a way is the space in which none of its smooth
/// functions is positive. Choices make f unsmooth: abs, min, max, if, atan2, and asin, acos or atan of their
/// inverses or of a quotient, as asin(sin(a)) and atan(a/b). If f grows with a min or max, the min joins
/// solids and the max intersects them; if f falls with it, as z - max(x, -2*x) does, the reverse. Otherwise
/// each combination of choices is a way, bounded also by the functions of its choices.
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
