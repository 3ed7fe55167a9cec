#include "geometry/loop/loop_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <sstream>
#include <string>

#include "geometry/loop_reference.h"
#include "geometry/mesh/mesh_topology.h"
#include "geometry/mesh/polygon_triangulation.h"
#include "geometry/meshes.h"
#include "geometry/tree/triangle_tree.h"
#include "places.h"
#include "repeats.h"

namespace icome::geometry {
namespace loop_surface_test {
namespace {

namespace ref = loop_reference;

std::string refusal(const ControlMesh& control) {
  const auto surface = LoopSurface::create(control);
  return surface ? "" : surface.error().message;
}

TEST(LoopSurface, RefusesWhatIsNoSurface) {
  const TriangleMesh box = unit_box();
  EXPECT_NE(refusal({}).find("no triangles"), std::string::npos);
  ControlMesh bad{box, {}, {}};
  bad.mesh.positions[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(bad).find("vertex 3"), std::string::npos);
  bad = {box, {}, {}};
  bad.mesh.triangles[2][1] = 99;
  EXPECT_NE(refusal(bad).find("triangle 2 names vertex 99"), std::string::npos);
  bad = {box, {}, {}};
  bad.mesh.triangles[5][1] = bad.mesh.triangles[5][0];
  EXPECT_NE(refusal(bad).find("triangle 5"), std::string::npos);
  bad = {box, {}, {}};
  bad.mesh.positions.emplace_back(5.0, 5.0, 5.0);
  bad.mesh.triangles.push_back({0, 2, 8});
  EXPECT_NE(refusal(bad).find("3 triangles"), std::string::npos);
  EXPECT_NE(refusal({box, {{0, 7}}, {}}).find("not an edge"), std::string::npos);
  EXPECT_NE(refusal({box, {{0, 70}}, {}}).find("vertex 70"), std::string::npos);
  EXPECT_NE(refusal({box, {}, {8}}).find("vertex 8"), std::string::npos);
  bad = {box, {}, {}};
  for (Vector3& p : bad.mesh.positions) p.setOnes();
  EXPECT_NE(refusal(bad).find("no extent"), std::string::npos);
  const TriangleMesh pillow{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
  EXPECT_NE(refusal({pillow, {}, {}}).find("back to back"), std::string::npos);
}

TEST(LoopSurface, TakesWhatIsOnlyUnusual) {
  ControlMesh control{unit_box(), {}, {}};
  control.mesh.positions.emplace_back(50.0, 0.0, 0.0);  // no triangle has it
  auto surface = *LoopSurface::create(control);
  EXPECT_TRUE(surface->closed());
  EXPECT_TRUE(surface->inside({0.5, 0.5, 0.5}));
  EXPECT_LT(surface->bounds().max().x(), 1.0);

  // A band with half a turn has no inside; a triangle alone is a sheet.
  surface = *LoopSurface::create({ring(9, true), {}, {}});
  EXPECT_FALSE(surface->closed());
  EXPECT_FALSE(surface->inside({0.0, 0.0, 0.0}));
  EXPECT_FALSE(surface->way_out({0.0, 0.0, 0.0}, 0.0).has_value());
  EXPECT_TRUE(surface->tessellate(3).has_value());
  surface = *LoopSurface::create({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, {}, {}});
  const auto middle = surface->sample(0, 1.0 / 3.0, 1.0 / 3.0);
  EXPECT_LT((middle.point - Vector3(1.0 / 3.0, 1.0 / 3.0, 0.0)).norm(), 1e-15);
  EXPECT_LT((middle.normal - Vector3::UnitZ()).norm(), 1e-15);

  // Two boxes that touch at a vertex: each stays closed, the vertex in place.
  const TriangleMesh pair = together(unit_box(), box_mesh({1, 1, 1}, {2, 2, 2}));
  ControlMesh joined{pair, {}, {}};
  for (auto& t : joined.mesh.triangles) {
    for (auto& v : t) v = v == 8 ? 7 : v;
  }
  surface = *LoopSurface::create(joined);
  EXPECT_TRUE(surface->closed());
  EXPECT_TRUE(surface->inside({0.5, 0.5, 0.5}));
  EXPECT_TRUE(surface->inside({1.5, 1.5, 1.5}));
  EXPECT_FALSE(surface->inside({1.5, 0.5, 0.5}));
}

TEST(LoopSurface, PointsAndNormalsAreFiniteOnDegenerateShapes) {
  ControlMesh flat{unit_box(), {}, {}};
  for (Vector3& p : flat.mesh.positions) p.z() = 0.0;
  ControlMesh needle{unit_box(), {}, {}};
  for (Vector3& p : needle.mesh.positions) p.x() = p.y() = 0.0;
  for (const ControlMesh& control : {flat, needle}) {
    const auto surface = *LoopSurface::create(control);
    base::Random random(1);
    for (int trial = 0; trial < 500; ++trial) {
      const auto face = std::uint32_t(random.index(12));
      const auto sample = surface->sample(face, random.uniform(0.0, 0.5), random.uniform(0.0, 0.5));
      EXPECT_TRUE(sample.point.allFinite());
      EXPECT_NEAR(sample.normal.norm(), 1.0, 1e-6);
      const Vector3 start = sample.point + 0.1 * random.direction();
      const auto piece = std::uint32_t(random.index(48));
      EXPECT_TRUE(surface->nearest_local({{}, {}, piece, 0.3, 0.3}, start, 0.0).point.allFinite());
      const auto hit = surface->first_hit(piece, start, 2.0 * (sample.point - start), false, 0.0, 1e-11);
      if (hit) {
        EXPECT_TRUE(hit->place.point.allFinite());
      }
    }
  }
}

TEST(LoopSurface, MetresAndMillimetresBehaveAlike) {
  const ControlMesh metres = ref::torn(ref::wild_ball(1, 30, 0.1, 8), 0.1, 0.1, 0.0, 8);
  ControlMesh small = metres;
  for (Vector3& p : small.mesh.positions) p *= 1e-3;
  const auto one = *LoopSurface::create(metres), other = *LoopSurface::create(small);
  base::Random random(8);
  for (int trial = 0; trial < 2000; ++trial) {
    const auto piece = std::uint32_t(random.index(4 * metres.mesh.triangles.size()));
    const SurfacePlace from{{}, {}, piece, random.uniform(0.0, 0.5), random.uniform(0.0, 0.5)};
    const Vector3 goal = one->nearest_local(from, Vector3::Zero(), 0.0).point + 0.05 * random.direction();
    const SurfacePlace a = one->nearest_local(from, goal, 0.0);
    const SurfacePlace b = other->nearest_local({{}, {}, a.piece, a.u, a.v}, 1e-3 * goal, 0.0);
    EXPECT_LT((1e-3 * a.point - b.point).norm(), 1e-14);
    const Vector3 start = a.point + 0.1 * random.direction(), step = 0.2 * random.direction();
    const auto c = one->first_hit(a.piece, start, step, false, 0.0, 1e-11);
    const auto d = other->first_hit(a.piece, 1e-3 * start, 1e-3 * step, false, 0.0, 1e-14);
    ASSERT_EQ(c.has_value(), d.has_value());
    if (c) {
      EXPECT_NEAR(c->t, d->t, 1e-9);
    }
  }
}

/// Positions and faces of an OBJ file.
TriangleMesh read_obj(const std::filesystem::path& path) {
  TriangleMesh mesh;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      Vector3 p;
      words >> p.x() >> p.y() >> p.z();
      mesh.positions.push_back(p);
    } else if (word == "f") {
      std::vector<std::uint32_t> corners;
      while (words >> word) corners.push_back(std::uint32_t(std::stoul(word) - 1));
      std::vector<Vector3> polygon;
      for (const std::uint32_t v : corners) polygon.push_back(mesh.positions[v]);
      std::vector<std::array<std::uint32_t, 3>> parts;
      triangulate_polygon(polygon, parts);
      for (const auto& part : parts) {
        mesh.triangles.push_back({corners[part[0]], corners[part[1]], corners[part[2]]});
      }
    }
  }
  return mesh;
}

TEST(LoopSurface, TakesRealControlMeshes) {
  const std::filesystem::path folder = places::shared_data() / "meshes" / "control";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
  for (const std::string name : {"cow", "spot", "suzanne", "cat_head", "woody", "dodecahedron_poly"}) {
    SCOPED_TRACE(name);
    const ControlMesh control{read_obj(folder / (name + ".obj")), {}, {}};
    const auto surface = LoopSurface::create(control);
    ASSERT_TRUE(surface.has_value()) << surface.error().message;
    const MeshReport report = analyse_topology(control.mesh).report;
    EXPECT_EQ((*surface)->closed(), report.closed && report.inconsistent_edges == 0);
    const auto mesh = (*surface)->tessellate(2);
    ASSERT_TRUE(mesh.has_value());
    const TriangleTree tree(*mesh);
    const Bounds box = (*surface)->bounds();
    const double size = box.diagonal().norm();
    for (const Vector3& p : mesh->positions) ASSERT_TRUE(p.allFinite());
    base::Random random(1);
    int agreed = 0, asked = 0;
    for (int trial = 0; trial < repeats(300) && (*surface)->closed(); ++trial) {
      const Vector3 p =
          box.min() +
          Vector3(random.uniform(), random.uniform(), random.uniform()).cwiseProduct(box.diagonal());
      const auto nearest = tree.nearest(p);
      if (!nearest || nearest->parameter < 0.01 * size) continue;
      ++asked;
      agreed += (*surface)->inside(p) == tree.encloses(p);
    }
    EXPECT_EQ(agreed, asked);
    EXPECT_LT(double((*surface)->bytes()), 4e6 + 1500.0 * double(control.mesh.triangles.size()));
  }
}

}  // namespace
}  // namespace loop_surface_test
}  // namespace icome::geometry
