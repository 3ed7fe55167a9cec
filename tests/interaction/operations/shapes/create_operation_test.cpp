#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/mesh/mesh_topology.h"
#include "interaction/operations/shapes/shape_operations.h"
#include "interaction/shape_samples.h"

namespace icome::interaction {
namespace {

using geometry::signed_volume;
using geometry::surface_area;

TEST(CreateOperation, MakesSolidsOfTheirSizes) {
  OperationRunner runner({});
  performed(runner, R"({"op": "create", "shape": "box", "size": [0.4, 0.02, 0.3]})");
  EXPECT_EQ(solid_of<geometry::Box>(runner, "box").half, Vector3(0.2, 0.01, 0.15));
  performed(runner, R"({"op": "create", "shape": "cube", "side": 0.5})");
  EXPECT_EQ(solid_of<geometry::Box>(runner, "cube").half, Vector3(0.25, 0.25, 0.25));
  performed(runner, R"({"op": "create", "shape": "sphere", "radius": 2})");
  EXPECT_EQ(solid_of<geometry::Sphere>(runner, "sphere").radius, 2.0);
  performed(runner, R"({"op": "create", "shape": "cylinder", "radius": 0.1, "height": 3})");
  EXPECT_EQ(solid_of<geometry::Cylinder>(runner, "cylinder").radius, 0.1);
  performed(runner, R"({"op": "create", "shape": "cone", "radius": 3, "height": 2, "top_radius": 1})");
  const auto& cone = solid_of<geometry::Cone>(runner, "cone");
  EXPECT_EQ((Vector3{cone.bottom_radius, cone.top_radius, cone.height}), Vector3(3, 1, 2));
  performed(runner, R"({"op": "create", "shape": "torus", "radius": 3, "tube": 1})");
  EXPECT_EQ(solid_of<geometry::Torus>(runner, "torus").major_radius, 3.0);
  EXPECT_EQ(solid_of<geometry::Torus>(runner, "torus").minor_radius, 1.0);
  performed(runner, R"({"op": "create", "shape": "capsule", "radius": 1, "height": 2})");
  EXPECT_EQ(solid_of<geometry::Capsule>(runner, "capsule").height, 2.0);
  performed(runner, R"({"op": "create", "shape": "plane"})");
  EXPECT_NO_THROW(solid_of<geometry::Plane>(runner, "plane"));
}

TEST(CreateOperation, StandsThingsUp) {
  OperationRunner runner({});
  performed(runner, R"({"op": "create", "shape": "cylinder", "radius": 1, "height": 6})");
  EXPECT_NEAR(shape_named(runner, "cylinder")->bounds().sizes().y(), 6.0, 1e-12);
  performed(runner, R"({"op": "create", "shape": "torus", "radius": 3, "tube": 1})");
  EXPECT_NEAR(shape_named(runner, "torus")->bounds().sizes().y(), 2.0, 1e-12);
  performed(runner, R"({"op": "create", "shape": "pyramid", "radius": 1, "height": 6})");
  // The tip is the one vertex at the top.
  int at_top = 0;
  for (const Vector3& position : triangles_of(runner, "pyramid").positions)
    at_top += position == Vector3(0, 3, 0) ? 1 : 0;
  EXPECT_EQ(at_top, 1);
}

TEST(CreateOperation, MeshesMeasureWhatTheyShould) {
  OperationRunner runner({});
  performed(runner, R"({"op": "create", "shape": "triangle", "side": 2})");
  EXPECT_NEAR(surface_area(triangles_of(runner, "triangle")), std::sqrt(3.0), 1e-14);
  performed(runner, R"({"op": "create", "shape": "square", "side": 3})");
  EXPECT_NEAR(surface_area(triangles_of(runner, "square")), 9.0, 1e-14);
  performed(runner, R"({"op": "create", "shape": "rectangle", "width": 3, "height": 2})");
  EXPECT_NEAR(surface_area(triangles_of(runner, "rectangle")), 6.0, 1e-14);
  performed(runner, R"({"op": "create", "shape": "circle", "radius": 2, "segments": 12})");
  EXPECT_NEAR(surface_area(triangles_of(runner, "circle")), polygon_area(12, 2), 1e-13);
  performed(runner, R"({"op": "create", "shape": "polygon", "sides": 5, "radius": 2})");
  EXPECT_NEAR(surface_area(triangles_of(runner, "polygon")), polygon_area(5, 2), 1e-13);
  performed(runner, R"({"op": "create", "shape": "pyramid", "sides": 5, "radius": 2, "height": 3})");
  EXPECT_NEAR(signed_volume(triangles_of(runner, "pyramid")), polygon_area(5, 2), 1e-13);
  EXPECT_TRUE(geometry::analyse_topology(triangles_of(runner, "pyramid")).report.closed);
}

TEST(CreateOperation, TextIsASolidOfItsLetters) {
  OperationRunner runner({});
  performed(runner, R"({"op": "create", "shape": "text", "text": "HI", "height": 2, "depth": 0.5})");
  const geometry::TriangleMesh letters = triangles_of(runner, "text");
  EXPECT_TRUE(geometry::analyse_topology(letters).report.closed);
  const Vector3 size = shape_named(runner, "text")->bounds().sizes();
  EXPECT_NEAR(size.y(), 2.0, 1e-3);
  EXPECT_NEAR(size.z(), 0.5, 1e-12);
  // Bars and nothing else: twice as thick is twice the volume.
  performed(runner, R"({"op": "reshape", "object": "text", "depth": 1})");
  EXPECT_NEAR(signed_volume(triangles_of(runner, "text")), 2 * signed_volume(letters), 1e-12);
  EXPECT_GT(signed_volume(letters), 0.0);
}

TEST(CreateOperation, MakesEverythingWithoutAWordMore) {
  OperationRunner runner({});
  const Operation create = create_operation();
  for (const std::string& shape : create.parameters.front().choices) {
    std::string more;
    if (shape == "implicit") more = R"(, "formula": "x^2 + y^2 + z^2 - 0.25")";
    if (shape == "text") more = R"(, "text": "a word")";
    if (shape == "mesh") more = R"(, "points": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,2]])";
    const auto made = performed(runner, R"({"op": "create", "shape": ")" + shape + "\"" + more + "}");
    ASSERT_EQ(made.objects.size(), 1U) << shape;
    const world::PhysicalObject& object = *runner.world().find(made.objects[0]);
    EXPECT_EQ(object.name, shape);
    EXPECT_EQ(bool(object.geometry), shape != "group") << shape;
  }
}

TEST(CreateOperation, NamesWhatHasNoNameByNumbers) {
  OperationRunner runner({});
  for (int i = 0; i < 3; ++i) performed(runner, R"({"op": "create", "shape": "box"})");
  EXPECT_NO_THROW(object_named(runner, "box"));
  EXPECT_NO_THROW(object_named(runner, "box 2"));
  EXPECT_NO_THROW(object_named(runner, "box 3"));
}

TEST(CreateOperation, CutsFormulasOffByTheirBox) {
  OperationRunner runner({});
  performed(runner, R"({"op": "create", "shape": "implicit", "formula": "y", "name": "slab",
                        "bounds": [[1, 1, 2], [-1, -1, -2]]})");
  const auto& slab = dynamic_cast<const world::ImplicitGeometry&>(*shape_named(runner, "slab"));
  EXPECT_EQ(slab.formula(), "y");
  EXPECT_EQ(slab.surface()->box().min(), Vector3(-1, -1, -2));
}

TEST(CreateOperation, RefusesWhatIsNoShape) {
  OperationRunner runner({});
  const std::string endless_formula = R"("implicit", "formula": ")" + std::string(100'000, '(') + "\"";
  for (const std::string& said : std::vector<std::string>{
           R"("cube", "side": 0)",
           R"("cube", "side": -1)",
           R"("cube", "side": 1e300)",
           R"("cube", "side": 1e-300)",
           R"("cube", "radius": 1)",
           R"("cubes")",
           R"(3)",
           R"("box", "size": [1, 1])",
           R"("box", "size": [1, 1, 0])",
           R"("sphere", "radius": 1e7)",
           R"("cylinder", "height": 0)",
           R"("cone", "top_radius": -1)",
           R"("cone", "top_radius": 1e-12)",
           R"("torus", "radius": 1, "tube": 1)",
           R"("torus", "radius": 1, "tube": 2)",
           R"("polygon", "sides": 2)",
           R"("polygon", "sides": 3.5)",
           R"("polygon", "sides": -3)",
           R"("polygon", "sides": 9007199254740992)",
           R"("circle", "segments": 1e300)",
           R"("pyramid", "sides": 1000000)",
           R"("pyramid", "height": 0)",
           R"("rectangle", "width": 0)",
           R"("text")",
           R"("text", "text": "")",
           R"("text", "text": " ")",
           R"("text", "text": "a", "depth": -1)",
           R"("text", "text": "a", "height": 0)",
           R"("text", "text": "a", "font": "No Such Font")",
           R"("text", "text": "\ue000")",
           R"("implicit")",
           R"("implicit", "formula": "")",
           R"("implicit", "formula": "x +")",
           R"("implicit", "formula": "x", "bounds": [[0, 0, 0]])",
           R"("implicit", "formula": "x", "bounds": [[0, 0, 0], [0, 1, 1]])",
           R"("implicit", "formula": "1")",
           R"("implicit", "formula": "x", "bounds": [[0, 0, 0], [1, 1e9, 1]])",
           R"("mesh", "points": [[0,0,0],[1,0,0],[0,1,0]])",
           R"("mesh", "points": [], "triangles": [])",
           R"("mesh", "points": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,3]])",
           R"("mesh", "points": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,4294967295]])",
           R"("mesh", "points": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,1e300]])",
           R"("mesh", "points": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,-1]])",
           R"("mesh", "points": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,0.5]])",
           R"("mesh", "points": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,1]])",
           R"("mesh", "points": [[0,0,0],[1,0,0],[0,1e300,0]], "triangles": [[0,1,2]])",
           R"("group", "radius": 1)",
           endless_formula}) {
    const std::string command = R"({"op": "create", "shape": )" + said + "}";
    EXPECT_EQ(refusal(runner, command).find("create: "), 0U) << said.substr(0, 100);
  }
  EXPECT_EQ(refusal(runner, R"({"op": "create", "shape": "sphere", "size": [1, 1, 1]})"),
            "create: 'size' is nothing that 'sphere' has; it is for box");
}

}  // namespace
}  // namespace icome::interaction
