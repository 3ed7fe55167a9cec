#pragma once
// A second opinion on CSG solids and on where a surface contact point (SCP) belongs on them, by closed forms
// of its own and plain search: nothing of what is under test, and slow.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/csg/csg_tree.h"
#include "haptics/contact_world.h"

namespace icome::haptics {

/// Distances to the primitives, negative inside, worked out from their definitions.
struct BruteDistance {
  Vector3 p;

  /// In the quarter plane of a solid |x| <= a, |y| <= b around the origin.
  static double rectangle(double x, double y) {
    return std::hypot(std::max(x, 0.0), std::max(y, 0.0)) + std::min(std::max(x, y), 0.0);
  }
  double rho() const { return std::hypot(p.x(), p.y()); }

  double operator()(const geometry::Plane&) const { return p.z(); }
  double operator()(const geometry::Box& box) const {
    const Vector3 q = p.cwiseAbs() - box.half;
    return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
  }
  double operator()(const geometry::Sphere& sphere) const { return p.norm() - sphere.radius; }
  double operator()(const geometry::Cylinder& it) const {
    return rectangle(rho() - it.radius, std::abs(p.z()) - 0.5 * it.height);
  }
  double operator()(const geometry::Cone& it) const {
    const double h = 0.5 * it.height;
    const base::Vector2 at(rho(), p.z());
    const auto to_segment = [&](double x1, double y1, double x2, double y2) {
      const base::Vector2 from(x1, y1), way(x2 - x1, y2 - y1);
      const double t = std::clamp((at - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
      return (at - from - t * way).norm();
    };
    double distance = to_segment(it.bottom_radius, -h, it.top_radius, h);
    if (it.bottom_radius > 0.0) distance = std::min(distance, to_segment(0.0, -h, it.bottom_radius, -h));
    if (it.top_radius > 0.0) distance = std::min(distance, to_segment(0.0, h, it.top_radius, h));
    const double beyond = at.x() * it.height - it.bottom_radius * (h - at.y()) - it.top_radius * (at.y() + h);
    return beyond <= 0.0 && std::abs(at.y()) <= h ? -distance : distance;
  }
  double operator()(const geometry::Torus& it) const {
    return std::hypot(rho() - it.major_radius, p.z()) - it.minor_radius;
  }
  double operator()(const geometry::Capsule& it) const {
    const double h = 0.5 * it.height;
    return (p - Vector3(0, 0, std::clamp(p.z(), -h, h))).norm() - it.radius;
  }

  double operator()(const geometry::Primitive& primitive) const { return std::visit(*this, primitive); }
  double operator()(const std::shared_ptr<const geometry::MeshSolid>& solid) const {
    const double distance = brute_nearest(solid->mesh, p).distance;
    return brute_winding(solid->mesh, p) > 0.5 ? -distance : distance;
  }
  double operator()(const std::shared_ptr<const geometry::CsgPrimitive>& own) const {
    return own->inside(p) ? -(own->scp_from_inside(p).point - p).norm()
                          : (own->scp_from_outside(p).point - p).norm();
  }
};

/// A CSG solid as a function that changes no faster than its argument moves: negative inside, and the
/// surface is at least so far away.
class BruteSolid {
 public:
  explicit BruteSolid(const geometry::CsgTree& tree) {
    if (!tree.empty()) root_ = take(tree, tree.root(), base::Affine3::Identity());
  }

  double bound(const Vector3& point) const { return bound(root_, point); }
  bool inside(const Vector3& point) const { return bound(point) <= 0.0; }

  /// The same within `radius` of `centre`, without what does not matter there.
  BruteSolid near(const Vector3& centre, double radius) const {
    BruteSolid local;
    local.root_ = local.copy(*this, root_, centre, radius);
    return local;
  }

  std::size_t leaves() const { return leaves_.size(); }

 private:
  struct Leaf {
    geometry::CsgShape shape;
    base::Matrix3 turn;
    Vector3 shift;
    double least_stretch;
  };
  struct Node {
    enum { Union, Intersection, Difference, Leaf } kind;
    int left, right;
  };
  static constexpr int kEmpty = -1, kFull = -2;

  BruteSolid() = default;

  int take(const geometry::CsgTree& tree, geometry::CsgTree::Index index, const base::Affine3& outer) {
    const geometry::CsgTree::Node& node = tree.node(index);
    const base::Affine3 place = outer * node.parent_from_node;
    if (node.is_leaf) {
      const base::Matrix3 inverse = place.linear().inverse();
      const double least = place.linear().jacobiSvd().singularValues().minCoeff();
      leaves_.push_back({*node.shape, inverse, -inverse * place.translation(), least});
      nodes_.push_back({Node::Leaf, int(leaves_.size()) - 1, 0});
    } else {
      const int left = take(tree, node.left, place);
      const int right = take(tree, node.right, place);
      const auto kind = node.op == geometry::CsgOperator::Union          ? Node::Union
                        : node.op == geometry::CsgOperator::Intersection ? Node::Intersection
                                                                         : Node::Difference;
      nodes_.push_back({kind, left, right});
    }
    return int(nodes_.size()) - 1;
  }

  double leaf_bound(const Leaf& leaf, const Vector3& point) const {
    const BruteDistance distance{leaf.turn * point + leaf.shift};
    return leaf.least_stretch * std::visit(distance, leaf.shape);
  }

  double bound(int index, const Vector3& point) const {
    if (index < 0) return index == kFull ? -1e3 : 1e3;
    const Node& node = nodes_[std::size_t(index)];
    if (node.kind == Node::Leaf) return leaf_bound(leaves_[std::size_t(node.left)], point);
    const double left = bound(node.left, point), right = bound(node.right, point);
    if (node.kind == Node::Union) return std::min(left, right);
    return std::max(left, node.kind == Node::Difference ? -right : right);
  }

  int copy(const BruteSolid& from, int index, const Vector3& centre, double radius) {
    if (index < 0) return index;
    const Node& node = from.nodes_[std::size_t(index)];
    if (node.kind == Node::Leaf) {
      const Leaf& leaf = from.leaves_[std::size_t(node.left)];
      const double there = leaf_bound(leaf, centre);
      if (std::abs(there) > radius) return there < 0.0 ? kFull : kEmpty;
      leaves_.push_back(leaf);
      nodes_.push_back({Node::Leaf, int(leaves_.size()) - 1, 0});
      return int(nodes_.size()) - 1;
    }
    const int left = copy(from, node.left, centre, radius);
    const int right = copy(from, node.right, centre, radius);
    if (node.kind == Node::Union) {
      if (left == kFull || right == kFull) return kFull;
      if (left == kEmpty || right == kEmpty) return left == kEmpty ? right : left;
    } else if (node.kind == Node::Intersection) {
      if (left == kEmpty || right == kEmpty) return kEmpty;
      if (left == kFull || right == kFull) return left == kFull ? right : left;
    } else {
      if (left == kEmpty || right == kFull) return kEmpty;
      if (right == kEmpty) return left;
    }
    nodes_.push_back({node.kind, left, right});
    return int(nodes_.size()) - 1;
  }

  std::vector<Leaf> leaves_;
  std::vector<Node> nodes_;
  int root_ = kEmpty;
};

/// The free side of a solid around a place, as heights along the pull: from places beside it straight on
/// towards the tip until the solid is in the way. A solid is what has the functions of BruteSolid.
template <typename Solid>
class BruteTerrain {
 public:
  BruteTerrain(const Solid& solid, const Vector3& place, const Vector3& tip, double size)
      : solid_(solid), place_(place), tip_(tip), pull_((tip - place).normalized()), least_(1e-7 * size) {
    u_ = pull_.unitOrthogonal();
    v_ = pull_.cross(u_);
  }

  Vector3 at(double u, double v) const {
    const Vector3 start = place_ + u * u_ + v * v_;
    const double scale = std::max(std::hypot(u, v), least_);
    const double farthest = std::min(20.0 * scale, (tip_ - place_).norm());
    return solid_.inside(start) ? out_of(start, scale, 20.0 * scale) : into(start, scale, farthest);
  }
  double operator()(double u, double v) const { return (at(u, v) - tip_).norm(); }

 private:
  Vector3 between(Vector3 free, Vector3 solid) const {
    for (int i = 0; i < 60; ++i) {
      const Vector3 middle = 0.5 * (free + solid);
      (solid_.inside(middle) ? solid : free) = middle;
    }
    return free;
  }
  Vector3 into(const Vector3& start, double scale, double farthest) const {
    double last = 0.0;
    for (double t = 0.0; t < farthest;) {
      last = t;
      t = std::min(farthest, t + std::max(std::abs(solid_.bound(start + t * pull_)), 0.005 * scale));
      if (solid_.inside(start + t * pull_)) return between(start + last * pull_, start + t * pull_);
    }
    return start + farthest * pull_;
  }
  Vector3 out_of(const Vector3& start, double scale, double farthest) const {
    double last = 0.0;
    for (double t = 0.0; t < farthest;) {
      last = t;
      t = std::min(farthest, t + std::max(std::abs(solid_.bound(start - t * pull_)), 0.005 * scale));
      if (!solid_.inside(start - t * pull_)) return between(start - t * pull_, start - last * pull_);
    }
    return start - farthest * pull_;
  }

  const Solid& solid_;
  Vector3 place_, tip_, pull_, u_, v_;
  double least_;
};

/// The least of `f` in [-w, w], found by golden section.
template <typename Function>
std::pair<double, double> golden(Function&& f, double w, double finest) {
  constexpr double kRatio = 0.6180339887498949;
  double a = -w, b = w, c = b - kRatio * (b - a), d = a + kRatio * (b - a);
  double at_c = f(c), at_d = f(d);
  while (b - a > finest) {
    if (at_c < at_d) {
      b = d, d = c, at_d = at_c;
      c = b - kRatio * (b - a), at_c = f(c);
    } else {
      a = c, c = d, at_c = at_d;
      d = a + kRatio * (b - a), at_d = f(d);
    }
  }
  return at_c < at_d ? std::pair(c, at_c) : std::pair(d, at_d);
}

/// How wrong an SCP is.
struct ScpError {
  double inside = 0.0;  // m, at least so deep in the solid
  double error = 0.0;   // m, to the place where the way downhill from it really ends
  double drop = 0.0;    // m, how much nearer to the tip that is
  Vector3 rest = Vector3::Zero();
};

/// One step downhill from `place`, over every scale from 0.2 % to 1e-7 of `size`; nothing at a minimum. What
/// lies beyond a ridge is not downhill, however low it is.
template <typename Solid>
class BruteDescent {
 public:
  BruteDescent(const Solid& solid, const Vector3& place, const Vector3& tip, double size)
      : terrain_(solid, place, tip, size), here_((place - tip).norm()), tell_(1e-14 * size), size_(size) {}

  std::optional<Vector3> step() const {
    for (const double radius : {2e-3, 5e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6}) {
      double best_u = 0.0, best_v = 0.0, best = here_ - tell_;
      for (int i = 0; i < 24; ++i) {
        const double angle = 6.283185307179586 * (i + 0.37 + 1e3 * radius) / 24;
        const double u = radius * size_ * std::cos(angle), v = radius * size_ * std::sin(angle);
        const double there = terrain_(u, v);
        if (there >= best || !falls(u, v)) continue;
        best = there, best_u = u, best_v = v;
      }
      if (best < here_ - tell_) return terrain_.at(best_u, best_v);
    }
    return along_valley();
  }

 private:
  /// For valleys that are too narrow for a few directions.
  std::optional<Vector3> along_valley() const {
    for (const double window : {1e-3, 3e-5, 1e-6}) {
      const double w = window * size_, finest = 1e-4 * w;
      const auto deepest = [&](double u) {
        return golden([&](double v) { return terrain_(u, v); }, w, 1e-3 * finest);
      };
      const double u = golden([&](double x) { return deepest(x).second; }, w, finest).first;
      const double v = deepest(u).first;
      if (terrain_(u, v) < here_ - tell_ && falls(u, v)) return terrain_.at(u, v);
    }
    return std::nullopt;
  }

  /// Does the way there lead down from its beginning?
  bool falls(double u, double v) const {
    for (double share = 0.5; share * std::hypot(u, v) > 1e-7 * size_; share *= 0.5) {
      if (terrain_(share * u, share * v) > here_ + tell_) return false;
    }
    return true;
  }

  BruteTerrain<Solid> terrain_;
  double here_, tell_, size_;  // m; `tell_` is the rounding of a distance
};

/// Goes downhill from the SCP to where it should be.
template <typename Solid>
ScpError brute_scp_error(const Solid& whole, const Vector3& tip, const Vector3& scp, double size,
                         int max_steps = 60) {
  ScpError result;
  const Solid solid = whole.near(scp, 0.1 * size);
  result.inside = std::max(0.0, -solid.bound(scp));
  result.rest = scp;
  if ((tip - scp).norm() <= 1e-9 * size) return result;
  Vector3 place = BruteTerrain(solid, scp, tip, size).at(0.0, 0.0);
  for (int i = 0; i < max_steps; ++i) {
    const auto next = BruteDescent(solid, place, tip, size).step();
    if (!next) break;
    place = *next;
    if ((place - scp).norm() > 0.02 * size || (place - tip).norm() <= 1e-9 * size) break;
  }
  result.rest = place;
  result.error = (place - scp).norm();
  result.drop = (scp - tip).norm() - (place - tip).norm();
  return result;
}

}  // namespace icome::haptics
