// Land, and move that stops and snaps, as scripts say them.
#include <algorithm>

#include "interaction/scripted_design.h"
#include "world/collision/collisions.h"
#include "world/shape/mesh_geometry.h"

namespace icome::interaction {
namespace {

class LandOperation : public ScriptedDesign {
 protected:
  /// A table whose top is at 0.7 m, and things above it.
  void SetUp() override {
    run(R"({"op": "create", "shape": "box", "name": "table", "size": [1.2, 0.04, 0.8], "at": [0, 0.68, 0]})");
    run(R"({"op": "turn", "objects": "table", "turn": [0, 30, 0]})");
  }
  void vase(const std::string& name = "vase", const Vector3& at = {0.1, 1.3, 0.1}) {
    run(fmt::format(R"({{"op": "create", "shape": "cylinder", "name": "{}", "radius": 0.05, "height": 0.3,
                        "at": {}}})",
                    name, text_of(at)));
  }
  /// What the object meets as the design is now.
  world::Meeting meeting(std::string_view name, std::string_view other) const {
    world::CollisionIndex index(design());
    for (const world::Collision& it : index.collisions(id(name))) {
      if (it.other == id(other)) return it.meeting;
    }
    return world::Meeting::Apart;
  }
};

TEST_F(LandOperation, LetsAVaseFallOntoTheTable) {
  vase();
  const Performed done = run(R"({"op": "land", "objects": "vase"})");
  EXPECT_NEAR(bounds("vase").min().y(), 0.7, 1e-6);
  EXPECT_EQ(at("vase").x(), 0.1);
  EXPECT_EQ(meeting("vase", "table"), world::Meeting::Touching);
  EXPECT_EQ(done.objects, std::vector{id("vase")});
  EXPECT_EQ(done.note, "on 'table'");
  run(R"({"op": "land", "objects": "vase"})");
  EXPECT_NEAR(bounds("vase").min().y(), 0.7, 1e-6) << "it rests already";
}

TEST_F(LandOperation, LetsAMeshFallAsItIsTurned) {
  vase();
  run(R"({"op": "mesh", "object": "vase"})");
  run(R"({"op": "turn", "objects": "vase", "turn": [30, 0, 10]})");
  run(R"({"op": "land", "objects": "vase"})");
  double lowest = 1.0;
  for (const Vector3& it : dynamic_cast<const world::MeshGeometry&>(shape("vase")).mesh.positions)
    lowest = std::min(lowest, (place("vase") * it).y());
  EXPECT_NEAR(lowest, 0.7, 1e-6);
  EXPECT_NE(meeting("vase", "table"), world::Meeting::Overlapping);
}

TEST_F(LandOperation, FallsAlongAnyDirectionWithAllBelow) {
  box("wall", {5, 1.3, 0.1});
  vase();
  vase("bud", {0.1, 1.6, 0.1});
  run(R"({"op": "put", "objects": "bud", "parent": "vase"})");
  run(R"({"op": "land", "objects": ["vase", "bud"], "direction": [7, 0, 0]})");
  // As far as a cylinder of 1/1000 of its size off can be told.
  EXPECT_NEAR(bounds("vase").max().x(), 4.5, 3e-4);
  EXPECT_NEAR(at("bud").x(), at("vase").x(), 1e-12);
  EXPECT_EQ(at("vase").y(), 1.3);
  EXPECT_NE(meeting("vase", "wall"), world::Meeting::Overlapping);
}

TEST_F(LandOperation, FallsToTheFloorWhereThereIsNothingElse) {
  vase("vase", {3, 1.3, 0});
  expect_refused({{R"({"op": "land", "objects": "vase"})", "nothing below"}});
  const Performed done = run(R"({"op": "land", "objects": "vase", "floor": true})");
  EXPECT_NEAR(bounds("vase").min().y(), 0.0, 1e-6);
  EXPECT_EQ(done.note, "on the floor");
}

TEST_F(LandOperation, MovesStopAtAPlateThinnerThanAnyStep) {
  run(R"({"op": "create", "shape": "box", "name": "plate", "size": [1e-5, 9, 9], "at": [2, 0, 0]})");
  box("crate", {0, 3, 0});
  for (const char* by : {"[4, 0, 0]", "[4000, 0, 0]", "[1e5, 1, 0]"}) {
    const Performed done =
        run(fmt::format(R"({{"op": "move", "objects": "crate", "by": {}, "stop": true}})", by));
    EXPECT_LE(bounds("crate").max().x(), 2.0 - 5e-6);
    EXPECT_GE(bounds("crate").max().x(), 2.0 - 1e-4);
    EXPECT_NE(meeting("crate", "plate"), world::Meeting::Overlapping);
    EXPECT_EQ(done.note, "'crate' stopped at 'plate'");
    run(R"({"op": "place", "object": "crate", "at": [0, 3, 0]})");
  }
  run(R"({"op": "move", "objects": "crate", "by": [4, 0, 0]})");
  EXPECT_EQ(at("crate"), Vector3(4, 3, 0)) << "without that it goes through";
}

TEST_F(LandOperation, MovesSlideAlongWhatTheyMeet) {
  box("wall", {3, 0.5, 0});
  box("crate", {0, 0.5, 0});
  run(R"({"op": "delete", "objects": "table"})");
  run(R"({"op": "move", "objects": "crate", "by": [2.5, 0, 0.5], "stop": true})");
  EXPECT_NEAR(at("crate").x(), 2.0, 1e-5);
  EXPECT_NEAR(at("crate").z(), 0.5, 1e-5);
}

TEST_F(LandOperation, MovesSnapToCorners) {
  box("one", {0, 2, 0});
  box("other", {5, 2, 0});
  const Performed done =
      run(R"({"op": "move", "objects": "other", "by": [-3.99, 0.02, 0.01], "snap": 0.03})");
  EXPECT_LT((at("other") - Vector3(1, 2, 0)).norm(), 1e-9);
  EXPECT_EQ(done.note, "snapped to a corner of 'one'");
  const Performed plain = run(R"({"op": "move", "objects": "other", "by": [1, 0, 0], "snap": 0.03})");
  EXPECT_LT((at("other") - Vector3(2, 2, 0)).norm(), 1e-12);
  EXPECT_EQ(plain.note, "");
}

TEST_F(LandOperation, MovesSnapToAGridAndToWhatIsChosen) {
  run(R"({"op": "delete", "objects": "table"})");
  box("one", {0, 2, 0});
  box("other", {5, 2.25, 0});
  // The corners of the cube are half of its size off its origin: the lattice of 0.25 m takes either.
  const Performed done = run(R"({"op": "move", "objects": "other", "by": [-0.93, 0.3, 0.07], "grid": 0.25})");
  EXPECT_EQ(done.note, "snapped to the grid");
  EXPECT_LT((at("other") - Vector3(4, 2.5, 0)).norm(), 1e-9) << at("other").transpose();
  // Near a corner, an edge and a face of the other cube; only what is wanted draws it.
  const char* beside = R"({"op": "move", "objects": "other", "by": [-2.99, -0.48, 0.02], "snap": 0.05)";
  const auto snapped = [&](const std::string& choice) {
    const Performed moved = run(beside + choice + "}");
    run(R"({"op": "place", "object": "other", "at": [4, 2.5, 0]})");
    return moved.note;
  };
  EXPECT_EQ(snapped(""), "snapped to a corner of 'one'");
  EXPECT_EQ(snapped(R"(, "corners": false)"), "snapped to an edge of 'one'");
  EXPECT_EQ(snapped(R"(, "corners": false, "edges": false)"), "snapped to a face of 'one'");
  EXPECT_EQ(snapped(R"(, "corners": false, "edges": false, "faces": false, "grid": 0.25)"),
            "snapped to the grid");
  expect_refused({{R"({"op": "move", "objects": "other", "by": [1, 0, 0], "edges": true})", "within how far"},
                  {R"({"op": "move", "objects": "other", "by": [1, 0, 0], "snap": 0.1, "corners": false,
                       "edges": false, "faces": false})",
                   "nothing left"}});
}

TEST_F(LandOperation, WhatIsInTheWayOfAGridsPlaceStopsShortOfItAndSendsNothingAside) {
  run(R"({"op": "delete", "objects": "table"})");
  box("wall", {2.93, 2, 0});
  box("crate", {0, 2, 0});
  // The grid's places before the wall that corners could take lie 0.1 m aside, behind it the origin's.
  const Performed stopped =
      run(R"({"op": "move", "objects": "crate", "by": [2.5, 0, 0], "stop": true, "grid": 0.4})");
  EXPECT_EQ(stopped.note, "'crate' stopped at 'wall'");
  EXPECT_LT((at("crate") - Vector3(1.93, 2, 0)).norm(), 1e-5) << at("crate").transpose();
  // With room for it the grid's place is taken; along the wall it is only the way into it that is stopped.
  const Performed snapped =
      run(R"({"op": "move", "objects": "crate", "by": [-0.7, 0.05, 0.03], "stop": true, "grid": 0.4})");
  EXPECT_EQ(snapped.note, "snapped to the grid");
  EXPECT_LT((at("crate") - Vector3(1.2, 2, 0)).norm(), 1e-9) << at("crate").transpose();
  run(R"({"op": "move", "objects": "crate", "by": [2.05, 0, 0.81], "stop": true, "grid": 0.4})");
  EXPECT_LT((at("crate") - Vector3(1.93, 2, 0.8)).norm(), 1e-5) << at("crate").transpose();
}

TEST_F(LandOperation, RefusesWhatMakesNoSense) {
  vase();
  run(R"({"op": "group", "objects": "table", "name": "group"})");
  run(R"({"op": "create", "shape": "box", "name": "stuck", "size": [1, 1, 1], "at": [0, 0.6, 0]})");
  expect_refused(
      {{R"({"op": "land"})", "'objects' is missing"},
       {R"({"op": "land", "objects": "nobody"})", "nobody"},
       {R"({"op": "land", "objects": "vase", "direction": [0, 0, 0]})", "with a length"},
       {R"({"op": "land", "objects": "vase", "direction": [0, 1, 0]})", "nothing below"},
       {R"({"op": "land", "objects": "vase", "direction": [0, 1e99, 0]})", "between"},
       {R"({"op": "land", "objects": "vase", "floor": 1})", "'floor' must be"},
       {R"({"op": "land", "objects": "stuck"})", "goes through something"},
       {R"({"op": "move", "objects": "vase", "by": [1e9, 0, 0], "stop": true})", "too far away"},
       {R"({"op": "move", "objects": "vase", "by": [1, 0, 0], "snap": 0})", "between"},
       {R"({"op": "move", "objects": "vase", "by": [1, 0, 0], "stop": "yes"})", "'stop' must be"}});
}

}  // namespace
}  // namespace icome::interaction
