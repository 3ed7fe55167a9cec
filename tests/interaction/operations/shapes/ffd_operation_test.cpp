#include <fmt/format.h>

#include <cmath>
#include <map>

#include "base/random.h"
#include "geometry/mesh/mesh_topology.h"
#include "interaction/mesh_samples.h"

namespace icome::interaction {
namespace {

using base::Bounds;
using geometry::TriangleMesh;
using world::MeshGeometry;

double binomial(int n, int k) {
  double result = 1;
  for (int i = 1; i <= k; ++i) result = result * (n - k + i) / i;
  return result;
}
double bernstein(int n, int k, double t) { return binomial(n, k) * std::pow(1 - t, n - k) * std::pow(t, k); }

struct PointMove {
  std::array<int, 3> point;
  Vector3 by;
};

/// Equation 2 of Sederberg and Parry with control points at rest but for the moves; the points at rest add up
/// to the place itself.
Vector3 by_the_paper(const Vector3& place, const Bounds& box, const std::array<int, 3>& cells,
                     const std::vector<PointMove>& moves) {
  const Vector3 stu = (place - box.min()).cwiseQuotient(box.sizes());
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i <= cells[0]; ++i) {
    for (int j = 0; j <= cells[1]; ++j) {
      for (int k = 0; k <= cells[2]; ++k) {
        Vector3 point = box.min() + box.sizes().cwiseProduct(Vector3(
                                        double(i) / cells[0], double(j) / cells[1], double(k) / cells[2]));
        for (const PointMove& move : moves)
          if (move.point == std::array{i, j, k}) point += move.by;
        sum += bernstein(cells[0], i, stu.x()) * bernstein(cells[1], j, stu.y()) *
               bernstein(cells[2], k, stu.z()) * point;
      }
    }
  }
  return sum;
}

std::string written(const Vector3& v) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z());
}

std::string written(const std::vector<PointMove>& moves) {
  std::string text;
  for (const auto& [point, by] : moves)
    text += fmt::format(R"({}{{"point": [{}, {}, {}], "by": {}}})", text.empty() ? "" : ", ", point[0],
                        point[1], point[2], written(by));
  return "[" + text + "]";
}

/// All control points of a box, carried by an affine map.
std::string carried_points(const Bounds& box, const std::array<int, 3>& cells, const base::Affine3& map) {
  std::string text;
  for (int i = 0; i <= cells[0]; ++i) {
    for (int j = 0; j <= cells[1]; ++j) {
      for (int k = 0; k <= cells[2]; ++k) {
        const Vector3 share(double(i) / cells[0], double(j) / cells[1], double(k) / cells[2]);
        text += (text.empty() ? "" : ", ") +
                written(Vector3(map * (box.min() + box.sizes().cwiseProduct(share))));
      }
    }
  }
  return "[" + text + "]";
}

base::Affine3 some_map() {
  base::Affine3 map = base::Affine3::Identity();
  map.translate(Vector3(0.3, -1, 2));
  map.rotate(Eigen::AngleAxisd(1.1, Vector3(1, 2, -1).normalized()));
  map.scale(Vector3(0.5, 2, 1.5));
  map.linear().col(0) += 0.4 * map.linear().col(1);
  return map;
}

TEST(FfdOperation, MakesTheSquareOfTheThesisASheet) {
  OperationRunner runner(world_of(square_mesh(0.3)));
  performed(runner, R"({"op": "subdivide", "object": "thing", "levels": 4})");
  const TriangleMesh flat = mesh_of(runner).mesh;
  ASSERT_EQ(flat.triangles.size(), 512U);
  ASSERT_EQ(flat.positions.size(), 289U);
  const std::array<int, 3> cells = {3, 1, 2};
  const std::vector<PointMove> moves = {{{1, 1, 0}, {0, 0.1, 0.02}},
                                        {{2, 0, 2}, {0.01, -0.2, 0}},
                                        {{3, 1, 1}, {-0.05, 0.15, 0}},
                                        {{0, 0, 0}, {0, 0.08, 0}}};
  performed_both_ways(
      runner,
      fmt::format(R"({{"op": "ffd", "object": "thing", "cells": [3, 1, 2], "moves": {}}})", written(moves)));
  // The square is flat along y: its box is a tenth as thick as it is wide, with the square in the middle.
  const Bounds box(Vector3(0, -0.015, -0.3), Vector3(0.3, 0.015, 0));
  const TriangleMesh& sheet = mesh_of(runner).mesh;
  EXPECT_EQ(sheet.triangles, flat.triangles);
  double highest = 0;
  for (std::size_t v = 0; v < flat.positions.size(); ++v) {
    EXPECT_LT((sheet.positions[v] - by_the_paper(flat.positions[v], box, cells, moves)).norm(), 1e-15) << v;
    highest = std::max(highest, sheet.positions[v].y());
  }
  EXPECT_GT(highest, 0.02);
}

TEST(FfdOperation, TakesEachVertexAlongWhenAllPointsGoTheSameWay) {
  // Partition of unity: the shares of a vertex add up to 1.
  OperationRunner runner(world_of(cube_mesh()));
  performed(runner, R"({"op": "subdivide", "object": "thing", "levels": 2})");
  const TriangleMesh before = mesh_of(runner).mesh;
  std::vector<PointMove> moves;
  const Vector3 by(0.25, -3, 0.5);
  for (int i = 0; i <= 2; ++i)
    for (int j = 0; j <= 3; ++j)
      for (int k = 0; k <= 1; ++k) moves.push_back({{i, j, k}, by});
  performed_both_ways(
      runner,
      fmt::format(R"({{"op": "ffd", "object": "thing", "cells": [2, 3, 1], "moves": {}}})", written(moves)));
  for (std::size_t v = 0; v < before.positions.size(); ++v)
    EXPECT_LT((mesh_of(runner).mesh.positions[v] - before.positions[v] - by).norm(), 1e-14);
}

TEST(FfdOperation, ChangesNothingWhenNoPointGoesAnywhere) {
  auto shape = std::make_shared<MeshGeometry>(cube_mesh());
  for (Vector3& position : shape->mesh.positions) position = position / 3 + Vector3(0.1, 0.7, 0);
  shape->normals = flat_normals(shape->mesh);
  OperationRunner runner(world_of(shape));
  const std::uint64_t before = hash(runner.world());
  performed(runner, R"({"op": "ffd", "object": "thing", "cells": [3, 4, 5], "moves": []})");
  EXPECT_EQ(hash(runner.world()), before);
  performed(runner, R"({"op": "ffd", "object": "thing", "moves": [{"point": [1, 1, 1], "by": [0, 0, 0]}]})");
  EXPECT_EQ(hash(runner.world()), before);
}

TEST(FfdOperation, MapsEveryVertexAffinelyWhenAllPointsGoSo) {
  OperationRunner runner(world_of(cube_mesh()));
  performed(runner, R"({"op": "subdivide", "object": "thing", "levels": 2})");
  const TriangleMesh before = mesh_of(runner).mesh;
  const std::array<int, 3> cells = {2, 1, 3};
  performed_both_ways(runner,
                      fmt::format(R"({{"op": "ffd", "object": "thing", "cells": [2, 1, 3], "points": {}}})",
                                  carried_points(geometry::bounds(before), cells, some_map())));
  const TriangleMesh& after = mesh_of(runner).mesh;
  for (std::size_t v = 0; v < before.positions.size(); ++v)
    EXPECT_LT((after.positions[v] - some_map() * before.positions[v]).norm(), 1e-13);
  EXPECT_NEAR(geometry::signed_volume(after), 8 * some_map().linear().determinant(), 1e-12);
  EXPECT_TRUE(geometry::analyse_topology(after).report.closed);
}

TEST(FfdOperation, TurnsCornerNormalsWithARigidMotion) {
  auto shape = std::make_shared<MeshGeometry>(cube_mesh());
  base::Random random(5);
  shape->normals = flat_normals(shape->mesh);
  for (auto& corners : shape->normals)  // as an author may tilt them
    for (Vector3& normal : corners) normal = (normal + 0.3 * random.direction()).normalized();
  base::Affine3 turn = base::Affine3::Identity();
  turn.rotate(Eigen::AngleAxisd(2.0, Vector3(1, 1, -2).normalized()));
  OperationRunner runner(world_of(shape));
  performed_both_ways(runner,
                      fmt::format(R"({{"op": "ffd", "object": "thing", "cells": [1, 1, 1], "points": {}}})",
                                  carried_points(geometry::bounds(shape->mesh), {1, 1, 1}, turn)));
  for (std::size_t t = 0; t < 12; ++t)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_LT((mesh_of(runner).normals[t][i] - turn.linear() * shape->normals[t][i]).norm(), 1e-14);
}

TEST(FfdOperation, MovesTheControlMeshOfALoopSurface) {
  OperationRunner runner(world_of_loop({cube_mesh(), {{0, 1}}, {}}));
  const std::vector<PointMove> moves = {{{1, 2, 1}, {0, 1, 0}}, {{0, 0, 2}, {0.5, 0, 0}}};
  performed_both_ways(runner,
                      fmt::format(R"({{"op": "ffd", "object": "thing", "moves": {}}})", written(moves)));
  const Bounds box(Vector3(-1, -1, -1), Vector3(1, 1, 1));
  for (std::size_t v = 0; v < 8; ++v)
    EXPECT_LT(
        (control_of(runner).mesh.positions[v] - by_the_paper(cube_mesh().positions[v], box, {2, 2, 2}, moves))
            .norm(),
        1e-15);
  EXPECT_EQ(control_of(runner).creases.size(), 1U);
}

TEST(FfdOperation, MovesOnlyWhatIsSelectedAndInTheBox) {
  const auto heights = [](const char* where) {
    OperationRunner runner(world_of(square_mesh()));
    performed_both_ways(runner,
                        fmt::format(R"({{"op": "ffd", "object": "thing", "cells": [1, 1, 1], "moves": [
        {{"point": [0, 0, 0], "by": [0, 1, 0]}}, {{"point": [0, 1, 0], "by": [0, 1, 0]}}], {}}})",
                                    where));
    std::vector<double> result;
    for (const Vector3& at : mesh_of(runner).mesh.positions) result.push_back(at.y());
    return result;
  };
  EXPECT_EQ(heights(R"("alone": false)"), (std::vector<double>{0, 0, 0, 1}));
  EXPECT_EQ(heights(R"("vertices": [0, 1, 0])"),
            (std::vector<double>{0.5, 0, 0, 0}));  // in the middle of a box round those two
  EXPECT_EQ(heights(R"("from": [0, 0, -1], "to": [2, 0, -0.5])"), (std::vector<double>{0, 0, 0.5, 1}));
  EXPECT_EQ(heights(R"("from": [5, 5, 5], "to": [6, 6, 6])"), (std::vector<double>{0, 0, 0, 0}));
  EXPECT_EQ(heights(R"("vertices": [2], "from": [0, 0, -1], "to": [2, 0, -0.5])"),
            (std::vector<double>{0, 0, 0.5, 0}));
}

TEST(FfdOperation, MakesTrianglesOfExactShapesOnlyWhenAsked) {
  OperationRunner runner(world_of(std::make_shared<world::PrimitiveGeometry>(geometry::Sphere{1.0})));
  const char* stretched = R"({"op": "ffd", "object": "thing", "cells": [1, 1, 1], "moves": [
      {"point": [0, 1, 0], "by": [0, 2, 0]}, {"point": [0, 1, 1], "by": [0, 2, 0]},
      {"point": [1, 1, 0], "by": [0, 2, 0]}, {"point": [1, 1, 1], "by": [0, 2, 0]}] %})";
  const auto with = [&](const char* more) {
    std::string command = stretched;
    return command.replace(command.find('%'), 1, more);
  };
  EXPECT_NE(refusal(runner, with("")).find("perform 'mesh' first"), std::string::npos);
  performed_both_ways(runner, with(R"(, "as_mesh": true)"));
  const TriangleMesh& mesh = mesh_of(runner).mesh;
  EXPECT_NEAR(geometry::bounds(mesh).sizes().y(), 4.0, 0.02);  // twice as high
  EXPECT_NEAR(geometry::signed_volume(mesh), 2 * 4.18879, 0.1);
  EXPECT_TRUE(geometry::analyse_topology(mesh).report.closed);
}

TEST(FfdOperation, RefusesLatticesThatMakeNoSense) {
  struct BadLattice {
    const char* said;
    const char* because;
  };
  const BadLattice lattices[] = {
      {R"("cells": [2, 2, 2])", "say where control points go"},
      {R"("moves": [], "points": [])", "say where control points go"},
      {R"("cells": [2, 2], "moves": [])", "'cells' must be three numbers"},
      {R"("cells": [0, 2, 2], "moves": [])", "'cells' must be between 1 and"},
      {R"("cells": [40, 40, 40], "moves": [])", "32768 control points at most"},
      {R"("cells": [32768, 32768, 32768], "moves": [])", "32768 control points at most"},
      {R"("cells": [1e300, 1, 1], "moves": [])", "'cells' must be"},
      {R"("moves": [{"point": [0, 0, 3], "by": [0, 0, 1]}])", "'point' must be [i, j, k]"},
      {R"("moves": [{"point": [0, 0], "by": [0, 0, 1]}])", "'moves', number 1: 'point'"},
      {R"("moves": [{"point": [0, 0, 1e12], "by": [0, 0, 1]}])", "'point' must be [i, j, k]"},
      {R"("moves": [{"point": [0, 0, 0]}])", "'by' is missing"},
      {R"("moves": [{"point": [0, 0, 0], "by": [0, 0, 1e200]}])", "'by' must be between"},
      {R"("points": [[0, 0, 0]])", "does not have 1 control points"},
      {R"("moves": [], "from": [0, 0, 0])", "say both corners"},
      {R"("moves": [], "from": [0, 0, 1], "to": [1, 1, 0])", "'from' must not be beyond 'to'"},
      {R"("moves": [], "from": [1, 1, 1], "to": [1, 1, 1])", "has no size"},
      {R"("moves": [], "vertices": [])", "'vertices' is empty"},
      {R"("moves": [], "vertices": [4])", "vertex 4 is not there"},
      {R"("moves": [], "vertices": [3])", "has no size"},
  };
  OperationRunner runner(world_of(square_mesh()));
  for (const auto& [said, because] : lattices) {
    const std::string why = refusal(runner, fmt::format(R"({{"op": "ffd", "object": "thing", {}}})", said));
    EXPECT_NE(why.find(because), std::string::npos) << said << ": " << why;
  }
}

TEST(FfdOperation, GivesTheSameWorldWhenItsCommandsAreSaidAgain) {
  base::Random random(9);
  std::vector<std::string> commands;
  for (int i = 0; i < 40; ++i) {
    const auto number = [&] { return random.uniform() - 0.5; };
    const Vector3 by(number(), number(), number());
    switch (random.index(4)) {
      case 0:
        commands.push_back(fmt::format(
            R"({{"op": "drag", "object": "thing", "near": {}, "by": {}, "radius": {}, "alone": true}})",
            written(Vector3(number(), number(), number())), written(by), random.uniform()));
        break;
      case 1:
        commands.push_back(fmt::format(R"({{"op": "subdivide", "object": "thing", "triangles": [{}, {}]}})",
                                       random.index(12), random.index(12)));
        break;
      default:
        commands.push_back(fmt::format(R"({{"op": "ffd", "object": "thing", "moves": {}}})",
                                       written({{{1, int(random.index(3)), 2}, by}})));
    }
  }
  auto shape = std::make_shared<MeshGeometry>(cube_mesh());
  shape->normals = flat_normals(shape->mesh);
  OperationRunner once(world_of(shape)), again(world_of(shape));
  const std::uint64_t start = hash(once.world());
  for (const std::string& command : commands) performed(once, command);
  for (const std::string& command : commands) performed(again, command);
  EXPECT_EQ(hash(once.world()), hash(again.world()));
  EXPECT_NE(hash(once.world()), start);
  for (std::size_t i = 0; i < commands.size(); ++i) performed(again, R"({"op": "undo"})");
  EXPECT_EQ(hash(again.world()), start);
}

/// Corners of cubes in the world's frame.
std::vector<Vector3> standing_corners(const OperationRunner& runner, std::string_view name) {
  const world::World& world = runner.world();
  const base::Affine3 place = world::world_from_object(world, named_object(world, name).value());
  std::vector<Vector3> corners;
  for (const Vector3& corner : mesh_of(runner, name).mesh.positions) corners.emplace_back(place * corner);
  return corners;
}

TEST(FfdOperation, DeformsSeveralObjectsByOneLatticeInTheWorld) {
  OperationRunner runner({});
  performed(runner, R"({"op": "create", "shape": "group", "name": "both", "at": [0, 1, 0]})");
  performed(runner, R"({"op": "create", "shape": "cube", "name": "one", "parent": "both"})");
  performed(
      runner,
      R"({"op": "create", "shape": "box", "name": "other", "size": [0.1, 0.3, 0.2], "at": [0.4, 0.2, 0.1],
                        "turn": [10, 20, 30], "scale": [1, 2, 0.5], "parent": "both"})");
  for (const char* name : {"one", "other"})
    performed(runner, fmt::format(R"({{"op": "mesh", "object": "{}"}})", name));
  Bounds all;
  std::map<std::string, std::vector<Vector3>> before;
  for (const std::string name : {"one", "other"}) {
    before[name] = standing_corners(runner, name);
    for (const Vector3& corner : before[name]) all.extend(corner);
  }
  const std::vector<PointMove> moves = {{{1, 1, 1}, {0.1, 0.2, -0.1}}, {{2, 1, 0}, {0, -0.3, 0.2}}};
  const std::string said = fmt::format(R"("cells": [2, 1, 1], "moves": {}}})", written(moves));
  performed_both_ways(runner, R"({"op": "ffd", "object": ["one", "other"], )" + said);
  for (const std::string name : {"one", "other"}) {
    const std::vector<Vector3> now = standing_corners(runner, name);
    for (std::size_t i = 0; i < now.size(); ++i)
      EXPECT_LT((now[i] - by_the_paper(before[name][i], all, {2, 1, 1}, moves)).norm(), 1e-12) << name;
  }
  performed(runner, R"({"op": "undo"})");
  performed(runner, R"({"op": "ffd", "object": "both", )" + said);  // all below it
  EXPECT_LT(
      (standing_corners(runner, "one")[0] - by_the_paper(before["one"][0], all, {2, 1, 1}, moves)).norm(),
      1e-12);
}

TEST(FfdOperation, DoesNotPullASharedShapeToTwoPlaces) {
  OperationRunner runner({});
  performed(runner, R"({"op": "create", "shape": "cube", "name": "one"})");
  performed(runner, R"({"op": "mesh", "object": "one"})");
  performed(runner, R"({"op": "clone", "object": "one", "name": "other", "by": [0.3, 0, 0]})");
  const std::string said = R"({"op": "ffd", "object": ["one", "other"], "cells": [1, 1, 1],
                              "moves": [{"point": [1, 1, 1], "by": [0.1, 0, 0]}])";
  EXPECT_NE(refusal(runner, said + "}").find("'one' and 'other' share a shape"), std::string::npos);
  const std::vector<Vector3> before = standing_corners(runner, "one");
  performed_both_ways(runner, said + R"(, "alone": true})");
  EXPECT_EQ(runner.world().geometries().size(), 2U);
  // The lattice's corner (1, 1, 1) is the other's: the nearer one follows less.
  EXPECT_LT((standing_corners(runner, "one").back() - before.back()).norm(), 0.03);
  EXPECT_NE(refusal(runner, R"({"op": "ffd", "object": ["one", "other"], "vertices": [0], "moves": []})")
                .find("of one object"),
            std::string::npos);
}

TEST(FfdOperation, TellsOfABoxWithNothingInIt) {
  OperationRunner runner(world_of(cube_mesh()));
  const std::string said =
      R"({"op": "ffd", "object": "thing", "moves": [{"point": [0, 0, 0], "by": [0, 1, 0]}])";
  const std::uint64_t before = hash(runner.world());
  EXPECT_EQ(performed(runner, said + R"(, "from": [-0.5, -0.5, -0.5], "to": [0.5, 0.5, 0.5]})").note,
            "nothing is deformed, as no vertex lies in the box from [-0.5, -0.5, -0.5] to [0.5, 0.5, 0.5]");
  EXPECT_EQ(hash(runner.world()), before);
  EXPECT_EQ(performed(runner, said + R"(, "from": [-1, -1, -1], "to": [0.5, 0.5, 0.5]})").note, "");
  performed(runner, R"({"op": "copy", "object": "thing", "name": "other", "by": [5, 0, 0]})");
  const std::string both =
      R"({"op": "ffd", "object": ["thing", "other"], "moves": [{"point": [0, 0, 0], "by": [0, 0.1, 0]}])";
  EXPECT_EQ(performed(runner, both + R"(, "from": [2, -1, -1], "to": [3, 1, 1]})").note,
            "nothing is deformed, as no vertex lies in the box from [2, -1, -1] to [3, 1, 1]");
  EXPECT_EQ(performed(runner, both + R"(, "from": [2, -1, -1], "to": [4, 1, 1]})").note, "");
}

}  // namespace
}  // namespace icome::interaction
