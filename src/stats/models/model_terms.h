#pragma once
#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "stats/models/anova.h"

namespace icome::stats {

/// Factors that act together: indices, ascending. Empty: the grand mean.
using Term = std::vector<int>;

/// Every term of so many factors without the grand mean: single factors first, then pairs, ..., up to
/// `highest` factors in one.
std::vector<Term> model_terms(int factors, int highest);

/// Whether `whole` has every factor of `part`.
bool contains(const Term& whole, const Term& part);

/// "wool:tension"; "1" for the grand mean.
std::string term_name(std::span<const Factor> factors, const Term& term);

/// The columns of a term under sum-to-zero contrasts, a row for each row of levels (one level a factor).
Eigen::MatrixXd term_columns(std::span<const Factor> factors, const Term& term,
                             std::span<const std::vector<int>> rows);

/// How many columns a term has, as far as one need know: the product stops growing at 1e9.
double column_count(std::span<const Factor> factors, const Term& term);

/// Orthonormal directions that grow by what new columns add to them.
class Directions {
 public:
  explicit Directions(Eigen::Index rows) : basis_(rows, 0) {}

  /// Adds what is new in the columns, at most 1e-8 of a column's length being rounding. Returns how many
  /// directions that is: the columns' rank given what was there.
  int add(const Eigen::MatrixXd& columns);

  Eigen::Index size() const { return basis_.cols(); }
  /// The last `count` directions.
  auto last(int count) const { return basis_.rightCols(count); }
  /// What is left of the columns without their parts along the directions.
  Eigen::MatrixXd without(const Eigen::MatrixXd& columns) const;

 private:
  Eigen::MatrixXd basis_;
};

/// Directions (columns, orthonormal) along which a term's effect lies after what it is adjusted for. Where
/// the rows are not enough to tell it apart there are fewer than its columns, or none.
struct TermDirections {
  Term term;
  Eigen::MatrixXd directions;
};

/// The directions of every term, and of all of them with the grand mean. `columns` go with `terms`, the first
/// of which is the grand mean.
struct ModelDirections {
  std::vector<TermDirections> terms;
  Directions all;
};
ModelDirections model_directions(std::span<const Term> terms, std::span<const Eigen::MatrixXd> columns,
                                 SumsOfSquares type);

}  // namespace icome::stats
