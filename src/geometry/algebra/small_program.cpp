#include "geometry/algebra/small_program.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>

namespace icome::geometry {
namespace {

using base::Matrix3;
using base::Vector3;

constexpr double kLeastSpan = 1e-12;  // for two independent rows, the least squared sine between them

/// Tries sets of rows that hold with equality.
class ActiveSets {
 public:
  ActiveSets(std::span<const SmallProgram::Row> rows, const Matrix3& inverse, const Vector3& p, double doubt)
      : rows_(rows), doubt_(doubt), free_(-inverse * p) {
    for (std::size_t i = 0; i < rows.size(); ++i) pushed_[i] = inverse * rows[i].normal;
  }

  /// Tries the guess's active set only. The solution is unique: any set that finds it will do.
  std::optional<SmallProgram::Solution> find_by(const SmallProgram::Solution& guess) {
    std::array<std::size_t, 3> set{};
    int count = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (guess.push[i] <= 0.0) continue;
      if (count == 3) return std::nullopt;
      set[std::size_t(count++)] = i;
    }
    return count > 0 && holds(count, set[0], set[1], set[2]) ? std::optional(solution_) : std::nullopt;
  }

  /// Tries all sets that include a row broken by the free minimum: one of these rows holds with equality.
  std::optional<SmallProgram::Solution> find() {
    const std::size_t n = rows_.size();
    if (holds(0, 0, 0, 0)) return solution_;
    std::array<std::size_t, SmallProgram::kMostRows> broken{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (rows_[i].normal.dot(free_) > rows_[i].most) broken[count++] = i;
    }
    for (std::size_t b = 0; b < count; ++b) {
      if (holds(1, broken[b], 0, 0)) return solution_;
    }
    for (std::size_t b = 0; b < count; ++b) {
      for (std::size_t j = 0; j < n; ++j) {
        if (j != broken[b] && holds(2, broken[b], j, 0)) return solution_;
      }
    }
    for (std::size_t b = 0; b < count; ++b) {
      for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t k = 0; k < j && j != broken[b]; ++k) {
          if (k != broken[b] && holds(3, broken[b], j, k)) return solution_;
        }
      }
    }
    return std::nullopt;
  }

 private:
  bool holds(int count, std::size_t i, std::size_t j, std::size_t k) {
    const std::array<std::size_t, 3> set{i, j, k};
    Matrix3 across = Matrix3::Identity();
    Vector3 over = Vector3::Zero();
    double scale = 1.0;
    for (int a = 0; a < count; ++a) {
      over[a] = rows_[set[a]].normal.dot(free_) - rows_[set[a]].most;
      for (int b = 0; b < count; ++b) across(a, b) = rows_[set[a]].normal.dot(pushed_[set[b]]);
      scale *= across(a, a);
    }
    if (count == 1 && over[0] < 0.0) return false;
    if (!(across.determinant() > kLeastSpan * scale)) return false;
    const Vector3 push = across.inverse() * over;
    solution_.push.fill(0.0);
    solution_.y = free_;
    for (int a = 0; a < count; ++a) {
      if (push[a] < 0.0) return false;
      solution_.push[set[a]] = push[a];
      solution_.y -= push[a] * pushed_[set[a]];
    }
    return std::all_of(rows_.begin(), rows_.end(), [&](const SmallProgram::Row& row) {
      return row.normal.dot(solution_.y) <= row.most + doubt_;
    });
  }

  std::span<const SmallProgram::Row> rows_;
  const double doubt_;
  const Vector3 free_;  // the least without any row
  std::array<Vector3, SmallProgram::kMostRows> pushed_;
  SmallProgram::Solution solution_;
};

}  // namespace

std::optional<SmallProgram::Solution> SmallProgram::solve(const Matrix3& inverse_of_w, const Vector3& p,
                                                          double doubt, const Solution* guess) const {
  ActiveSets sets{std::span(rows_).first(count_), inverse_of_w, p, doubt};
  if (guess) {
    if (const auto found = sets.find_by(*guess)) return found;
  }
  return sets.find();
}

}  // namespace icome::geometry
