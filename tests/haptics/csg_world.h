#pragma once
// CSG trees to be touched: the thesis's own, random ones, and those that are nasty by design.
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/random.h"
#include "geometry/csg/csg_tree.h"

namespace icome::haptics {

using base::Affine3;
using base::Random;
using base::Vector3;
using geometry::CsgOperator;
using geometry::CsgTree;

struct NamedTree {
  std::string name;
  CsgTree tree;

  friend std::ostream& operator<<(std::ostream& out, const NamedTree& it) { return out << it.name; }
};

inline Affine3 moved(double x, double y, double z) {
  Affine3 transform = Affine3::Identity();
  transform.translation() = Vector3(x, y, z);
  return transform;
}

inline Affine3 turned(double angle, const Vector3& axis) {
  return Affine3(Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix());
}

inline Affine3 stretched(double x, double y, double z) {
  return Affine3(Eigen::DiagonalMatrix<double, 3>(x, y, z).toDenseMatrix());
}

inline geometry::CsgShape box_shape(double x, double y, double z) {
  return geometry::Primitive(geometry::Box{0.5 * Vector3(x, y, z)});
}
inline geometry::CsgShape ball_shape(double radius) { return geometry::Primitive(geometry::Sphere{radius}); }
inline geometry::CsgShape rod_shape(double radius, double height) {
  return geometry::Primitive(geometry::Cylinder{radius, height});
}
inline geometry::CsgShape cone_shape(double bottom, double top, double height) {
  return geometry::Primitive(geometry::Cone{bottom, top, height});
}
inline geometry::CsgShape ring_shape(double major, double minor) {
  return geometry::Primitive(geometry::Torus{major, minor});
}

/// Builds a tree from left to right: every call combines what is there with one more leaf.
class TreeChain {
 public:
  explicit TreeChain(const geometry::CsgShape& first, const Affine3& place = Affine3::Identity()) {
    root_ = tree_.add_leaf(first, place);
  }
  TreeChain& add(CsgOperator op, const geometry::CsgShape& shape, const Affine3& place) {
    const CsgTree::Index leaf = tree_.add_leaf(shape, place);
    root_ = tree_.add(op, root_, leaf);
    return *this;
  }
  TreeChain& unite(const geometry::CsgShape& shape, const Affine3& place = Affine3::Identity()) {
    return add(CsgOperator::Union, shape, place);
  }
  TreeChain& cut(const geometry::CsgShape& shape, const Affine3& place = Affine3::Identity()) {
    return add(CsgOperator::Difference, shape, place);
  }
  TreeChain& keep(const geometry::CsgShape& shape, const Affine3& place = Affine3::Identity()) {
    return add(CsgOperator::Intersection, shape, place);
  }
  const CsgTree& tree() const { return tree_; }

 private:
  CsgTree tree_;
  CsgTree::Index root_ = 0;
};

/// (cube n sphere) - cylinder, 0.1 m: the thesis's figure 5.6.
inline CsgTree figure_5_6(double scale = 1.0) {
  return TreeChain(box_shape(0.1 * scale, 0.1 * scale, 0.1 * scale))
      .keep(ball_shape(0.065 * scale))
      .cut(rod_shape(0.025 * scale, 0.2 * scale))
      .tree();
}

/// The tree within a transform of its own.
inline CsgTree transformed(CsgTree tree, const Affine3& transform) {
  tree.set_transform(tree.root(), transform * tree.node(tree.root()).parent_from_node);
  return tree;
}

inline Affine3 random_turn(Random& random) { return turned(random.uniform(0.0, 6.28), random.direction()); }

/// Rotation, a place within `spread`, and in half of the cases a stretch (uniform or not) and a mirror.
inline Affine3 random_placing(Random& random, double spread) {
  Affine3 transform = moved(random.uniform(-spread, spread), random.uniform(-spread, spread),
                            random.uniform(-spread, spread)) *
                      random_turn(random);
  switch (random.index(6)) {
    case 0:
      transform = transform * stretched(1.4, 1.4, 1.4);
      break;
    case 1:
      transform = transform * stretched(random.uniform(0.5, 2.0), random.uniform(0.5, 2.0), 1.0);
      break;
    case 2:
      transform = transform * stretched(-1.0, 1.0, random.uniform(0.6, 1.6));
      break;
    default:
      break;
  }
  return transform;
}

inline geometry::CsgShape random_shape(Random& random, double size) {
  const double a = size * random.uniform(0.4, 1.0), b = size * random.uniform(0.4, 1.0);
  switch (random.index(7)) {
    case 0:
    case 1:
      return box_shape(2.0 * a, 2.0 * b, 2.0 * size * random.uniform(0.4, 1.0));
    case 2:
      return ball_shape(a);
    case 3:
      return rod_shape(0.7 * a, 2.0 * b);
    case 4:
      return cone_shape(a, random.index(2) == 0 ? 0.0 : 0.4 * a, 1.5 * b);
    case 5:
      return ring_shape(0.8 * size, 0.8 * size * random.uniform(0.2, 0.6));
    default:
      return geometry::Primitive(geometry::Capsule{0.5 * a, 1.2 * b});
  }
}

/// A tree of `primitives` random primitives of some 0.1 m altogether, balanced by chance, with transforms at
/// inner nodes too.
inline CsgTree random_tree(std::uint64_t seed, std::size_t primitives) {
  Random random(seed);
  const double size = 0.045 / std::cbrt(std::sqrt(double(primitives)));
  CsgTree tree;
  std::vector<CsgTree::Index> roots;
  for (std::size_t i = 0; i < primitives; ++i) {
    const geometry::CsgShape shape = random_shape(random, size);
    roots.push_back(tree.add_leaf(shape, random_placing(random, i == 0 ? 0.0 : 0.05 - 0.5 * size)));
  }
  while (roots.size() > 1) {
    const std::size_t at = random.index(roots.size() - 1);
    const std::uint64_t dice = random.index(20);
    const CsgOperator op = dice < 11   ? CsgOperator::Union
                           : dice < 18 ? CsgOperator::Difference
                                       : CsgOperator::Intersection;
    Affine3 place = Affine3::Identity();
    if (random.index(4) == 0) place = moved(random.uniform(-0.005, 0.005), 0.0, 0.0) * random_turn(random);
    roots[at] = tree.add(op, roots[at], roots[at + 1], place);
    roots.erase(roots.begin() + std::ptrdiff_t(at) + 1);
  }
  return tree;
}

namespace nasty {

inline NamedTree abutting() {
  return {"Abutting", TreeChain(box_shape(0.05, 0.06, 0.04), moved(-0.025, 0, 0))
                          .unite(box_shape(0.05, 0.06, 0.04), moved(0.025, 0, 0))
                          .tree()};
}
inline NamedTree flush_union() {
  return {"FlushUnion", TreeChain(box_shape(0.06, 0.06, 0.04), moved(-0.02, 0, 0))
                            .unite(box_shape(0.06, 0.03, 0.04), moved(0.02, 0.015, 0))
                            .unite(rod_shape(0.02, 0.04), moved(0, -0.03, 0))
                            .tree()};
}
inline NamedTree flush_pocket() {
  return {"FlushPocket", TreeChain(box_shape(0.1, 0.08, 0.04))
                             .cut(box_shape(0.04, 0.04, 0.02), moved(0, 0, 0.01))
                             .cut(rod_shape(0.01, 0.04), moved(0.035, 0.02, 0))
                             .tree()};
}
inline NamedTree flush_cut() {
  return {
      "FlushCut",
      TreeChain(box_shape(0.1, 0.08, 0.04)).cut(box_shape(0.05, 0.08, 0.02), moved(0.025, 0, 0.01)).tree()};
}
inline NamedTree flush_intersection() {
  return {"FlushIntersection", TreeChain(box_shape(0.1, 0.06, 0.04))
                                   .keep(box_shape(0.06, 0.1, 0.04))
                                   .keep(rod_shape(0.035, 0.04))
                                   .tree()};
}
inline NamedTree plugged() {
  return {
      "Plugged",
      TreeChain(box_shape(0.1, 0.08, 0.04)).cut(rod_shape(0.02, 0.06)).unite(rod_shape(0.02, 0.04)).tree()};
}
inline NamedTree pipe() {
  return {"Pipe", TreeChain(rod_shape(0.04, 0.08))
                      .cut(rod_shape(0.03, 0.08))
                      .unite(rod_shape(0.03, 0.01))
                      .unite(rod_shape(0.04, 0.02), moved(0, 0, -0.04))
                      .tree()};
}
inline NamedTree tangent_balls() {
  return {"TangentBalls", TreeChain(ball_shape(0.025), moved(-0.025, 0, 0))
                              .unite(ball_shape(0.025), moved(0.025, 0, 0))
                              .unite(rod_shape(0.01, 0.1), moved(0, 0.035, 0))
                              .tree()};
}
inline NamedTree tangent_hole() {
  return {"TangentHole", TreeChain(box_shape(0.08, 0.08, 0.04))
                             .cut(rod_shape(0.02, 0.06), moved(0.02, 0, 0))
                             .cut(ball_shape(0.02), moved(-0.02, 0, 0))
                             .tree()};
}
inline NamedTree twice() {
  return {"Twice", TreeChain(box_shape(0.06, 0.06, 0.06))
                       .unite(box_shape(0.06, 0.06, 0.06))
                       .keep(ball_shape(0.04))
                       .keep(ball_shape(0.04))
                       .cut(rod_shape(0.01, 0.1))
                       .cut(rod_shape(0.01, 0.1))
                       .tree()};
}
inline NamedTree thin_walls() {
  return {"ThinWalls", TreeChain(box_shape(0.08, 0.08, 0.06))
                           .cut(box_shape(0.0796, 0.0796, 0.06), moved(0, 0, 0.0002))
                           .unite(box_shape(0.0002, 0.08, 0.06))
                           .unite(rod_shape(0.0201, 0.04), moved(0.02, 0.01, 0))
                           .cut(rod_shape(0.0199, 0.06), moved(0.02, 0.01, 0))
                           .tree()};
}
inline NamedTree slots() {
  return {"Slots", TreeChain(box_shape(0.1, 0.06, 0.04))
                       .cut(box_shape(0.0002, 0.08, 0.03), moved(-0.02, 0, 0.01))
                       .cut(box_shape(0.0005, 0.08, 0.03), moved(0.01, 0, 0.01))
                       .cut(box_shape(0.08, 0.001, 0.02), moved(0, 0.01, 0.01))
                       .tree()};
}
inline NamedTree socket() {
  return {"Socket", TreeChain(box_shape(0.08, 0.08, 0.08), moved(0, 0, -0.02))
                        .cut(ball_shape(0.03))
                        .unite(ball_shape(0.0295))
                        .unite(rod_shape(0.008, 0.06), moved(0, 0, 0.03))
                        .tree()};
}
inline NamedTree crossed_rods() {
  return {"CrossedRods", TreeChain(rod_shape(0.03, 0.1))
                             .keep(rod_shape(0.03, 0.1), turned(1.5707963267948966, Vector3::UnitX()))
                             .tree()};
}
inline NamedTree crossed_holes() {
  return {"CrossedHoles", TreeChain(box_shape(0.08, 0.08, 0.08))
                              .cut(rod_shape(0.02, 0.1))
                              .cut(rod_shape(0.02, 0.1), turned(1.5707963267948966, Vector3::UnitX()))
                              .cut(rod_shape(0.02, 0.1), turned(1.5707963267948966, Vector3::UnitY()))
                              .tree()};
}
inline NamedTree crossed_rods_united() {
  return {"CrossedRodsUnited", TreeChain(rod_shape(0.02, 0.1))
                                   .unite(rod_shape(0.02, 0.1), turned(1.5707963267948966, Vector3::UnitX()))
                                   .unite(rod_shape(0.015, 0.1), turned(0.7, Vector3(1, 1, 0)))
                                   .tree()};
}
inline NamedTree countersink() {
  return {"Countersink", TreeChain(box_shape(0.08, 0.08, 0.03))
                             .cut(rod_shape(0.01, 0.04))
                             .cut(cone_shape(0.01, 0.02, 0.01), moved(0, 0, 0.0105))
                             .cut(cone_shape(0.0, 0.02, 0.02), moved(0.028, 0.028, 0.0055))
                             .tree()};
}
inline NamedTree spikes() {
  return {"Spikes", TreeChain(box_shape(0.08, 0.08, 0.02))
                        .unite(cone_shape(0.02, 0.0, 0.04), moved(0.015, 0, 0.03))
                        .unite(cone_shape(0.02, 0.0, 0.04), moved(-0.015, 0, 0.03))
                        .cut(cone_shape(0.012, 0.0, 0.018), moved(0, 0.02, -0.001))
                        .tree()};
}
inline NamedTree rings() {
  return {"Rings", TreeChain(ring_shape(0.035, 0.012))
                       .unite(ring_shape(0.035, 0.012), turned(1.5707963267948966, Vector3::UnitX()))
                       .cut(box_shape(0.1, 0.02, 0.1), moved(0, 0.04, 0))
                       .tree()};
}
inline NamedTree grooved() {
  return {"Grooved", TreeChain(rod_shape(0.04, 0.04))
                         .cut(ring_shape(0.04, 0.008))
                         .cut(ring_shape(0.025, 0.006), moved(0, 0, 0.02))
                         .tree()};
}
inline NamedTree stretched_shapes() {
  return {"Stretched", TreeChain(ball_shape(0.02), stretched(2.0, 1.0, 0.7))
                           .unite(rod_shape(0.01, 0.04), moved(0, 0.01, 0) * stretched(1.0, 2.5, 1.5))
                           .cut(cone_shape(0.01, 0.004, 0.05), moved(0.015, 0, 0) * stretched(1.5, 0.6, -1.0))
                           .unite(ring_shape(0.015, 0.005), moved(-0.03, 0, 0.005) * stretched(1.0, 1.6, 2.0))
                           .tree()};
}
inline NamedTree sheared() {
  Affine3 shear = Affine3::Identity();
  shear.matrix()(0, 2) = 0.7;
  shear.matrix()(1, 0) = -0.3;
  return {"Sheared", TreeChain(box_shape(0.05, 0.05, 0.05), shear)
                         .cut(rod_shape(0.015, 0.1), shear)
                         .unite(ball_shape(0.015), moved(0.03, 0, 0.03) * shear)
                         .tree()};
}
inline NamedTree plate_of_holes() {
  TreeChain chain(box_shape(0.1, 0.1, 0.01));
  for (int i = 0; i < 25; ++i) {
    chain.cut(rod_shape(0.008, 0.02), moved(0.0185 * (i % 5 - 2), 0.0185 * (i / 5 - 2), 0));
  }
  return {"PlateOfHoles", chain.tree()};
}
inline NamedTree deep_chain() {
  TreeChain chain(box_shape(0.1, 0.03, 0.03));
  Random random(77);
  for (int i = 0; i < 120; ++i) {
    const Affine3 place =
        moved(random.uniform(-0.05, 0.05), random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02));
    chain.add(i % 2 ? CsgOperator::Union : CsgOperator::Difference, ball_shape(random.uniform(0.003, 0.012)),
              place);
  }
  return {"DeepChain", chain.tree()};
}
inline NamedTree stairs() {
  TreeChain chain(box_shape(0.02, 0.06, 0.01), moved(-0.04, 0, 0.005));
  for (int i = 1; i < 5; ++i) {
    chain.unite(box_shape(0.02, 0.06, 0.01 * (i + 1)), moved(0.02 * i - 0.04, 0, 0.005 * (i + 1)));
  }
  return {"Stairs", chain.tree()};
}
inline NamedTree half_spaces() {
  const geometry::CsgShape plane = geometry::Primitive(geometry::Plane{});
  return {"HalfSpaces", TreeChain(ball_shape(0.05))
                            .keep(plane, moved(0, 0, 0.02))
                            .cut(plane, moved(0, 0, -0.03) * turned(0.3, Vector3::UnitX()))
                            .keep(plane, turned(1.2, Vector3::UnitY()) * moved(0, 0, 0.03))
                            .tree()};
}
inline NamedTree mesh_operand() {
  geometry::TriangleMesh mesh;  // an octahedron
  mesh.positions = {{0.04, 0, 0}, {-0.04, 0, 0}, {0, 0.05, 0}, {0, -0.05, 0}, {0, 0, 0.03}, {0, 0, -0.03}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  const auto solid = std::make_shared<const geometry::MeshSolid>(std::move(mesh));
  return {
      "MeshOperand",
      TreeChain(solid).cut(rod_shape(0.012, 0.1)).unite(ball_shape(0.012), moved(0.035, 0.01, 0.0)).tree()};
}

}  // namespace nasty

inline std::vector<NamedTree> nasty_trees() {
  return {nasty::abutting(),
          nasty::flush_union(),
          nasty::flush_pocket(),
          nasty::flush_cut(),
          nasty::flush_intersection(),
          nasty::plugged(),
          nasty::pipe(),
          nasty::tangent_balls(),
          nasty::tangent_hole(),
          nasty::twice(),
          nasty::thin_walls(),
          nasty::slots(),
          nasty::socket(),
          nasty::crossed_rods(),
          nasty::crossed_holes(),
          nasty::crossed_rods_united(),
          nasty::countersink(),
          nasty::spikes(),
          nasty::rings(),
          nasty::grooved(),
          nasty::stretched_shapes(),
          nasty::sheared(),
          nasty::plate_of_holes(),
          nasty::deep_chain(),
          nasty::stairs(),
          nasty::half_spaces(),
          nasty::mesh_operand()};
}

/// The tree in a pose that no coordinate plane agrees with: then coincident faces differ by rounding.
inline NamedTree askew(NamedTree it) {
  it.tree = transformed(std::move(it.tree), moved(0.01, -0.02, 0.013) * turned(0.9, Vector3(3, -1, 2)));
  it.name += "Askew";
  return it;
}

}  // namespace icome::haptics
