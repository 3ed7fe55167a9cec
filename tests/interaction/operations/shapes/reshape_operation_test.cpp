#include <gtest/gtest.h>

#include "interaction/operations/shapes/shape_operations.h"
#include "interaction/shape_samples.h"

namespace icome::interaction {
namespace {

TEST(ReshapeOperation, ChangesWhatIsSaidAndLeavesTheRest) {
  OperationRunner runner({});
  performed(runner, R"({"op": "create", "shape": "cone", "radius": 3, "height": 2, "name": "hat"})");
  performed(runner, R"({"op": "reshape", "object": "hat", "top_radius": 1})");
  const auto& hat = solid_of<geometry::Cone>(runner, "hat");
  EXPECT_EQ((Vector3{hat.bottom_radius, hat.top_radius, hat.height}), Vector3(3, 1, 2));
  performed(runner, R"({"op": "create", "shape": "implicit", "formula": "x", "name": "wall"})");
  performed(runner, R"({"op": "reshape", "object": "wall", "formula": "y"})");
  const auto& wall = dynamic_cast<const world::ImplicitGeometry&>(*shape_named(runner, "wall"));
  EXPECT_EQ(wall.formula(), "y");
  EXPECT_EQ(wall.surface()->box().max(), Vector3(1, 1, 1));
}

/// Whatever create makes can be made otherwise, and comes out as if it had been made so from the start.
TEST(ReshapeOperation, ComesToWhatCreatingWouldHaveMade) {
  struct Case {
    const char *shape, *before, *change, *after;
  };
  const std::vector<Case> cases = {
      {"box", R"("size": [1, 2, 3])", R"("size": [3, 2, 1])", R"("size": [3, 2, 1])"},
      {"cube", R"("side": 1)", R"("side": 2)", R"("side": 2)"},
      {"sphere", R"("radius": 1)", R"("radius": 2)", R"("radius": 2)"},
      {"cylinder", R"("radius": 1, "height": 1)", R"("height": 2)", R"("radius": 1, "height": 2)"},
      {"cone", R"("radius": 1, "height": 1)", R"("radius": 2)", R"("radius": 2, "height": 1)"},
      {"torus", R"("radius": 3, "tube": 1)", R"("tube": 2)", R"("radius": 3, "tube": 2)"},
      {"capsule", R"("radius": 3, "height": 1)", R"("height": 2)", R"("radius": 3, "height": 2)"},
      {"triangle", R"("side": 3)", R"("side": 2)", R"("side": 2)"},
      {"square", R"("side": 3)", R"("side": 2)", R"("side": 2)"},
      {"rectangle", R"("width": 3, "height": 2)", R"("width": 2)", R"("width": 2, "height": 2)"},
      {"circle", R"("radius": 3, "segments": 9)", R"("segments": 7)", R"("radius": 3, "segments": 7)"},
      {"polygon", R"("radius": 3, "sides": 5)", R"("radius": 1)", R"("radius": 1, "sides": 5)"},
      {"pyramid", R"("radius": 3, "height": 5)", R"("sides": 5)", R"("radius": 3, "height": 5, "sides": 5)"},
      {"text", R"("text": "a", "depth": 0)", R"("text": "b")", R"("text": "b", "depth": 0)"},
  };
  for (const Case& it : cases) {
    OperationRunner changed({}), made({});
    const std::string create =
        R"({"op": "create", "name": "it", "shape": ")" + std::string(it.shape) + "\", ";
    performed(changed, create + it.before + "}");
    performed(made, create + it.after + "}");
    const std::uint64_t before = hash(changed.world());
    EXPECT_NE(before, hash(made.world())) << it.shape;
    performed(changed, R"({"op": "reshape", "object": "it", )" + std::string(it.change) + "}");
    EXPECT_EQ(hash(changed.world()), hash(made.world())) << it.shape;
    performed(changed, R"({"op": "undo"})");
    EXPECT_EQ(hash(changed.world()), before) << it.shape;
  }
}

TEST(ReshapeOperation, KeepsTheAxisThatAShapeStandsAlong) {
  world::World world;
  world::IdSource ids;
  const auto shape = ids.next<world::GeometryId>();
  const auto lying = std::make_shared<world::PrimitiveGeometry>(geometry::Cylinder{1.0, 6.0}, world::Axis::Z);
  ASSERT_TRUE(apply(world, world::CreateGeometry{shape, lying}));
  ASSERT_TRUE(
      apply(world, world::CreateObject{ids.next<world::ObjectId>(), 0, {.name = "log", .geometry = shape}}));
  OperationRunner runner(world);
  performed(runner, R"({"op": "reshape", "object": "log", "height": 8})");
  EXPECT_NEAR(shape_named(runner, "log")->bounds().sizes().z(), 8.0, 1e-12);
}

TEST(ReshapeOperation, ChangesAllThatShareOrOneAlone) {
  OperationRunner runner({});
  performed(runner, R"({"op": "create", "shape": "sphere", "radius": 1, "name": "bead"})");
  performed(runner, R"({"op": "repeat", "object": "bead", "count": 2, "move": [3, 0, 0]})");
  const auto all = performed(runner, R"({"op": "reshape", "object": "bead 2", "radius": 2})");
  EXPECT_EQ(all.note, "3 objects use this shape");
  EXPECT_EQ(solid_of<geometry::Sphere>(runner, "bead").radius, 2.0);

  const auto alone =
      performed(runner, R"({"op": "reshape", "object": "bead 2", "radius": 5, "alone": true})");
  EXPECT_EQ(alone.note, "");
  EXPECT_EQ(solid_of<geometry::Sphere>(runner, "bead 2").radius, 5.0);
  EXPECT_EQ(solid_of<geometry::Sphere>(runner, "bead 3").radius, 2.0);
  EXPECT_EQ(runner.world().geometries().size(), 2U);
  // Alone already: nothing more is made.
  performed(runner, R"({"op": "reshape", "object": "bead 2", "radius": 6, "alone": true})");
  EXPECT_EQ(runner.world().geometries().size(), 2U);
}

TEST(ReshapeOperation, RefusesWhatHasNoSizes) {
  OperationRunner runner({});
  performed(runner, R"({"op": "create", "shape": "group", "name": "group"})");
  performed(runner, R"({"op": "create", "shape": "mesh", "name": "bent",
                        "points": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,2]]})");
  performed(runner, R"({"op": "create", "shape": "box", "name": "seat"})");
  performed(runner, R"({"op": "create", "shape": "torus", "name": "ring"})");
  performed(runner, R"({"op": "create", "shape": "plane", "name": "floor"})");
  EXPECT_EQ(refusal(runner, R"({"op": "reshape", "object": "bent", "side": 1})"),
            "reshape: its shape was made or bent by hand and has no sizes; move its vertices, or scale it");
  EXPECT_EQ(refusal(runner, R"({"op": "reshape", "object": "ring"})"),
            "reshape: say what is to change: radius, tube");
  for (const char* said :
       {R"("group", "radius": 1)", R"("floor")", R"("floor", "radius": 1)", R"("seat")",
        R"("seat", "size": [0, 1, 1])", R"("seat", "size": [1, 1, 1e300])", R"("seat", "radius": 1)",
        R"("seat", "side": 1, "size": [1, 1, 1])", R"("seat", "alone": true)", R"("ring", "tube": 1)",
        R"("ring", "tube": -1)", R"("nobody", "tube": 1)", R"("seat", "shape": "sphere")",
        R"("seat", "steps": [])", R"("ring", "points": [[0, 0]])"}) {
    const std::string command = std::string(R"({"op": "reshape", "object": )") + said + "}";
    EXPECT_EQ(refusal(runner, command).find("reshape: "), 0U) << said;
  }
}

/// A recipe out of somebody else's file is no more than text.
TEST(ReshapeOperation, DoesNotTrustRecipes) {
  for (const char* recipe :
       {"{", "[]", "{}", "3", R"({"op": 3})", R"({"op": "extrude"})", R"({"op": "extrude", "steps": [{}]})",
        R"({"op": "delete", "objects": "it"})", R"({"shape": "pyramid", "sides": 1e300})",
        R"({"shape": "mesh"})", R"({"shape": "pyramid", "sides": "many"})", R"({"shape": {}})"}) {
    world::World world;
    world::IdSource ids;
    const auto id = ids.next<world::GeometryId>();
    auto shape = std::make_shared<world::MeshGeometry>(geometry::TriangleMesh{});
    shape->recipe = recipe;
    ASSERT_TRUE(apply(world, world::CreateGeometry{id, shape}));
    ASSERT_TRUE(
        apply(world, world::CreateObject{ids.next<world::ObjectId>(), 0, {.name = "it", .geometry = id}}));
    OperationRunner runner(world);
    EXPECT_EQ(refusal(runner, R"({"op": "reshape", "object": "it", "height": 1})").find("reshape: "), 0U)
        << recipe;
    EXPECT_EQ(refusal(runner, R"({"op": "reshape", "object": "it"})").find("reshape: "), 0U) << recipe;
  }
}

}  // namespace
}  // namespace icome::interaction
