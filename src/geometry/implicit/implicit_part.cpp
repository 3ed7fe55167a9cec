#include "geometry/implicit/implicit_part.h"

#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/decompositions.h"
#include "geometry/algebra/small_program.h"

namespace icome::geometry {
namespace {

constexpr unsigned kConditions = ImplicitParts::kMostConditions;
constexpr int kMostSolves = 16;
constexpr double kExactly = 1e-12;   // of the box: the last step, after which the error is its square
constexpr double kNearly = 1e-10;    // likewise, where steps shrink slowly
constexpr double kBroken = 1e-14;    // of the box: the tolerance of conditions
constexpr double kOverlap = 0.05;    // of a cell: its reach beyond its sides
constexpr double kLeastCurve = 0.1;  // the least eigenvalue used of the Lagrangian's second derivative
constexpr int kCellSplits = 1;
constexpr int kMostAlong = 24;

Vector3 side_direction(unsigned side) {
  Vector3 normal = Vector3::Zero();
  normal[side / 2] = side % 2 == 0 ? -1.0 : 1.0;
  return normal;
}

double side_place(const Bounds& box, unsigned side) {
  return (side % 2 == 0 ? box.min() : box.max())[side / 2];
}

Bounds with_margin(const Bounds& cell, const Bounds& box) {
  const Vector3 margin = kOverlap * cell.sizes();
  return Bounds(cell.min() - margin, cell.max() + margin).intersection(box);
}

double gap_between(const Bounds& box, const Vector3& point) {
  return (box.min() - point).cwiseMax(point - box.max()).cwiseMax(0.0).norm();
}

/// Is a row, written for steps from `at`, broken all over the cell?
bool forbids(const SmallProgram::Row& row, const Bounds& cell, const Vector3& at) {
  const Vector3 lowest = (row.normal.array() > 0.0).select(cell.min(), cell.max());
  return row.normal.dot(lowest - at) > row.most;
}

/// The inverse of a symmetric matrix made safely positive.
base::Matrix3 inverse_upwards(const base::Matrix3& matrix) {
  if (matrix.isIdentity(0.0)) return matrix;
  const base::SymmetricEigen it = base::symmetric_eigen(matrix);
  const Vector3 values = it.values.cwiseMax(kLeastCurve).cwiseInverse();
  return it.vectors * values.asDiagonal() * it.vectors.transpose();
}

}  // namespace

ImplicitPart::Slope ImplicitPart::slope(unsigned condition, const Vector3& place) const {
  if (condition >= kConditions) {
    const unsigned side = condition - kConditions;
    const Vector3 normal = side_direction(side);
    return {normal[side / 2] * (place[side / 2] - side_place(parts_.box(), side)), normal, 0.0};
  }
  const ImplicitParts::Condition& it = conditions_[condition];
  const Formula::Slope at = it.formula->slope(place, time_);
  return {it.sign * at.value, it.sign * at.gradient, it.sign * at.rate};
}

// Each condition keeps the part behind a plane.
bool ImplicitPart::keeps_off(const Vector3& a, const Vector3& b, double reach) const {
  const Bounds cell = with_margin(part_.cell, parts_.box());
  const Vector3 middle = cell.center();
  const double corner = 0.25 * cell.sizes().squaredNorm();
  for (unsigned i = 0; i < conditions_.size(); ++i) {
    const Slope at = slope(i, middle);
    const double height = at.value - 0.5 * conditions_[i].bend * corner;
    const double lower = std::min(at.gradient.dot(a - middle), at.gradient.dot(b - middle));
    if (height + lower >= reach * at.gradient.norm()) return true;
  }
  return false;
}

double ImplicitPart::Nearest::least() const {
  return std::sqrt(std::max(0.0, distance * distance - std::max(0.0, spread - 1.0) * width * width));
}

std::optional<ImplicitPart::Nearest> ImplicitPart::nearest(const Vector3& point, double close,
                                                           double limit) const {
  if (gap_between(with_margin(part_.cell, parts_.box()), point) >= limit || keeps_off(point, point, limit))
    return std::nullopt;
  return nearest_in(with_margin(part_.cell, parts_.box()), point, close, kCellSplits);
}

/// The nearest place in a cell. In hollows narrower than the distance, parts of the cell are searched.
std::optional<ImplicitPart::Nearest> ImplicitPart::nearest_in(const Bounds& cell, const Vector3& point,
                                                              double close, int splits) const {
  std::optional<Nearest> found = solve_in(cell, point);
  const bool enough = !found || found->cut || found->least() >= std::min(close, found->distance);
  if (enough || splits == 0) return found;
  for (unsigned i = 0; i < 8; ++i) {
    Bounds eighth = cell;
    for (int axis = 0; axis < 3; ++axis)
      (i >> axis & 1U ? eighth.min() : eighth.max())[axis] = cell.center()[axis];
    if (gap_between(eighth, point) >= std::min(close, found->distance)) continue;
    const auto there = nearest_in(eighth, point, close, splits - 1);
    if (there && !there->cut && there->distance < found->distance) found = there;
  }
  found->width = cell.diagonal().norm();
  return found;
}

// Sequential quadratic programming: conditions as their tangent planes, distances exactly, and the bends of
// the conditions weighted by their multipliers (Nocedal and Wright 2006, 18.1).
std::optional<ImplicitPart::Nearest> ImplicitPart::solve_in(const Bounds& cell, const Vector3& point) const {
  const double size = parts_.box().diagonal().norm();
  const double reach = cell.sizes().squaredNorm();
  Vector3 at = point.cwiseMax(cell.min()).cwiseMin(cell.max());
  SmallProgram::Solution last_step{Vector3::Zero(), {}};
  const std::array<double, SmallProgram::kMostRows>& push = last_step.push;
  std::array<unsigned, kConditions> row_of{};
  for (int i = 0; i < kMostSolves; ++i) {
    SmallProgram program, relaxed;
    base::Matrix3 bend = base::Matrix3::Identity();
    std::array<double, kConditions> hollow{}, steepness{};
    for (unsigned k = 0; k < conditions_.size(); ++k) {
      const ImplicitParts::Condition& it = conditions_[k];
      const Formula::Bend there = it.formula->bend(at, time_);
      const double slope = steepness[k] = there.gradient.norm();
      if (!(slope > 0.0) || !std::isfinite(there.value) || !there.hessian.allFinite()) return std::nullopt;
      row_of[k] = unsigned(program.size());
      const Vector3 normal = (it.sign / slope) * there.gradient;
      const double most = -it.sign * there.value / slope;
      hollow[k] = it.bend / slope;
      bend += push[row_of[k]] * (it.sign / slope) * there.hessian;
      program.add({normal, most});
      relaxed.add({normal, most + 0.5 * hollow[k] * reach});
      if (forbids(relaxed.row(k), cell, at)) return std::nullopt;
    }
    for (unsigned side = 0; side < 6; ++side) {
      const Vector3 normal = side_direction(side);
      const double room = normal[side / 2] * (side_place(cell, side) - at[side / 2]);
      program.add({normal, room});
      relaxed.add({normal, room});
    }
    const Vector3 pull = at - point;
    const double doubt = kBroken * size;
    auto step = program.solve(inverse_upwards(bend), pull, doubt, &last_step);
    const bool whole = step.has_value();
    if (!whole) step = relaxed.solve(base::Matrix3::Identity(), pull, doubt, &last_step);
    if (!step) return std::nullopt;
    at += step->y;
    last_step = *step;
    const bool last = i + 1 == kMostSolves;
    if (!whole || !(step->y.norm() <= (last ? kNearly : kExactly) * size)) continue;
    Nearest nearest{at, (at - point).norm(), 0, 0.0, base::Matrix3::Identity(), std::sqrt(reach), false};
    for (unsigned k = 0; k < conditions_.size(); ++k) {
      if (push[row_of[k]] <= 0.0) continue;
      nearest.active |= 1U << k;
      nearest.spread += push[row_of[k]] * hollow[k];
      nearest.bowl += push[row_of[k]] / steepness[k] * conditions_[k].least;
    }
    for (unsigned side = 0; side < 6; ++side) {
      if (push[conditions_.size() + side] <= 0.0) continue;
      const bool real = side_place(cell, side) == side_place(parts_.box(), side);
      nearest.cut = nearest.cut || !real;
      if (real) nearest.active |= 1U << (kConditions + side);
    }
    return nearest;
  }
  return std::nullopt;
}

ActiveSet ImplicitPart::holding(ActiveSet active, const Vector3& place, const Vector3& out) const {
  // The nearest sum of normals is `out` minus the nearest direction to it that none of them forbids.
  SmallProgram program;
  std::array<unsigned, SmallProgram::kMostRows> bits{};
  for (ActiveSet set = active; set != 0; set &= set - 1) {
    const auto k = unsigned(std::countr_zero(set));
    bits[program.size()] = k;
    program.add({slope(k, place).gradient.normalized(), 0.0});
  }
  const auto free = program.solve(base::Matrix3::Identity(), -out, kBroken);
  if (!free) return active;
  ActiveSet holding = 0;
  for (std::size_t i = 0; i < program.size(); ++i) {
    if (free->push[i] > 0.0) holding |= ActiveSet{1} << bits[i];
  }
  return holding;
}

Vector3 ImplicitPart::along(ActiveSet active, const Vector3& from, const Vector3& goal, double reach) const {
  const double size = parts_.box().diagonal().norm();
  Vector3 at = from;
  Vector3 push = Vector3::Zero();
  for (int i = 0; i < kMostAlong; ++i) {
    // The active conditions as planes; those after the third follow from the others at a corner.
    base::Matrix3 normals = base::Matrix3::Zero(), across = base::Matrix3::Identity();
    base::Matrix3 bend = base::Matrix3::Identity();
    Vector3 values = Vector3::Zero();
    int count = 0;
    for (unsigned k = 0; k < kActiveBits && count < 3; ++k) {
      if ((active >> k & 1U) == 0) continue;
      if (k < kConditions) {
        const Formula::Bend there = conditions_[k].formula->bend(at, time_);
        const double scale = conditions_[k].sign / there.gradient.norm();
        normals.row(count) = scale * there.gradient;
        values[count] = scale * there.value;
        bend += push[count] * scale * there.hessian;
      } else {
        const Slope there = slope(k, at);
        normals.row(count) = there.gradient;
        values[count] = there.value;
      }
      ++count;
    }
    if (!normals.allFinite() || !values.allFinite() || count == 0) return at;
    for (int a = 0; a < count; ++a) {
      for (int b = 0; b < count; ++b) across(a, b) = normals.row(a).dot(normals.row(b));
    }
    if (!(across.determinant() > 1e-10)) return at;
    const base::Matrix3 inverse = across.inverse();
    const Vector3 onto = -normals.transpose() * (inverse * values);
    const Vector3 pull = goal - at;
    push = inverse * (normals * pull);
    Vector3 step = onto;
    if (count == 2) {
      const Vector3 direction = Vector3(normals.row(0)).cross(Vector3(normals.row(1))).normalized();
      const double curved = std::max(direction.dot(bend * direction), kLeastCurve);
      step += direction * (direction.dot(pull - bend * onto) / curved);
    }
    const Vector3 way = at + step - from;
    const bool too_far = way.norm() > reach;
    at = too_far ? Vector3(from + way * (reach / way.norm())) : Vector3(at + step);
    if (step.norm() <= kExactly * size) break;
  }
  return at;
}

}  // namespace icome::geometry
