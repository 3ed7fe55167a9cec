#include "haptics/plain_solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <queue>
#include <utility>
#include <variant>
#include <vector>

#include "base/decompositions.h"
#include "haptics/witness_tree.h"

namespace icome::haptics {
namespace {

using base::Affine3;
using base::Bounds;
using base::Vector2;
using base::Vector3;
using geometry::CsgOperator;
using geometry::CsgTree;

/// From a point of the half-plane beside an axis (distance from it, height) to what a trapezium beside the
/// axis, `low` wide at -half and `high` at +half, sweeps around it.
double frustum_distance(const Vector2& point, double low, double high, double half) {
  const Vector2 bottom(low, -half), top(high, half);
  const auto to_edge = [&](const Vector2& from, const Vector2& to) {
    const Vector2 way = to - from;
    const double along = way.squaredNorm() > 0.0 ? (point - from).dot(way) / way.squaredNorm() : 0.0;
    return (from + std::clamp(along, 0.0, 1.0) * way - point).norm();
  };
  const double distance =
      std::min({to_edge({0.0, -half}, bottom), to_edge(bottom, top), to_edge(top, {0.0, half})});
  const Vector2 slant = top - bottom, off = point - bottom;
  const bool inside = std::abs(point.y()) <= half && slant.x() * off.y() - slant.y() * off.x() >= 0.0;
  return inside ? -distance : distance;
}

struct PlainDistance {
  const Vector3& point;

  Vector2 beside_axis() const { return {std::hypot(point.x(), point.y()), point.z()}; }

  double operator()(const geometry::Plane&) const { return point.z(); }
  double operator()(const geometry::Box& box) const {
    const Vector3 over = point.cwiseAbs() - box.half;
    return over.cwiseMax(0.0).norm() + std::min(0.0, over.maxCoeff());
  }
  double operator()(const geometry::Sphere& sphere) const { return point.norm() - sphere.radius; }
  double operator()(const geometry::Cylinder& it) const {
    return frustum_distance(beside_axis(), it.radius, it.radius, 0.5 * it.height);
  }
  double operator()(const geometry::Cone& it) const {
    return frustum_distance(beside_axis(), it.bottom_radius, it.top_radius, 0.5 * it.height);
  }
  double operator()(const geometry::Torus& it) const {
    return (beside_axis() - Vector2(it.major_radius, 0.0)).norm() - it.minor_radius;
  }
  double operator()(const geometry::Capsule& it) const {
    const double height = std::clamp(point.z(), -0.5 * it.height, 0.5 * it.height);
    return (point - Vector3(0.0, 0.0, height)).norm() - it.radius;
  }
};

/// A primitive, a polyhedron or a custom shape, in its own frame.
struct PlainShape {
  std::function<bool(const Vector3&)> inside;      // empty: no shape
  std::function<double(const Vector3&)> distance;  // m, to the surface; negative inside
};

struct ShapeMaker {
  PlainShape operator()(const geometry::Primitive& primitive) const {
    return {[primitive](const Vector3& point) { return plain_distance(primitive, point) <= 0.0; },
            [primitive](const Vector3& point) { return plain_distance(primitive, point); }};
  }
  PlainShape operator()(const std::shared_ptr<const geometry::MeshSolid>& solid) const {
    const auto tree =
        std::make_shared<WitnessTree>(std::shared_ptr<const geometry::TriangleMesh>(solid, &solid->mesh));
    return {[tree](const Vector3& point) { return winding(*tree, point) > 0; },
            [tree](const Vector3& point) {
              const double distance = tree->distance(point, std::numeric_limits<double>::infinity());
              return winding(*tree, point) > 0 ? -distance : distance;
            }};
  }
  PlainShape operator()(const std::shared_ptr<const geometry::CsgPrimitive>& custom) const {
    return {[custom](const Vector3& point) { return custom->inside(point); },
            [custom](const Vector3& point) {
              return custom->inside(point) ? -(custom->scp_from_inside(point).point - point).norm()
                                           : (custom->scp_from_outside(point).point - point).norm();
            }};
  }
};

/// A tree with all transforms multiplied out.
class PlainTree {
 public:
  explicit PlainTree(const CsgTree& tree) : root_(tree.root()) {
    const std::vector<Affine3> placings = tree.tree_from_node();
    for (CsgTree::Index i = 0; i < tree.size(); ++i) {
      const CsgTree::Node& node = tree.node(i);
      Part& part = parts_.emplace_back();
      if (node.is_leaf) {
        part.shape = std::visit(ShapeMaker{}, *node.shape);
        part.shape_from_tree = geometry::unplacing(placings[i]);
        part.least_stretch = base::singular_values(placings[i].linear()).values.minCoeff();
        continue;
      }
      part.op = node.op;
      part.operands = {node.left, node.right};
      part.size = parts_[node.left].size + parts_[node.right].size;
    }
  }

  bool inside(const Vector3& point) const { return inside(root_, point); }

  std::optional<Vector3> nearest(const Vector3& point, double limit, double fineness) const;

 private:
  struct Part {
    PlainShape shape;  // of a leaf; else empty
    Affine3 shape_from_tree;
    double least_stretch = 1.0;  // of what the leaf's transform does to lengths
    CsgOperator op = CsgOperator::Union;
    std::array<CsgTree::Index, 2> operands{};
    std::size_t size = 1;  // leaves
  };

  /// Asks the smaller operand and goes on with the larger: however deep the tree is, this recurses no deeper
  /// than its leaves can be halved.
  bool inside(CsgTree::Index index, const Vector3& point) const {
    bool outcome = true;  // when the point is in the part that is left over
    while (!parts_[index].shape.inside) {
      const Part& part = parts_[index];
      const bool left_first = parts_[part.operands[0]].size <= parts_[part.operands[1]].size;
      const CsgTree::Index asked = part.operands[left_first ? 0 : 1];
      const bool answer = inside(asked, point);
      index = part.operands[left_first ? 1 : 0];
      if (part.op == CsgOperator::Union) {
        if (answer) return outcome;
      } else if (part.op == CsgOperator::Intersection || left_first) {
        if (!answer) return !outcome;
        if (part.op == CsgOperator::Difference) outcome = !outcome;
      } else if (answer) {
        return !outcome;
      }
    }
    return parts_[index].shape.inside(parts_[index].shape_from_tree * point) == outcome;
  }

  /// No farther than the leaf's surface is; negative inside.
  double bound(CsgTree::Index leaf, const Vector3& point) const {
    const Part& part = parts_[leaf];
    return part.least_stretch * part.shape.distance(part.shape_from_tree * point);
  }

  friend class LocalTree;
  std::vector<Part> parts_;
  CsgTree::Index root_;
};

/// What a tree is within some distance of a place, without the parts that are all solid or all free there.
class LocalTree {
 public:
  LocalTree(const PlainTree& whole, const Vector3& centre, double reach) : whole_(whole) {
    std::vector<std::uint32_t> local(whole.parts_.size());
    for (CsgTree::Index i = 0; i < whole.parts_.size(); ++i) {
      const PlainTree::Part& part = whole.parts_[i];
      local[i] = part.shape.inside ? leaf(i, centre, reach)
                                   : joined(part.op, local[part.operands[0]], local[part.operands[1]]);
    }
    root_ = local[whole.root_];
    values_.resize(steps_.size());
  }

  /// The surface is at least so far away (m); negative inside.
  double bound(const Vector3& point) {
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      const Step& step = steps_[i];
      if (step.is_leaf) {
        values_[i] = whole_.bound(step.left, point);
        continue;
      }
      const double left = value(step.left), right = value(step.right);
      values_[i] = step.op == CsgOperator::Union
                       ? std::min(left, right)
                       : std::max(left, step.op == CsgOperator::Difference ? -right : right);
    }
    return value(root_);
  }

 private:
  static constexpr std::uint32_t kFree = 0xffff'ffff, kSolid = 0xffff'fffe;

  struct Step {
    bool is_leaf;
    CsgOperator op;
    std::uint32_t left, right;  // steps before; of a leaf, the part
  };

  std::uint32_t leaf(CsgTree::Index part, const Vector3& centre, double reach) {
    const double there = whole_.bound(part, centre);
    if (std::abs(there) > reach) return there < 0.0 ? kSolid : kFree;
    steps_.push_back({true, CsgOperator::Union, part, 0});
    return std::uint32_t(steps_.size() - 1);
  }

  std::uint32_t joined(CsgOperator op, std::uint32_t left, std::uint32_t right) {
    if (op == CsgOperator::Union) {
      if (left == kSolid || right == kFree) return left;
      if (right == kSolid || left == kFree) return right;
    } else if (op == CsgOperator::Intersection) {
      if (left == kFree || right == kSolid) return left;
      if (right == kFree || left == kSolid) return right;
    } else {
      if (left == kFree || right == kFree) return left;
      if (right == kSolid) return kFree;
    }
    steps_.push_back({false, op, left, right});
    return std::uint32_t(steps_.size() - 1);
  }

  double value(std::uint32_t step) const {
    if (step < kSolid) return values_[step];
    return (step == kFree ? 1.0 : -1.0) * std::numeric_limits<double>::infinity();
  }

  const PlainTree& whole_;
  std::vector<Step> steps_;
  std::vector<double> values_;
  std::uint32_t root_;
};

/// A cube around a place, and how far it is from the place that is asked about (m).
struct PlainCell {
  Vector3 centre;
  double half;
  double apart;
};

/// The cell next to be looked at is the nearest.
struct FartherCell {
  bool operator()(const PlainCell& one, const PlainCell& other) const { return one.apart > other.apart; }
};

// Cubes, the nearest first, are halved until they are all solid, all free or small.
std::optional<Vector3> PlainTree::nearest(const Vector3& point, double limit, double fineness) const {
  LocalTree local(*this, point, 2.0 * limit);
  std::priority_queue<PlainCell, std::vector<PlainCell>, FartherCell> open;
  open.push({point, limit, 0.0});
  std::optional<Vector3> found;
  double least = limit;
  while (!open.empty() && open.top().apart < least) {
    const PlainCell cell = open.top();
    open.pop();
    const double bound = local.bound(cell.centre), corner = std::sqrt(3.0) * cell.half;
    if (bound > corner) continue;
    const auto take = [&](const Vector3& place) {
      const double distance = (place - point).norm();
      if (distance < least) found = place;
      least = std::min(least, distance);
    };
    if (bound <= 0.0) take(cell.centre);
    if (bound < -corner) {
      const Vector3 reach = Vector3::Constant(cell.half);
      take(point.cwiseMax(cell.centre - reach).cwiseMin(cell.centre + reach));
    } else if (corner > fineness) {
      for (int i = 0; i < 8; ++i) {
        const double half = 0.5 * cell.half;
        const Vector3 centre = cell.centre + half * Vector3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
        const Vector3 over = ((centre - point).cwiseAbs() - Vector3::Constant(half)).cwiseMax(0.0);
        open.push({centre, half, over.norm()});
      }
    }
  }
  return found;
}

}  // namespace

double plain_distance(const geometry::Primitive& primitive, const Vector3& point) {
  return std::visit(PlainDistance{point}, primitive);
}

MembershipSolid plain_solid(const CsgTree& tree) {
  if (tree.empty()) return {[](const Vector3&, double) { return false; }, Bounds()};
  const auto plain = std::make_shared<const PlainTree>(tree);
  return {[plain](const Vector3& point, double) { return plain->inside(point); }, geometry::bounds(tree),
          [plain](const Vector3& point, double limit, double fineness) {
            return plain->nearest(point, limit, fineness);
          }};
}

}  // namespace icome::haptics
