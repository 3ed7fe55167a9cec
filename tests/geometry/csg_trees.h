#pragma once
// What the tests of CSG make their trees of, and a second account of what a tree is.
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "base/random.h"
#include "geometry/csg/csg_tree.h"
#include "geometry/meshes.h"

namespace icome::geometry {

// Sanitizers make long chains ten times as slow, and recursion overflows their stack ten times as soon.
#if defined(ICOME_ADDRESS_SANITIZER) || defined(ICOME_THREAD_SANITIZER)
inline constexpr std::size_t kLongShare = 10;
#else
inline constexpr std::size_t kLongShare = 1;
#endif

inline std::shared_ptr<const MeshSolid> mesh_solid(TriangleMesh mesh) {
  return std::make_shared<const MeshSolid>(std::move(mesh));
}

inline Affine3 moved(double x, double y, double z) { return Affine3(Eigen::Translation3d(x, y, z)); }

/// A transform whose singular values lie between 0.4 and 2.5, mirrored half of the time.
inline Affine3 random_affine(base::Random& random, double reach) {
  const auto turn = [&] {
    return Eigen::AngleAxisd(random.uniform(0.0, 6.28), random.direction()).toRotationMatrix();
  };
  Vector3 stretch;
  for (int k = 0; k < 3; ++k) stretch[k] = std::exp(random.uniform(-0.9, 0.9));
  if (random.index(2) == 0) stretch.x() = -stretch.x();
  Affine3 result = Affine3::Identity();
  result.linear() = turn() * stretch.asDiagonal() * turn();
  result.translation() = reach * random.uniform() * random.direction();
  return result;
}

/// One of every kind of shape, about 1 m large.
inline std::vector<CsgShape> all_shapes() {
  return {Primitive(Box{{0.5, 0.4, 0.3}}),
          Primitive(Sphere{0.5}),
          Primitive(Cylinder{0.4, 0.9}),
          Primitive(Cone{0.5, 0.0, 0.8}),
          Primitive(Cone{0.2, 0.5, 0.7}),
          Primitive(Torus{0.4, 0.15}),
          Primitive(Capsule{0.3, 0.5}),
          mesh_solid(box_mesh({-0.4, -0.3, -0.5}, {0.2, 0.5, 0.4})),
          Primitive(Plane{})};
}

struct RandomTreeOptions {
  std::size_t leaves = 8;
  double transformed = 0.5;  // of the nodes
  double repeated = 0.2;     // of the leaves: the same operand a second time, coincident
};

/// A tree of random shape: operands are drawn from those without a parent until one is left.
inline CsgTree random_tree(base::Random& random, const RandomTreeOptions& options) {
  CsgTree tree;
  const std::vector<CsgShape> shapes = all_shapes();
  std::vector<CsgTree::Index> loose;
  for (std::size_t i = 0; i < options.leaves; ++i) {
    if (i > 0 && random.uniform() < options.repeated) {
      const CsgTree::Index again = loose[random.index(loose.size())];
      const Affine3 parent_from_again = tree.node(again).parent_from_node;
      loose.push_back(tree.add_leaf(CsgShape(tree.node(again).shape.value()), parent_from_again));
    } else {
      loose.push_back(tree.add_leaf(shapes[random.index(shapes.size())], random_affine(random, 0.7)));
    }
  }
  const auto draw = [&] {
    const std::size_t which = random.index(loose.size());
    const CsgTree::Index operand = loose[which];
    loose[which] = loose.back();
    loose.pop_back();
    return operand;
  };
  while (loose.size() > 1) {
    const CsgTree::Index left = draw(), right = draw();
    const auto op = static_cast<CsgOperator>(random.index(3));
    const bool moves = random.uniform() < options.transformed;
    loose.push_back(tree.add(op, left, right, moves ? random_affine(random, 0.3) : Affine3::Identity()));
  }
  return tree;
}

/// Set algebra by recursion, without short cuts or boxes: the account that tests compare with.
inline bool recursively_inside(const CsgTree& tree, CsgTree::Index index, const Affine3& tree_from_parent,
                               const Vector3& point) {
  const CsgTree::Node& node = tree.node(index);
  const Affine3 tree_from_node = tree_from_parent * node.parent_from_node;
  if (node.is_leaf) return CsgLeaf(*node.shape, tree_from_node).inside(point);
  const bool left = recursively_inside(tree, node.left, tree_from_node, point);
  const bool right = recursively_inside(tree, node.right, tree_from_node, point);
  switch (node.op) {
    case CsgOperator::Union:
      return left || right;
    case CsgOperator::Intersection:
      return left && right;
    case CsgOperator::Difference:
      return left && !right;
  }
  return false;
}

inline bool recursively_inside(const CsgTree& tree, const Vector3& point) {
  return !tree.empty() && recursively_inside(tree, tree.root(), Affine3::Identity(), point);
}

/// A chain of `operations` operations that leans left or right, operators by turns, over small boxes.
inline CsgTree chain(std::size_t operations, bool left_deep, const std::vector<CsgOperator>& ops,
                     double step = 0.0) {
  CsgTree tree;
  CsgTree::Index deep = tree.add_leaf(Primitive(Box{{0.5, 0.5, 0.5}}));
  for (std::size_t i = 0; i < operations; ++i) {
    const CsgTree::Index leaf =
        tree.add_leaf(Primitive(Box{{0.25, 0.25, 0.25}}), moved(step * static_cast<double>(i + 1), 0, 0));
    const CsgOperator op = ops[i % ops.size()];
    deep = left_deep ? tree.add(op, deep, leaf) : tree.add(op, leaf, deep);
  }
  return tree;
}

}  // namespace icome::geometry
