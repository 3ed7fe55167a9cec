#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/mesh/mesh_topology.h"
#include "interaction/operations/shapes/shape_operations.h"
#include "interaction/shape_samples.h"

namespace icome::interaction {
namespace {

using geometry::signed_volume;

bool is_closed(const geometry::TriangleMesh& mesh) { return geometry::analyse_topology(mesh).report.closed; }

TEST(ExtrudeOperation, RaisesASquareToAStep) {
  OperationRunner runner({});
  performed(runner, R"({"op": "extrude", "name": "step", "points": [[0, 0], [2, 0], [2, 1], [0, 1]],
                        "steps": [{"move": [0, 0, 3]}]})");
  EXPECT_TRUE(is_closed(triangles_of(runner, "step")));
  EXPECT_NEAR(signed_volume(triangles_of(runner, "step")), 6.0, 1e-14);
  EXPECT_EQ(runner.history().undo_name(), "Extrude");
}

/// Thesis 2.4.3: "A cone can be extruded by rotations from a triangle".
TEST(ExtrudeOperation, TurnsATriangleToACone) {
  OperationRunner runner({});
  performed(runner, R"({"op": "extrude", "points": [[0, 0], [3, 0], [0, 2]], "ends": "joined",
                        "steps": [{"turn": [0, 10, 0], "repeat": 36}]})");
  // Pappus's rule for chords: all of the area goes n sin(360 degrees / n) times its distance from the axis.
  const double volume = 36 * std::sin(2 * std::numbers::pi / 36) * 3.0 * 1.0;
  EXPECT_NEAR(signed_volume(triangles_of(runner, "extrusion")), volume, 1e-12);
  EXPECT_TRUE(is_closed(triangles_of(runner, "extrusion")));
}

/// "or by translations and scaling of a circle".
TEST(ExtrudeOperation, ShrinksACircleToACone) {
  OperationRunner runner({});
  performed(runner, R"({"op": "create", "shape": "circle", "radius": 2, "segments": 24})");
  performed(runner, R"({"op": "extrude", "profile": "circle",
                        "steps": [{"move": [0, 0, 6], "factor": 0}]})");
  EXPECT_NEAR(signed_volume(triangles_of(runner, "extrusion")), polygon_area(24, 2) * 6 / 3, 1e-12);
  EXPECT_TRUE(is_closed(triangles_of(runner, "extrusion")));
}

/// "A torus is extruded from a circle".
TEST(ExtrudeOperation, TakesACircleRoundToATorus) {
  OperationRunner runner({});
  performed(runner, R"({"op": "create", "shape": "circle", "radius": 1, "segments": 12})");
  performed(runner, R"({"op": "extrude", "profile": "circle", "ends": "joined",
                        "steps": [{"turn": [0, 7.5, 0], "centre": [-5, 0, 0], "repeat": 48}]})");
  const double volume = 48 * std::sin(2 * std::numbers::pi / 48) * polygon_area(12, 1) * 5;
  EXPECT_NEAR(signed_volume(triangles_of(runner, "extrusion")), volume, 1e-10);
  EXPECT_TRUE(is_closed(triangles_of(runner, "extrusion")));
}

TEST(ExtrudeOperation, StandsWhereItsProfileIsAndLooksLikeIt) {
  world::World world;
  ASSERT_TRUE(apply(world, world::CreateMaterial{world::MaterialId{99}, {.name = "wood"}}));
  OperationRunner runner(world);
  performed(runner, R"({"op": "create", "shape": "group", "name": "room", "at": [1, 0, 0]})");
  performed(runner, R"({"op": "create", "shape": "square", "side": 2, "parent": "room", "at": [0, 5, 0],
                        "turn": [-90, 0, 0], "material": "wood"})");
  performed(runner,
            R"({"op": "extrude", "profile": "square", "name": "step", "steps": [{"move": [0, 0, 1]}]})");
  const world::PhysicalObject& step = object_named(runner, "room/step");
  EXPECT_EQ(step.material.value, 99U);
  const base::Bounds bounds = world::bounds(runner.world(), *named_object(runner.world(), "step"));
  EXPECT_TRUE(bounds.min().isApprox(Vector3(0, 5, -1), 1e-12)) << bounds.min().transpose();
  EXPECT_TRUE(bounds.max().isApprox(Vector3(2, 6, 1), 1e-12)) << bounds.max().transpose();

  performed(runner, R"({"op": "extrude", "profile": "square", "name": "free", "at": [7, 0, 0],
                        "steps": [{"move": [0, 0, 1]}]})");
  EXPECT_FALSE(object_named(runner, "free").parent);
  EXPECT_EQ(Vector3(object_named(runner, "free").parent_from_object.translation()), Vector3(7, 0, 0));
}

/// Thesis 2.4.3, figure 2.11: "create a square with a wood texture; extrude the square to create a step".
TEST(ExtrudeOperation, CarriesThePictureOfItsProfileAlong) {
  OperationRunner runner({}, sample_picture);
  performed(runner, R"({"op": "create", "shape": "square", "side": 2, "name": "square"})");
  performed(runner, R"({"op": "texture", "object": "square", "file": "wood.png"})");
  performed(runner,
            R"({"op": "extrude", "profile": "square", "name": "step", "steps": [{"move": [0, 0, 3]}]})");
  const auto shape = [&]() -> const world::MeshGeometry& {
    return dynamic_cast<const world::MeshGeometry&>(
        *runner.world().find(object_named(runner, "step").geometry)->shape);
  };
  EXPECT_EQ(shape().texture_coordinates.size(), shape().mesh.triangles.size());
  EXPECT_EQ(object_named(runner, "step").material, object_named(runner, "square").material);
  // It is made anew with another size of the drawing, and the picture stays.
  performed(runner, R"({"op": "reshape", "object": "step", "steps": [{"move": [0, 0, 5]}]})");
  EXPECT_EQ(shape().texture_coordinates.size(), shape().mesh.triangles.size());
  EXPECT_NE(refusal(runner, R"({"op": "reshape", "object": "step", "points": [[0, 0], [1, 0], [0, 1]]})")
                .find("give each corner one"),
            std::string::npos);
  EXPECT_NE(refusal(runner, R"({"op": "extrude", "open": true, "points": [[0, 0], [1, 0]],
                                "places": [[0, 0], [1, 0]], "steps": [{"move": [0, 0, 1]}]})")
                .find("outline"),
            std::string::npos);
}

TEST(ExtrudeOperation, TakesMeshesThatLieInAnyPlane) {
  OperationRunner runner({});
  // An L lying at height 4, fronts up.
  performed(runner, R"({"op": "create", "shape": "mesh", "name": "ell",
      "points": [[0,4,0],[0,4,2],[1,4,2],[1,4,1],[3,4,1],[3,4,0]],
      "triangles": [[0,1,2],[0,2,3],[0,3,4],[0,4,5]]})");
  performed(runner, R"({"op": "extrude", "profile": "ell", "steps": [{"move": [0, 0, 2]}]})");
  EXPECT_NEAR(signed_volume(triangles_of(runner, "extrusion")), 8.0, 1e-12);
  const base::Bounds bounds = world::bounds(runner.world(), *named_object(runner.world(), "extrusion"));
  EXPECT_TRUE(bounds.min().isApprox(Vector3(0, 4, 0), 1e-12)) << bounds.min().transpose();
  EXPECT_TRUE(bounds.max().isApprox(Vector3(3, 6, 2), 1e-12)) << bounds.max().transpose();
}

TEST(ExtrudeOperation, MakesSheetsOfLines) {
  OperationRunner runner({});
  performed(runner, R"({"op": "extrude", "points": [[0, 0], [1, 0], [1, 1]], "open": true,
                        "steps": [{"move": [0, 0, 3]}]})");
  EXPECT_NEAR(geometry::surface_area(triangles_of(runner, "extrusion")), 6.0, 1e-14);
  EXPECT_FALSE(is_closed(triangles_of(runner, "extrusion")));
}

TEST(ExtrudeOperation, CanBeReshaped) {
  OperationRunner changed({}), made({});
  performed(changed, R"({"op": "extrude", "points": [[0, 0], [2, 0], [0, 1]],
                         "steps": [{"move": [0, 0, 3]}], "ends": "open"})");
  performed(made, R"({"op": "extrude", "points": [[0, 0], [2, 0], [0, 1]],
                      "steps": [{"move": [0, 0, 1], "factor": 0.5, "repeat": 2}], "ends": "open"})");
  performed(changed, R"({"op": "reshape", "object": "extrusion",
                         "steps": [{"move": [0, 0, 1], "factor": 0.5, "repeat": 2}]})");
  EXPECT_EQ(hash(changed.world()), hash(made.world()));
  performed(changed, R"({"op": "reshape", "object": "extrusion", "ends": "capped"})");
  EXPECT_TRUE(is_closed(triangles_of(changed, "extrusion")));
  EXPECT_EQ(refusal(changed, R"({"op": "reshape", "object": "extrusion", "radius": 1})"),
            "reshape: there is no 'radius'; there are ends, open, places, points, steps");
}

TEST(ExtrudeOperation, TakesBackAllItMade) {
  OperationRunner runner({});
  performed(runner, R"({"op": "create", "shape": "square"})");
  const std::uint64_t before = hash(runner.world());
  performed(runner, R"({"op": "extrude", "profile": "square", "steps": [{"move": [0, 0, 3]}]})");
  performed(runner, R"({"op": "undo"})");
  EXPECT_EQ(hash(runner.world()), before);
}

TEST(ExtrudeOperation, RefusesWhatCannotBeSwept) {
  OperationRunner runner({});
  performed(runner, R"({"op": "create", "shape": "square", "name": "square"})");
  performed(runner, R"({"op": "create", "shape": "pyramid", "name": "pyramid"})");
  performed(runner, R"({"op": "create", "shape": "box", "name": "box"})");
  performed(runner, R"({"op": "create", "shape": "group", "name": "group"})");
  performed(runner, R"({"op": "create", "shape": "mesh", "name": "bent",
      "points": [[0,0,0],[1,0,0],[1,1,0],[0,1,1]], "triangles": [[0,1,2],[0,2,3]]})");
  performed(runner, R"({"op": "create", "shape": "mesh", "name": "two", "points":
      [[0,0,0],[1,0,0],[0,1,0],[5,0,0],[6,0,0],[5,1,0]], "triangles": [[0,1,2],[3,4,5]]})");
  const std::string good = R"("points": [[0, 0], [1, 0], [0, 1]], )";
  for (const std::string& said : std::vector<std::string>{
           R"("steps": [{"move": [0, 0, 1]}])",
           good + R"("profile": "square", "steps": [{"move": [0, 0, 1]}])",
           R"("profile": "box", "steps": [{"move": [0, 0, 1]}])",
           R"("profile": "group", "steps": [{"move": [0, 0, 1]}])",
           R"("profile": "pyramid", "steps": [{"move": [0, 0, 1]}])",
           R"("profile": "bent", "steps": [{"move": [0, 0, 1]}])",
           R"("profile": "two", "steps": [{"move": [0, 0, 1]}])",
           R"("profile": "square", "open": true, "steps": [{"move": [0, 0, 1]}])",
           R"("points": [], "steps": [{"move": [0, 0, 1]}])",
           R"("points": [[0, 0], [1, 0]], "steps": [{"move": [0, 0, 1]}])",
           R"("points": [[0, 0], [1, 0], [2, 0]], "steps": [{"move": [0, 0, 1]}])",
           R"("points": [[0, 0], [1, 0], [0, 1e300]], "steps": [{"move": [0, 0, 1]}])",
           R"("points": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "steps": [{"move": [0, 0, 1]}])",
           R"("points": [[0, 0], [1, 1], [1, 0], [0, 1]], "steps": [{"move": [0, 0, 1]}])",
           good + R"("steps": [])",
           good + R"("steps": [{}])",
           good + R"("steps": [{"move": [0, 0, 1e300]}])",
           good + R"("steps": [{"move": [0, 0, 1], "scale": [-1, 1, 1]}])",
           good + R"("steps": [{"move": [0, 0, 1], "scale": [1, 1, 1], "factor": 2}])",
           good + R"("steps": [{"move": [0, 0, 1], "repeat": 0}])",
           good + R"("steps": [{"move": [0, 0, 1], "repeat": 9007199254740992}])",
           good + R"("steps": [{"move": [0, 0, 1], "repeat": 10000000}])",
           good + R"("steps": [{"move": [0, 0, 1], "factor": 1000, "repeat": 500}])",
           good + R"("steps": [{"move": [1, 0, 0]}])",
           good + R"("steps": [{"turn": [0, 90, 0]}], "ends": "shut")",
           good + R"("steps": [{"move": [0, 0, 1]}], "name": "")"}) {
    const std::string command = R"({"op": "extrude", )" + said + "}";
    EXPECT_EQ(refusal(runner, command).find("extrude: "), 0U) << said;
  }
  EXPECT_EQ(refusal(runner, R"({"op": "extrude", "profile": "bent", "steps": [{"move": [0, 0, 1]}]})"),
            "extrude: the profile 'bent': it is not flat; name something flat, such as a square");
}

/// A spiral that climbs by so much in a turn, of a drawing that is 0.1 m thick.
std::string spiral(double climb) {
  return fmt::format(
      R"({{"op": "extrude", "name": "spiral", "points": [[0.2, -0.05], [0.3, -0.05], [0.3, 0.05], [0.2, 0.05]],
           "steps": [{{"turn": [0, 10, 0], "move": [0, {}, 0], "repeat": 60}}]}})",
      climb / 36);
}

TEST(ExtrudeOperation, TellsOfASweepThatGoesThroughItselfAndMakesItAllTheSame) {
  OperationRunner runner({});
  EXPECT_EQ(performed(runner, spiral(0.12)).note, "");
  performed(runner, R"({"op": "undo"})");
  const std::string note = performed(runner, spiral(0.08)).note;
  EXPECT_EQ(note.find("it goes through itself near ["), 0U) << note;
  EXPECT_TRUE(is_closed(triangles_of(runner, "spiral")));
  // So does a change of it.
  const Performed wide = performed(runner, R"({"op": "reshape", "object": "spiral",
                  "points": [[0.2, -0.01], [0.3, -0.01], [0.3, 0.01], [0.2, 0.01]]})");
  EXPECT_EQ(wide.note, "");
  performed(runner, R"({"op": "clone", "object": "spiral", "name": "other"})");
  const Performed high = performed(runner, R"({"op": "reshape", "object": "spiral",
                  "points": [[0.2, -0.05], [0.3, -0.05], [0.3, 0.05], [0.2, 0.05]]})");
  EXPECT_EQ(high.note.find("it goes through itself near ["), 0U) << high.note;
  EXPECT_NE(high.note.find("2 objects use this shape"), std::string::npos) << high.note;
}

TEST(ExtrudeOperation, TellsOfALineThatIsSweptThroughItself) {
  OperationRunner runner({});
  const char* loop = R"({"op": "extrude", "points": [[0, 0], [0, 0.1]], "open": true, "ends": "open",
                         "steps": [{"move": [0, 0, 1]}, {"move": [1, 0, 0]}, {"move": [0, 0, -0.5]},
                                   {"move": [-2, 0, 0]}]})";
  EXPECT_EQ(performed(runner, loop).note.find("it goes through itself near [0, "), 0U);
}

}  // namespace
}  // namespace icome::interaction
