#include "geometry/csg_mesh.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/box_tree.h"
#include "geometry/contour_error.h"
#include "geometry/csg_cut.h"
#include "geometry/csg_solid.h"
#include "geometry/hilbert.h"

namespace icome::geometry {
namespace {

/// A transform stretches evenly when its squared stretches differ by less than this part.
constexpr double kEven = 1e-9;
/// Walls below this many cells may slip between the points of a grid.
constexpr double kThinCells = 2.0;
constexpr double kCutPart = 0.8;  // of the whole work, without measuring
/// Distances from a primitive are trusted to this part of the coordinates.
constexpr double kDistanceRounding = 1e-9;

bool stretches_evenly(const Affine3& transform) {
  const Matrix3 squared = transform.linear().transpose() * transform.linear();
  const double mean = squared.trace() / 3;
  return (squared - mean * Matrix3::Identity()).cwiseAbs().maxCoeff() <= kEven * mean;
}

/// Says where the surfaces of a tree's primitives are, and with them all of the solid's surface.
class CsgLeafSurfaces {
 public:
  /// Of the primitives that reach into `box`.
  CsgLeafSurfaces(const CsgTree& tree, const Bounds& box) {
    std::vector<Leaf> unsorted;
    std::vector<Bounds> parts;
    std::vector<Eigen::Vector3f> centres;
    const std::vector<Affine3> tree_from_node = tree.tree_from_node();
    for (const CsgTree::Index index : leaves_below_root(tree)) {
      const CsgLeaf leaf(*tree.node(index).shape, tree_from_node[index]);
      const Bounds part = leaf.bounds().intersection(box);
      if (part.isEmpty()) continue;
      unsorted.push_back({leaf, stretches_evenly(tree_from_node[index])});
      parts.push_back(part);
      centres.emplace_back(part.center().cast<float>());
    }
    std::vector<FloatBox> boxes;
    for (const std::uint32_t i : hilbert_order(centres)) {
      leaves_.push_back(unsorted[i]);
      boxes.push_back(float_box(parts[i]));
    }
    boxes_ = BoxTree(boxes);
  }

  /// May one of them pass the box?
  bool may_cross(const Bounds& box) const {
    const Vector3 centre = box.center();
    const double size = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
    const double radius = box.diagonal().norm() / 2 + kDistanceRounding * size;
    bool crossed = false;
    boxes_.near(SegmentQuery(centre, centre, radius), [&](std::uint32_t index) {
      const Leaf& leaf = leaves_[index];
      crossed = !leaf.even || distance(leaf.leaf, centre) <= radius;
      return !crossed;
    });
    return crossed;
  }

 private:
  struct Leaf {
    CsgLeaf leaf;
    bool even;  // distances from it are exact
  };

  static std::vector<CsgTree::Index> leaves_below_root(const CsgTree& tree) {
    std::vector<CsgTree::Index> leaves, todo{tree.root()};
    while (!todo.empty()) {
      const CsgTree::Index index = todo.back();
      todo.pop_back();
      const CsgTree::Node& node = tree.node(index);
      if (node.is_leaf) {
        leaves.push_back(index);
      } else {
        todo.push_back(node.right);
        todo.push_back(node.left);
      }
    }
    return leaves;
  }

  static double distance(const CsgLeaf& leaf, const Vector3& point) {
    const SurfacePoint nearest =
        leaf.inside(point) ? leaf.scp_from_inside(point) : leaf.scp_from_outside(point);
    return (nearest.point - point).norm();
  }

  std::vector<Leaf> leaves_;
  BoxTree boxes_;
};

/// Nothing where cutting would take too much: then cells must do. Who says how many triangles are allowed
/// hears that they do not suffice.
base::Result<std::optional<ContourMesh>> cut_out(const CsgTree& tree, const SampledSolid& solid,
                                                 const ContourOptions& options) {
  bool stopped = false;
  const ContourProgress go_on = [&](double part) {
    stopped = stopped || (options.progress && !options.progress(part));
    return !stopped;
  };
  auto mesh = cut_csg(tree, options.cell, options.max_triangles, contour_share(go_on, 0.0, kCutPart));
  const bool limited = options.max_triangles < ContourOptions().max_triangles;
  if (!mesh && (stopped || limited)) return tl::unexpected(mesh.error());
  if (!mesh) return std::nullopt;
  ContourMesh result{std::move(*mesh)};
  if (!options.measures) return std::optional(std::move(result));
  const auto error =
      measure_contour_error(solid, options.cell, result.mesh, contour_share(go_on, kCutPart, 1.0 - kCutPart));
  if (!error) return base::fail("the meshing was interrupted");
  result.error = *error;
  return std::optional(std::move(result));
}

}  // namespace

base::Result<ContourMesh> contour(const CsgTree& tree, const ContourOptions& options) {
  if (tree.empty()) return contour(SampledSolid{}, options);
  const CsgSolid compiled(tree);
  SampledSolid solid;
  solid.bounds = bounds(tree);
  solid.inside = [&](const Vector3& point) { return compiled.inside(point); };
  solid.crossing = [&](const Vector3& a, const Vector3& b) {
    const double nowhere = std::numeric_limits<double>::quiet_NaN();  // then it is found by halving
    return compiled.crossing(a, b).value_or(SurfacePoint{Vector3::Constant(nowhere), b - a});
  };
  const CsgProgram& program = compiled.program();
  const bool limited = !solid.bounds.isEmpty() && solid.bounds.sizes().allFinite();
  if (limited && options.cell > 0.0 && csg_can_cut(program) && is_thin(program, kThinCells * options.cell)) {
    if (auto cut = cut_out(tree, solid, options); !cut || *cut) {
      if (!cut) return tl::unexpected(cut.error());
      return std::move(**cut);
    }
  }
  const CsgLeafSurfaces surfaces(tree, solid.bounds);
  solid.may_cross = [&](const Bounds& box) { return surfaces.may_cross(box); };
  return contour(solid, options);
}

}  // namespace icome::geometry
