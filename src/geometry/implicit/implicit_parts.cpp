#include "geometry/implicit/implicit_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/decompositions.h"
#include "geometry/implicit/implicit_cells.h"
#include "geometry/tree/hilbert.h"

namespace icome::geometry {
namespace {

constexpr std::size_t kMostImplicitParts = 1 << 16;
constexpr std::size_t kMostFunctionLooks = 400'000;  // at a function in a cell
constexpr double kLargestCell = 1.0 / 12.0;          // of the box
constexpr double kSmallestCell = 1.0 / 4000.0;
constexpr double kMostGradientTurn = 0.5;  // of a gradient in a cell, as part of its length
constexpr double kGentle = 0.5;            // the ball's radius, of the surface's own in a hollow
constexpr double kNeighbours = 1.0;        // cells around one
constexpr double kTame = 0.9;              // of the ball's own curvature: tame hollows have less
// If a hollow curves in about as much as the ball, cells are cut until they are this small, in radii;
// coarser ones are tried where that makes too many parts.
constexpr std::array<double, 3> kFoldCells{1.0 / 12.0, 1.0 / 3.0, std::numeric_limits<double>::infinity()};
constexpr const char* kTooManyParts = "it takes too many small parts to follow its surface";

/// Bounds on a function and its derivatives in a cell, at all times.
struct CellShape {
  bool tame;           // it is defined, and its derivatives are bounded
  double least_slope;  // of the gradient's length
  double most_bend;    // of the second derivatives', as a matrix
  double hollow;       // as Condition::bend
  std::array<Interval, 3> slope;
  base::Matrix3 least = base::Matrix3::Zero();  // as Condition::least
  double most_slope = 0.0;
  Vector3 inwards = Vector3::Zero();  // unit: along this the middles of the second derivatives bend down most
  double least_bend = 0.0, largest_bend = 0.0,
         doubt = 0.0;  // extreme eigenvalues of the second derivatives in the cell, and their error

  /// A lower bound, for every place of the cell, of the curvature (1/m) with which a surface of the function
  /// curves in along some tangent.
  double least_hollow() const;
};

// With c the cosine between the unit vector `inwards` and the unit gradient g, the tangent w = inwards - c g
// has the length sqrt(1 - c^2), and the second derivatives H bend w'Hw = least_bend (1 - 2 c^2) + c^2 g'Hg.
double CellShape::least_hollow() const {
  Interval along{0.0, 0.0};
  for (std::size_t i = 0; i < 3; ++i) along = along + slope[i] * inwards[Eigen::Index(i)];
  const double c = std::max(std::abs(along.lo), std::abs(along.hi)) / least_slope;
  if (!(c < 0.7) || !(least_bend < 0.0)) return 0.0;
  const double bend = least_bend * (1.0 - 2.0 * c * c) + c * c * std::max(0.0, largest_bend);
  return std::max(0.0, -bend - doubt) / most_slope;
}

CellShape shape_of(const Formula& formula, double sign, const Bounds& cell) {
  const Formula::BendRange at = formula.bend_range(always_in(cell));
  CellShape shape{at.range.total, 0.0, 0.0, 0.0, {}};
  double square = 0.0, most_square = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    shape.slope[i] = at.slope[i] * sign;
    const double least = std::max({0.0, at.slope[i].lo, -at.slope[i].hi});
    const double most = std::max(std::abs(at.slope[i].lo), std::abs(at.slope[i].hi));
    square += least * least;
    most_square += most * most;
  }
  shape.least_slope = std::sqrt(square);
  shape.most_slope = std::sqrt(most_square);
  base::Matrix3 middle, doubt;
  for (Eigen::Index i = 0, k = 0; i < 3; ++i) {
    for (Eigen::Index j = i; j < 3; ++j, ++k) {
      const Interval& it = at.bend[std::size_t(k)];
      middle(i, j) = middle(j, i) = sign * 0.5 * (it.lo + it.hi);
      doubt(i, j) = doubt(j, i) = 0.5 * (it.hi - it.lo);
    }
  }
  if (!middle.allFinite() || !doubt.allFinite() || !std::isfinite(square)) shape.tame = false;
  if (!shape.tame) return shape;
  const base::SymmetricEigen axes = base::symmetric_eigen(middle);
  const Vector3& values = axes.values;
  const double doubtful = doubt.rowwise().sum().maxCoeff();
  shape.most_bend = values.cwiseAbs().maxCoeff() + doubtful;
  // With each row's sum of uncertainties taken from the diagonal, it is a lower bound of all these matrices.
  shape.least = middle - base::Matrix3(doubt.rowwise().sum().asDiagonal());
  shape.hollow = std::max(0.0, -base::symmetric_eigen(shape.least).values[0]);
  shape.inwards = axes.vectors.col(0);
  shape.least_bend = values[0];
  shape.largest_bend = values[2];
  shape.doubt = doubtful;
  return shape;
}

Bounds eighth_of_cell(const Bounds& cell, unsigned which) {
  const Vector3 middle = cell.center();
  Bounds eighth = cell;
  for (int axis = 0; axis < 3; ++axis)
    (which >> axis & 1U ? eighth.min() : eighth.max())[axis] = middle[axis];
  return eighth;
}

/// A function and the sign with which it enters.
struct SignedFormula {
  const Formula* formula;
  double sign;
};

}  // namespace

/// Cuts a solid into parts, one way of choosing after the other.
class ImplicitPartsMaker {
 public:
  /// `fold_cell`: the smallest cells that are cut because a hollow curves in about as much as the ball (m).
  ImplicitPartsMaker(ImplicitParts& parts, double radius, double fold_cell)
      : parts_(parts), radius_(radius), fold_cell_(fold_cell) {}

  /// Does the work. Returns the reason why it cannot be done; empty when it was.
  std::string run() {
    for (const std::vector<FormulaWays::Term>& way : parts_.ways_->ways) {
      way_.clear();
      for (const FormulaWays::Term& term : way)
        way_.push_back({&parts_.ways_->formulas[term.formula], term.sign});
      if (std::string reason = cut(parts_.box_, way_); !reason.empty()) return reason;
      ++way_number_;
    }
    parts_.sort(centres_);
    return {};
  }

 private:
  /// `terms`: those of the way that may be positive in the cell.
  std::string cut(const Bounds& cell, std::vector<SignedFormula> terms) {
    bool free = false;
    std::erase_if(terms, [&](const SignedFormula& term) {
      const int sign = sign_in_box(*term.formula, cell) * (term.sign > 0.0 ? 1 : -1);
      free = free || sign > 0;
      return sign < 0;
    });
    looks_ += terms.size() + 1;
    if (free || (terms.empty() && !at_side(cell))) return {};
    if (parts_.parts_.size() >= kMostImplicitParts || looks_ >= kMostFunctionLooks) return kTooManyParts;
    const Vector3 sizes = cell.sizes();
    const double largest = parts_.box_.sizes().maxCoeff();
    if (terms.empty() || (sizes.maxCoeff() <= kLargestCell * largest && take(cell, terms))) {
      if (terms.empty()) add(cell, {}, {});
      return {};
    }
    if (sizes.maxCoeff() <= kSmallestCell * largest)
      return "it comes to a point, a pole or an end of where the formula has values, or bends without limit";
    for (unsigned i = 0; i < 8; ++i) {
      if (std::string reason = cut(eighth_of_cell(cell, i), terms); !reason.empty()) return reason;
    }
    return {};
  }

  bool at_side(const Bounds& cell) const {
    return (cell.min().array() <= parts_.box_.min().array()).any() ||
           (cell.max().array() >= parts_.box_.max().array()).any();
  }

  /// Makes the cell a part if all functions are simple enough there.
  bool take(const Bounds& cell, const std::vector<SignedFormula>& terms) {
    if (terms.size() > ImplicitParts::kMostConditions) return false;
    const double diagonal = cell.diagonal().norm();
    std::vector<CellShape> shapes;
    for (const SignedFormula& term : terms) {
      shapes.push_back(shape_of(*term.formula, term.sign, cell));
      const CellShape& shape = shapes.back();
      if (!shape.tame || !(diagonal * shape.most_bend <= kMostGradientTurn * shape.least_slope)) return false;
      const bool half_folded = terms.size() == 1 && radius_ * shape.hollow > kTame * shape.least_slope &&
                               !(radius_ * shape.least_hollow() > 1.0);
      if (half_folded && cell.sizes().maxCoeff() > fold_cell_) return false;
    }
    add(cell, terms, shapes);
    return true;
  }

  void add(const Bounds& cell, const std::vector<SignedFormula>& terms,
           const std::vector<CellShape>& shapes) {
    const auto first = std::uint32_t(parts_.conditions_.size());
    for (std::size_t i = 0; i < terms.size(); ++i)
      parts_.conditions_.push_back({terms[i].formula, terms[i].sign, shapes[i].hollow, shapes[i].least});
    const bool gentle = terms.size() == 1 && is_gentle(cell, terms.front());
    // Around a place of a surface that curves in more than the ball, some of it is nearer to the centre.
    const bool folded = terms.size() == 1 && !at_side(cell) && radius_ * shapes.front().least_hollow() > 1.0;
    parts_.parts_.push_back({cell, way_number_, first, std::uint32_t(terms.size()), gentle, folded});
    centres_.push_back(centres(cell, shapes));
  }

  bool is_gentle(const Bounds& cell, const SignedFormula& term) const {
    const Vector3 around = kNeighbours * cell.sizes();
    const Bounds wide(cell.min() - around, cell.max() + around);
    if (!parts_.box_.contains(wide)) return false;
    for (const SignedFormula& other : way_) {
      const int sign = sign_in_box(*other.formula, wide) * (other.sign > 0.0 ? 1 : -1);
      if (other.formula != term.formula && sign >= 0) return false;
    }
    const CellShape shape = shape_of(*term.formula, term.sign, wide);
    return shape.tame && radius_ * shape.hollow <= kGentle * shape.least_slope;
  }

  /// Bounds of the centres of balls that rest on the part in the cell: a radius away along the normals, which
  /// are sums of gradients and of the normals of the box's sides.
  Bounds centres(const Bounds& cell, const std::vector<CellShape>& shapes) const {
    Vector3 lo = Vector3::Zero(), hi = Vector3::Zero();
    const bool side = at_side(cell);
    for (const CellShape& shape : shapes) {
      for (int i = 0; i < 3; ++i) {
        const Interval& it = shape.slope[std::size_t(i)];
        const bool alone = shapes.size() == 1 && !side && shape.least_slope > 0.0;
        const double scale = alone ? 1.0 / shape.least_slope : std::numeric_limits<double>::infinity();
        if (it.lo < 0.0) lo[i] = std::max(-1.0, std::min(lo[i], it.lo * scale));
        if (it.hi > 0.0) hi[i] = std::min(1.0, std::max(hi[i], it.hi * scale));
      }
    }
    for (int i = 0; i < 3; ++i) {
      if (cell.min()[i] <= parts_.box_.min()[i]) lo[i] = -1.0;
      if (cell.max()[i] >= parts_.box_.max()[i]) hi[i] = 1.0;
    }
    return {cell.min() + radius_ * lo, cell.max() + radius_ * hi};
  }

  ImplicitParts& parts_;
  const double radius_;
  const double fold_cell_;
  std::vector<SignedFormula> way_;
  std::uint32_t way_number_ = 0;
  std::size_t looks_ = 0;
  std::vector<Bounds> centres_;
};

ImplicitParts::ImplicitParts(FormulaWays ways, const Bounds& box)
    : ways_(std::make_shared<const FormulaWays>(std::move(ways))), box_(box) {}

base::Result<ImplicitParts> ImplicitParts::create(const std::string& formula, const Bounds& box,
                                                  double radius) {
  auto ways = FormulaWays::parse(formula);
  if (!ways) return base::fail(ways.error().message);
  std::string reason = kTooManyParts;
  for (const double fold_cell : kFoldCells) {
    if (reason != kTooManyParts) break;
    ImplicitParts parts(*ways, box);
    reason = ImplicitPartsMaker(parts, radius, fold_cell * radius).run();
    if (reason.empty()) return parts;
  }
  return base::fail(reason);
}

void ImplicitParts::sort(const std::vector<Bounds>& centres) {
  constexpr double kMargin = 1e-9;  // boxes are this much larger than their contents, of the whole
  const Vector3 margin = Vector3::Constant(kMargin * box_.diagonal().norm());
  std::vector<Eigen::Vector3f> middles;
  for (const Part& part : parts_) middles.emplace_back(part.cell.center().cast<float>());
  std::vector<Part> sorted;
  std::vector<FloatBox> cells;
  std::vector<std::uint32_t> order = hilbert_order(middles);
  const auto folded =
      std::ranges::stable_partition(order, [&](std::uint32_t i) { return !parts_[i].folded; });
  for (const std::uint32_t i : order) {
    sorted.push_back(parts_[i]);
    cells.push_back(float_box(parts_[i].cell));
    centres_.push_back(float_box(Bounds(centres[i].min() - margin, centres[i].max() + margin)));
    bounds_.extend(parts_[i].cell);
  }
  parts_ = std::move(sorted);
  cell_tree_ = BoxTree(cells);
  centres_.resize(centres_.size() - folded.size());
  rest_tree_ = BoxTree(centres_);
}

std::size_t ImplicitParts::bytes() const {
  std::size_t sum = sizeof(*this) + sizeof(FormulaWays) + parts_.capacity() * sizeof(Part) +
                    conditions_.capacity() * sizeof(Condition) + centres_.capacity() * sizeof(FloatBox) +
                    cell_tree_.bytes() + rest_tree_.bytes();
  for (const Formula& formula : ways_->formulas) sum += formula.bytes();
  return sum;
}

}  // namespace icome::geometry
