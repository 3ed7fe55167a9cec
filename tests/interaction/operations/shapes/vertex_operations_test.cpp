// Drag, subdivide, refine, smooth, mesh and own-shape as scripts perform them.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "geometry/loop/loop_surface.h"
#include "geometry/mesh/mesh_topology.h"
#include "interaction/mesh_samples.h"

namespace icome::interaction {
namespace {

using geometry::TriangleMesh;
using world::MeshGeometry;

std::vector<Vector3> moved_by(const TriangleMesh& now, const TriangleMesh& before) {
  std::vector<Vector3> moves;
  for (std::size_t v = 0; v < before.positions.size(); ++v)
    moves.push_back(now.positions[v] - before.positions[v]);
  return moves;
}

TEST(DragOperation, MovesVerticesEdgesFacesAndTheNearestVertex) {
  const Vector3 up(0, 0.5, 0), none(0, 0, 0);
  const auto after = [&](const char* what) {
    OperationRunner runner(world_of(square_mesh()));
    performed_both_ways(runner,
                        fmt::format(R"({{"op": "drag", "object": "thing", {}, "by": [0, 0.5, 0]}})", what));
    return moved_by(mesh_of(runner).mesh, square_mesh());
  };
  EXPECT_EQ(after(R"("vertices": [1, 1, 3])"), (std::vector<Vector3>{none, up, none, up}));
  EXPECT_EQ(after(R"("edges": [[2, 0]])"), (std::vector<Vector3>{up, none, up, none}));
  EXPECT_EQ(after(R"("faces": [0])"), (std::vector<Vector3>{up, up, up, none}));
  EXPECT_EQ(after(R"("near": [0.9, 3, -0.8])"), (std::vector<Vector3>{none, none, up, none}));
  // Of two as near, the first.
  EXPECT_EQ(after(R"("near": [0.5, 0, 0.1])"), (std::vector<Vector3>{up, none, none, none}));
}

TEST(DragOperation, TakesThoseRoundItAlongByTheFalloff) {
  // Vertices at distance 0, 1, sqrt 2 and 1 from vertex 0, the diagonal being an edge.
  const auto heights = [&](const char* soft) {
    OperationRunner runner(world_of(square_mesh()));
    performed(
        runner,
        fmt::format(R"({{"op": "drag", "object": "thing", "vertices": [0], "by": [0, 1, 0], {}}})", soft));
    std::vector<double> result;
    for (const Vector3& move : moved_by(mesh_of(runner).mesh, square_mesh())) result.push_back(move.y());
    return result;
  };
  const auto near = [](const std::vector<double>& one, const std::vector<double>& other) {
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(one[i], other[i], 1e-15) << i;
  };
  const double far = std::numbers::sqrt2 / 2;
  near(heights(R"("radius": 2)"), {1, 0.5, 1 - 3 * far * far + 2 * far * far * far, 0.5});
  near(heights(R"("radius": 2, "falloff": "linear")"), {1, 0.5, 1 - far, 0.5});
  near(heights(R"("radius": 2, "falloff": "sharp")"), {1, 0.25, (1 - far) * (1 - far), 0.25});
  near(heights(R"("radius": 1.2, "falloff": "constant")"), {1, 1, 0, 1});
  near(heights(R"("radius": 1.9, "falloff": "constant", "distance": "along-edges")"), {1, 1, 1, 1});
}

TEST(DragOperation, MovesTheControlMeshOfALoopSurface) {
  OperationRunner runner(world_of_loop({cube_mesh(), {{0, 1}}, {7}}));
  performed_both_ways(runner, R"({"op": "drag", "object": "thing", "vertices": [7], "by": [1, 2, 3]})");
  EXPECT_EQ(control_of(runner).mesh.positions[7], Vector3(2, 3, 4));
  EXPECT_EQ(control_of(runner).creases.size(), 1U);
  EXPECT_EQ(control_of(runner).corners, std::vector<std::uint32_t>{7});
}

TEST(DragOperation, BendsCornerNormalsWithTheSurface) {
  auto shape = std::make_shared<MeshGeometry>(cube_mesh());
  shape->normals = flat_normals(shape->mesh);
  shape->colours.resize(12);
  OperationRunner runner(world_of(shape));
  performed_both_ways(runner, R"({"op": "drag", "object": "thing", "vertices": [7], "by": [0.5, 0.7, 0.3]})");
  const MeshGeometry& now = mesh_of(runner);
  EXPECT_EQ(now.colours, shape->colours);
  // Both triangles of a side had one normal, which is the mean of theirs now by their angles at the corner;
  // sides that vertex 7 is no part of are as they were.
  const auto flat = flat_normals(now.mesh);
  for (std::size_t t = 0; t < 12; ++t) {
    const bool touched = std::ranges::count(now.mesh.triangles[t], 7U) > 0;
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(now.normals[t][i].norm(), 1.0, 1e-15);
      EXPECT_GT(now.normals[t][i].dot(flat[t][i]), 0.9);
      if (!touched && now.mesh.triangles[t][i] != 7) continue;
      EXPECT_LT(now.normals[t][i].dot(shape->normals[t][i]), 1.0 - 1e-4) << t;
    }
  }
  EXPECT_EQ(now.normals[0], shape->normals[0]);
}

TEST(DragOperation, ChangesClonesToo) {
  world::World world = world_of(square_mesh());
  world::IdSource ids(0, world.next_number(0));
  const auto model = named_object(world, "thing").value();
  const auto clone = world::duplicated(world, ids, model, world::Duplicate::CloneObject);
  world::applied(world, world::RenameObject{clone, "clone"});
  OperationRunner runner(world);
  performed_both_ways(runner, R"({"op": "drag", "object": "clone", "vertices": [0], "by": [0, 1, 0]})");
  EXPECT_EQ(&shape_of(runner, "thing"), &shape_of(runner, "clone"));
  EXPECT_EQ(mesh_of(runner).mesh.positions[0].y(), 1);
  const char* alone = R"({"op": "drag", "object": "clone", "vertices": [0], "by": [0, 1, 0], "alone": true})";
  performed_both_ways(runner, alone);
  EXPECT_EQ(mesh_of(runner, "thing").mesh.positions[0].y(), 1);
  EXPECT_EQ(mesh_of(runner, "clone").mesh.positions[0].y(), 2);
  EXPECT_EQ(runner.world().geometries().size(), 2U);
  performed_both_ways(runner, alone);  // it is alone already
  EXPECT_EQ(runner.world().geometries().size(), 2U);
  EXPECT_EQ(mesh_of(runner, "clone").mesh.positions[0].y(), 3);
}

TEST(OwnShape, LetsAnObjectChangeByItself) {
  world::World world = world_of(square_mesh());
  world::IdSource ids(0, world.next_number(0));
  const auto model = named_object(world, "thing").value();
  const auto clone = world::duplicated(world, ids, model, world::Duplicate::CloneObject);
  world::applied(world, world::RenameObject{clone, "clone"});
  OperationRunner runner(world);
  performed_both_ways(runner, R"({"op": "own-shape", "object": "clone"})");
  EXPECT_EQ(shape_of(runner, "clone").hash(), shape_of(runner, "thing").hash());
  performed(runner, R"({"op": "subdivide", "object": "clone"})");
  EXPECT_EQ(mesh_of(runner, "thing").mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh_of(runner, "clone").mesh.triangles.size(), 8U);
  EXPECT_EQ(refusal(runner, R"({"op": "own-shape", "object": "clone"})"),
            "own-shape: 'clone' has a shape of its own already");
}

TEST(SubdivideOperation, KeepsAreaVolumeAndWatertightness) {
  OperationRunner runner(world_of(cube_mesh()));
  performed_both_ways(runner, R"({"op": "subdivide", "object": "thing", "levels": 3})");
  EXPECT_EQ(mesh_of(runner).mesh.triangles.size(), 12U * 64);
  performed_both_ways(runner,
                      R"({"op": "subdivide", "object": "thing", "triangles": [5, 9, 10], "levels": 2})");
  const TriangleMesh& mesh = mesh_of(runner).mesh;
  EXPECT_GT(mesh.triangles.size(), 12U * 64 + 3 * 15);
  EXPECT_NEAR(geometry::surface_area(mesh), 24.0, 1e-12);
  EXPECT_NEAR(geometry::signed_volume(mesh), 8.0, 1e-12);
  const auto report = geometry::analyse_topology(mesh).report;
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.non_manifold_edges, 0U);
}

TEST(SubdivideOperation, CutsTrianglesToFitThatOnlyTouchTheChosenOnes) {
  TriangleMesh soup;  // the square, with vertices of its own for each triangle
  soup.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, -1}, {0, 0, 0}, {1, 0, -1}, {0, 0, -1}};
  soup.triangles = {{0, 1, 2}, {3, 4, 5}};
  OperationRunner runner(world_of(soup));
  performed(runner, R"({"op": "subdivide", "object": "thing", "triangles": [0]})");
  EXPECT_EQ(mesh_of(runner).mesh.triangles.size(), 6U);
}

TEST(SubdivideOperation, CarriesWhatCornersHave) {
  auto shape = std::make_shared<MeshGeometry>(square_mesh());
  // Texture coordinates that are an affine map of the place, and so are those of the pieces.
  const auto coordinates = [](const Vector3& at) { return Vector2(2 * at.x() + 1, at.x() - 3 * at.z()); };
  for (std::size_t t = 0; t < 2; ++t) {
    std::array<Vector2, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = coordinates(shape->mesh.corner(t, int(i)));
    shape->texture_coordinates.push_back(corners);
    shape->colours.push_back({world::Colour{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    shape->normals.push_back({Vector3::UnitY(), Vector3::UnitX(), Vector3::UnitZ()});
  }
  OperationRunner runner(world_of(shape));
  performed_both_ways(runner, R"({"op": "subdivide", "object": "thing", "levels": 2})");
  const MeshGeometry& now = mesh_of(runner);
  ASSERT_EQ(now.texture_coordinates.size(), 32U);
  ASSERT_EQ(now.normals.size(), 32U);
  ASSERT_EQ(now.colours.size(), 32U);
  for (std::size_t t = 0; t < 32; ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector2 expected = coordinates(now.mesh.corner(t, int(i)));
      EXPECT_LT((now.texture_coordinates[t][i] - expected).norm(), 1e-14);
      EXPECT_NEAR(now.normals[t][i].norm(), 1.0, 1e-15);
      const world::Colour& colour = now.colours[t][i];
      EXPECT_FLOAT_EQ(colour[0] + colour[1] + colour[2], 1.0F);
      // All three are the same weights of the corners.
      const Vector3 weights(colour[1], colour[0], colour[2]);
      EXPECT_LT((now.normals[t][i] - weights.normalized()).norm(), 1e-6);
    }
  }
}

TEST(RefineOperation, KeepsTheSurface) {
  const geometry::ControlMesh control{cube_mesh(), {{0, 1}, {1, 3}, {3, 2}}, {7}};
  OperationRunner runner(world_of_loop(control));
  performed_both_ways(runner, R"({"op": "refine", "object": "thing", "levels": 2})");
  const geometry::ControlMesh& finer = control_of(runner);
  ASSERT_EQ(finer.mesh.triangles.size(), 12U * 16);
  EXPECT_EQ(finer.creases.size(), 12U);
  const auto before = geometry::LoopSurface::create(control), after = geometry::LoopSurface::create(finer);
  ASSERT_TRUE(before && after);
  // The first piece of the first piece of a triangle is its corner of a quarter of the size.
  for (std::uint32_t t = 0; t < 12; ++t) {
    for (const auto& [u, v] : {std::pair(0.1, 0.2), std::pair(0.6, 0.3), std::pair(0.0, 1.0)}) {
      const auto one = (*before)->sample(t, u / 4, v / 4), other = (*after)->sample(16 * t, u, v);
      EXPECT_LT((one.point - other.point).norm(), 1e-13) << t;
      EXPECT_GT(one.normal.dot(other.normal), 1.0 - 1e-9) << t;
    }
  }
}

TEST(SmoothOperation, MakesALoopSurfaceWithTheCreasesAskedFor) {
  OperationRunner runner(world_of(cube_mesh()));
  performed_both_ways(runner, R"({"op": "smooth", "object": "thing"})");
  EXPECT_EQ(control_of(runner).mesh.positions, cube_mesh().positions);
  EXPECT_TRUE(control_of(runner).creases.empty());
  performed(runner, R"({"op": "undo"})");
  performed_both_ways(runner, R"({"op": "smooth", "object": "thing", "crease": 60})");
  EXPECT_EQ(control_of(runner).creases.size(), 12U);
  // A cube whose edges all stay sharp stays the cube.
  const auto surface = geometry::LoopSurface::create(control_of(runner));
  ASSERT_TRUE(surface) << surface.error().message;
  EXPECT_NEAR(geometry::signed_volume((*surface)->tessellate(3).value()), 8.0, 1e-9);
}

TEST(SmoothOperation, JoinsTrianglesThatOnlyTouch) {
  TriangleMesh soup;
  for (const TriangleMesh::Triangle& triangle : cube_mesh().triangles) {
    const auto first = std::uint32_t(soup.positions.size());
    for (const std::uint32_t v : triangle) soup.positions.push_back(cube_mesh().positions[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  OperationRunner runner(world_of(soup));
  performed(runner, R"({"op": "smooth", "object": "thing"})");
  const auto surface = geometry::LoopSurface::create(control_of(runner));
  ASSERT_TRUE(surface);
  EXPECT_TRUE((*surface)->closed());
}

TEST(MeshOperation, MakesTrianglesWithinTheTolerance) {
  OperationRunner runner(world_of(std::make_shared<world::PrimitiveGeometry>(geometry::Sphere{0.5})));
  const double sphere = std::numbers::pi / 6;
  performed_both_ways(runner, R"({"op": "mesh", "object": "thing", "tolerance": 1e-4})");
  EXPECT_NEAR(geometry::signed_volume(mesh_of(runner).mesh), sphere, 1e-3 * sphere);
  for (const Vector3& at : mesh_of(runner).mesh.positions) EXPECT_NEAR(at.norm(), 0.5, 1e-4 + 1e-12);
  EXPECT_EQ(refusal(runner, R"({"op": "mesh", "object": "thing"})"), "mesh: 'thing' is a mesh already");
  performed(runner, R"({"op": "undo"})");
  performed_both_ways(runner, R"({"op": "mesh", "object": "thing"})");
  EXPECT_NEAR(geometry::signed_volume(mesh_of(runner).mesh), sphere, 1e-2 * sphere);
  EXPECT_TRUE(geometry::analyse_topology(mesh_of(runner).mesh).report.closed);
}

TEST(MeshOperation, MakesTrianglesOfALoopSurface) {
  OperationRunner runner(world_of_loop({cube_mesh(), {}, {}}));
  performed_both_ways(runner, R"({"op": "mesh", "object": "thing"})");
  EXPECT_TRUE(geometry::analyse_topology(mesh_of(runner).mesh).report.closed);
}

struct BadCommand {
  const char* command;
  const char* because;  // a part of the sentence
};

TEST(VertexOperations, RefuseWhatMakesNoSense) {
  const BadCommand commands[] = {
      {R"("drag", "vertices": [8], "by": [0, 0, 1])", "vertex 8 is not there"},
      {R"("drag", "vertices": [1e15], "by": [0, 0, 1])", "is not there"},
      {R"("drag", "vertices": [-1], "by": [0, 0, 1])", "'vertices' must be 0 or more"},
      {R"("drag", "vertices": [0.5], "by": [0, 0, 1])", "'vertices' must be a list of whole numbers"},
      {R"("drag", "vertices": [], "by": [0, 0, 1])", "nothing is dragged"},
      {R"("drag", "by": [0, 0, 1])", "say what is dragged"},
      {R"("drag", "vertices": [0], "faces": [0], "by": [0, 0, 1])", "say what is dragged"},
      {R"("drag", "vertices": [0])", "'by' is missing"},
      {R"("drag", "vertices": [0], "by": [0, 0, 1e300])", "'by' must be between"},
      {R"("drag", "vertices": [0], "by": [0, 0])", "'by' must be three numbers"},
      {R"("drag", "vertices": [0], "by": [0, 0, 1], "radius": -1)", "'radius' must be between"},
      {R"("drag", "vertices": [0], "by": [0, 0, 1], "falloff": "bell")", "'falloff' must be one of"},
      {R"("drag", "edges": [[0, 8]], "by": [0, 0, 1])", "there are 8, counted from 0"},
      {R"("drag", "edges": [[0, 0.5]], "by": [0, 0, 1])", "'edges' names vertex 0.5"},
      {R"("drag", "edges": [[0, 7]], "by": [0, 0, 1])", "no edge goes from vertex 0 to vertex 7"},
      {R"("drag", "faces": [12], "by": [0, 0, 1])", "triangle 12 is not there"},
      {R"("drag", "near": [0, 0], "by": [0, 0, 1])", "'near' must be three numbers"},
      {R"("subdivide", "triangles": [12])", "triangle 12 is not there"},
      {R"("subdivide", "triangles": [])", "there is no triangle to subdivide"},
      {R"("subdivide", "levels": 0)", "'levels' must be between 1 and 12"},
      {R"("subdivide", "levels": 12)", "more than 20 million triangles"},
      {R"("subdivide", "levels": 1.5)", "'levels' must be a whole number"},
      {R"("refine")", "'thing' is a mesh and no Loop surface"},
      {R"("smooth", "crease": 200)", "'crease' must be between 0 and 180"},
      {R"("mesh")", "'thing' is a mesh already"},
      {R"("own-shape")", "'thing' has a shape of its own already"},
      {R"("drag", "vertice": [0], "by": [0, 0, 1])", "did you mean 'vertices'?"},
  };
  OperationRunner runner(world_of(cube_mesh()));
  for (const auto& [command, because] : commands) {
    const std::string why = refusal(runner, fmt::format(R"({{"object": "thing", "op": {}}})", command));
    EXPECT_NE(why.find(because), std::string::npos) << command << ": " << why;
  }
}

TEST(VertexOperations, SayWhatToDoWithShapesThatHaveNoVertices) {
  OperationRunner exact(world_of(world::box(1.0)));
  EXPECT_EQ(refusal(exact, R"({"op": "drag", "object": "thing", "vertices": [0], "by": [0, 0, 1]})"),
            "drag: 'thing' is an exact shape and has no vertices to move: perform 'mesh' first, which makes "
            "triangles of it, or say \"as_mesh\": true to do so in the same step");
  EXPECT_NE(refusal(exact, R"({"op": "subdivide", "object": "thing"})").find("perform 'mesh' first"),
            std::string::npos);
  performed_both_ways(exact, R"({"op": "subdivide", "object": "thing", "as_mesh": true})");
  EXPECT_EQ(mesh_of(exact).mesh.triangles.size(), 48U);
  OperationRunner endless(world_of(std::make_shared<world::PrimitiveGeometry>(geometry::Plane{})));
  EXPECT_NE(refusal(endless, R"({"op": "mesh", "object": "thing"})").find("A plane has no end"),
            std::string::npos);
  OperationRunner group(world_of(world::GeometryPointer()));
  EXPECT_NE(refusal(group, R"({"op": "drag", "object": "thing", "vertices": [0], "by": [0, 0, 1]})")
                .find("'thing' has no shape"),
            std::string::npos);
  OperationRunner loop(world_of_loop({cube_mesh(), {}, {}}));
  EXPECT_NE(refusal(loop, R"({"op": "smooth", "object": "thing"})").find("is a Loop surface already"),
            std::string::npos);
  EXPECT_NE(refusal(loop, R"({"op": "refine", "object": "thing", "levels": 12})").find("20000000 triangles"),
            std::string::npos);
}

TEST(VertexOperations, RefuseMeshesThatDoNotHoldTogether) {
  TriangleMesh broken = cube_mesh();
  broken.triangles[3][1] = 99;
  OperationRunner runner(world_of(broken));
  for (const char* operation : {R"("drag", "vertices": [0], "by": [0, 0, 1])", R"("subdivide")",
                                R"("smooth")", R"("ffd", "moves": [])"})
    EXPECT_NE(refusal(runner, fmt::format(R"({{"object": "thing", "op": {}}})", operation))
                  .find("names a vertex that is not there"),
              std::string::npos)
        << operation;
  OperationRunner empty(world_of(TriangleMesh()));
  EXPECT_NE(refusal(empty, R"({"object": "thing", "op": "drag", "near": [0, 0, 0], "by": [0, 0, 1]})"), "");
  EXPECT_NE(refusal(empty, R"({"object": "thing", "op": "subdivide"})"), "");
  EXPECT_NE(refusal(empty, R"({"object": "thing", "op": "smooth"})"), "");
  EXPECT_NE(refusal(empty, R"({"object": "thing", "op": "ffd", "moves": []})"), "");
}

}  // namespace
}  // namespace icome::interaction
