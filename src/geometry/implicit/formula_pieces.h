#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/implicit/formula.h"

namespace icome::geometry {

/// A formula taken apart into smooth functions. Each abs, min, max and if in it is a choice between two
/// operands (abs(a): a or -a); with every choice made, a smooth function is left: z - abs(x) is z - x or
/// z + x. atan2(y, x) is a choice by the sign of y: each branch goes on smoothly beyond, so that a spiral or
/// a star has no edge where the angle jumps by 2 pi unless it jumps there itself. A zigzag such as
/// asin(sin(a)) is one by the sign of cos(a), and atan(a/b) by that of b. A formula may jump, or begin to
/// have values, only at zeros of smooth functions too: of a denominator, or of the operand of a root.
struct FormulaPieces {
  using ChoiceSet = std::uint64_t;  // a bit for each choice

  /// A combination of choices that leaves a piece: those `made`, and those of them that take their `second`
  /// operand. The others do not matter then.
  struct Case {
    ChoiceSet made, second;
  };
  struct Piece {
    Formula formula;
    std::vector<Case> cases;
  };

  Formula whole;
  /// Different functions of x, y, z. A part of a formula with more than some hundred combinations of choices,
  /// or more than 64 choices, stays as it is, with its creases.
  std::vector<Piece> pieces;
  /// A choice takes its first operand where its function here is zero or less.
  std::vector<Formula> choices;
  /// The formula may jump, or begin to have values, only where one of these goes through zero, each given
  /// with either sign (and where atan2 is undefined, and in parts with creases).
  std::vector<Formula> borders;

  /// The treatment of pieces where a root, a power, asin or acos ends. With `GoOn`, a piece need not be the
  /// formula with its choices made: it has the same zeros, faces the same way there, and is trimmed by more
  /// choices.
  enum class Ends { AsWritten, GoOn };
  /// Fails with a sentence that names the column.
  static base::Result<FormulaPieces> parse(const std::string& text, Ends ends = Ends::AsWritten);
};

}  // namespace icome::geometry
