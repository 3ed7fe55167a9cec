#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/implicit/formula.h"

namespace icome::geometry {

/// A formula taken apart into smooth functions. Each abs, min, max and if in it is a choice between two
/// operands (abs(a): a or -a); with every choice made, what is left is smooth: z - abs(x) is z - x or z + x.
/// So is each atan2(y, x), by the sign of y: what it is there goes on smoothly beyond, so that a spiral or a
/// star has no edge where the angle jumps by 2 pi unless it jumps there itself. So are a zigzag such as
/// asin(sin(a)), by the sign of cos(a), and atan(a/b), by that of b. Where a formula may jump, or begin to
/// have values, is the zero of a smooth function too: the denominator's, or that of what a root is taken of.
struct FormulaPieces {
  using ChoiceSet = std::uint64_t;  // a bit for each choice

  /// Choices that leave a piece: those `made`, and which of these take their second operand. The others do
  /// not matter then.
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

  /// What becomes of pieces where a root, a power, asin or acos ends. Where they `GoOn`, a piece need not be
  /// the formula with its choices made: it has the same zeros, faces the same way there, and is trimmed by
  /// more choices.
  enum class Ends { AsWritten, GoOn };
  /// Fails with a sentence that names the column.
  static base::Result<FormulaPieces> parse(const std::string& text, Ends ends = Ends::AsWritten);
};

}  // namespace icome::geometry
