#include "haptics/judge/plain_solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "base/decompositions.h"
#include "haptics/judge/plain_cells.h"
#include "haptics/judge/witness_tree.h"

namespace icome::haptics {
namespace {

using base::Affine3;
using base::Bounds;
using base::Vector2;
using base::Vector3;
using geometry::CsgOperator;
using geometry::CsgTree;

/// Distance of a point of the half-plane beside an axis (distance from it, height) from the solid that a
/// trapezium beside the axis, `low` wide at -half, `high` at +half, sweeps around it; negative inside.
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

  /// The steps that bound distances to it; the last is the whole.
  std::vector<PlainStep> steps() const {
    std::vector<PlainStep> steps;
    for (CsgTree::Index i = 0; i <= root_; ++i) {
      const Part& part = parts_[i];
      PlainStep& step = steps.emplace_back(PlainStep{{}, part.op, {part.operands[0], part.operands[1]}});
      if (part.shape.distance) step.bound = bound(part);
    }
    return steps;
  }

 private:
  struct Part {
    PlainShape shape;  // of a leaf; else empty
    Affine3 shape_from_tree;
    double least_stretch = 1.0;  // of lengths by the leaf's transform
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

  /// A distance no larger than that of the leaf's surface; negative inside.
  static std::function<double(const Vector3&)> bound(const Part& leaf) {
    return [distance = leaf.shape.distance, shape_from_tree = leaf.shape_from_tree,
            stretch = leaf.least_stretch](const Vector3& point) {
      return stretch * distance(shape_from_tree * point);
    };
  }

  std::vector<Part> parts_;
  CsgTree::Index root_;
};

}  // namespace

double plain_distance(const geometry::Primitive& primitive, const Vector3& point) {
  return std::visit(PlainDistance{point}, primitive);
}

MembershipSolid plain_solid(const CsgTree& tree) {
  if (tree.empty()) return {[](const Vector3&, double) { return false; }, Bounds()};
  const auto plain = std::make_shared<const PlainTree>(tree);
  const auto cells = std::make_shared<PlainCells>(plain->steps());
  return {[plain](const Vector3& point, double) { return plain->inside(point); }, geometry::bounds(tree),
          [cells](const Vector3& point, double, double limit, double fineness) {
            return cells->nearest(point, limit, fineness);
          }};
}

}  // namespace icome::haptics
