#include "geometry/tree/triangle_tree.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <mutex>

#include "base/parallel.h"
#include "geometry/tree/hilbert.h"
#include "geometry/tree/ray_winding.h"

namespace icome::geometry {
namespace {

constexpr std::size_t kTriangleGrain = 1 << 15;
constexpr double kRoundingOfVolume = 4e-16;

std::vector<Eigen::Vector3f> centroids(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3f> result(mesh.triangles.size());
  base::parallel_for(result.size(), kTriangleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vector3 sum = mesh.corner(i, 0) + mesh.corner(i, 1) + mesh.corner(i, 2);
      result[i] = (sum / 3.0).cast<float>();
    }
  });
  return result;
}

/// Six times the signed volume of the tetrahedron from the origin; swapping u and v flips the sign
/// exactly, which is what makes shared edges watertight.
double edge_side(const Vector3& u, const Vector3& v, const Vector3& direction) {
  return (u.y() * v.z() - u.z() * v.y()) * direction.x() + (u.z() * v.x() - u.x() * v.z()) * direction.y() +
         (u.x() * v.y() - u.y() * v.x()) * direction.z();
}

/// The t in [0, 1] at which the segment start + t * direction crosses the triangle; nothing if it does not.
std::optional<double> crossing(const Corners& corners, const Vector3& start, const Vector3& direction) {
  const Vector3 u = corners[0] - start;
  const Vector3 v = corners[1] - start;
  const Vector3 w = corners[2] - start;
  const double a = edge_side(v, w, direction);
  const double b = edge_side(w, u, direction);
  const double c = edge_side(u, v, direction);
  // The rounding error of zero: a path through a corner belongs to all triangles that meet there.
  const double zero = kRoundingOfVolume * std::sqrt(direction.squaredNorm()) *
                      std::max({u.squaredNorm(), v.squaredNorm(), w.squaredNorm()});
  if (std::min({a, b, c}) < -zero && std::max({a, b, c}) > zero) return std::nullopt;
  const double sum = a + b + c;
  if (std::abs(sum) <= zero) return std::nullopt;  // the segment runs in the triangle's plane
  const double t = (a * u + b * v + c * w).dot(direction) / (sum * direction.squaredNorm());
  if (!(t >= 0.0 && t <= 1.0)) return std::nullopt;
  return t;
}

}  // namespace

Vector3 nearest_point(const Corners& corners, const Vector3& point) {
  const auto& [a, b, c] = corners;
  const Vector3 ab = b - a;
  const Vector3 ac = c - a;
  const Vector3 ap = point - a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const Vector3 bp = point - b;
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + ab * (d1 / (d1 - d3));
  const Vector3 cp = point - c;
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double sum = va + vb + vc;
  return a + ab * (vb / sum) + ac * (vc / sum);
}

TriangleTree::TriangleTree(const TriangleMesh& mesh)
    : order_(hilbert_order(centroids(mesh))), corners_(mesh.triangles.size()) {
  copy_corners(mesh);
  boxes_ = BoxTree(group_boxes());
}

TriangleTree::TriangleTree(const TriangleTree& other, const TriangleMesh& mesh)
    : order_(other.order_), corners_(other.corners_.size()), boxes_(other.boxes_) {
  refit(mesh);
}

void TriangleTree::refit(const TriangleMesh& mesh) {
  assert(mesh.triangles.size() == corners_.size());
  copy_corners(mesh);
  boxes_.refit(group_boxes());
}

void TriangleTree::copy_corners(const TriangleMesh& mesh) {
  bounds_.setEmpty();
  std::mutex mutex;
  base::parallel_for(corners_.size(), kTriangleGrain, [&](std::size_t begin, std::size_t end) {
    Bounds part;
    for (std::size_t slot = begin; slot < end; ++slot) {
      for (int which = 0; which < 3; ++which) {
        corners_[slot][which] = mesh.corner(order_[slot], which);
        part.extend(corners_[slot][which]);
      }
    }
    const std::lock_guard lock(mutex);
    bounds_.extend(part);
  });
}

Bounds TriangleTree::triangle_bounds(std::uint32_t slot) const {
  const auto& [a, b, c] = corners_[slot];
  return {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
}

std::vector<FloatBox> TriangleTree::group_boxes() const {
  std::vector<FloatBox> boxes((corners_.size() + kGroup - 1) / kGroup);
  base::parallel_for(boxes.size(), kTriangleGrain / kGroup, [&](std::size_t begin, std::size_t end) {
    for (std::size_t group = begin; group < end; ++group) {
      Bounds box;
      const std::size_t last = std::min(group * kGroup + kGroup, corners_.size());
      for (std::size_t slot = group * kGroup; slot < last; ++slot)
        box.extend(triangle_bounds(std::uint32_t(slot)));
      boxes[group] = float_box(box);
    }
  });
  return boxes;
}

std::optional<MeshHit> TriangleTree::first_hit(const Vector3& a, const Vector3& b) const {
  std::optional<MeshHit> best;
  const Vector3 direction = b - a;
  near(a, b, 0.0, [&](std::uint32_t slot) {
    const std::optional<double> t = crossing(corners_[slot], a, direction);
    if (t && (!best || *t < best->parameter)) best = MeshHit{a + *t * direction, order_[slot], *t};
    return true;
  });
  return best;
}

std::optional<MeshHit> TriangleTree::nearest(const Vector3& point, double limit) const {
  std::optional<MeshHit> best;
  double best_squared = limit * limit;
  boxes_.nearest(point, best_squared, [&](std::uint32_t group) {
    const std::size_t end = std::min<std::size_t>(group * kGroup + kGroup, corners_.size());
    for (std::size_t slot = group * kGroup; slot < end; ++slot) {
      const Vector3 candidate = nearest_point(corners_[slot], point);
      const double squared = (candidate - point).squaredNorm();
      if (squared < best_squared) {
        best_squared = squared;
        best = MeshHit{candidate, order_[slot], 0.0};
      }
    }
    return best_squared;
  });
  if (best) best->parameter = std::sqrt(best_squared);
  return best;
}

int TriangleTree::winding(const Vector3& point) const {
  if (!bounds_.contains(point)) return 0;
  const WindingRay ray(point, bounds_);
  int winding = 0;
  near(point, ray.end(), 0.0, [&](std::uint32_t slot) {
    winding += ray.through(corners_[slot]);
    return true;
  });
  return winding;
}

std::size_t TriangleTree::bytes() const {
  return sizeof(*this) + order_.capacity() * sizeof(std::uint32_t) + corners_.capacity() * sizeof(Corners) +
         boxes_.bytes();
}

}  // namespace icome::geometry
