#include "stats/models/model_terms.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/QR>
#include <algorithm>

namespace icome::stats {
namespace {

/// Appends all terms that extend `begun` by `more` factors.
void append_terms(Term& begun, int factors, int more, std::vector<Term>& terms) {
  if (more == 0) {
    terms.push_back(begun);
    return;
  }
  for (int next = begun.empty() ? 0 : begun.back() + 1; next < factors; ++next) {
    begun.push_back(next);
    append_terms(begun, factors, more - 1, terms);
    begun.pop_back();
  }
}

/// 1 at its own level's column, -1 everywhere at the last level, otherwise 0 (R's contr.sum).
Eigen::RowVectorXd sum_to_zero(int level, int levels) {
  if (level == levels - 1) return Eigen::RowVectorXd::Constant(levels - 1, -1.0);
  return Eigen::RowVectorXd::Unit(levels - 1, level);
}

/// Every product of an element of a with one of b.
Eigen::RowVectorXd products(const Eigen::RowVectorXd& a, const Eigen::RowVectorXd& b) {
  Eigen::RowVectorXd result(a.size() * b.size());
  for (Eigen::Index i = 0; i < a.size(); ++i) result.segment(i * b.size(), b.size()) = a[i] * b;
  return result;
}

/// Is a term adjusted for another one in this type of sums of squares?
bool is_adjusted_for(std::size_t term, std::size_t other, std::span<const Term> terms, SumsOfSquares type) {
  if (term == other) return false;
  if (type == SumsOfSquares::TypeI) return other < term;
  return type == SumsOfSquares::TypeIII || !contains(terms[other], terms[term]);
}

/// An orthonormal basis of the columns, whose lengths are at most 1.
Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  const Eigen::Index most = std::min(columns.rows(), columns.cols());
  Eigen::Index rank = 0;
  while (rank < most && std::abs(qr.matrixQR()(rank, rank)) > 1e-8) ++rank;
  return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), rank);
}

}  // namespace

std::vector<Term> model_terms(int factors, int highest) {
  std::vector<Term> terms;
  for (int size = 1; size <= std::min(factors, highest); ++size) {
    Term begun;
    append_terms(begun, factors, size, terms);
  }
  return terms;
}

bool contains(const Term& whole, const Term& part) {
  return std::includes(whole.begin(), whole.end(), part.begin(), part.end());
}

std::string term_name(std::span<const Factor> factors, const Term& term) {
  if (term.empty()) return "1";
  std::vector<std::string> names;
  for (const int factor : term) names.push_back(factors[static_cast<std::size_t>(factor)].name);
  return fmt::format("{}", fmt::join(names, ":"));
}

Eigen::MatrixXd term_columns(std::span<const Factor> factors, const Term& term,
                             std::span<const std::vector<int>> rows) {
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(rows.size()),
                          static_cast<Eigen::Index>(column_count(factors, term)));
  for (std::size_t row = 0; row < rows.size(); ++row) {
    Eigen::RowVectorXd values = Eigen::RowVectorXd::Ones(1);
    for (const int factor : term) {
      const auto index = static_cast<std::size_t>(factor);
      values =
          products(values, sum_to_zero(rows[row][index], static_cast<int>(factors[index].levels.size())));
    }
    columns.row(static_cast<Eigen::Index>(row)) = values;
  }
  return columns;
}

double column_count(std::span<const Factor> factors, const Term& term) {
  double count = 1.0;
  for (const int factor : term) {
    count *= static_cast<double>(factors[static_cast<std::size_t>(factor)].levels.size() - 1);
  }
  return std::min(count, 1e9);
}

Eigen::MatrixXd Directions::without(const Eigen::MatrixXd& columns) const {
  // Twice, as the first pass leaves rounding in proportion to the part that it removes.
  Eigen::MatrixXd rest = columns - basis_ * (basis_.transpose() * columns);
  rest -= basis_ * (basis_.transpose() * rest);
  return rest;
}

int Directions::add(const Eigen::MatrixXd& columns) {
  const Eigen::VectorXd lengths = columns.colwise().norm().transpose().unaryExpr(
      [](double length) { return length > 0.0 ? length : 1.0; });
  Eigen::MatrixXd fresh = orthonormal_basis(without(columns * lengths.cwiseInverse().asDiagonal()));
  if (fresh.cols() == 0) return 0;
  // The small rest of a column has been stretched, and its rounding with it.
  const Eigen::HouseholderQR<Eigen::MatrixXd> again(without(fresh));
  fresh = again.householderQ() * Eigen::MatrixXd::Identity(fresh.rows(), fresh.cols());
  Eigen::MatrixXd grown(basis_.rows(), basis_.cols() + fresh.cols());
  grown << basis_, fresh;
  basis_ = std::move(grown);
  return static_cast<int>(fresh.cols());
}

ModelDirections model_directions(std::span<const Term> terms, std::span<const Eigen::MatrixXd> columns,
                                 SumsOfSquares type) {
  ModelDirections model{{}, Directions(columns.front().rows())};
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const int added = model.all.add(columns[i]);
    if (type == SumsOfSquares::TypeI) model.terms.push_back({terms[i], model.all.last(added)});
  }
  if (type == SumsOfSquares::TypeI) return model;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    Directions others(columns.front().rows());
    for (std::size_t k = 0; k < terms.size(); ++k) {
      if (is_adjusted_for(i, k, terms, type)) others.add(columns[k]);
    }
    const int added = others.add(columns[i]);
    model.terms.push_back({terms[i], others.last(added)});
  }
  return model;
}

}  // namespace icome::stats
