#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "geometry/implicit/formula_ways.h"
#include "geometry/tree/box_tree.h"

namespace icome::geometry {

/// The solid f < 0 of a formula in a box as a union of simple parts: each is the part of a cell in which a
/// few smooth functions are not positive (FormulaWays), and each of these is nearly linear there. Only cells
/// in which the surface may run, at any time, are kept. Immutable; see implicit_part.h for the queries of
/// one part.
class ImplicitParts {
 public:
  static constexpr std::size_t kMostConditions = 6;  // of one part

  /// sign * formula <= 0 in the part.
  struct Condition {
    const Formula* formula;
    double sign;
    /// sign * (f(x) - f(a) - f'(a)(x - a)) is nowhere in the cell less than -bend * |x - a|^2 / 2, nor less
    /// than (x - a)' least (x - a) / 2.
    double bend;
    base::Matrix3 least;
  };
  struct Part {
    Bounds cell;
    std::uint32_t way;    // of the formula; parts of one way continue each other
    std::uint32_t first;  // of its conditions
    std::uint32_t count;
    bool gentle;  // nothing in the way's neighbouring cells is nearer to a ball of the radius that rests
                  // on it
    bool folded;  // it curves in more than the ball does, so that none can touch it
  };

  /// For balls of this radius (m). Fails, with the reason as a clause, where the surface cannot be cut into
  /// such parts.
  static base::Result<ImplicitParts> create(const std::string& formula, const Bounds& box, double radius);

  std::uint32_t size() const { return std::uint32_t(parts_.size()); }
  const Part& part(std::uint32_t number) const { return parts_[number]; }
  std::span<const Condition> conditions(std::uint32_t number) const {
    return std::span(conditions_).subspan(parts_[number].first, parts_[number].count);
  }
  const FloatBox& centres(std::uint32_t number) const { return centres_[number]; }
  const Bounds& box() const { return box_; }
  /// Bounds of all cells.
  const Bounds& bounds() const { return bounds_; }
  /// The tree over the cells.
  const BoxTree& cells() const { return cell_tree_; }
  /// The tree over the places of a ball's centre while it rests on a part; folded parts come last, and are
  /// not in it.
  const BoxTree& rests() const { return rest_tree_; }
  std::size_t bytes() const;

 private:
  friend class ImplicitPartsMaker;
  ImplicitParts(FormulaWays ways, const Bounds& box);
  void sort(const std::vector<Bounds>& centres);

  std::shared_ptr<const FormulaWays> ways_;  // conditions point into it
  Bounds box_, bounds_;
  std::vector<Part> parts_;
  std::vector<Condition> conditions_;
  std::vector<FloatBox> centres_;
  BoxTree cell_tree_, rest_tree_;
};

}  // namespace icome::geometry
