#pragma once
#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "stats/models/anova.h"

namespace icome::stats {

/// Factors that act together: indices, ascending. Empty: the grand mean.
using Term = std::vector<int>;

/// All terms of that many factors without the grand mean: single factors first, then pairs, ..., up
/// to `highest` factors in one.
std::vector<Term> model_terms(int factors, int highest);

/// Does `whole` have every factor of `part`?
bool contains(const Term& whole, const Term& part);

/// "wool:tension"; "1" for the grand mean.
std::string term_name(std::span<const Factor> factors, const Term& term);

/// The columns of a term under sum-to-zero contrasts, a row for each row of levels (one level a factor).
Eigen::MatrixXd term_columns(std::span<const Factor> factors, const Term& term,
                             std::span<const std::vector<int>> rows);

/// The number of columns of a term, at most 1e9: a larger number is cut.
double column_count(std::span<const Factor> factors, const Term& term);

/// An orthonormal basis that new columns extend.
class Directions {
 public:
  explicit Directions(Eigen::Index rows) : basis_(rows, 0) {}

  /// Adds the directions that are new in the columns; up to 1e-8 of a column's length counts as
  /// rounding. Returns their number: the rank that the columns add.
  int add(const Eigen::MatrixXd& columns);

  Eigen::Index size() const { return basis_.cols(); }
  /// The last `count` directions.
  auto last(int count) const { return basis_.rightCols(count); }
  /// The columns without their parts along the directions.
  Eigen::MatrixXd without(const Eigen::MatrixXd& columns) const;

 private:
  Eigen::MatrixXd basis_;
};

/// The directions (orthonormal columns) of a term's effect, adjusted for other terms. Where the rows are
/// not enough to tell it apart there are fewer directions than columns of the term, or none.
struct TermDirections {
  Term term;
  Eigen::MatrixXd directions;
};

/// The directions of every term, and those of all terms with the grand mean. `columns` belong to `terms`, the
/// first of which is the grand mean.
struct ModelDirections {
  std::vector<TermDirections> terms;
  Directions all;
};
ModelDirections model_directions(std::span<const Term> terms, std::span<const Eigen::MatrixXd> columns,
                                 SumsOfSquares type);

}  // namespace icome::stats
