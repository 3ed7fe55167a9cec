#include "haptics/judge/witness_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace icome::haptics {
namespace {

using base::Bounds;
using base::Vector3;

Vector3 nearest_on_edge(const Vector3& from, const Vector3& to, const Vector3& point) {
  const Vector3 way = to - from;
  const double squared = way.squaredNorm();
  if (squared <= 0.0) return from;
  return from + std::clamp((point - from).dot(way) / squared, 0.0, 1.0) * way;
}

/// The triple product of u, v and w. Exchanging u and v changes exactly the sign: two triangles agree on
/// which side of their edge a segment passes.
double side_of(const Vector3& u, const Vector3& v, const Vector3& w) {
  return (u.y() * v.z() - u.z() * v.y()) * w.x() + (u.z() * v.x() - u.x() * v.z()) * w.y() +
         (u.x() * v.y() - u.y() * v.x()) * w.z();
}

}  // namespace

// The foot on the triangle's plane if it lies within all edges, else the nearest place of an edge.
Vector3 nearest_on(const WitnessTree::Corners& corners, const Vector3& point) {
  const auto& [a, b, c] = corners;
  const Vector3 normal = (b - a).cross(c - a);
  const auto within = [&](const Vector3& from, const Vector3& to) {
    return (to - from).cross(point - from).dot(normal) >= 0.0;
  };
  if (normal.squaredNorm() > 0.0 && within(a, b) && within(b, c) && within(c, a)) {
    return point - normal * (normal.dot(point - a) / normal.squaredNorm());
  }
  Vector3 best = nearest_on_edge(a, b, point);
  for (const Vector3& place : {nearest_on_edge(b, c, point), nearest_on_edge(c, a, point)}) {
    if ((place - point).squaredNorm() < (best - point).squaredNorm()) best = place;
  }
  return best;
}

WitnessTree::WitnessTree(std::shared_ptr<const geometry::TriangleMesh> mesh) : mesh_(std::move(mesh)) {
  const auto count = static_cast<std::uint32_t>(mesh_->triangles.size());
  if (count == 0) return;
  std::vector<Vector3> centres(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto [a, b, c] = corners(i);
    centres[i] = (a + b + c) / 3.0;
  }
  order_.resize(count);
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(count);
  build(0, count, centres);
}

WitnessTree::Corners WitnessTree::corners(std::uint32_t triangle) const {
  return {mesh_->corner(triangle, 0), mesh_->corner(triangle, 1), mesh_->corner(triangle, 2)};
}

/// Halves the triangles by their middles along the longest side; returns the index of the node made.
std::uint32_t WitnessTree::build(std::uint32_t first, std::uint32_t last,
                                 const std::vector<Vector3>& centres) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Bounds box, middles;
  for (std::uint32_t i = first; i < last; ++i) {
    for (const Vector3& corner : corners(order_[i])) box.extend(corner);
    middles.extend(centres[order_[i]]);
  }
  nodes_[index].box = box;
  nodes_[index].first = first;
  if (last - first <= kLeaf) {
    nodes_[index].count = last - first;
    return index;
  }
  Eigen::Index axis = 0;
  middles.sizes().maxCoeff(&axis);
  const std::uint32_t half = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last,
                   [&](std::uint32_t i, std::uint32_t j) { return centres[i][axis] < centres[j][axis]; });
  build(first, half, centres);
  nodes_[index].right = build(half, last, centres);
  return index;
}

/// Tests the axes that can separate a box and a segment: the box's own, and those across each of them and the
/// segment. What rounding may hide counts as met.
bool WitnessTree::meets(const Bounds& box, const Vector3& a, const Vector3& b) {
  constexpr double kBoxRounding = 1e-14;
  const Vector3 reach = 0.5 * (b - a);
  const Vector3 offset = 0.5 * ((a - box.min()) + (b - box.max()));
  const Vector3 half = 0.5 * box.sizes();
  const double slack = kBoxRounding * (half.sum() + offset.lpNorm<1>() + reach.lpNorm<1>());
  for (int i = 0; i < 3; ++i) {
    if (std::abs(offset[i]) > half[i] + std::abs(reach[i]) + slack) return false;
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double apart = std::abs(offset[j] * reach[k] - offset[k] * reach[j]);
    const double held = half[j] * std::abs(reach[k]) + half[k] * std::abs(reach[j]);
    if (apart > held + slack * (std::abs(reach[j]) + std::abs(reach[k]))) return false;
  }
  return true;
}

double WitnessTree::distance(const Vector3& point, double limit) const {
  around(point, limit, [&](std::uint32_t triangle) {
    limit = std::min(limit, (nearest_on(corners(triangle), point) - point).norm());
  });
  return limit;
}

std::optional<Crossing> crossing(const WitnessTree::Corners& corners, const Vector3& start,
                                 const Vector3& step) {
  const Vector3 a = corners[0] - start;
  const Vector3 b = corners[1] - start;
  const Vector3 c = corners[2] - start;
  const double at_a = side_of(b, c, step);
  const double at_b = side_of(c, a, step);
  const double at_c = side_of(a, b, step);
  const auto [least, most] = std::minmax({at_a, at_b, at_c});
  const double sum = at_a + at_b + at_c;
  if ((least < 0.0 && most > 0.0) || sum == 0.0) return std::nullopt;
  const double t = (at_a * a + at_b * b + at_c * c).dot(step) / (sum * step.squaredNorm());
  if (!(t >= 0.0 && t <= 1.0)) return std::nullopt;
  return Crossing{t, sum < 0.0, std::min(std::abs(least), std::abs(most)) / std::abs(sum)};
}

// A ray near an edge is ambiguous: another one is tried.
int winding(const WitnessTree& tree, const Vector3& point) {
  constexpr std::array<std::array<double, 3>, 6> kDirections{{{0.532, 0.713, 0.457},
                                                              {-0.617, 0.281, 0.735},
                                                              {0.271, -0.829, 0.489},
                                                              {-0.443, -0.389, -0.808},
                                                              {0.903, -0.137, -0.407},
                                                              {-0.159, 0.921, -0.355}}};
  const Bounds box = tree.bounds();
  if (!box.contains(point)) return 0;
  const double length = 2.0 * box.sizes().norm();
  int count = 0;
  for (const auto& [x, y, z] : kDirections) {
    count = 0;
    bool clear = true;
    const Vector3 step = length * Vector3(x, y, z);
    tree.along(point, point + step, [&](std::uint32_t triangle) {
      const std::optional<Crossing> crossed = crossing(tree.corners(triangle), point, step);
      if (!crossed) return;
      count += crossed->from_front ? -1 : 1;
      clear = clear && crossed->margin > 1e-9;
    });
    if (clear) break;
  }
  return count;
}

}  // namespace icome::haptics
