#include "geometry/csg/meshing/csg_cut.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/closed_mesh.h"
#include "geometry/csg/meshing/csg_mesh.h"
#include "geometry/csg_trees.h"
#include "geometry/mesh/mesh_sheets.h"
#include "geometry/mesh/mesh_topology.h"
#include "repeats.h"

namespace icome::geometry {
namespace {

using base::Random;

constexpr double kPi = std::numbers::pi;
constexpr double kExact = 1e-7;  // what volumes of flat faces are off, relatively

void expect_manifold(const TriangleMesh& mesh) {
  const MeshReport report = analyse_topology(mesh).report;
  EXPECT_EQ(report.boundary_edges + report.non_manifold_edges + report.inconsistent_edges, 0u);
  EXPECT_TRUE(is_closed(mesh));
}

Affine3 turned(Random& random) {
  Affine3 placing = Affine3::Identity();
  placing.rotate(Eigen::AngleAxisd(random.uniform(0.0, 3.0), random.direction()));
  placing.pretranslate(0.1 * random.direction());
  return placing;
}

/// The tree moved as a whole.
CsgTree placed_tree(CsgTree tree, const Affine3& placing) {
  tree.set_transform(tree.root(), placing * tree.node(tree.root()).parent_from_node);
  return tree;
}

CsgTree difference(const Primitive& whole, const Primitive& hole, const Affine3& at = Affine3::Identity()) {
  CsgTree tree;
  const auto left = tree.add_leaf(whole);
  const auto right = tree.add_leaf(hole, at);
  tree.add(CsgOperator::Difference, left, right);
  return tree;
}

CsgTree single(const Primitive& primitive) {
  CsgTree tree;
  tree.add_leaf(primitive);
  return tree;
}

struct ThinSolid {
  const char* name;
  CsgTree tree;
  double volume;       // m3
  double tolerance;    // of the volume: chords of bent faces lie within
  int characteristic;  // of Euler
};

std::vector<ThinSolid> thin_solids() {
  std::vector<ThinSolid> solids;
  solids.push_back({"plate", single(Box{{0.1, 0.1, 0.0001}}), 0.2 * 0.2 * 0.0002, kExact, 2});
  solids.push_back({"bar", single(Box{{0.1, 0.0001, 0.0001}}), 0.2 * 0.0002 * 0.0002, kExact, 2});
  solids.push_back({"wire", single(Box{{0.5, 1e-5, 2e-5}}), 1.0 * 2e-5 * 4e-5, kExact, 2});
  solids.push_back({"rod", single(Cylinder{5e-5, 0.02}), kPi * 25e-10 * 0.02, 0.04, 2});
  solids.push_back(
      {"tube", difference(Cylinder{4e-4, 0.02}, Cylinder{3e-4, 0.03}), kPi * (16e-8 - 9e-8) * 0.02, 0.04, 0});
  solids.push_back({"foil tube", difference(Cylinder{4e-4, 0.02}, Cylinder{3.99e-4, 0.03}),
                    kPi * (16e-8 - 3.99 * 3.99e-8) * 0.02, 0.08, 0});
  solids.push_back({"shell", difference(Sphere{0.05}, Sphere{0.0499}),
                    4 * kPi / 3 * (std::pow(0.05, 3) - std::pow(0.0499, 3)), 0.03, 4});
  solids.push_back({"box with thin walls", difference(Box{{0.1, 0.08, 0.05}}, Box{{0.0999, 0.0799, 0.0499}}),
                    8 * (0.1 * 0.08 * 0.05 - 0.0999 * 0.0799 * 0.0499), kExact, 4});
  return solids;
}

TEST(CsgCut, ThinSolidsKeepTheirVolumeAtAnyOrientation) {
  Random random(7);
  for (const ThinSolid& solid : thin_solids()) {
    for (int i = 0; i < repeats(3); ++i) {
      SCOPED_TRACE(testing::Message() << solid.name << " " << i);
      const CsgTree tree = i == 0 ? solid.tree : placed_tree(solid.tree, turned(random));
      const auto made = contour(tree, {.cell = bounds(tree).sizes().maxCoeff() / 60, .measures = false});
      ASSERT_TRUE(made.has_value()) << made.error().message;
      expect_manifold(made->mesh);
      EXPECT_NEAR(signed_volume(made->mesh) / solid.volume, 1.0, solid.tolerance);
      EXPECT_EQ(euler_characteristic(made->mesh), solid.characteristic);
      EXPECT_LT(made->mesh.triangles.size(), 400'000u);
      if (solid.tolerance > kExact) continue;
      Bounds box;
      for (const Vector3& position : made->mesh.positions) box.extend(position);
      EXPECT_LT((box.min() - bounds(tree).min()).norm() + (box.max() - bounds(tree).max()).norm(), 1e-9);
    }
  }
}

TEST(CsgCut, PlateHasItsThicknessEverywhere) {
  Random random(8);
  const Affine3 placing = turned(random);
  const auto made = contour(placed_tree(single(Box{{0.1, 0.1, 0.0001}}), placing), {.cell = 0.002});
  ASSERT_TRUE(made.has_value());
  EXPECT_LT(made->mesh.triangles.size(), 5000u);
  EXPECT_LT(made->error, 1e-9);
  const TriangleTree triangles(made->mesh);
  for (int i = 0; i < 200; ++i) {
    const Vector3 place(random.uniform(-0.099, 0.099), random.uniform(-0.099, 0.099), 0.0);
    const Vector3 above = placing * Vector3(place + 0.01 * Vector3::UnitZ());
    const Vector3 below = placing * Vector3(place - 0.01 * Vector3::UnitZ());
    const auto top = triangles.first_hit(above, below), bottom = triangles.first_hit(below, above);
    ASSERT_TRUE(top && bottom);
    EXPECT_NEAR((top->point - bottom->point).norm(), 0.0002, 1e-9);
  }
}

TEST(CsgCut, RandomTreesEncloseWhatTheTreeDoes) {
  Random random(11);
  std::size_t cut = 0;
  for (int i = 0; cut < std::max<std::size_t>(1, 6 / kLongShare); ++i) {
    ASSERT_LT(i, 100);  // so many hold nothing, or cannot be cut
    SCOPED_TRACE(i);
    RandomTreeOptions options;
    options.leaves = 2 + random.index(8);
    CsgTree tree = random_tree(random, options);
    const auto frame = tree.add_leaf(Primitive(Box{Vector3::Constant(1.0)}));  // limits half-spaces
    tree.add(CsgOperator::Intersection, frame - 1, frame);
    if (!csg_can_cut(CsgProgram(tree))) continue;
    const double cell = 0.1;
    const auto made = cut_csg(tree, cell, 1'000'000, [](double) { return true; });
    ASSERT_TRUE(made.has_value()) << made.error().message;
    expect_manifold(*made);
    if (made->triangles.empty()) continue;
    const TriangleTree triangles(*made);
    int wrong = 0, enclosed = 0;
    constexpr int kThrows = 2000;
    for (int k = 0; k < kThrows; ++k) {
      const Vector3 point(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      const bool expected = inside(tree, point);
      enclosed += expected;
      if (triangles.encloses(point) == expected) continue;
      // Chords: wrong only next to the surface.
      EXPECT_TRUE(triangles.nearest(point, 0.3 * cell)) << point.transpose();
      ++wrong;
    }
    EXPECT_LT(wrong, kThrows / 50);
    if (HasFailure()) return;
    cut += enclosed > 15;  // so that both answers were asked for
  }
}

TEST(CsgCut, FlushFacesLeaveNoSkin) {
  // A box put together from two, and one taken away by itself.
  CsgTree joined;
  const auto left = joined.add_leaf(Primitive(Box{Vector3::Constant(0.5)}), moved(-0.5, 0, 0));
  const auto right = joined.add_leaf(Primitive(Box{Vector3::Constant(0.5)}), moved(0.5, 0, 0));
  joined.add(CsgOperator::Union, left, right);
  Random random(3);
  const auto go_on = [](double) { return true; };
  const auto one = cut_csg(placed_tree(joined, turned(random)), 0.1, 100'000, go_on);
  ASSERT_TRUE(one.has_value());
  expect_manifold(*one);
  EXPECT_EQ(euler_characteristic(*one), 2);
  EXPECT_NEAR(signed_volume(*one), 2.0, 1e-9);

  for (const Primitive& primitive :
       {Primitive(Sphere{0.5}), Primitive(Torus{0.5, 0.2}), Primitive(Cylinder{0.3, 1.0})}) {
    const auto nothing = cut_csg(difference(primitive, primitive), 0.1, 100'000, go_on);
    ASSERT_TRUE(nothing.has_value());
    EXPECT_TRUE(nothing->triangles.empty());
  }
}

TEST(CsgCut, TooManyTrianglesAreRefused) {
  const auto made = contour(single(Torus{0.1, 5e-5}), {.cell = 1e-3, .max_triangles = 1000});
  ASSERT_FALSE(made.has_value());
  EXPECT_NE(made.error().message.find("more than"), std::string::npos);
}

/// Bars 200 x 0.2 x 0.2 mm in all directions, through one point.
CsgTree crossing_bars(int count) {
  Random random(5);
  CsgTree tree;
  CsgTree::Index root = tree.add_leaf(Box{{0.1, 1e-4, 1e-4}});
  for (int i = 1; i < count; ++i) {
    Affine3 placing = Affine3::Identity();
    placing.rotate(Eigen::AngleAxisd(random.uniform(0.0, 3.0), random.direction()));
    root = tree.add(CsgOperator::Union, root, tree.add_leaf(Box{{0.1, 1e-4, 1e-4}}, placing));
  }
  return tree;
}

TEST(CsgCut, BarsThatCrossAreOneSolid) {
  const CsgTree tree = crossing_bars(4);
  const auto made = contour(tree, {.cell = 0.005, .measures = false});
  ASSERT_TRUE(made.has_value()) << made.error().message;
  expect_manifold(made->mesh);
  EXPECT_EQ(euler_characteristic(made->mesh), 2);
  // Inclusion and exclusion: what they share lies within some thicknesses of the point.
  const double one = 0.2 * 2e-4 * 2e-4;
  EXPECT_LT(signed_volume(made->mesh), 4 * one);
  EXPECT_GT(signed_volume(made->mesh), 3.95 * one);
}

TEST(CsgCut, TooManyPiecesAreRefusedAndCellsDoThen) {
  const CsgTree tree = crossing_bars(20);
  const auto made = cut_csg(tree, 0.2, 20'000'000, [](double) { return true; });
  ASSERT_FALSE(made.has_value());
  EXPECT_NE(made.error().message.find("meet in one place"), std::string::npos) << made.error().message;
  EXPECT_TRUE(contour(tree, {.cell = 0.2, .measures = false}).has_value());
}

TEST(CsgCut, CanBeInterruptedWithinATetrahedron) {
  int repeated = 0;
  double last = 0.0;
  const auto progress = [&](double part) {
    repeated = part > 0.2 && part == last ? repeated + 1 : 0;  // the tetrahedra are made before
    last = part;
    return repeated < 3;
  };
  const auto made = contour(crossing_bars(20), {.cell = 0.2, .measures = false, .progress = progress});
  ASSERT_FALSE(made.has_value());
  EXPECT_NE(made.error().message.find("interrupted"), std::string::npos) << made.error().message;
}

TEST(CsgCut, CanBeInterruptedWhileFacesAreMerged) {
  // Cutting ends at 0.8; the first time that all vertices were tried is half of the rest.
  const auto go_on = [](double part) { return part < 0.85; };
  const auto made = cut_csg(crossing_bars(4), 0.005, 20'000'000, go_on);
  ASSERT_FALSE(made.has_value());
  EXPECT_NE(made.error().message.find("interrupted"), std::string::npos) << made.error().message;
}

TEST(MeshSheets, CubesThatShareAnEdgeAreTwo) {
  // Two tetrahedra that share the edge from vertex 0 to 1.
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {a, b, d}, {a, d, c}, {b, c, d}});
  };
  add(0, 2, 3, 1);
  add(0, 4, 5, 1);
  const TriangleMesh apart = separate_sheets(mesh);
  expect_manifold(apart);
  EXPECT_EQ(apart.positions.size(), 8u);
  EXPECT_EQ(euler_characteristic(apart), 4);
  EXPECT_NEAR(signed_volume(apart), 2.0 / 6.0, 1e-12);
}

}  // namespace
}  // namespace icome::geometry
