// Solids that are cut out as what they are, flat or thin: one thread does that.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "geometry/convex_volume.h"
#include "geometry/csg/meshing/csg_cut.h"
#include "geometry/csg_meshed.h"
#include "geometry/csg_trees.h"
#include "geometry/tree/triangle_tree.h"

namespace icome::geometry {
namespace {

using base::Random;

/// Boxes whose corners have whole coordinates below `size`, put together at random.
CsgTree random_boxes(Random& random, int leaves, int size) {
  CsgTree tree;
  CsgTree::Index root = 0;
  for (int i = 0; i < leaves; ++i) {
    Vector3 low, high;
    for (int k = 0; k < 3; ++k) {
      const auto a = int(random.index(std::size_t(size)));
      low[k] = a;
      high[k] = a + 1 + int(random.index(std::size_t(size - a)));
    }
    const Vector3 middle = 0.5 * (low + high);
    const auto leaf =
        tree.add_leaf(Primitive(Box{0.5 * (high - low)}), moved(middle.x(), middle.y(), middle.z()));
    const std::size_t choice = random.index(5);
    const CsgOperator op = choice < 2   ? CsgOperator::Union
                           : choice < 4 ? CsgOperator::Difference
                                        : CsgOperator::Intersection;
    root = i == 0 ? leaf : tree.add(op, root, leaf);
  }
  return tree;
}

/// Its volume in unit cubes, of which the reference asks the middles.
int unit_cubes(const CsgTree& tree, int size) {
  int cubes = 0;
  for (int x = 0; x < size; ++x) {
    for (int y = 0; y < size; ++y) {
      for (int z = 0; z < size; ++z) cubes += inside(tree, Vector3(x + 0.5, y + 0.5, z + 0.5));
    }
  }
  return cubes;
}

Affine3 tilted() {
  Affine3 placing = Affine3::Identity();
  placing.rotate(Eigen::AngleAxisd(1.1, Vector3(0.3, -0.5, 0.8).normalized()));
  return placing;
}

CsgTree placed(CsgTree tree, const Affine3& placing) {
  tree.set_transform(tree.root(), placing * tree.node(tree.root()).parent_from_node);
  return tree;
}

CsgTree with_hole(const Primitive& whole, const Primitive& hole, const Affine3& at = Affine3::Identity()) {
  CsgTree tree;
  const auto left = tree.add_leaf(whole);
  const auto right = tree.add_leaf(hole, at);
  tree.add(CsgOperator::Difference, left, right);
  return tree;
}

TEST(CsgMesh, BoxesAreExactAndOfFewTriangles) {
  Random random(17);
  constexpr int kSize = 6;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const CsgTree tree = random_boxes(random, 2 + int(random.index(7)), kSize);
    const int cubes = unit_cubes(tree, kSize);
    if (cubes == 0) continue;
    const CsgTree turned_tree = i % 2 == 0 ? tree : placed(tree, tilted());
    const ContourMesh made = csg_meshed(turned_tree, 0.06);
    EXPECT_NEAR(volume(made.mesh), cubes, 1e-6);
    EXPECT_LT(made.error, 1e-7);
    EXPECT_FALSE(made.lost);
    EXPECT_LT(made.mesh.triangles.size(), 600u);
    if (HasFailure()) return;
  }
}

TEST(CsgMesh, CubeLessACubeHasTensOfTriangles) {
  const CsgTree notched =
      with_hole(Box{Vector3::Constant(0.5)}, Box{Vector3::Constant(0.5)}, moved(0.6, 0.7, 0.8));
  for (const CsgTree& tree : {notched, placed(notched, tilted())}) {
    const ContourMesh made = csg_meshed(tree, 0.01);
    EXPECT_LE(made.mesh.triangles.size(), 40u);
    EXPECT_NEAR(volume(made.mesh), 1.0 - 0.4 * 0.3 * 0.2, 1e-9);
    EXPECT_EQ(euler_characteristic(made.mesh), 2);
  }
}

TEST(CsgMesh, SlitsStayOpenHoweverNarrow) {
  for (const double width : {0.002, 1e-5}) {
    const CsgTree slit =
        with_hole(Box{Vector3::Constant(0.5)}, Box{{0.5 * width, 0.6, 0.4}}, moved(0, 0, 0.2));
    for (const double cell : {0.036, 0.01}) {
      for (const CsgTree& tree : {slit, placed(slit, tilted())}) {
        const ContourMesh made = csg_meshed(tree, cell);
        EXPECT_NEAR(volume(made.mesh), 1.0 - width * 0.7, 1e-9);
        EXPECT_EQ(euler_characteristic(made.mesh), 2);
        EXPECT_FALSE(made.lost);
      }
    }
  }
  // Between a cylinder and its hole: two parts, of which the outer is a ring.
  CsgTree bearing = with_hole(Cylinder{0.3, 0.2}, Cylinder{0.2, 0.4});
  const auto ring = bearing.root();
  bearing.add(CsgOperator::Union, ring, bearing.add_leaf(Primitive(Cylinder{0.1995, 0.2})));
  const ContourMesh made = csg_meshed(bearing, 0.01);
  EXPECT_EQ(analyse_topology(made.mesh).report.components, 2u);
  EXPECT_EQ(euler_characteristic(made.mesh), 0 + 2);
  EXPECT_FALSE(made.lost);
}

TEST(CsgMesh, DrilledPlatesKeepThicknessAndHole) {
  for (const double thickness : {0.018, 0.005, 1e-4}) {
    const CsgTree plate = with_hole(Box{{0.5, 0.5, 0.5 * thickness}}, Cylinder{0.1, 0.3});
    for (const CsgTree& tree : {plate, placed(plate, tilted())}) {
      for (const double cell : {0.036, 0.01}) {
        SCOPED_TRACE(testing::Message() << thickness << " " << cell);
        const ContourMesh made = csg_meshed(tree, cell);
        EXPECT_NEAR(volume(made.mesh) / (thickness * (1.0 - std::numbers::pi * 0.01)), 1.0, 0.005);
        EXPECT_EQ(euler_characteristic(made.mesh), 0);
        EXPECT_FALSE(made.lost);
      }
    }
  }
}

TEST(CsgMesh, BallThatTouchesAPlateAndOneThatDipsIn) {
  for (const double dip : {0.0, 1e-3}) {
    CsgTree tree;
    const auto plate = tree.add_leaf(Primitive(Box{{0.5, 0.5, 0.05}}));
    const auto ball = tree.add_leaf(Primitive(Sphere{0.2}), moved(0.1, 0.07, 0.25 - dip));
    tree.add(CsgOperator::Union, plate, ball);
    const ContourMesh made = csg_meshed(tree, 0.01);
    EXPECT_NEAR(volume(made.mesh) / (0.1 + 4 * std::numbers::pi / 3 * 0.008), 1.0, 0.005);
    EXPECT_FALSE(made.lost);
    if (dip > 0.0) {
      EXPECT_EQ(euler_characteristic(made.mesh), 2);
    }
  }
}

/// A prism, frustum or pyramid over a regular polygon, z in [-height / 2, height / 2]; one radius may be 0.
TriangleMesh facetted(std::uint32_t sides, double bottom, double top, double height) {
  TriangleMesh mesh;
  for (const double end : {-0.5, 0.5}) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / sides, radius = end < 0.0 ? bottom : top;
      mesh.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), end * height);
    }
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t next = (i + 1) % sides;
    if (bottom > 0.0) mesh.triangles.push_back({i, next, sides + next});
    if (top > 0.0) mesh.triangles.push_back({i, sides + next, sides + i});
    if (i < 2) continue;
    if (bottom > 0.0) mesh.triangles.push_back({0, i, i - 1});
    if (top > 0.0) mesh.triangles.push_back({sides, sides + i - 1, sides + i});
  }
  for (TriangleMesh::Triangle& triangle : mesh.triangles) {  // all corners of an end without size are one
    for (std::uint32_t& corner : triangle) {
      if (corner < sides && bottom == 0.0) corner = 0;
      if (corner >= sides && top == 0.0) corner = sides;
    }
  }
  return mesh;
}

/// Beside a corner of 2 x 2, an L: not convex, but two boxes are.
TriangleMesh angle_bar(double length) {
  const std::vector<Vector2> outline{{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}};
  TriangleMesh mesh;
  for (const double z : {-0.5 * length, 0.5 * length}) {
    for (const Vector2& corner : outline) mesh.positions.emplace_back(corner.x(), corner.y(), z);
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t next = (i + 1) % 6;
    mesh.triangles.push_back({i, next, 6 + next});
    mesh.triangles.push_back({i, 6 + next, 6 + i});
  }
  for (const auto& [a, b, c] : {std::array<std::uint32_t, 3>{3, 0, 1}, {3, 1, 2}, {3, 4, 5}, {3, 5, 0}}) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({6 + a, 6 + b, 6 + c});
  }
  return mesh;
}

/// A tree of polyhedra, and what the judge knows of it.
struct PlanarSolid {
  CsgTree tree;
  std::vector<ConvexBody> bodies;
  std::vector<std::uint32_t> leaf_bodies;  // by node: bits of the bodies that make a leaf

  bool holds(CsgTree::Index index, std::uint32_t within) const {
    const CsgTree::Node& node = tree.node(index);
    if (node.is_leaf) return (leaf_bodies[index] & within) != 0;
    const bool left = holds(node.left, within), right = holds(node.right, within);
    return node.op == CsgOperator::Union          ? left || right
           : node.op == CsgOperator::Intersection ? left && right
                                                  : left && !right;
  }
  double exact_volume() const {
    return set_volume(bodies, [this](std::uint32_t within) { return holds(tree.root(), within); });
  }
};

/// Rotated freely, or by quarter turns and whole steps, so that faces are flush.
Affine3 random_placing(Random& random, bool on_grid) {
  Affine3 placing = Affine3::Identity();
  if (on_grid) {
    for (int k = 0; k < 3; ++k)
      placing.rotate(Eigen::AngleAxisd(0.5 * std::numbers::pi * double(random.index(4)), Vector3::Unit(k)));
    placing.pretranslate(0.5 *
                         Vector3(double(random.index(4)), double(random.index(4)), double(random.index(4))));
  } else {
    placing = random_affine(random, 0.8);
  }
  return placing;
}

PlanarSolid random_planar_solid(Random& random, int leaves, bool on_grid) {
  PlanarSolid solid;
  CsgTree::Index root = 0;
  for (int i = 0; i < leaves; ++i) {
    const Affine3 placing = random_placing(random, on_grid);
    const auto sides = std::uint32_t(3 + random.index(6));
    std::uint32_t made = 0;
    const auto add_body = [&](const TriangleMesh& mesh) {
      made |= 1U << solid.bodies.size();
      solid.bodies.push_back(convex_body(mesh, placing));
    };
    CsgTree::Index leaf = 0;
    switch (random.index(4)) {
      case 0:
        leaf = solid.tree.add_leaf(Primitive(Box{{1.0, 0.5, 0.5}}), placing);
        add_body(box_mesh({-1.0, -0.5, -0.5}, {1.0, 0.5, 0.5}));
        break;
      case 1:
        leaf = solid.tree.add_leaf(mesh_solid(angle_bar(1.5)), placing);
        add_body(box_mesh({-1, -1, -0.75}, {0, 1, 0.75}));
        add_body(box_mesh({-1, -1, -0.75}, {1, 0, 0.75}));
        break;
      default: {
        const TriangleMesh mesh = facetted(sides, 1.0, 0.5 * double(random.index(3)), 1.5);
        leaf = solid.tree.add_leaf(mesh_solid(mesh), placing);
        add_body(mesh);
      }
    }
    solid.leaf_bodies.resize(leaf + 1);
    solid.leaf_bodies[leaf] = made;
    const std::size_t choice = random.index(5);
    const CsgOperator op = choice < 2   ? CsgOperator::Union
                           : choice < 4 ? CsgOperator::Difference
                                        : CsgOperator::Intersection;
    root = i == 0 ? leaf : solid.tree.add(op, root, leaf);
  }
  return solid;
}

/// In how many directions the planes of the bodies that pass the place hold it: 3 at a corner, 2 on an edge,
/// 1 in a face.
int planes_through(const PlanarSolid& solid, const Vector3& place) {
  std::vector<Vector3> normals;
  for (const ConvexBody& body : solid.bodies) {
    for (const HalfSpace& face : body) {
      if (std::abs(face.normal.dot(place) - face.offset) < 1e-9) normals.push_back(face.normal);
    }
  }
  int most = normals.empty() ? 0 : 1;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vector3 along = normals[i].cross(normals[j]);
      if (along.norm() > 1e-6) most = std::max(most, 2);
      for (std::size_t k = 0; k < j; ++k) {
        if (std::abs(along.dot(normals[k])) > 1e-6) return 3;
      }
    }
  }
  return most;
}

class PlanarSolids : public testing::TestWithParam<int> {};

TEST_P(PlanarSolids, AreExactAndOfFewTriangles) {
  Random random(100 + std::uint64_t(GetParam()));
  constexpr double kCell = 0.03;
  int meshed = 0;
  for (int i = 0; i < int(16 / kLongShare) + 1; ++i) {
    SCOPED_TRACE(i);
    const PlanarSolid solid = random_planar_solid(random, 2 + int(random.index(3)), i % 2 == 0);
    const double exact = solid.exact_volume();
    if (exact < 1e-3) continue;
    ++meshed;
    const ContourMesh made = csg_meshed(solid.tree, kCell);
    EXPECT_NEAR(volume(made.mesh), exact, 1e-8);
    EXPECT_LT(made.error, 0.1 * kCell);  // an upper bound: beside knife edges it is measured past them
    EXPECT_FALSE(made.lost);
    EXPECT_LT(made.mesh.triangles.size(), 400u);
    std::size_t superfluous = 0;  // what taking away one vertex after the other does not get at
    for (const Vector3& position : made.mesh.positions) {
      const int planes = planes_through(solid, position);
      EXPECT_GE(planes, 1) << position.transpose();
      superfluous += planes < 3 ? 1 : 0;
    }
    EXPECT_LE(superfluous, 2 + made.mesh.positions.size() / 4);
    if (HasFailure()) return;
  }
  EXPECT_GT(meshed, 0);
}

INSTANTIATE_TEST_SUITE_P(Parts, PlanarSolids, testing::Range(0, 4));

TEST(CsgMesh, PolyhedraThemselvesAreOfTheirFaces) {
  struct Case {
    TriangleMesh mesh;
    double volume;
    std::size_t triangles;
  };
  const double hexagon = 1.5 * std::sqrt(3.0);
  for (const Case& it : {Case{facetted(6, 1.0, 1.0, 2.0), 2.0 * hexagon, 20},
                         Case{facetted(6, 1.0, 0.0, 2.0), 2.0 * hexagon / 3.0, 10},
                         Case{angle_bar(2.0), 6.0, 20}, Case{box_mesh({0, 0, 0}, {1, 2, 3}), 6.0, 12}}) {
    for (const bool turned : {false, true}) {
      CsgTree tree;
      tree.add_leaf(mesh_solid(it.mesh), turned ? tilted() : Affine3::Identity());
      const ContourMesh made = csg_meshed(tree, 0.02);
      EXPECT_EQ(made.mesh.triangles.size(), it.triangles);
      EXPECT_NEAR(volume(made.mesh), it.volume, 1e-9);
      EXPECT_EQ(euler_characteristic(made.mesh), 2);
    }
  }
}

TEST(CsgMesh, PlateWithHexagonalHolesHasItsGenus) {
  CsgTree tree;
  CsgTree::Index root = tree.add_leaf(Primitive(Box{{0.5, 0.5, 0.05}}));
  const auto prism = mesh_solid(facetted(6, 0.1, 0.1, 1.0));
  for (const double x : {-0.3, 0.0, 0.3})
    root = tree.add(CsgOperator::Difference, root, tree.add_leaf(prism, moved(x, 0.01 * x, 0.0)));
  for (const CsgTree& solid : {tree, placed(tree, tilted())}) {
    const ContourMesh made = csg_meshed(solid, 0.005);
    EXPECT_NEAR(volume(made.mesh), 0.1 * (1.0 - 3 * 1.5 * std::sqrt(3.0) * 0.01), 1e-9);
    EXPECT_EQ(euler_characteristic(made.mesh), 2 - 2 * 3);
    EXPECT_LE(made.mesh.triangles.size(), 110u);
  }
}

TEST(CsgMesh, BentFacesHaveTheTrianglesThatTheyNeed) {
  // A plate of 100 x 100 x 5 mm with a hole of 5 mm: what the hole's chords take, and some for the plate.
  const CsgTree plate = with_hole(Box{{0.05, 0.05, 0.0025}}, Cylinder{0.0025, 0.1});
  for (const CsgTree& tree : {plate, placed(plate, tilted())}) {
    std::size_t last = 0;
    for (const double cell : {5e-4, 5e-5}) {
      const ContourMesh made = csg_meshed(tree, cell);
      EXPECT_LE(made.error, 0.06 * cell);  // measured askew: an upper bound
      EXPECT_EQ(euler_characteristic(made.mesh), 0);
      EXPECT_NEAR(volume(made.mesh), 0.1 * 0.1 * 0.005 - std::numbers::pi * 0.0025 * 0.0025 * 0.005,
                  0.03 * cell * 2 * std::numbers::pi * 0.0025 * 0.005);
      EXPECT_LT(made.mesh.triangles.size(), 700u);
      EXPECT_GT(made.mesh.triangles.size(), last);
      last = made.mesh.triangles.size();
    }
  }
}

/// Polyhedra, cylinders, cones and balls.
CsgTree random_mixed_tree(Random& random, int leaves) {
  CsgTree tree;
  CsgTree::Index root = 0;
  const std::vector<CsgShape> shapes{
      Primitive(Box{{0.6, 0.5, 0.3}}), Primitive(Cylinder{0.4, 1.2}),          Primitive(Sphere{0.6}),
      Primitive(Cone{0.5, 0.0, 1.0}),  mesh_solid(facetted(5, 0.6, 0.3, 0.9)), mesh_solid(angle_bar(0.8))};
  for (int i = 0; i < leaves; ++i) {
    Affine3 placing = Affine3::Identity();
    placing.rotate(Eigen::AngleAxisd(random.uniform(0.0, 6.28), random.direction()));
    placing.pretranslate(0.6 * random.uniform() * random.direction());
    const auto leaf = tree.add_leaf(shapes[random.index(shapes.size())], placing);
    root = i == 0 ? leaf : tree.add(static_cast<CsgOperator>(random.index(3)), root, leaf);
  }
  return tree;
}

/// How far the place is from the nearest surface of an operand, m. Precondition: nothing is stretched.
double nearest_operand(const CsgTree& tree, const Vector3& place) {
  const std::vector<Affine3> tree_from_node = tree.tree_from_node();
  double nearest = std::numeric_limits<double>::infinity();
  for (CsgTree::Index i = 0; i < tree.size(); ++i) {
    if (!tree.node(i).is_leaf) continue;
    const CsgLeaf leaf(*tree.node(i).shape, tree_from_node[i]);
    const SurfacePoint there =
        leaf.inside(place) ? leaf.scp_from_inside(place) : leaf.scp_from_outside(place);
    nearest = std::min(nearest, (there.point - place).norm());
  }
  return nearest;
}

class MixedSolids : public testing::TestWithParam<int> {};

TEST_P(MixedSolids, KeepToTheirSurface) {
  Random random(200 + std::uint64_t(GetParam()));
  constexpr double kCell = 0.05, kOff = 0.03 * kCell;
  int meshed = 0;
  for (int i = 0; i < 40 && meshed < int(3 / kLongShare) + 1; ++i) {
    SCOPED_TRACE(i);
    const CsgTree tree = random_mixed_tree(random, 2 + int(random.index(4)));
    if (!has_flat_faces(CsgProgram(tree))) continue;
    const ContourMesh made = csg_meshed(tree, kCell);
    if (made.mesh.triangles.empty()) continue;
    ++meshed;
    EXPECT_FALSE(made.lost);
    EXPECT_LT(made.mesh.triangles.size(), 6000u);
    for (const Vector3& position : made.mesh.positions)
      EXPECT_LT(nearest_operand(tree, position), kOff) << position.transpose();
    const TriangleTree triangles(made.mesh);
    for (int k = 0; k < 2000; ++k) {
      const Vector3 point(random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2));
      if (triangles.encloses(point) != recursively_inside(tree, point)) {
        EXPECT_LT(nearest_operand(tree, point), 3 * kOff) << point.transpose();
      }
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(meshed, 0);
}

INSTANTIATE_TEST_SUITE_P(Parts, MixedSolids, testing::Range(0, 4));

TEST(CsgMesh, ConesKeepTheirTips) {
  CsgTree tree;
  tree.add_leaf(Primitive(Cone{0.5, 0.0, 1.0}));
  for (const CsgTree& cone : {tree, placed(tree, tilted())}) {
    const ContourMesh made = csg_meshed(cone, 0.02);
    const Vector3 tip = cone.node(cone.root()).parent_from_node * Vector3(0, 0, 0.5);
    double nearest = 1.0;
    for (const Vector3& position : made.mesh.positions) nearest = std::min(nearest, (position - tip).norm());
    EXPECT_LT(nearest, 1e-9);
    EXPECT_LT(made.error, 0.06 * 0.02);
    EXPECT_EQ(euler_characteristic(made.mesh), 2);
  }
}

}  // namespace
}  // namespace icome::geometry
