// Where a tip is put that begins inside solids, against brute force and closed forms.
#include "haptics/contact/place_outside.h"

#include <gtest/gtest.h>

#include <numbers>

#include "files/mesh/mesh_reader.h"
#include "haptics/contact_world.h"
#include "places.h"

namespace icome::haptics {
namespace {

const ContactRegion::Frame kPointTip{Vector3::Zero()};

/// How often the mesh winds around the point, by the solid angles of all triangles (van Oosterom and Strackee
/// 1983).
double solid_angle_winding(const TriangleMesh& mesh, const Vector3& point) {
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3 a = mesh.corner(t, 0) - point, b = mesh.corner(t, 1) - point, c = mesh.corner(t, 2) - point;
    sum += std::atan2(a.dot(b.cross(c)), a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                             b.dot(c) * a.norm() + c.dot(a) * b.norm());
  }
  return sum / (2.0 * std::numbers::pi);
}

/// A gear in the x-y plane: a disc with teeth that are wedges; closed.
struct Gear {
  int teeth;
  double root, tip, height;  // m

  double radius(double angle) const {
    const double part = angle * teeth / (2.0 * std::numbers::pi);
    const double off = std::abs(2.0 * (part - std::floor(part)) - 1.0);  // 1 in a gap, 0 on a tooth
    return tip + off * (root - tip);
  }
  TriangleMesh mesh() const {
    std::vector<base::Vector2> outline;
    std::vector<TriangleMesh::Triangle> fans;
    const int count = 2 * teeth;
    for (int i = 0; i < count; ++i) {
      const double angle = std::numbers::pi * i / teeth;
      outline.push_back(radius(angle) * base::Vector2(std::cos(angle), std::sin(angle)));
    }
    outline.push_back(base::Vector2::Zero());
    const auto middle = std::uint32_t(count);
    TriangleMesh mesh;
    for (const double z : {-0.5 * height, 0.5 * height}) {
      for (const base::Vector2& p : outline) mesh.positions.emplace_back(p.x(), p.y(), z);
    }
    const std::uint32_t above = middle + 1;
    for (std::uint32_t i = 0; i < middle; ++i) {
      const std::uint32_t next = (i + 1) % middle;
      mesh.triangles.push_back({middle, next, i});
      mesh.triangles.push_back({middle + above, i + above, next + above});
      mesh.triangles.push_back({i, next, next + above});
      mesh.triangles.push_back({i, next + above, i + above});
    }
    return mesh;
  }
};

Vector3 random_place(Random& random, const Bounds& box) {
  Vector3 place;
  for (int axis = 0; axis < 3; ++axis) place[axis] = random.uniform(box.min()[axis], box.max()[axis]);
  return place;
}

TEST(PlaceOutside, OfScansAndPartsIsTheNearestPlaceOfTheirSurface) {
  int meshes = 0;
  for (const char* name :
       {"control/cow.obj", "cad/fandisk.obj", "cad/20mm-xyz-cube.stl", "cad/angle_block.STL",
        "boolean/Cray_left.obj", "boolean/Generic_Twin_7863.1.t0_left.obj"}) {
    const auto path = places::shared_data() / "meshes" / name;
    if (!std::filesystem::exists(path)) continue;
    SCOPED_TRACE(name);
    files::ReadOptions how;
    how.fit = 0.1;
    auto loaded = files::read_mesh(path, how);
    ASSERT_TRUE(loaded);
    if (!loaded->repair.surface.closed) continue;
    ++meshes;
    const MeshPointer mesh = shared(std::move(loaded->mesh));
    const ScenePointer scene = HapticScene::compile({object(1, shape_of(mesh))});
    Random random(11);
    int begun_inside = 0;
    for (int i = 0; i < repeats(200); ++i) {
      const std::size_t t = random.index(mesh->triangles.size());
      const Vector3 foot = (mesh->corner(t, 0) + mesh->corner(t, 1) + mesh->corner(t, 2)) / 3.0;
      const Vector3 start = foot + 0.1 * std::pow(10.0, random.uniform(-6.0, -1.0)) * random.direction();
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < mesh->triangles.size(); ++k) {
        const geometry::Corners corners{mesh->corner(k, 0), mesh->corner(k, 1), mesh->corner(k, 2)};
        nearest = std::min(nearest, (geometry::nearest_point(corners, start) - start).norm());
      }
      const bool inside = solid_angle_winding(*mesh, start) > 0.5;
      const auto free = place_outside(*scene, kPointTip, start);
      ASSERT_EQ(free.has_value(), inside) << i << ", " << nearest << " m from the surface";
      if (!free) continue;
      ++begun_inside;
      EXPECT_LT(solid_angle_winding(*mesh, *free), 0.6) << i;  // on the surface it is a half
      EXPECT_LT((*free - start).norm(), nearest * (1.0 + 1e-6) + 1e-9) << i;
    }
    EXPECT_GT(begun_inside, repeats(200) / 20);
  }
  if (meshes == 0) GTEST_SKIP() << "the shared meshes are not there";
}

/// Two gears whose teeth reach into each other, by more than there is room for.
TEST(PlaceOutside, OfGearsIsInNeither) {
  const Gear gear{12, 0.040, 0.050, 0.010};
  const MeshPointer mesh = shared(gear.mesh());
  for (const double apart : {0.092, 0.0899, 0.085, 0.08}) {
    Pose second = translation(apart, 0.0, 0.0);
    second.linear() = Eigen::AngleAxisd(std::numbers::pi / 12, Vector3::UnitZ()).toRotationMatrix();
    const ScenePointer scene =
        HapticScene::compile({object(1, shape_of(mesh)), object(2, shape_of(mesh), second)});
    const auto held = [&](const Vector3& place) {
      return solid_angle_winding(*mesh, place) > 0.75 ||
             solid_angle_winding(*mesh, second.inverse() * place) > 0.75;
    };
    Random random(12);
    const Bounds meeting(Vector3(0.035, -0.03, -0.005), Vector3(apart - 0.035, 0.03, 0.005));
    int begun_inside = 0;
    for (int i = 0; i < repeats(2000); ++i) {
      const Vector3 start = random_place(random, meeting);
      const auto free = place_outside(*scene, kPointTip, start);
      ASSERT_EQ(free.has_value(), held(start)) << i;
      if (!free) continue;
      ++begun_inside;
      EXPECT_FALSE(held(*free)) << apart << ", " << i << ": " << start.transpose() << " to "
                                << free->transpose();
      // Their flat sides are never farther.
      EXPECT_LT((*free - start).norm(), 0.006) << i;
    }
    EXPECT_GT(begun_inside, repeats(2000) / 4);
  }
}

TEST(PlaceOutside, OfBlocksThatTouchLeadsOutOfAll) {
  // A row of three cubes of 20 mm that touch, in a tray that they stand in by 1 mm.
  const auto cube = shape_of(primitive("box:0.02x0.02x0.02"));
  std::vector<HapticObject> objects;
  for (std::uint32_t i = 0; i < 3; ++i) objects.push_back(object(i, cube, translation(0.02 * i, 0.0, 0.0)));
  objects.push_back(object(3, shape_of(primitive("box:0.2x0.2x0.01")), translation(0.02, 0.0, -0.014)));
  const ScenePointer scene = HapticScene::compile(objects);
  const auto distance = [](const Vector3& place) {  // to the union's surface from within, below zero outside
    const double row =
        std::min({place.x() + 0.01, 0.05 - place.x(), 0.01 - std::abs(place.y()), 0.01 - place.z()});
    const double tray = std::min(
        {0.1 - std::abs(place.x() - 0.02), 0.1 - std::abs(place.y()), -0.009 - place.z(), place.z() + 0.019});
    return std::pair(row, tray);
  };
  Random random(13);
  for (int i = 0; i < repeats(2000); ++i) {
    const Vector3 start =
        random_place(random, Bounds(Vector3(-0.009, -0.009, -0.0089), Vector3(0.049, 0.009, 0.0099)));
    const auto free = place_outside(*scene, kPointTip, start);
    ASSERT_TRUE(free) << i;
    const auto [row, tray] = distance(*free);
    EXPECT_TRUE((row < 0.0 || free->z() < -0.01) && tray < 0.0) << i << ": " << free->transpose();
    EXPECT_LT((*free - start).norm(), 2.0 * distance(start).first + 1e-6) << i;
  }
}

TEST(PlaceOutside, OfAStackOfPlatesThatTouchLeadsThroughThem) {
  const auto plate = shape_of(primitive("box:1x1x0.01"));
  std::vector<HapticObject> objects;
  for (std::uint32_t i = 0; i < 9; ++i)
    objects.push_back(object(i, plate, translation(0.0, 0.0, 0.01 * i - 0.04)));
  const ScenePointer scene = HapticScene::compile(objects);
  Random random(15);
  for (int i = 0; i < repeats(200); ++i) {
    const Vector3 start = random_place(random, Bounds(Vector3(-0.2, -0.2, -0.044), Vector3(0.2, 0.2, 0.044)));
    const auto free = place_outside(*scene, kPointTip, start);
    ASSERT_TRUE(free) << start.transpose();
    EXPECT_GT(std::abs(free->z()), 0.045) << free->transpose();
    EXPECT_LT((*free - start).norm(), 0.3);
  }
}

TEST(PlaceOutside, OfManyBallsIsInNone) {
  Random random(14);
  for (int world = 0; world < repeats(40); ++world) {
    std::vector<HapticObject> objects;
    std::vector<std::pair<Vector3, double>> balls;
    for (std::uint32_t i = 0; i < 30; ++i) {
      const double radius = random.uniform(0.005, 0.03);
      const Vector3 middle = 0.04 * random.uniform() * random.direction();
      balls.emplace_back(middle, radius);
      objects.push_back(
          object(i, shape_of(geometry::Sphere{radius}), translation(middle.x(), middle.y(), middle.z())));
    }
    const auto held = [&](const Vector3& place) {
      return std::ranges::any_of(balls,
                                 [&](const auto& it) { return (place - it.first).norm() < it.second; });
    };
    const ScenePointer scene = HapticScene::compile(objects);
    for (int i = 0; i < 50; ++i) {
      const Vector3 start = 0.06 * random.uniform() * random.direction();
      const auto free = place_outside(*scene, kPointTip, start);
      ASSERT_EQ(free.has_value(), held(start));
      if (!free) continue;
      EXPECT_FALSE(held(*free));
      // No farther than a straight way in the best of many directions, and some.
      double best = std::numeric_limits<double>::infinity();
      for (int k = 0; k < 200; ++k) {
        const Vector3 way = random.direction();
        double far = 0.0;
        while (held(start + far * way)) far += 0.0005;
        best = std::min(best, far);
      }
      EXPECT_LT((*free - start).norm(), 2.0 * best + 0.002) << world << ", " << i;
    }
  }
}

TEST(PlaceOutside, ATipThatBeginsInTwoSolidsRestsOnTheirSurface) {
  // Two boxes that overlap in the middle; a tip there is put on top of both, which is nearest.
  const ScenePointer scene = HapticScene::compile({object(1, shape_of(primitive("box:0.1x0.05x0.02"))),
                                                   object(2, shape_of(primitive("box:0.05x0.1x0.03")))});
  Toucher toucher(scene);
  const Vector3 tip(0.004, 0.003, 0.006);
  const ScpState first = toucher.step(tip);
  EXPECT_TRUE(first.touching);
  for (int i = 0; i < 5; ++i) toucher.step(tip);
  EXPECT_NEAR((toucher.solver.state().scp - Vector3(0.004, 0.003, 0.015)).norm(), 0.0, 1e-9);
}

TEST(PlaceOutside, ASolidThatAppearsAroundATipLetsItOutOfAll) {
  const HapticObject floor = object(1, shape_of(primitive("box:0.2x0.2x0.02")));
  const ScenePointer before = HapticScene::compile({floor});
  const HapticObject block =
      object(2, shape_of(primitive("box:0.04x0.04x0.04")), translation(0.0, 0.0, 0.025));
  const ScenePointer after = HapticScene::compile({floor, block});
  Toucher toucher(before);
  const Vector3 tip(0.018, 0.0, 0.008);
  toucher.go(Vector3(0.018, 0.0, 0.05), tip, 100);
  ASSERT_NEAR(toucher.solver.state().scp.z(), 0.01, 1e-9);
  const SceneChange appeared{block.id, geometry::float_box(after->object_bounds(1))};
  toucher.solver.adopt(*after, {&appeared, 1});
  const Vector3 scp = toucher.step(tip).scp;
  EXPECT_GE(scp.z(), 0.01);
  EXPECT_GE(scp.x(), 0.02);
  EXPECT_LT((scp - tip).norm(), 0.01);
}

}  // namespace
}  // namespace icome::haptics
