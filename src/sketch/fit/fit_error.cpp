#include "sketch/fit/fit_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/curve/curve_index.h"

namespace icome::sketch {
namespace {

constexpr int kMostHalvingsOfAPiece = 24;
constexpr int kMostSteps = 20;
constexpr double kSameT = 1e-6;

/// The most by which the part of a cubic between two places leaves its chord, run through evenly in t.
double bulge_of(const CubicBezier& cubic, double a, double b) {
  const double bend = std::max(cubic.second_derivative(a).norm(), cubic.second_derivative(b).norm());
  return (b - a) * (b - a) / 8.0 * bend;
}

/// Runs along a line and a cubic. Between two places of the line that have partners on the cubic, the cubic
/// between the partners is held against the straight piece, place by place: that bounds both distances, as
/// the pieces cover the line and, since they follow one another without a gap, the cubic between its ends.
class Comparison {
 public:
  Comparison(const CubicBezier& cubic, double resolution) : cubic_(cubic), resolution_(resolution) {}

  double distance() const { return greatest_; }

  void compare(const Vector2& a, double t_a, const Vector2& b, double t_b, int halvings) {
    const double ends = std::max(away(a, t_a), away(b, t_b));
    const double bulge = bulge_of(cubic_, t_a, t_b);
    if (!std::isfinite(ends + bulge)) {
      greatest_ = std::numeric_limits<double>::infinity();
      return;
    }
    // A piece below the greatest so far needs no closer look.
    if (ends + bulge <= greatest_ || bulge <= resolution_ || halvings == 0) {
      greatest_ = std::max(greatest_, ends + bulge);
      return;
    }
    const Vector2 middle = 0.5 * (a + b);
    const double t_middle = nearest(middle, 0.5 * (t_a + t_b));
    compare(a, t_a, middle, t_middle, halvings - 1);
    compare(middle, t_middle, b, t_b, halvings - 1);
  }

  /// The t near `guess` at which the cubic is nearest to the point, by Newton's method.
  double nearest(const Vector2& point, double guess) const {
    for (int step = 0; step < kMostSteps; ++step) {
      const Vector2 from = cubic_.at(guess) - point;
      const Vector2 speed = cubic_.derivative(guess);
      const double bend = speed.squaredNorm() + from.dot(cubic_.second_derivative(guess));
      const double steepness = bend > 0.0 ? bend : speed.squaredNorm();
      if (!(steepness > 0.0)) break;
      const double t = std::clamp(guess - std::clamp(from.dot(speed) / steepness, -0.25, 0.25), 0.0, 1.0);
      const bool stays = std::abs(t - guess) < kSameT;
      guess = t;
      if (stays) break;
    }
    return guess;
  }

  /// The t that lies a length further along.
  double further(double t, double length) const {
    const double speed = cubic_.derivative(t).norm();
    return std::min(1.0, t + (speed > 0.0 ? std::min(length / speed, 0.5) : 0.0));
  }

 private:
  double away(const Vector2& point, double t) const { return (cubic_.at(t) - point).norm(); }

  const CubicBezier& cubic_;
  double resolution_;
  double greatest_ = 0.0;
};

/// The greatest distance of pieces of a curve from what an index holds. A piece whose ends are d and e away
/// and which is l long is nowhere farther away than (d + e + l) / 2; and if the nearest places of its ends
/// lie on one cubic, nowhere farther than the greater of d and e and the bulges of both between. Pieces for
/// which both are too much are halved, the rest cannot matter.
class FarthestPlace {
 public:
  /// `seen` is a distance that is known to be there.
  FarthestPlace(std::span<const CubicBezier> others, double resolution, double seen)
      : others_(others), index_(others), resolution_(resolution), seen_(seen), bound_(seen) {}

  double bound() const { return bound_; }

  void add(const CubicBezier& piece) {
    add(piece, nearest(piece.points[0]), nearest(piece.points[3]), kMostHalvingsOfAPiece);
  }

 private:
  struct NearPlace {
    double distance;
    std::size_t cubic;
    double t;
  };

  NearPlace nearest(const Vector2& point) {
    geometry::CurveIndex::Nearest found;
    index_.nearest(point, std::numeric_limits<double>::infinity(), found);
    const double distance = std::sqrt(found.on_curve.distance_squared);
    seen_ = std::max(seen_, distance);
    return {distance, found.curve, found.on_curve.t};
  }

  double most_of(const CubicBezier& piece, const NearPlace& start, const NearPlace& end) const {
    // No curve is longer than the lines between its control points.
    const double length = (piece.points[1] - piece.points[0]).norm() +
                          (piece.points[2] - piece.points[1]).norm() +
                          (piece.points[3] - piece.points[2]).norm();
    const double by_length = 0.5 * (start.distance + end.distance + length);
    if (start.cubic != end.cubic) return by_length;
    const double by_shape = std::max(start.distance, end.distance) + bulge_of(piece, 0.0, 1.0) +
                            bulge_of(others_[start.cubic], start.t, end.t);
    return std::min(by_length, by_shape);
  }

  void add(const CubicBezier& piece, const NearPlace& start, const NearPlace& end, int halvings) {
    const double most = most_of(piece, start, end);
    if (most <= std::max(bound_, seen_ + resolution_) || halvings == 0) {
      bound_ = std::max(bound_, most);
      return;
    }
    const auto [left, right] = piece.split(0.5);
    const NearPlace middle = nearest(right.points[0]);
    add(left, start, middle, halvings - 1);
    add(right, middle, end, halvings - 1);
  }

  std::span<const CubicBezier> others_;
  geometry::CurveIndex index_;
  double resolution_;
  double seen_;   // the greatest distance of a place that was looked at
  double bound_;  // no place of the pieces added is farther away
};

}  // namespace

double certified_distance(std::span<const Vector2> line, const CubicBezier& cubic, double resolution) {
  Comparison comparison(cubic, resolution);
  double t = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double next =
        i + 1 == line.size()
            ? 1.0
            : comparison.nearest(line[i], comparison.further(t, (line[i] - line[i - 1]).norm()));
    comparison.compare(line[i - 1], t, line[i], next, kMostHalvingsOfAPiece);
    t = next;
  }
  return comparison.distance();
}

double greatest_distance(std::span<const Vector2> line, std::span<const CubicBezier> curve,
                         double resolution) {
  std::vector<CubicBezier> pieces;
  for (std::size_t i = 1; i < line.size(); ++i) pieces.push_back(CubicBezier::line(line[i - 1], line[i]));
  if (line.size() == 1) pieces.push_back(CubicBezier::line(line[0], line[0]));
  FarthestPlace of_line(curve, resolution, 0.0);
  for (const CubicBezier& piece : pieces) of_line.add(piece);
  FarthestPlace of_curve(pieces, resolution, of_line.bound());
  for (const CubicBezier& piece : curve) of_curve.add(piece);
  return of_curve.bound();
}

}  // namespace icome::sketch
