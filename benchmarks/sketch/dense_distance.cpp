#include "dense_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace icome::benchmarks {
namespace {

constexpr int kChords = 48;        // of each cubic
constexpr int kPlacesOfPiece = 8;  // of each piece of the line

/// The cubic's power form, written out anew.
Vector2 place_at(const CubicBezier& c, double t) {
  const Vector2 linear = 3.0 * (c.points[1] - c.points[0]);
  const Vector2 square = 3.0 * (c.points[0] - 2.0 * c.points[1] + c.points[2]);
  const Vector2 cube = c.points[3] - 3.0 * c.points[2] + 3.0 * c.points[1] - c.points[0];
  return c.points[0] + t * (linear + t * (square + t * cube));
}

std::vector<Vector2> chords_of(const std::vector<CubicBezier>& curve) {
  std::vector<Vector2> places = {curve.front().points[0]};
  for (const CubicBezier& cubic : curve)
    for (int k = 1; k <= kChords; ++k) places.push_back(place_at(cubic, double(k) / kChords));
  return places;
}

/// The most by which a cubic may leave its chords.
double bulge_of(const std::vector<CubicBezier>& curve) {
  double bend = 0.0;
  for (const CubicBezier& c : curve)
    bend = std::max({bend, 6.0 * (c.points[0] - 2.0 * c.points[1] + c.points[2]).norm(),
                     6.0 * (c.points[1] - 2.0 * c.points[2] + c.points[3]).norm()});
  return bend / (8.0 * kChords * kChords);
}

double squared_from_piece(const Vector2& a, const Vector2& b, const Vector2& point) {
  const Vector2 way = b - a;
  const double length = way.squaredNorm();
  const double t = length > 0.0 ? std::clamp((point - a).dot(way) / length, 0.0, 1.0) : 0.0;
  return (a + t * way - point).squaredNorm();
}

double squared_from_line(const std::vector<Vector2>& line, const Vector2& point) {
  double least = (line.front() - point).squaredNorm();
  for (std::size_t i = 1; i < line.size(); ++i)
    least = std::min(least, squared_from_piece(line[i - 1], line[i], point));
  return least;
}

double greatest_squared(const std::vector<Vector2>& of, int places, const std::vector<Vector2>& from) {
  double greatest = squared_from_line(from, of.front());
  for (std::size_t i = 1; i < of.size(); ++i)
    for (int k = 1; k <= places; ++k) {
      const Vector2 place = of[i - 1] + double(k) / places * (of[i] - of[i - 1]);
      greatest = std::max(greatest, squared_from_line(from, place));
    }
  return greatest;
}

}  // namespace

DenseDistance dense_distance(const std::vector<Vector2>& line, const std::vector<CubicBezier>& curve) {
  const std::vector<Vector2> chords = chords_of(curve);
  const double squared =
      std::max(greatest_squared(line, kPlacesOfPiece, chords), greatest_squared(chords, 1, line));
  return {std::sqrt(squared), bulge_of(curve)};
}

}  // namespace icome::benchmarks
