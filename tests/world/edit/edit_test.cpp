#include "world/edit/edit.h"

#include <limits>

#include "world/sample_world.h"

namespace icome::world {
namespace {

/// What a refused edit must do: nothing, and say why.
void expect_refused(World& world, const Edit& edit, const std::string& why) {
  const std::uint64_t before = hash(world);
  const auto result = apply(world, edit);
  ASSERT_FALSE(result.has_value()) << why;
  EXPECT_NE(result.error().message.find(why), std::string::npos) << result.error().message;
  EXPECT_EQ(hash(world), before);
}

void expect_taken_back(World& world, const Edit& edit) {
  const std::uint64_t before = hash(world);
  const Edit inverse = applied(world, edit);
  const std::uint64_t after = hash(world);
  EXPECT_NE(after, before);
  const Edit again = applied(world, inverse);
  EXPECT_EQ(hash(world), before);
  applied(world, again);
  EXPECT_EQ(hash(world), after);
}

struct House {
  World world;
  IdSource ids;
  ObjectId house = add_object(world, ids, "house", box(10.0));
  ObjectId roof = add_object(world, ids, "roof", one_triangle(), house, at(0.0, 0.0, 5.0));
  ObjectId chimney = add_object(world, ids, "chimney", box(1.0), roof, at(1.0, 0.0, 2.0));
  ObjectId tree = add_object(world, ids, "tree", nullptr);
};

TEST(Edits, AreTakenBack) {
  House it;
  const GeometryId shape = it.world.find(it.roof)->geometry;
  const MaterialId paint = it.ids.next<MaterialId>();
  const TextureId tiles = it.ids.next<TextureId>();
  const SceneId street = it.ids.next<SceneId>();
  expect_taken_back(it.world, PlaceObject{it.roof, at(1.0, 2.0, 3.0)});
  expect_taken_back(it.world, RenameObject{it.roof, "top"});
  expect_taken_back(it.world, MoveObject{it.chimney, it.house, 0, at(0.0, 0.0, 1.0)});
  expect_taken_back(it.world, MoveObject{it.chimney, {}, 1, at(4.0, 0.0, 1.0)});
  expect_taken_back(it.world, ReplaceGeometry{shape, box(3.0)});
  expect_taken_back(it.world, ChooseGeometry{it.tree, shape});
  expect_taken_back(it.world,
                    CreateTexture{tiles, {"tiles.png", "image/png", std::make_shared<std::string>("x")}});
  expect_taken_back(it.world, CreateMaterial{paint, {.name = "paint", .texture = tiles}});
  expect_taken_back(it.world, ChooseMaterial{it.house, paint});
  expect_taken_back(it.world, ChangeMaterial{paint, {.name = "red paint", .diffuse = {1.0F, 0.0F, 0.0F}}});
  expect_taken_back(it.world, CreateScene{street, "street"});
  expect_taken_back(it.world, EnterScene{street, it.house, 0});
  expect_taken_back(it.world, RenameScene{street, "road"});
  expect_taken_back(it.world, delete_subtree(it.world, it.house));
}

TEST(Edits, MoveVerticesOfMeshesAndControlMeshes) {
  House it;
  const GeometryId roof = it.world.find(it.roof)->geometry;
  expect_taken_back(it.world, MoveVertices{roof, {2, 0}, {{0.0, 2.0, 0.0}, {0.0, 0.0, 1.0}}});
  geometry::ControlMesh control;
  control.mesh = dynamic_cast<const MeshGeometry&>(*one_triangle()).mesh;
  applied(it.world, ReplaceGeometry{roof, std::make_shared<LoopGeometry>(control)});
  expect_taken_back(it.world, MoveVertices{roof, {1}, {{3.0, 2.0, 0.0}}});
}

/// That of a shape in the world.
std::string recipe(const World& world, GeometryId id) {
  return std::string(recipe_of(*world.find(id)->shape));
}

TEST(Edits, ThatMoveVerticesTakeTheRecipeAndUndoBringsItBack) {
  World world;
  IdSource ids;
  const GeometryId id = world.find(add_object(world, ids, "sign", made_mesh("{\"a\":1}")))->geometry;
  const GeometryId copy = ids.next<GeometryId>();
  applied(world, CopyGeometry{copy, id});
  expect_taken_back(world, MoveVertices{id, {1}, {{3.0, 2.0, 0.0}}});
  EXPECT_EQ(recipe(world, id), "");
  EXPECT_EQ(recipe(world, copy), "{\"a\":1}");
  // Even where the vertex was put to where it is: a person took hold of it.
  expect_taken_back(world, MoveVertices{copy, {0}, {{0.0, 0.0, 0.0}}});
  expect_taken_back(world, MoveVertices{id, {1}, {{4.0, 2.0, 0.0}}});
}

TEST(Edits, OfAGroupThatIsRefusedLeaveTheRecipe) {
  for (const bool alone : {false, true}) {
    World world;
    applied(world, CreateGeometry{{7}, made_mesh("{}")});
    const std::uint64_t before = hash(world);
    const EditGroup group{{MoveVertices{{7}, {1}, {{2.0, 0.0, 0.0}}},
                           MoveVertices{{7}, {2}, {{2.0, 0.0, 1.0}}}, DeleteGeometry{{99}}}};
    EXPECT_FALSE(alone ? replay(world, group).has_value() : apply(world, group).has_value());
    EXPECT_EQ(hash(world), before);
    EXPECT_EQ(recipe(world, {7}), "{}");
    ASSERT_TRUE(replay(world, group.edits[0]));
    EXPECT_EQ(recipe(world, {7}), "");
  }
}

TEST(MeshGeometry, CountsItsRecipeInItsHashAndItsBytes) {
  const GeometryPointer by_hand = one_triangle(), made = made_mesh("{}"), other = made_mesh("{ }");
  EXPECT_EQ(made_mesh("")->hash(), by_hand->hash());
  EXPECT_NE(made->hash(), by_hand->hash());
  EXPECT_NE(made->hash(), other->hash());
  EXPECT_EQ(made->hash(), made_mesh("{}")->hash());
  EXPECT_EQ(made_mesh(std::string(1000, ' '))->bytes(), by_hand->bytes() + 1000);
  EXPECT_EQ(recipe_of(*box(1.0)), "");
}

TEST(Edits, CopyShapesThatGoTheirOwnWay) {
  House it;
  const GeometryId roof = it.world.find(it.roof)->geometry, copy = it.ids.next<GeometryId>();
  expect_taken_back(it.world, CopyGeometry{copy, roof});
  EXPECT_EQ(it.world.find(copy)->shape, it.world.find(roof)->shape);
  const std::uint64_t before = it.world.find(roof)->shape->hash();
  ASSERT_TRUE(replay(it.world, MoveVertices{copy, {0}, {{5.0, 0.0, 0.0}}}));
  EXPECT_EQ(it.world.find(roof)->shape->hash(), before);
  EXPECT_NE(it.world.find(copy)->shape->hash(), before);
  expect_refused(it.world, CopyGeometry{copy, roof}, "already");
  expect_refused(it.world, CopyGeometry{it.ids.next<GeometryId>(), GeometryId{77}}, "shape to copy");
}

TEST(Edits, AreRefusedWithAReason) {
  House it;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const GeometryId roof = it.world.find(it.roof)->geometry;
  const GeometryId walls = it.world.find(it.house)->geometry;
  expect_refused(it.world, DeleteObject{it.house}, "\"house\" has objects below it");
  expect_refused(it.world, DeleteObject{ObjectId{77}}, "not there any more");
  expect_refused(it.world, MoveObject{it.house, it.chimney, 0}, "under itself");
  expect_refused(it.world, MoveObject{it.house, it.house, 0}, "under itself");
  expect_refused(it.world, MoveObject{it.roof, it.tree, 1}, "not so many objects");
  expect_refused(it.world, MoveObject{it.roof, it.house, 1}, "not so many objects");  // it leaves first
  expect_refused(it.world, PlaceObject{it.roof, at(nan, 0.0, 0.0)}, "finite");
  expect_refused(it.world, PlaceObject{it.roof, Affine3(Eigen::Scaling(1.0, 0.0, 1.0))}, "flatten");
  expect_refused(it.world, DeleteGeometry{roof}, "1 objects use this shape");
  expect_refused(it.world, ChooseGeometry{it.roof, GeometryId{77}}, "shape is not there");
  expect_refused(it.world, CreateObject{it.roof, 0, {}}, "already");
  expect_refused(it.world, CreateObject{ObjectId{}, 0, {}}, "needs an id");
  constexpr std::uint64_t kAuthor = std::uint64_t{5} << IdSource::kNumberBits;
  expect_refused(it.world, CreateObject{ObjectId{kAuthor}, 0, {}}, "numbers run from 1");
  expect_refused(it.world, CreateScene{SceneId{kAuthor | IdSource::kNumberMask}, ""}, "numbers run from 1");
  expect_refused(it.world, ReserveIds{1U << 24U, 1}, "no such numbers");
  expect_refused(it.world, ReserveIds{1, IdSource::kNumberMask}, "no such numbers");
  expect_refused(it.world, MoveVertices{roof, {3}, {{0.0, 0.0, 0.0}}}, "no vertex 3");
  expect_refused(it.world, MoveVertices{roof, {1, 1}, {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}}, "moved twice");
  expect_refused(it.world, MoveVertices{roof, {1}, {}}, "one position");
  expect_refused(it.world, MoveVertices{roof, {1}, {{0.0, nan, 0.0}}}, "finite");
  expect_refused(it.world, MoveVertices{walls, {0}, {{0.0, 0.0, 0.0}}}, "no vertices to move");
  const auto light = std::make_shared<const Fixture>(Light{.radius = nan});
  expect_refused(it.world, ChangeFixture{it.roof, light}, "light must be finite");
  const auto view = std::make_shared<const Fixture>(Viewpoint{4.0});
  expect_refused(it.world, CreateObject{it.ids.next<ObjectId>(), 0, {.fixture = view}}, "180 degrees");
  TouchProperties slippery;
  slippery.dynamic_friction = 0.5;
  expect_refused(it.world, CreateMaterial{it.ids.next<MaterialId>(), {.touch = slippery}}, "Static friction");
  expect_refused(it.world, CreateMaterial{it.ids.next<MaterialId>(), {.diffuse = {0.0F, float(nan), 0.0F}}},
                 "must be finite");
}

TEST(Edits, OfAGroupAreAllAppliedOrNone) {
  House it;
  const EditGroup group{{RenameObject{it.roof, "top"}, PlaceObject{it.tree, at(1.0, 0.0, 0.0)},
                         EditGroup{{RenameObject{it.tree, "oak"}, DeleteObject{it.house}}}}};
  expect_refused(it.world, group, "\"house\" has objects below it");
}

TEST(Edits, OfASceneKeepItsObjectsAlive) {
  House it;
  const SceneId scene = it.ids.next<SceneId>();
  applied(it.world, CreateScene{scene, "garden"});
  applied(it.world, EnterScene{scene, it.tree, 0});
  expect_refused(it.world, EnterScene{scene, it.tree, 0}, "already");
  expect_refused(it.world, DeleteObject{it.tree}, "in the scene \"garden\"");
  expect_refused(it.world, DeleteScene{scene}, "holds objects");
  applied(it.world, delete_subtree(it.world, it.tree));
  EXPECT_TRUE(it.world.find(scene)->roots.empty());
}

TEST(Edits, NeverMakeAnIdAnew) {
  House it;
  applied(it.world, delete_subtree(it.world, it.tree));
  IdSource later(0, it.world.next_number(0));
  EXPECT_EQ(it.world.find(later.next<ObjectId>()), nullptr);
  EXPECT_GT(it.world.next_number(0), it.tree.value);
}

TEST(Edits, ReserveIdsForGood) {
  World world;
  const Edit back = applied(world, ReserveIds{3, 70});
  EXPECT_EQ(world.next_number(3), 71u);
  applied(world, ReserveIds{3, 20});
  applied(world, back);
  EXPECT_EQ(world.next_number(3), 71u);
  EXPECT_EQ(world.next_number(4), 1u);
}

TEST(Edits, OfAnAuthorWithoutNumbersAreRefused) {
  World world;
  applied(world, ReserveIds{3, IdSource::kLastNumber - 1});
  IdSource ids(3, world.next_number(3));
  add_object(world, ids, "last", nullptr);
  for (int i = 0; i < 3; ++i)
    expect_refused(world, CreateObject{ids.next<ObjectId>(), 0, {}}, "numbers run from 1");
}

TEST(Edits, KeepManySiblingsInOrder) {
  World world;
  IdSource ids;
  base::Random random(4);
  const ObjectId parent = add_object(world, ids, "parent", nullptr);
  std::vector<ObjectId> row;
  const auto at_place = [&](std::size_t place) { return row.begin() + std::ptrdiff_t(place); };
  for (int i = 0; i < 5000; ++i) {
    const std::size_t place = random.index(row.size() + 1);
    if (row.size() < 50 || random.index(3) > 0) {
      const ObjectId id = ids.next<ObjectId>();
      applied(world, CreateObject{id, place, {.parent = parent}});
      row.insert(at_place(place), id);
      continue;
    }
    const std::size_t old = random.index(row.size());
    const ObjectId id = row[old];
    row.erase(at_place(old));
    if (place < row.size()) row.insert(at_place(place), id);
    applied(world, place < row.size() ? Edit(MoveObject{id, parent, place}) : Edit(DeleteObject{id}));
  }
  EXPECT_EQ(world.find(parent)->children, row);
}

/// A mesh of one triangle that is the world's alone, as what a factory made is.
GeometryId add_triangle(World& world, IdSource& ids) {
  const GeometryId id = ids.next<GeometryId>();
  applied(world, CreateGeometry{id, one_triangle()});
  return id;
}

TEST(Replay, ChangesShapesInPlaceThatAreTheWorldsAlone) {
  World world;
  IdSource ids;
  const GeometryId id = add_triangle(world, ids);
  const Geometry* shape = world.find(id)->shape.get();
  const MoveVertices move{id, {1}, {{2.0, 0.0, 0.0}}};
  ASSERT_TRUE(replay(world, move));
  EXPECT_EQ(world.find(id)->shape.get(), shape);
  const World copy = world;
  const std::uint64_t before = hash(copy);
  ASSERT_TRUE(replay(world, MoveVertices{id, {1}, {{3.0, 0.0, 0.0}}}));
  EXPECT_EQ(hash(copy), before);
  EXPECT_NE(hash(world), before);
  EXPECT_FALSE(replay(world, MoveVertices{id, {3}, {{3.0, 0.0, 0.0}}}));
}

TEST(Replay, TakesARefusedGroupBack) {
  World world;
  IdSource ids;
  const GeometryId id = add_triangle(world, ids);
  const std::uint64_t before = hash(world);
  EXPECT_FALSE(replay(world, EditGroup{{MoveVertices{id, {1}, {{2.0, 0.0, 0.0}}}, DeleteGeometry{{99}}}}));
  EXPECT_EQ(hash(world), before);
}

TEST(DeleteSubtree, LetsGoOfShapesThatNothingElseUses) {
  House it;
  const GeometryId shared = it.world.find(it.chimney)->geometry;
  applied(it.world, ChooseGeometry{it.tree, shared});
  applied(it.world, delete_subtree(it.world, it.house));
  EXPECT_EQ(it.world.objects().size(), 1u);
  EXPECT_EQ(it.world.geometries().size(), 1u);
  EXPECT_EQ(it.world.find(shared)->users, 1u);
}

}  // namespace
}  // namespace icome::world
