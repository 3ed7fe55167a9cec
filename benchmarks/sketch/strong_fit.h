#pragma once
#include <optional>
#include <span>

#include "bench_strokes.h"

namespace icome::benchmarks {

/// Searches, with much patience, a cubic within distance 1 of a line: reparametrised least squares from
/// several starts, then rounds in which the greatest distances weigh more and more. No code of the program's
/// own fit, but for the judge of the result, which is the one for all.
class StrongFit {
 public:
  explicit StrongFit(std::span<const Vector2> line);

  /// The cubic from the line's start to its end that keeps the distance, if one is found, whose directions
  /// there (length 1) are given or free. `start` is a curve to begin with, besides the others.
  std::optional<CubicBezier> within(const std::optional<Vector2>& leaves,
                                    const std::optional<Vector2>& arrives, const CubicBezier* start);

 private:
  struct Place {
    Vector2 point;
    double t;
    double distance;
  };
  struct Free;  // the directions in which control points may move

  std::optional<CubicBezier> improved(const Free& free, CubicBezier curve);
  CubicBezier first_curve(const Free& free, double power);
  double find_places(const CubicBezier& curve, int steps);
  bool is_certified(const CubicBezier& curve, const Free& free) const;

  std::span<const Vector2> line_;
  std::vector<Place> places_;
};

}  // namespace icome::benchmarks
