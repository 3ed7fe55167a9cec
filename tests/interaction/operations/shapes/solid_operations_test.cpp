// Combine, separate and move-operand, as scripts say them.
#include <numbers>

#include "interaction/operations/shapes/combine_solids.h"
#include "interaction/scripted_design.h"

namespace icome::interaction {
namespace {

using geometry::CsgTree;
using world::Axis;
using world::GeometryPointer;

GeometryPointer upright(const geometry::Primitive& primitive) {
  return std::make_shared<world::PrimitiveGeometry>(primitive, Axis::Y);
}

GeometryPointer mesh_of(const geometry::Primitive& primitive) {
  return std::make_shared<world::MeshGeometry>(geometry::tessellate(primitive, 1e-3));
}

class SolidOperations : public ScriptedDesign {
 protected:
  void add(const std::string& name, const GeometryPointer& shape,
           const base::Affine3& place = base::Affine3::Identity()) {
    world::add_object(made_, ids_, name, shape, {}, place);
  }
  void begin_with_them() { begin(made_); }

  const CsgTree& tree(std::string_view name) const {
    return dynamic_cast<const world::CsgGeometry&>(shape(name)).tree;
  }
  bool holds(std::string_view name, const Vector3& point) const {
    return geometry::inside(tree(name), place(name).inverse() * point);
  }
  /// m^3, of the part of a cube around the origin with this edge that the solid fills, by a grid of points.
  double volume(std::string_view name, double edge) const {
    constexpr int kSteps = 60;
    const base::Affine3 object_from_world = place(name).inverse();
    int inside = 0;
    for (int i = 0; i < kSteps * kSteps * kSteps; ++i) {
      const Vector3 cell(i % kSteps, i / kSteps % kSteps, i / kSteps / kSteps);
      const Vector3 point = edge * ((cell + Vector3::Constant(0.5)) / kSteps - Vector3::Constant(0.5));
      if (geometry::inside(tree(name), object_from_world * point)) ++inside;
    }
    return edge * edge * edge * inside / (kSteps * kSteps * kSteps);
  }

  world::World made_;
  world::IdSource ids_;
};

struct HowMuch {
  const char* how;
  double volume;  // m^3
  friend std::ostream& operator<<(std::ostream& out, const HowMuch& it) { return out << it.how; }
};

class Combine : public SolidOperations, public testing::WithParamInterface<HowMuch> {};

// A cube of 1 m and an upright cylinder through it, 0.3 m in radius and 2 m high.
constexpr double kThrough = 0.09 * std::numbers::pi;
INSTANTIATE_TEST_SUITE_P(All, Combine,
                         testing::Values(HowMuch{"union", 1 + kThrough}, HowMuch{"intersection", kThrough},
                                         HowMuch{"difference", 1 - kThrough}));

TEST_P(Combine, EnclosesWhatItShould) {
  add("cube", world::box(1.0));
  add("bar", upright(geometry::Cylinder{0.3, 2.0}));
  begin_with_them();
  run(std::string(R"({"op": "combine", "objects": ["cube", "bar"], "how": ")") + GetParam().how + R"("})");
  EXPECT_EQ(design().objects().size(), 1U);
  EXPECT_EQ(design().geometries().size(), 1U);
  EXPECT_NEAR(volume("cube", 2.0), GetParam().volume, 0.01);
}

TEST_P(Combine, EnclosesTheSameOfMeshesAndOfSolidsTurnedAndScaled) {
  const base::Affine3 place = Eigen::Translation3d(0.1, 0.2, 0.3) *
                              Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()) * Eigen::Scaling(0.5);
  add("cube", mesh_of(geometry::Box{Vector3::Constant(1.0)}), place);
  add("bar", mesh_of(geometry::Cylinder{0.6, 4.0}), place);
  add("far", world::box(0.1), world::at(50, 0, 0));
  begin_with_them();
  run(R"({"op": "combine", "objects": ["bar", "far"], "how": "union"})");
  run(std::string(R"({"op": "combine", "objects": ["cube", "bar"], "how": ")") + GetParam().how + R"("})");
  const double far = std::string(GetParam().how) == "union" ? 1e-3 : 0.0;
  EXPECT_EQ(holds("cube", {50, 0, 0}), far > 0.0);
  EXPECT_NEAR(volume("cube", 3.0), GetParam().volume, 0.03);
}

TEST_F(SolidOperations, TheFirstKeepsItsNamePlaceAndMaterial) {
  box("wall", {0, 0, 0});
  box("window", {0.5, 0, 0});
  run(R"({"op": "material", "objects": "wall", "name": "stone"})");
  run(R"({"op": "material", "objects": "window", "name": "glass"})");
  run(R"({"op": "place", "object": "wall", "at": [0.2, 0, 0]})");
  const world::ObjectId wall = id("wall");
  run(R"({"op": "combine", "objects": ["wall", "window"], "how": "difference"})");
  EXPECT_EQ(id("wall"), wall);
  EXPECT_EQ(at("wall"), Vector3(0.2, 0, 0));
  EXPECT_EQ(material("wall").name, "stone");
  EXPECT_TRUE(holds("wall", {-0.2, 0, 0}));
  EXPECT_FALSE(holds("wall", {0.1, 0, 0}));
}

TEST_F(SolidOperations, WhatIsSharedStaysWithOthers) {
  box("a", {0, 0, 0});
  run(R"({"op": "clone", "object": "a", "name": "b", "by": [0.5, 0, 0]})");
  run(R"({"op": "clone", "object": "a", "name": "c", "by": [5, 0, 0]})");
  run(R"({"op": "combine", "objects": ["a", "b"], "how": "union"})");
  EXPECT_EQ(shape("c").kind(), "primitive");
  EXPECT_EQ(design().geometries().size(), 2U);
  run(R"({"op": "clone", "object": "c", "name": "d"})");
  run(R"({"op": "combine", "objects": ["c", "d"], "how": "union"})");
  EXPECT_EQ(design().geometries().size(), 2U);
}

/// Taken apart again, all stand where they stood, to rounding, and have the shapes that they had.
TEST_F(SolidOperations, SeparateIsTheInverseOfCombine) {
  base::Random random(21);
  const auto somewhere = [&] {
    return base::Affine3(Eigen::Translation3d(random.direction()) *
                         Eigen::AngleAxisd(random.uniform(0, 3), random.direction()) *
                         Eigen::Scaling(random.uniform(0.5, 2.0)));
  };
  const std::vector<GeometryPointer> shapes = {world::box(1.0),
                                               upright(geometry::Cylinder{0.3, 2.0}),
                                               upright(geometry::Cone{0.3, 0.1, 1.0}),
                                               upright(geometry::Sphere{0.4}),
                                               upright(geometry::Torus{0.4, 0.1}),
                                               upright(geometry::Capsule{0.2, 0.5}),
                                               mesh_of(geometry::Sphere{0.4})};
  std::vector<base::Affine3> places;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    places.push_back(somewhere());
    add("o" + std::to_string(i), shapes[i], places.back());
  }
  begin_with_them();
  run(R"({"op": "combine", "objects": ["o0", "o1", "o2"], "how": "union"})");
  run(R"({"op": "combine", "objects": ["o5", "o6"], "how": "intersection"})");
  run(R"({"op": "combine", "objects": ["o0", "o3", "o4", "o5"], "how": "difference"})");
  const auto parts = run(R"({"op": "separate", "object": "o0"})").objects;
  EXPECT_FALSE(find("o0").geometry);
  EXPECT_EQ(find("o0").children, parts);
  ASSERT_EQ(parts.size(), shapes.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const world::PhysicalObject& part = *design().find(parts[i]);
    EXPECT_EQ(design().find(part.geometry)->shape->hash(), shapes[i]->hash()) << part.name;
    const base::Affine3 there = world::world_from_object(design(), parts[i]);
    EXPECT_LT((there.matrix() - places[i].matrix()).cwiseAbs().maxCoeff(), 1e-12) << part.name;
  }
  EXPECT_EQ(design().find(parts[6])->name, "mesh");
  EXPECT_EQ(design().find(parts[1])->name, "cylinder");
}

TEST_F(SolidOperations, ColoursOfOperandsBecomeMaterials) {
  CsgTree tree;
  const CsgTree::Colour red{1, 0, 0, 1};
  const auto left = tree.add_leaf(geometry::Sphere{1.0}, base::Affine3::Identity(), red);
  const auto right = tree.add_leaf(geometry::Sphere{1.0}, world::at(3, 0, 0), red);
  const auto both = tree.add(geometry::CsgOperator::Union, left, right);
  tree.add(geometry::CsgOperator::Union, both, tree.add_leaf(geometry::Sphere{0.5}));
  add("balls", std::make_shared<world::CsgGeometry>(std::move(tree)));
  begin_with_them();
  const auto parts = run(R"({"op": "separate", "object": "balls"})").objects;
  EXPECT_EQ(design().materials().size(), 1U);
  EXPECT_EQ(material("sphere").diffuse, (world::Colour{1, 0, 0}));
  EXPECT_EQ(find("sphere").material, find("sphere 2").material);
  EXPECT_FALSE(find("sphere 3").material);
}

TEST_F(SolidOperations, OperandsMoveWithinALiveSolid) {
  box("plate", {10, 0, 0});
  box("hole", {10, 0, 0});
  run(R"({"op": "scale", "objects": "hole", "scale": [0.2, 2, 0.2]})");
  run(R"({"op": "turn", "objects": "plate", "turn": [0, 90, 0]})");
  run(R"({"op": "combine", "objects": ["plate", "hole"], "how": "difference"})");
  run(R"({"op": "clone", "object": "plate", "name": "other", "by": [0, 0, 5]})");
  EXPECT_FALSE(holds("plate", {10, 0, 0}));
  run(R"({"op": "move-operand", "object": "plate", "operand": "r", "by": [0.3, 0, 0]})");
  EXPECT_TRUE(holds("plate", {10, 0, 0}));
  EXPECT_FALSE(holds("plate", {10.3, 0, 0}));
  EXPECT_FALSE(holds("other", {10.3, 0, 5}));  // shares the solid
  // A quarter about its own middle lays it down; about another place it also moves.
  run(R"({"op": "move-operand", "object": "plate", "operand": "1", "turn": [90, 0, 0]})");
  EXPECT_FALSE(holds("plate", {10.3, 0, 0.45}));
  EXPECT_TRUE(holds("plate", {10.3, 0.45, 0}));
  run(R"({"op": "move-operand", "object": "plate", "operand": "1", "turn": [0, 0, 180], "centre": [10, 0, 0]})");
  EXPECT_FALSE(holds("plate", {9.7, 0, 0}));
  EXPECT_TRUE(holds("plate", {10.3, 0, 0}));
}

TEST_F(SolidOperations, OperatorsOfALiveSolidChange) {
  box("plate", {0, 0, 0});
  box("other", {0.5, 0, 0});
  box("third", {5, 0, 0});
  run(R"({"op": "combine", "objects": ["plate", "other"], "how": "difference"})");
  EXPECT_FALSE(holds("plate", {0.3, 0, 0}));
  run(R"({"op": "change-operator", "object": "plate", "how": "intersection"})");
  EXPECT_TRUE(holds("plate", {0.3, 0, 0}));
  EXPECT_FALSE(holds("plate", {-0.3, 0, 0}));
  run(R"({"op": "change-operator", "object": "plate", "how": "difference"})");
  EXPECT_TRUE(holds("plate", {-0.3, 0, 0}));
  run(R"({"op": "combine", "objects": ["plate", "third"], "how": "union"})");
  run(R"({"op": "change-operator", "object": "plate", "how": "union", "part": "l"})");
  for (const double x : {-0.3, 0.3, 0.8, 5.0}) EXPECT_TRUE(holds("plate", {x, 0, 0})) << x;
  run(R"({"op": "change-operator", "object": "plate", "how": "difference"})");
  EXPECT_FALSE(holds("plate", {5, 0, 0}));
  expect_refused(
      {{R"({"op": "change-operator", "object": "plate", "how": "union", "part": "r"})", "single shape"},
       {R"({"op": "change-operator", "object": "plate", "how": "glue"})", "one of union"},
       {R"({"op": "change-operator", "object": "plate", "how": "union", "part": "lll"})", "ends in"}});
}

TEST_F(SolidOperations, OperandsAreFoundByTheirWayAndByNumber) {
  CsgTree tree;
  const auto a = tree.add_leaf(geometry::Sphere{1.0});
  const auto b = tree.add_leaf(geometry::Sphere{2.0});
  const auto c = tree.add_leaf(geometry::Sphere{3.0});
  const auto bc = tree.add(geometry::CsgOperator::Union, b, c);
  tree.add(geometry::CsgOperator::Union, bc, a);
  EXPECT_EQ(operand_named(tree, "r").value(), a);
  EXPECT_EQ(operand_named(tree, "l").value(), bc);
  EXPECT_EQ(operand_named(tree, "lr").value(), c);
  EXPECT_EQ(operand_named(tree, "0").value(), b);
  EXPECT_EQ(operand_named(tree, "2").value(), a);
  for (const char* name : {"", "3", "-1", "rl", "lx", "1e9", "99999999999999999999", "0 "})
    EXPECT_FALSE(operand_named(tree, name)) << name;
}

TEST_F(SolidOperations, MeshesThatOnlyLackWeldingAreTaken) {
  geometry::TriangleMesh loose;  // as STL files have it: every triangle for itself, and inside-out
  const geometry::TriangleMesh cube = geometry::tessellate(geometry::Box{Vector3::Constant(0.5)}, 1.0);
  for (std::size_t i = 0; i < cube.triangles.size(); ++i) {
    const auto first = std::uint32_t(loose.positions.size());
    for (int corner = 0; corner < 3; ++corner) loose.positions.push_back(cube.corner(i, corner));
    loose.triangles.push_back({first, first + 2, first + 1});
  }
  add("loose", std::make_shared<world::MeshGeometry>(loose));
  add("ball", world::box(0.5));
  begin_with_them();
  run(R"({"op": "combine", "objects": ["loose", "ball"], "how": "difference"})");
  EXPECT_NEAR(volume("loose", 1.0), 1 - 0.125, 0.01);
}

TEST_F(SolidOperations, RefuseWhatMakesNoSense) {
  add("sheet", world::one_triangle());
  add("formula",
      *world::ImplicitGeometry::create("x^2+y^2+z^2-1", {Vector3::Constant(-2), Vector3::Constant(2)}));
  add("nothing", std::make_shared<world::CsgGeometry>(CsgTree()));
  add("group", nullptr);
  add("a", world::box(1.0));
  add("b", world::box(1.0));
  world::add_object(made_, ids_, "child", world::box(1.0), named_object(made_, "b").value());
  begin_with_them();
  expect_refused({{R"({"op": "combine", "objects": ["a", "sheet"], "how": "union"})", "'sheet' is open"},
                  {R"({"op": "combine", "objects": ["a", "formula"], "how": "union"})", "implicit"},
                  {R"({"op": "combine", "objects": ["a", "nothing"], "how": "union"})", "empty solid"},
                  {R"({"op": "combine", "objects": ["a", "group"], "how": "union"})", "no shape of its own"},
                  {R"({"op": "combine", "objects": ["a", "b"], "how": "union"})", "'b' has objects below it"},
                  {R"({"op": "combine", "objects": ["a", "a"], "how": "union"})", "two or more"},
                  {R"({"op": "combine", "objects": "a", "how": "union"})", "two or more"},
                  {R"({"op": "combine", "objects": ["a", "child"]})", "'how' is missing"},
                  {R"({"op": "combine", "objects": ["a", "child"], "how": "glue"})", "one of union"},
                  {R"({"op": "separate", "object": "a"})", "no solid"},
                  {R"({"op": "separate", "object": "nothing"})", "no solid"},
                  {R"({"op": "move-operand", "object": "group", "operand": "l"})", "no solid"}});
  run(R"({"op": "combine", "objects": ["a", "child"], "how": "union"})");
  expect_refused({{R"({"op": "move-operand", "object": "a", "operand": "2"})", "0 to 1"},
                  {R"({"op": "move-operand", "object": "a", "operand": "lll"})", "ends in a shape"},
                  {R"({"op": "move-operand", "object": "a", "operand": 1})", "must be a text"}});
}

TEST_F(SolidOperations, ASolidHasAnEndToItsParts) {
  // Combined with its own copies it doubles each time.
  CsgTree many;
  CsgTree::Index left = many.add_leaf(geometry::Primitive(geometry::Sphere{0.1}));
  for (int i = 0; i < 250'000; ++i) {
    const CsgTree::Index right = many.add_leaf(geometry::Primitive(geometry::Sphere{0.1}));
    left = many.add(geometry::CsgOperator::Union, left, right);
  }
  add("a", std::make_shared<world::CsgGeometry>(std::move(many)));
  begin_with_them();
  run(R"({"op": "clone", "object": "a", "name": "b"})");
  expect_refused({{R"({"op": "combine", "objects": ["a", "b"], "how": "union"})",
                   "would have more than 1000000 parts"}});
}

}  // namespace
}  // namespace icome::interaction
