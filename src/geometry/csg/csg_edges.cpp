#include "geometry/csg/csg_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/csg/csg_part.h"
#include "geometry/segment.h"

namespace icome::geometry {
namespace {

using Kind = CsgAtom::Kind;

// Shares of the solid's size:
constexpr double kFitted = 1e-13;      // tolerance of a polynomial to its edge
constexpr double kCoincident = 1e-13;  // surfaces so near are the same
constexpr double kCutAt = 1e-9;        // tolerance of the ends of edges
constexpr double kEdgeSlack = 1e-10;   // surfaces so near are taken to pass through an edge
constexpr double kTouching =
    4e-4;  // half a cell's diagonal: here surfaces that do not cross count as touching
constexpr double kSmallest = 1e-5;  // half the diagonal of the smallest cell

constexpr double kParallelFaces = 1e-9;   // sine of the angle between faces
constexpr double kFlatForCrossing = 0.2;  // turn of a surface in a cell, in terms of the angle between both
constexpr double kArcMargin = 0.4;        // of half a cell's diagonal: the reach of its arc out of it
constexpr double kMostTurnInCell = 0.25;  // rad: up to here its tightest bend bounds the turn of a surface
constexpr std::size_t kMostCellsOfPair = 1'000'000;
constexpr std::size_t kMostInAll = 8'000'000;
constexpr int kMostNewton = 24;
constexpr int kMostSplits = 10;  // of an arc that one polynomial does not fit

/// The surface that a face lies on, in the tree's frame.
class Sheet {
 public:
  Sheet(const CsgFaces& faces, std::uint32_t face)
      : atom_(&faces.program().atoms()[faces.atom_of(face)]), index_(faces.atom_of(face)) {
    if (atom_->kind == Kind::Mesh) triangle_.emplace(*atom_, faces.triangle_of(face), 0.0);
    flat_ = triangle_ || atom_->kind == Kind::Plane;
    if (triangle_) {
      origin_ = triangle_->corners[0];
      normal_ = triangle_->normal;
    } else if (flat_) {
      origin_ = atom_->tree_from_atom.translation();
      normal_ = tree_normal(*atom_, Vector3::UnitZ());
    }
    scale_ = 1.0 / atom_->normal_map.col(2).norm();
  }

  std::uint32_t atom() const { return index_; }
  bool flat() const { return flat_; }
  const std::optional<PlacedTriangle>& triangle() const { return triangle_; }

  double height(const Vector3& point) const {
    if (flat_) return normal_.dot(point - origin_);
    return scale_ * signed_distance(*atom_, atom_->atom_from_tree * point);
  }
  /// The unit normal out of the atom.
  Vector3 normal(const Vector3& point) const {
    return flat_ ? normal_ : tree_normal(*atom_, retract(*atom_, atom_->atom_from_tree * point).normal);
  }
  Vector3 nearest(const Vector3& point) const { return point - height(point) * normal(point); }
  /// The radius of the tightest bend nearby.
  double bend(const Vector3& point) const {
    if (flat_) return std::numeric_limits<double>::infinity();
    return scale_ * tightest_bend(*atom_, retract(*atom_, atom_->atom_from_tree * point).point);
  }

 private:
  const CsgAtom* atom_;
  std::uint32_t index_;
  bool flat_;
  std::optional<PlacedTriangle> triangle_;
  Vector3 origin_, normal_;  // of a flat one
  double scale_;             // metres of the tree for those of the atom
};

/// The curve in which two sheets meet, near a place.
class Crossing {
 public:
  Crossing(const Sheet& one, const Sheet& other, double rounding)
      : one_(one), other_(other), rounding_(rounding) {}

  /// Moves a place near by to the curve, the shortest way; false where Newton's method does not converge or
  /// the sheets are parallel.
  bool settle(Vector3& place) {
    for (int i = 0; i < kMostNewton; ++i) {
      const Vector3 n = one_.normal(place), m = other_.normal(place);
      const double cosine = n.dot(m), determinant = 1.0 - cosine * cosine;
      if (determinant < kParallelFaces * kParallelFaces) return false;
      const double h = one_.height(place), k = other_.height(place);
      const Vector3 step = ((cosine * k - h) * n + (cosine * h - k) * m) / determinant;
      place += step;
      if (step.norm() <= rounding_) {
        origin_ = place;
        along_ = n.cross(m).normalized();
        return true;
      }
    }
    return false;
  }

  const Vector3& along() const { return along_; }

  /// The curve's place at a distance from the settled one, along its direction there; nothing on failure.
  std::optional<Vector3> at(double distance) const {
    Vector3 place = origin_ + distance * along_;
    for (int i = 0; i < kMostNewton; ++i) {
      Matrix3 rows;
      rows.row(0) = one_.normal(place);
      rows.row(1) = other_.normal(place);
      rows.row(2) = along_;
      const Vector3 off(-one_.height(place), -other_.height(place), distance - along_.dot(place - origin_));
      const Vector3 step = rows.inverse() * off;
      if (!step.allFinite()) return std::nullopt;
      place += step;
      if (step.norm() <= rounding_) return place;
    }
    return std::nullopt;
  }

  /// Polynomials for the part between two distances; false where the curve cannot be followed.
  bool fit(double from, double to, double tolerance, int splits, std::vector<CurveArc>& into) const {
    CurveArc::Places places;
    const auto distance = [&](double s) { return 0.5 * (from + to) + 0.5 * (to - from) * s; };
    for (int i = 0; i <= CurveArc::kDegree; ++i) {
      const auto place = at(distance(CurveArc::node(i)));
      if (!place) return false;
      places[i] = *place;
    }
    const CurveArc arc(places);
    if (fits(arc, tolerance)) {
      into.push_back(arc);
      return true;
    }
    const double middle = distance(0.0);
    return splits > 0 && fit(from, middle, tolerance, splits - 1, into) &&
           fit(middle, to, tolerance, splits - 1, into);
  }

 private:
  /// Is the arc on both sheets, between its nodes and at its ends?
  bool fits(const CurveArc& arc, double tolerance) const {
    for (const double s : {-1.0, -0.93, -0.5, 0.17, 0.77, 1.0}) {
      const Vector3 place = arc.at(s);
      if (std::abs(one_.height(place)) > tolerance || std::abs(other_.height(place)) > tolerance)
        return false;
    }
    return true;
  }

  const Sheet &one_, &other_;
  double rounding_;
  Vector3 origin_, along_;
};

/// Finds all edges.
class EdgeFinder {
 public:
  explicit EdgeFinder(const CsgFaces& faces)
      : faces_(faces),
        program_(faces.program()),
        size_(program_.bounds().sizes().maxCoeff()),
        rounding_(4e-16 * largest_coordinate(program_)) {}

  bool find() {
    for (std::uint32_t face = 0; face < faces_.count(); ++face) {
      if (!cross_neighbours(face)) return false;
      const Sheet sheet(faces_, face);
      take_apex(sheet);
    }
    return true;
  }

  std::vector<CurveArc> edges;

 private:
  bool cross_neighbours(std::uint32_t face) {
    const Sheet one(faces_, face);
    const Bounds box = faces_.box(face);
    bool found = true;
    SegmentQuery around(box.center(), box.center(), 0.5 * box.sizes().norm());
    faces_.tree().near(around.only_in(box), [&](std::uint32_t next) {
      if (next <= face) return true;
      const Bounds its = faces_.box(next);
      if (!box.intersects(its)) return true;
      const Sheet other(faces_, next);
      if (one.atom() == other.atom() && !one.triangle()) return true;
      found = one.flat() && other.flat() ? cross_planes(one, other, box.intersection(its))
                                         : cross_in_cells(one, other, box.intersection(its));
      return found;
    });
    return found;
  }

  bool cross_planes(const Sheet& one, const Sheet& other, const Bounds& box) {
    const Vector3 middle = box.center();
    const Vector3 n = one.normal(middle), m = other.normal(middle), along = n.cross(m);
    if (along.norm() < kParallelFaces) return true;
    const Vector3 on_both =
        middle -
        (one.height(middle) * m.cross(along) + other.height(middle) * along.cross(n)) / along.squaredNorm();
    const double half = 2.0 * (box.sizes().norm() + (on_both - middle).norm());
    const Vector3 start = on_both - half * along.normalized(), step = 2.0 * half * along.normalized();
    const double slack = kEdgeSlack * size_;
    const auto within = part_within(box, start, step, slack);
    if (!within) return true;
    auto [first, last] = *within;
    for (const Sheet* sheet : {&one, &other}) {
      clip_to_leaf(*sheet, start, step, slack, first, last);
      clip(*sheet, start, step, slack, first, last);
    }
    if (first < last) trim(CurveArc(start + first * step, start + last * step), one, other);
    return true;
  }

  /// Clips to the primitive, which in a tilted tree fills little of its box.
  void clip_to_leaf(const Sheet& sheet, const Vector3& start, const Vector3& step, double slack,
                    double& first, double& last) const {
    const CsgAtom& atom = program_.atoms()[sheet.atom()];
    const auto part = part_within(program_.extent(sheet.atom()), atom.atom_from_tree * start,
                                  atom.atom_from_tree.linear() * step, slack * atom.most_stretch);
    first = part ? std::max(first, (*part)[0]) : 1.0;
    last = part ? std::min(last, (*part)[1]) : 0.0;
  }

  /// Clips to the edges of a triangle.
  static void clip(const Sheet& sheet, const Vector3& start, const Vector3& step, double slack, double& first,
                   double& last) {
    if (!sheet.triangle()) return;
    const Corners& corners = sheet.triangle()->corners;
    const Vector3 up = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    for (int i = 0; i < 3; ++i) {
      const Vector3 inward = up.cross(corners[(i + 1) % 3] - corners[i]).normalized();
      const double height = inward.dot(start - corners[i]) + slack, rise = inward.dot(step);
      if (rise > 0.0) first = std::max(first, -height / rise);
      if (rise < 0.0) last = std::min(last, -height / rise);
      if (rise == 0.0 && height < 0.0) last = -1.0;
    }
  }

  /// Finds the edges of two sheets by halving the box; false when it takes too much work.
  bool cross_in_cells(const Sheet& one, const Sheet& other, const Bounds& box) {
    const auto& atoms = program_.atoms();
    if (likeness(atoms[one.atom()], atoms[other.atom()], largest_coordinate(program_)) != AtomLikeness::None)
      return true;
    std::vector<Bounds> cells{box};
    for (std::size_t looks = 0; !cells.empty(); ++looks, ++looks_) {
      if (looks > kMostCellsOfPair || looks_ > kMostInAll) return false;
      const Bounds cell = cells.back();
      cells.pop_back();
      if (cross_in(one, other, cell)) continue;
      int axis = 0;
      cell.sizes().maxCoeff(&axis);
      for (const bool upper : {false, true}) {
        Bounds half = cell;
        (upper ? half.min() : half.max())[axis] = cell.center()[axis];
        cells.push_back(half);
      }
    }
    return true;
  }

  /// Is the cell done with: without an edge, or with it found?
  bool cross_in(const Sheet& one, const Sheet& other, const Bounds& cell) {
    const Vector3 centre = cell.center();
    const double half = 0.5 * cell.sizes().norm();
    if (std::abs(one.height(centre)) > half + rounding_ || std::abs(other.height(centre)) > half + rounding_)
      return true;
    const double turn = half / one.bend(centre) + half / other.bend(centre);
    const Vector3 n = one.normal(centre), m = other.normal(centre);
    if (stay_apart(one.height(centre), other.height(centre), n, m, turn, half)) return true;
    const bool small = half < kTouching * size_;
    const Vector3 nearest = one.nearest(centre);
    if (small || std::abs(other.height(nearest)) <= kCoincident * size_) {
      const Sides sides = sides_of(one, other, cell);
      if ((!sides.above && !sides.below) || (small && sides.above != sides.below)) return true;
    }
    if (half < kSmallest * size_) return true;
    if (turn > kFlatForCrossing * n.cross(m).norm()) return false;
    Crossing crossing(one, other, rounding_);
    Vector3 place = centre;
    if (!crossing.settle(place)) return false;
    if ((place - centre).norm() > 3.0 * half) return true;
    const double reach = 4.0 * half;
    const Vector3 start = place - reach * crossing.along(), step = 2.0 * reach * crossing.along();
    const auto within = part_within(cell, start, step, kArcMargin * half);
    if (!within) return true;
    std::vector<CurveArc> arcs;
    const double from = reach * (2.0 * (*within)[0] - 1.0), to = reach * (2.0 * (*within)[1] - 1.0);
    if (!crossing.fit(from, to, std::max(kFitted * size_, 2.0 * rounding_), kMostSplits, arcs)) return false;
    for (const CurveArc& arc : arcs) trim(arc, one, other);
    return true;
  }

  /// Are the sheets so alike in direction that their distance in the middle of a cell leaves no place in it
  /// for both? The change of that distance is bounded by the angle between them and by their turn.
  static bool stay_apart(double height, double other, const Vector3& n, const Vector3& m, double turn,
                         double half) {
    if (turn > kMostTurnInCell) return false;
    const bool alike = n.dot(m) > 0.0;
    const double apart = std::abs(alike ? height - other : height + other);
    return apart > half * ((alike ? Vector3(n - m) : Vector3(n + m)).norm() + 1.5 * turn);
  }

  /// The sides of the other sheet on which places of one in the cell lie; none where both are the same.
  struct Sides {
    bool above = false, below = false;
  };
  Sides sides_of(const Sheet& one, const Sheet& other, const Bounds& cell) const {
    Sides sides;
    const double least = kCoincident * size_;
    for (int i = 0; i < 9; ++i) {
      const Vector3 from = i == 8 ? Vector3(cell.center()) : Vector3(cell.corner(Bounds::CornerType(i)));
      const double height = other.height(one.nearest(from));
      sides.above = sides.above || height > least;
      sides.below = sides.below || height < -least;
    }
    return sides;
  }

  void take_apex(const Sheet& sheet) {
    const CsgAtom& atom = program_.atoms()[sheet.atom()];
    if (atom.kind != Kind::ConeSide || atom.subtracted || atom.b == 0.0) return;
    const Vector3 place = atom.tree_from_atom * apex(atom);
    const Vector3 normal = tree_normal(atom, way_out_of_apex(atom));
    if (program_.relevant(sheet.atom()).contains(place) &&
        program_.on_surface(sheet.atom(), place, normal, kEdgeSlack * size_))
      edges.emplace_back(place, place);
  }

  /// Keeps the parts along which the solid's surface runs along both sheets.
  void trim(const CurveArc& arc, const Sheet& one, const Sheet& other) {
    const double reach = arc.sagitta() + kEdgeSlack * size_;
    std::vector<std::uint32_t> others;
    faces_.near(arc.at(arc.first()), arc.at(arc.last()), reach, [&](std::uint32_t face, const Bounds&) {
      const std::uint32_t atom = faces_.atom_of(face);
      if (atom != one.atom() && atom != other.atom()) others.push_back(atom);
      return true;
    });
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    Kept kept;
    keep(arc, {one, other}, others, kept);
    if (kept.any) edges.push_back(arc.part(kept.from, kept.to));
  }

  struct Pair {
    const Sheet &one, &other;
  };
  /// The part kept last, which the next one may continue.
  struct Kept {
    double from = 0.0, to = 0.0;
    bool any = false;
  };

  void keep(const CurveArc& arc, const Pair& pair, const std::vector<std::uint32_t>& among, Kept& kept) {
    const Vector3 margin = Vector3::Constant(kEdgeSlack * size_);
    const Bounds box(arc.bounds().min() - margin, arc.bounds().max() + margin);
    std::vector<std::uint32_t> open = open_atoms(program_, box, among);
    open.erase(
        std::remove_if(open.begin(), open.end(), [&](std::uint32_t atom) { return runs_along(atom, arc); }),
        open.end());
    const double length = (arc.at(arc.last()) - arc.at(arc.first())).norm();
    if (!open.empty() && length > kCutAt * size_) {
      const double middle = 0.5 * (arc.first() + arc.last());
      keep(arc.part(arc.first(), middle), pair, open, kept);
      keep(arc.part(middle, arc.last()), pair, open, kept);
      return;
    }
    const double slack = open.empty() ? kEdgeSlack * size_ : kCutAt * size_;
    if (!is_edge(pair, arc.at(0.5 * (arc.first() + arc.last())), slack)) return;
    if (kept.any && kept.to != arc.first()) {
      edges.push_back(arc.part(kept.from, kept.to));
      kept.any = false;
    }
    if (!kept.any) kept.from = arc.first();
    kept.to = arc.last();
    kept.any = true;
  }

  bool is_edge(const Pair& pair, const Vector3& place, double slack) const {
    return program_.on_surface(pair.one.atom(), place, pair.one.normal(place), slack) &&
           program_.on_surface(pair.other.atom(), place, pair.other.normal(place), slack);
  }

  /// Does the atom's surface pass through the whole arc?
  bool runs_along(std::uint32_t index, const CurveArc& arc) const {
    const CsgAtom& atom = program_.atoms()[index];
    for (const double share : {0.0, 0.31, 0.5, 0.83, 1.0}) {
      const Vector3 place = arc.at(arc.first() + share * (arc.last() - arc.first()));
      const Vector3 in_atom = atom.atom_from_tree * place;
      const double slack = kEdgeSlack * size_ * atom.most_stretch;
      if (atom.kind == Kind::Mesh ? !atom.mesh->tree.nearest(in_atom, slack).has_value()
                                  : std::abs(signed_distance(atom, in_atom)) > slack)
        return false;
    }
    return true;
  }

  const CsgFaces& faces_;
  const CsgProgram& program_;
  double size_, rounding_;  // m
  std::size_t looks_ = 0;
};

}  // namespace

std::optional<std::vector<CurveArc>> csg_edges(const CsgFaces& faces) {
  EdgeFinder finder(faces);
  if (!finder.find()) return std::nullopt;
  return std::move(finder.edges);
}

}  // namespace icome::geometry
