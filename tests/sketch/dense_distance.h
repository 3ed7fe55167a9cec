// Distances by dense sampling, which share nothing with the index and the bounds of src/sketch.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "geometry/curve/cubic_bezier.h"
#include "sketch/fit/pen_sample.h"

namespace icome::sketch::judges {

using base::Vector2;
using geometry::CubicBezier;

inline double to_piece(const Vector2& point, const Vector2& a, const Vector2& b) {
  const Vector2 way = b - a;
  const double squared = way.squaredNorm();
  const double part = squared > 0.0 ? std::clamp((point - a).dot(way) / squared, 0.0, 1.0) : 0.0;
  return (a + part * way - point).norm();
}

/// The least distance to a line of straight pieces: a grid of cells, searched ring by ring.
class LineDistance {
 public:
  explicit LineDistance(std::vector<Vector2> line) : line_(std::move(line)) {
    if (line_.size() == 1) line_.push_back(line_[0]);
    low_ = line_[0];
    Vector2 high = low_;
    for (const Vector2& point : line_) {
      low_ = low_.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    cell_ = std::max((high - low_).maxCoeff() / kCells, 1e-300);
    cells_.resize(std::size_t(kCells) * kCells);
    for (std::size_t i = 1; i < line_.size(); ++i) put(i);
  }

  double from(const Vector2& point) const {
    const int x = column(point.x() - low_.x());
    const int y = column(point.y() - low_.y());
    const Vector2 middle = low_ + cell_ * Vector2(x + 0.5, y + 0.5);
    const double beside = (point - middle).cwiseAbs().maxCoeff() - 0.5 * cell_;  // above 0 outside the grid
    double least = std::numeric_limits<double>::infinity();
    for (int ring = 0; ring < kCells; ++ring) {
      for (int i = x - ring; i <= x + ring; ++i) {
        const bool side = i == x - ring || i == x + ring;
        for (int j = y - ring; j <= y + ring; j += side || ring == 0 ? 1 : 2 * ring) look(point, i, j, least);
      }
      if (least <= ring * cell_ - std::max(0.0, beside)) break;
    }
    return least;
  }

 private:
  static constexpr int kCells = 64;

  int column(double away) const { return int(std::clamp(away / cell_, 0.0, kCells - 1.0)); }

  void put(std::size_t piece) {
    const Vector2 a = line_[piece - 1].cwiseMin(line_[piece]) - low_;
    const Vector2 b = line_[piece - 1].cwiseMax(line_[piece]) - low_;
    for (int i = column(a.x()); i <= column(b.x()); ++i)
      for (int j = column(a.y()); j <= column(b.y()); ++j)
        cells_[std::size_t(j) * std::size_t(kCells) + std::size_t(i)].push_back(piece);
  }

  void look(const Vector2& point, int i, int j, double& least) const {
    if (i < 0 || j < 0 || i >= kCells || j >= kCells) return;
    for (const std::size_t piece : cells_[std::size_t(j) * std::size_t(kCells) + std::size_t(i)])
      least = std::min(least, to_piece(point, line_[piece - 1], line_[piece]));
  }

  std::vector<Vector2> line_;
  std::vector<std::vector<std::size_t>> cells_;
  Vector2 low_;
  double cell_ = 0.0;
};

inline std::vector<Vector2> sampled(std::span<const CubicBezier> curve, int steps) {
  std::vector<Vector2> points;
  for (const CubicBezier& segment : curve)
    for (int k = points.empty() ? 0 : 1; k <= steps; ++k) points.push_back(segment.at(k / double(steps)));
  return points;
}

/// The greatest distance of the places of a line from another one, looked at `steps` times a piece.
inline double farthest_of_line(std::span<const Vector2> line, const LineDistance& other, int steps) {
  double farthest = other.from(line[0]);
  for (std::size_t i = 1; i < line.size(); ++i) {
    for (int k = 1; k <= steps; ++k) {
      const Vector2 place = line[i - 1] + k / double(steps) * (line[i] - line[i - 1]);
      farthest = std::max(farthest, other.from(place));
    }
  }
  return farthest;
}

/// The two-way distance of a line and a curve, by `steps` places of each segment and some of each piece of
/// the line. It lacks at most what both bend between these places.
inline double dense_distance(std::span<const Vector2> line, std::span<const CubicBezier> curve,
                             int steps = 1000) {
  const std::vector<Vector2> places = sampled(curve, steps);
  const int line_steps = std::clamp(int(20000 / line.size()), 2, 200);
  return std::max(farthest_of_line(places, LineDistance({line.begin(), line.end()}), 1),
                  farthest_of_line(line, LineDistance(places), line_steps));
}

inline std::vector<Vector2> places_of(const PenStroke& stroke) {
  std::vector<Vector2> places;
  for (const PenSample& sample : stroke) places.push_back(sample.place);
  return places;
}

/// A stroke through what `way(u)` gives for u from 0 to 1, m.
template <typename Way>
PenStroke drawn(int samples, const Way& way) {
  PenStroke stroke;
  for (int i = 0; i < samples; ++i) {
    const double u = samples > 1 ? i / (samples - 1.0) : 0.0;
    stroke.push_back({0.005 * i, way(u), 0.5 + 0.4 * std::sin(7.0 * u)});
  }
  return stroke;
}

inline Vector2 polar(double radius, double angle) {
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// A pen that turns at random as it goes on.
inline PenStroke wandering(unsigned seed, int samples, double step, double turning) {
  std::mt19937 random(seed);
  std::normal_distribution<double> number;
  double angle = 0.0;
  Vector2 place(0.0, 0.0);
  return drawn(samples, [&](double) {
    angle += turning * number(random);
    return Vector2(place += polar(step, angle));
  });
}

}  // namespace icome::sketch::judges
