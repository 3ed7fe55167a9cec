#pragma once
// Loop's subdivision rules around one vertex, for positions and for rows of weights alike.
#include <cmath>
#include <numbers>
#include <vector>

#include "geometry/loop/loop_fan.h"

namespace icome::geometry::loop_rules {

/// The weight of each neighbour of an interior vertex (Loop 1987; thesis 5.4): 1/16 for six.
inline double beta(double neighbours) {
  const double root = 0.375 + 0.25 * std::cos(2.0 * std::numbers::pi / neighbours);
  return (0.625 - root * root) / neighbours;
}

/// The new point of the edge from a to b, with c and d across.
template <typename Point>
Point edge_point(const Point& a, const Point& b, const Point& c, const Point& d) {
  return 0.375 * (a + b) + 0.125 * (c + d);
}

/// The vertex and its spokes' ends (first the vertex) after one subdivision.
template <typename Point>
void refine_ring(const FanType& type, std::vector<Point>& ring) {
  const std::uint32_t count = type.spokes();
  const std::vector<Point> old = ring;
  const Point& vertex = old[0];
  for (std::uint32_t i = 0; i < count; ++i) {
    Point& end = ring[1 + i];
    if (type.sharp(i)) {
      end = 0.5 * (vertex + old[1 + i]);
    } else {
      end = edge_point(vertex, old[1 + i], old[1 + (i + 1) % count], old[1 + (i + count - 1) % count]);
    }
  }
  if (type.rule == FanRule::Crease) {
    ring[0] = 0.75 * vertex + 0.125 * (old[1] + old[count]);
  } else if (type.rule == FanRule::Smooth || type.rule == FanRule::Dart) {
    Point sum = old[1];
    for (std::uint32_t i = 1; i < count; ++i) sum += old[1 + i];
    ring[0] = (1.0 - count * beta(count)) * vertex + beta(count) * sum;
  }
}

/// Points 0, 1, 2, 6 and 8 of a lattice from the ring, those over sharp spokes mirrored.
template <typename Point, std::size_t kCount>
void lattice_from_ring(const FanType& type, const std::vector<Point>& ring,
                       std::array<Point, kCount>& lattice) {
  lattice[0] = ring[0];
  lattice[1] = ring[1 + type.spoke(0)];
  lattice[2] = ring[1 + type.spoke(1)];
  if (type.sharp_first()) {
    lattice[6] = lattice[0] + lattice[1] - lattice[2];
  } else {
    lattice[6] = ring[1 + type.spoke(-1)];
  }
  if (type.sharp_last()) {
    lattice[8] = lattice[0] + lattice[2] - lattice[1];
  } else {
    lattice[8] = ring[1 + type.spoke(2)];
  }
}

/// Points 7 and 9 of a lattice over sharp spokes.
template <typename Point, std::size_t kCount>
void mirror_outer(const FanType& type, std::array<Point, kCount>& lattice) {
  if (type.sharp_first()) lattice[7] = lattice[1] + lattice[4] - lattice[3];
  if (type.sharp_last()) lattice[9] = lattice[2] + lattice[5] - lattice[3];
}

/// Completes a fine lattice, whose 0, 1, 2, 6 and 8 are set, from the coarse one. All vertices and edges that
/// matter are regular, so one rule serves: mirrored points make it the boundary's.
template <typename Point>
void refine_lattice(const std::array<Point, kCoarsePoints>& c, std::array<Point, kFinePoints>& f) {
  f[3] = edge_point(c[1], c[2], c[0], c[3]);
  f[4] = 0.625 * c[1] + 0.0625 * (c[0] + c[2] + c[3] + c[4] + c[7] + c[6]);
  f[5] = 0.625 * c[2] + 0.0625 * (c[0] + c[1] + c[3] + c[5] + c[9] + c[8]);
  f[7] = edge_point(c[1], c[6], c[0], c[7]);
  f[9] = edge_point(c[2], c[8], c[0], c[9]);
  f[10] = edge_point(c[1], c[4], c[3], c[7]);
  f[11] = edge_point(c[1], c[3], c[2], c[4]);
  f[12] = edge_point(c[1], c[7], c[4], c[6]);
  f[13] = edge_point(c[2], c[3], c[1], c[5]);
  f[14] = edge_point(c[2], c[5], c[3], c[9]);
  f[15] = edge_point(c[2], c[9], c[5], c[8]);
}

}  // namespace icome::geometry::loop_rules
