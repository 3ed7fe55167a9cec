#pragma once
// CSG trees that the tests of pictures share.
#include <cmath>

#include "geometry/csg/csg_tree.h"

namespace icome::render {

inline base::Affine3 moved_by(double x, double y, double z) {
  base::Affine3 placing = base::Affine3::Identity();
  placing.translation() = base::Vector3(x, y, z);
  return placing;
}

/// The tree of figure 5.6, (cube n sphere) - cylinder, in a cube of twice that half side.
inline geometry::CsgTree figure_5_6(double half = 0.05) {
  using namespace geometry;
  CsgTree tree;
  const auto cube = tree.add_leaf(Primitive(Box{{half, half, half}}));
  const auto ball = tree.add_leaf(Primitive(Sphere{1.32 * half}));
  const auto rounded = tree.add(CsgOperator::Intersection, cube, ball);
  const auto hole = tree.add_leaf(Primitive(Cylinder{0.56 * half, 2.2 * half}));
  tree.add(CsgOperator::Difference, rounded, hole);
  return tree;
}

/// A ball with that many deep dents, all of which overlap: costly to draw from images.
inline geometry::CsgTree dented_ball(int dents) {
  using namespace geometry;
  CsgTree tree;
  auto solid = tree.add_leaf(Primitive(Sphere{0.1}));
  for (int i = 0; i < dents; ++i) {
    const double angle = 2.4 * i;
    const double z = 0.09 * (2.0 * (i + 0.5) / dents - 1.0);
    const double rho = std::sqrt(0.09 * 0.09 - z * z);
    const auto dent =
        tree.add_leaf(Primitive(Sphere{0.06}), moved_by(rho * std::cos(angle), rho * std::sin(angle), z));
    solid = tree.add(CsgOperator::Difference, solid, dent);
  }
  return tree;
}

}  // namespace icome::render
