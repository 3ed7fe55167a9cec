#include "interaction/shaping/placed_part.h"

#include <gtest/gtest.h>

#include <numbers>

#include "interaction/operations/looks/texture_projector.h"
#include "world/sample_world.h"

namespace icome::interaction {
namespace {

using base::Affine3;
using base::Vector3;
using geometry::CsgTree;
using world::ObjectId;

Affine3 turned_place() {
  return Eigen::Translation3d(0.3, -0.2, 1.0) * Eigen::AngleAxisd(0.8, Vector3(1, 2, 3).normalized()) *
         Eigen::Scaling(2.0);
}

/// A plate with a hole beside its middle, in a group that is turned and scaled.
struct Plate {
  world::World world;
  world::IdSource ids;
  ObjectId group = world::add_object(world, ids, "group", nullptr, {}, turned_place());
  ObjectId plate = world::add_object(world, ids, "plate", solid(), group, world::at(0.1, 0.0, 0.0));
  PlacedPart hole{plate, 1};

  static world::GeometryPointer solid() {
    CsgTree tree;
    const auto block = tree.add_leaf(geometry::Box{{0.5, 0.3, 0.05}});
    const auto hole = tree.add_leaf(geometry::Cylinder{0.1, 0.2}, world::at(0.2, 0.0, 0.0));
    tree.add(geometry::CsgOperator::Difference, block, hole);
    return std::make_shared<world::CsgGeometry>(std::move(tree));
  }
  bool encloses(const Vector3& point) const {
    const auto& shape = *world.find(world.find(plate)->geometry)->shape;
    return geometry::inside(dynamic_cast<const world::CsgGeometry&>(shape).tree,
                            world_from_object(world, plate).inverse() * point);
  }
  Vector3 in_world(const Vector3& in_plate) const { return world_from_object(world, plate) * in_plate; }
};

TEST(PlacedPart, OfASolidAreItsShapesAndOfAPictureItsProjector) {
  Plate it;
  EXPECT_EQ(placed_parts(it.world, std::vector{it.group}, 10),
            (std::vector<PlacedPart>{{it.plate, 0}, {it.plate, 1}}));
  EXPECT_EQ(placed_parts(it.world, std::vector{it.group}, 1).size(), 1U);
  EXPECT_EQ(name_of(it.world, it.hole), "operand 1 of plate");
  const auto place = world_from_part(it.world, it.hole);
  ASSERT_TRUE(place);
  EXPECT_LT((place->translation() - it.in_world({0.2, 0.0, 0.0})).norm(), 1e-12);

  const auto mesh = world::one_triangle();
  const ObjectId sheet = world::add_object(it.world, it.ids, "sheet", mesh);
  EXPECT_TRUE(placed_parts(it.world, std::vector{sheet}, 10).empty()) << "nobody knows where from";
  const auto thrown = with_projector(dynamic_cast<const world::MeshGeometry&>(*mesh), {});
  ASSERT_TRUE(thrown);
  world::applied(it.world, world::ReplaceGeometry{it.world.find(sheet)->geometry, *thrown});
  EXPECT_EQ(placed_parts(it.world, std::vector{sheet}, 10), (std::vector<PlacedPart>{{sheet, std::nullopt}}));
  EXPECT_EQ(name_of(it.world, {sheet, std::nullopt}), "projector of sheet");

  for (const PlacedPart& gone : {PlacedPart{it.plate, 2}, PlacedPart{it.plate, 7}, PlacedPart{it.plate, {}},
                                 PlacedPart{ObjectId{99}, 0}, PlacedPart{sheet, 0}}) {
    EXPECT_FALSE(world_from_part(it.world, gone));
    EXPECT_FALSE(PartDrag::take(it.world, gone));
  }
}

TEST(PlacedPart, OfAMeshIsLookedForInShortRecipesOnly) {
  const auto triangle = world::one_triangle();
  const auto thrown = with_projector(dynamic_cast<const world::MeshGeometry&>(*triangle),
                                     {.mesh_from_projector = turned_place()});
  ASSERT_TRUE(thrown);
  world::MeshGeometry mesh((*thrown)->mesh);
  mesh.recipe = (*thrown)->recipe;
  EXPECT_TRUE(projector_in(mesh));
  mesh.recipe.insert(1, 1'000'000, ' ');  // JSON that says the same
  EXPECT_FALSE(projector_in(mesh)) << "so much would have to be read at each step of a drag";
}

TEST(PartDrag, CarriesAHoleWithTheHandAndEveryStepCountsFromTheBeginning) {
  Plate it;
  const std::uint64_t before = hash(it.world);
  const auto drag = PartDrag::take(it.world, it.hole);
  ASSERT_TRUE(drag);
  EXPECT_EQ(drag->name(), "Move operand 1 of plate");
  EXPECT_LT((drag->centre() - it.in_world({0.2, 0.0, 0.0})).norm(), 1e-12);
  EXPECT_FALSE(it.encloses(it.in_world({0.2, 0.0, 0.0})));
  const Vector3 way = it.in_world({-0.2, 0.0, 0.0}) - it.in_world({0.2, 0.0, 0.0});
  std::optional<world::Edit> inverse;
  for (const double share : {0.3, 0.7, 1.0}) {
    const auto edit = drag->by(Affine3(Eigen::Translation3d(share * way)));
    ASSERT_TRUE(edit);
    const world::Edit back = world::applied(it.world, *edit);
    if (!inverse) inverse = back;
  }
  EXPECT_TRUE(it.encloses(it.in_world({0.2, 0.0, 0.0})));
  EXPECT_FALSE(it.encloses(it.in_world({-0.2, 0.0, 0.0})));
  EXPECT_LT((world_from_part(it.world, it.hole)->translation() - it.in_world({-0.2, 0.0, 0.0})).norm(),
            1e-12);
  world::applied(it.world, *inverse);
  EXPECT_EQ(hash(it.world), before);
}

TEST(PartDrag, TurnsAProjectorAndThePictureWithIt) {
  world::World world;
  world::IdSource ids;
  geometry::TriangleMesh square;
  square.positions = {{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  const auto thrown = with_projector(world::MeshGeometry(square), {});
  ASSERT_TRUE(thrown);
  const ObjectId sheet = world::add_object(world, ids, "sheet", *thrown, {}, turned_place());
  const PlacedPart part{sheet, std::nullopt};
  const auto drag = PartDrag::take(world, part);
  ASSERT_TRUE(drag);
  EXPECT_TRUE(drag->is_live());
  // A quarter turn about the sheet's own normal, through its middle.
  Affine3 motion = Affine3::Identity();
  motion.translate(drag->centre());
  motion.rotate(
      Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3(turned_place().rotation() * Vector3::UnitZ())));
  motion.translate(-drag->centre());
  const auto edit = drag->by(motion);
  ASSERT_TRUE(edit) << edit.error().message;
  world::applied(world, *edit);
  const auto& now = dynamic_cast<const world::MeshGeometry&>(*world.find(world.find(sheet)->geometry)->shape);
  // What was at the picture's lower left is at its lower right seen from the turned picture.
  const std::vector<base::Vector2> wanted = {{0, 1}, {0, 0}, {1, 0}, {1, 1}};
  for (std::size_t t = 0; t < 2; ++t)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_LT((now.texture_coordinates[t][i] - wanted[now.mesh.triangles[t][i]]).norm(), 1e-9) << t << i;
  EXPECT_TRUE(projector_of_part(world, part)) << "it can be dragged again";
  EXPECT_FALSE(drag->by(Affine3(Eigen::Scaling(0.0)))) << "there is nowhere to go";
}

}  // namespace
}  // namespace icome::interaction
