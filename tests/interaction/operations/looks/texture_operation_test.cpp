#include <fmt/format.h>

#include "interaction/mesh_samples.h"

namespace icome::interaction {
namespace {

using world::MeshGeometry;

/// The texture coordinates of a corner at that place; all triangles there must agree.
Vector2 coordinates_at(const MeshGeometry& shape, const Vector3& place) {
  for (std::size_t t = 0; t < shape.mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      if (shape.mesh.corner(t, int(i)) == place) return shape.texture_coordinates[t][i];
  throw std::runtime_error("there is no such vertex");
}

TEST(TextureOperation, LaysThePictureOverASquareOnTheFloorAsSeenFromAbove) {
  auto shape = std::make_shared<MeshGeometry>(square_mesh(0.3));
  shape->normals = flat_normals(shape->mesh);
  OperationRunner runner(world_of(shape));
  performed_both_ways(runner, R"({"op": "texture", "object": "thing"})");
  const MeshGeometry& now = mesh_of(runner);
  EXPECT_LT((coordinates_at(now, {0, 0, 0}) - Vector2(0, 0)).norm(), 1e-15);
  EXPECT_LT((coordinates_at(now, {0.3, 0, 0}) - Vector2(1, 0)).norm(), 1e-15);
  EXPECT_LT((coordinates_at(now, {0.3, 0, -0.3}) - Vector2(1, 1)).norm(), 1e-15);
  EXPECT_EQ(now.mesh.positions, shape->mesh.positions);
  EXPECT_EQ(now.normals, shape->normals);
}

TEST(TextureOperation, ThrowsItFromWhereItIsSaid) {
  OperationRunner runner(world_of(square_mesh()));
  // Twice as large a picture about the corner; turned a quarter about y, which takes +x to -z.
  performed_both_ways(
      runner,
      R"({"op": "texture", "object": "thing", "at": [0, 0, 0], "size": [2, 1, 2], "turn": [0, 90, 0]})");
  EXPECT_LT((coordinates_at(mesh_of(runner), {0, 0, 0}) - Vector2(0.5, 0.5)).norm(), 1e-15);
  EXPECT_LT((coordinates_at(mesh_of(runner), {0, 0, -1}) - Vector2(1, 0.5)).norm(), 1e-15);
  EXPECT_LT((coordinates_at(mesh_of(runner), {1, 0, 0}) - Vector2(0.5, 0)).norm(), 1e-15);
}

TEST(TextureOperation, StandsUprightRoundAnObject) {
  for (const char* projection : {"box", "cylindrical", "spherical"}) {
    OperationRunner runner(world_of(world::box(1.0)));
    const std::string command =
        fmt::format(R"({{"op": "texture", "object": "thing", "projection": "{}"}})", projection);
    EXPECT_NE(refusal(runner, command).find("perform 'mesh' first"), std::string::npos);
    performed_both_ways(runner, command.substr(0, command.size() - 1) + R"(, "as_mesh": true})");
    const MeshGeometry& shape = mesh_of(runner);
    for (std::size_t t = 0; t < shape.mesh.triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        // On the sides v rises with y.
        const Vector3& one = shape.mesh.corner(t, int(i));
        const Vector3& next = shape.mesh.corner(t, int((i + 1) % 3));
        if (next.y() <= one.y()) continue;
        EXPECT_GT(shape.texture_coordinates[t][(i + 1) % 3].y(), shape.texture_coordinates[t][i].y())
            << projection;
      }
    }
  }
}

TEST(TextureOperation, ShowsAPictureOfTheDesign) {
  world::World world = world_of(square_mesh());
  world::IdSource ids(0, world.next_number(0));
  const auto picture = ids.next<world::TextureId>();
  world::applied(world, world::CreateTexture{picture,
                                             {.name = "pictures/brick.png",
                                              .media_type = "image/png",
                                              .bytes = std::make_shared<const std::string>("brick")}});
  OperationRunner runner(world);
  performed_both_ways(runner, R"({"op": "texture", "object": "thing", "picture": "brick.png"})");
  const auto* object = runner.world().find(named_object(runner.world(), "thing").value());
  ASSERT_TRUE(runner.world().find(object->material));
  EXPECT_EQ(runner.world().find(object->material)->texture, picture);
  EXPECT_EQ(refusal(runner, R"({"op": "texture", "object": "thing", "picture": "brik.png"})"),
            "texture: the design has no picture named 'brik.png'; did you mean 'brick.png'?");
}

const world::Material& material_of(const OperationRunner& runner, std::string_view name) {
  const world::World& world = runner.world();
  return *world.find(world.find(named_object(world, name).value())->material);
}

TEST(TextureOperation, BringsAPictureOfAFileIntoTheDesignOnce) {
  OperationRunner runner(world_of(square_mesh()), sample_picture);
  performed(runner, R"({"op": "create", "shape": "box"})");
  performed_both_ways(runner, R"({"op": "texture", "object": "thing", "file": "wood.png"})");
  EXPECT_EQ(mesh_of(runner).texture_coordinates.size(), 2U);
  const world::Material& material = material_of(runner, "thing");
  ASSERT_TRUE(runner.world().find(material.texture));
  EXPECT_EQ(*runner.world().find(material.texture)->bytes, "wood");
  EXPECT_EQ(material.diffuse, (world::Colour{1.0F, 1.0F, 1.0F})) << "in its own colours";
  performed_both_ways(runner,
                      R"({"op": "texture", "object": "box", "file": "wood.png", "projection": "own"})");
  EXPECT_EQ(runner.world().textures().size(), 1U);
  EXPECT_EQ(material_of(runner, "box").texture, material.texture);
}

TEST(TextureOperation, LeavesShapesOnWhichAPictureHasItsPlaceAsTheyAre) {
  for (const char* shape : {"box", "sphere", "cylinder", "cone"}) {
    OperationRunner runner({}, sample_picture);
    performed(runner, fmt::format(R"({{"op": "create", "shape": "{}", "name": "thing"}})", shape));
    const std::uint64_t before = shape_of(runner).hash();
    performed_both_ways(runner,
                        R"({"op": "texture", "object": "thing", "file": "wood.png", "projection": "own"})");
    EXPECT_EQ(shape_of(runner).hash(), before) << shape;
  }
  // A mesh without texture coordinates gets some, one with keeps them.
  OperationRunner runner(world_of(square_mesh()), sample_picture);
  performed(runner, R"({"op": "texture", "object": "thing", "file": "wood.png", "projection": "own"})");
  ASSERT_EQ(mesh_of(runner).texture_coordinates.size(), 2U);
  performed(runner, R"({"op": "texture", "object": "thing", "size": [5, 5, 5]})");
  const auto placed = mesh_of(runner).texture_coordinates;
  performed(runner, R"({"op": "texture", "object": "thing", "file": "wood.png", "projection": "own"})");
  EXPECT_EQ(mesh_of(runner).texture_coordinates, placed);
}

TEST(TextureOperation, SaysWhyAPictureIsNotShown) {
  OperationRunner runner({}, sample_picture);
  performed(runner, R"({"op": "create", "shape": "torus", "name": "ring"})");
  const auto why = [&](const char* said) {
    return refusal(runner, fmt::format(R"({{"op": "texture", "object": "ring", {}}})", said));
  };
  EXPECT_EQ(why(R"("file": "nope.png", "as_mesh": true)"), "texture: nope.png: cannot be read");
  EXPECT_NE(why(R"("file": "wood.png", "picture": "wood.png")").find("not both"), std::string::npos);
  EXPECT_NE(why(R"("file": "wood.png", "projection": "own")").find("no place of its own"), std::string::npos);
  EXPECT_NE(why(R"("projection": "own")").find("say which picture"), std::string::npos);
  EXPECT_NE(why(R"("file": "wood.png", "projection": "own", "size": [1, 1, 1])").find("no"),
            std::string::npos);
  OperationRunner reads_nothing(world_of(square_mesh()));
  EXPECT_NE(refusal(reads_nothing, R"({"op": "texture", "object": "thing", "file": "wood.png"})"), "");
}

TEST(TextureOperation, IsOneActionForSeveralObjects) {
  OperationRunner runner({}, sample_picture);
  for (const char* name : {"one", "two"})
    performed(runner, fmt::format(R"({{"op": "create", "shape": "box", "name": "{}"}})", name));
  const auto id = [&](const char* name) { return named_object(runner.world(), name).value(); };
  world::World world = runner.world();
  world::IdSource ids(7);
  const auto plan = plan_for_each(**find_operation("texture"), {{"file", "wood.png"}, {"projection", "own"}},
                                  std::vector{id("one"), id("two")}, world, ids, sample_picture);
  ASSERT_TRUE(plan) << plan.error().message;
  world::applied(world, plan->edit);
  EXPECT_EQ(world.textures().size(), 1U);
  for (const char* name : {"one", "two"})
    EXPECT_TRUE(world.find(world.find(world.find(id(name))->material)->texture)) << name;
}

TEST(TextureOperation, RefusesProjectorsThatMakeNoSense) {
  OperationRunner runner(world_of(square_mesh()));
  for (const char* said : {R"("size": [0, 1, 1])", R"("size": [1, 1])", R"("at": [1e300, 0, 0])",
                           R"("projection": "conical")", R"("turn": "left")"})
    EXPECT_NE(refusal(runner, fmt::format(R"({{"op": "texture", "object": "thing", {}}})", said)), "")
        << said;
  OperationRunner empty(world_of(geometry::TriangleMesh()));
  EXPECT_NE(refusal(empty, R"({"op": "texture", "object": "thing"})"), "");
}

TEST(TextureOperation, ItsProjectorIsMovedAndTurnedAfterwards) {
  OperationRunner runner(world_of(square_mesh()));
  const char* move = R"({"op": "move-projector", "object": "thing", "by": [0.25, 0, 0]})";
  EXPECT_NE(refusal(runner, move).find("nobody knows where the picture of 'thing' was thrown from"),
            std::string::npos);
  performed(runner, R"({"op": "texture", "object": "thing"})");
  performed_both_ways(runner, move);
  EXPECT_LT((coordinates_at(mesh_of(runner), {0, 0, 0}) - Vector2(-0.25, 0)).norm(), 1e-12);
  EXPECT_LT((coordinates_at(mesh_of(runner), {1, 0, -1}) - Vector2(0.75, 1)).norm(), 1e-12);
  performed(runner, R"({"op": "undo"})");
  // The world's axes and metres count, not the object's.
  performed(runner,
            R"({"op": "place", "object": "thing", "at": [5, 0, 0], "turn": [0, 90, 0], "factor": 2})");
  performed(runner, R"({"op": "move-projector", "object": "thing", "by": [0, 0, -0.5]})");
  EXPECT_LT((coordinates_at(mesh_of(runner), {0, 0, 0}) - Vector2(-0.25, 0)).norm(), 1e-12);
  performed(runner, R"({"op": "move-projector", "object": "thing", "by": [0, 0, 0.5]})");
  performed(runner, R"({"op": "move-projector", "object": "thing", "turn": [0, 90, 0]})");
  EXPECT_LT((coordinates_at(mesh_of(runner), {0, 0, 0}) - Vector2(0, 1)).norm(), 1e-12);
  // Sizes of it are nothing that could be changed, and vertices that move take it away.
  EXPECT_NE(
      refusal(runner, R"({"op": "reshape", "object": "thing", "side": 2})").find("made or bent by hand"),
      std::string::npos);
  performed(runner, R"({"op": "drag", "object": "thing", "vertices": [0], "by": [0.1, 0, 0]})");
  EXPECT_NE(refusal(runner, move).find("nobody knows"), std::string::npos);
}

}  // namespace
}  // namespace icome::interaction
