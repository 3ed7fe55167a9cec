#include "geometry/deform/texture_projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/random.h"
#include "geometry/mesh/geodesic_sphere.h"
#include "geometry/meshes.h"

namespace icome::geometry {
namespace {

using std::numbers::pi;
using PictureCorners = std::array<Vector2, 3>;

double extent(const PictureCorners& corners) {
  const auto [low, high] = std::minmax({corners[0].x(), corners[1].x(), corners[2].x()});
  return high - low;
}

/// Of the picture that the triangle takes, positive when not mirrored.
double picture_area(const PictureCorners& corners) {
  const Vector2 a = corners[1] - corners[0], b = corners[2] - corners[0];
  return 0.5 * (a.x() * b.y() - a.y() * b.x());
}

std::vector<PictureCorners> project(const TriangleMesh& mesh, const TextureProjector& projector) {
  const auto result = project_texture(mesh, projector);
  EXPECT_TRUE(result) << result.error().message;
  return result ? *result : std::vector<PictureCorners>(mesh.triangles.size());
}

void expect_near(const Vector2& a, const Vector2& b, double tolerance = 1e-12) {
  EXPECT_NEAR(a.x(), b.x(), tolerance);
  EXPECT_NEAR(a.y(), b.y(), tolerance);
}

/// A tube or a globe of quads round z, its first column at angle `start`. On a globe the first and the last
/// rows are the poles.
TriangleMesh lathe(std::uint32_t columns, std::uint32_t rows, bool globe, double start) {
  TriangleMesh mesh;
  for (std::uint32_t row = 0; row <= rows; ++row) {
    const double at = double(row) / rows - 0.5;
    for (std::uint32_t column = 0; column < columns; ++column) {
      const double angle = start + 2 * pi * column / columns;
      const double radius = globe ? std::cos(pi * at) : 0.5;
      mesh.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                  globe ? std::sin(pi * at) : at);
    }
  }
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t a = row * columns + column, b = row * columns + (column + 1) % columns;
      if (!globe || row > 0) mesh.triangles.push_back({a, b, b + columns});
      if (!globe || row + 1 < rows) mesh.triangles.push_back({a, b + columns, a + columns});
      if (globe && row == 0) mesh.triangles.push_back({a, b + columns, a + columns});
      if (globe && row + 1 == rows) mesh.triangles.push_back({a, b, b + columns});
    }
  }
  if (globe) {
    std::vector<TriangleMesh::Triangle> unique;
    for (const auto& t : mesh.triangles)
      if (std::ranges::find(unique, t) == unique.end()) unique.push_back(t);
    mesh.triangles = unique;
  }
  return mesh;
}

Affine3 somewhere(base::Random& random) {
  Affine3 frame = Affine3::Identity();
  frame.translate(random.uniform(0, 3) * random.direction());
  frame.rotate(Eigen::AngleAxisd(random.uniform(0, 6), random.direction()));
  frame.scale(Vector3(random.uniform(0.1, 5), random.uniform(0.1, 5), random.uniform(0.1, 5)));
  return frame;
}

TEST(TextureProjection, PlanarTakesThePictureOnceOverItsSquare) {
  const TriangleMesh square{{{-0.5, -0.5, 3}, {0.5, -0.5, 0}, {0.5, 0.5, 1}, {-0.5, 0.5, 7}},
                            {{0, 1, 2}, {0, 2, 3}}};
  const auto corners = project(square, {});
  EXPECT_EQ(corners[0], (PictureCorners{Vector2(0, 0), Vector2(1, 0), Vector2(1, 1)}));
  EXPECT_EQ(corners[1], (PictureCorners{Vector2(0, 0), Vector2(1, 1), Vector2(0, 1)}));
}

TEST(TextureProjection, CornerCoordinatesAreBilinear) {
  base::Random random(81);
  TextureProjector projector;
  projector.corners = {Vector2(1, 2), Vector2(3, 1), Vector2(4, 5), Vector2(-1, 3)};
  for (int trial = 0; trial < 200; ++trial) {
    projector.mesh_from_projector = somewhere(random);
    TriangleMesh mesh{{}, {{0, 1, 2}}};
    std::array<Vector2, 3> wanted;
    for (Vector2& uv : wanted) {
      const double s = random.uniform(-1, 2), t = random.uniform(-1, 2);
      mesh.positions.push_back(projector.mesh_from_projector *
                               Vector3(s - 0.5, t - 0.5, random.uniform(-9, 9)));
      const auto& c = projector.corners;
      uv = (1 - s) * (1 - t) * c[0] + s * (1 - t) * c[1] + s * t * c[2] + (1 - s) * t * c[3];
    }
    const auto corners = project(mesh, projector);
    for (int i = 0; i < 3; ++i) expect_near(corners[0][i], wanted[i], 1e-10);
  }
}

TEST(TextureProjection, ABoxTakesThePictureOnEverySideUnmirrored) {
  base::Random random(82);
  for (int trial = 0; trial < 50; ++trial) {
    TextureProjector projector{TextureProjection::Box, somewhere(random)};
    TriangleMesh mesh = box_mesh({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
    for (Vector3& p : mesh.positions) p = projector.mesh_from_projector * p;
    for (const PictureCorners& corners : project(mesh, projector)) {
      EXPECT_NEAR(picture_area(corners), 0.5, 1e-10);
      for (const Vector2& uv : corners)
        for (const double x : {uv.x(), uv.y()}) EXPECT_LT(std::min(std::abs(x), std::abs(x - 1)), 1e-10);
    }
  }
}

TEST(TextureProjection, BoxSidesStandUpright) {
  const auto on = [](const Vector3& p, const Vector3& q, const Vector3& r) {
    return project(TriangleMesh{{p, q, r}, {{0, 1, 2}}}, {TextureProjection::Box})[0];
  };
  const double h = 0.5;
  // The lower left corner of each side as seen from outside, the lower right, the upper left.
  const PictureCorners wanted = {Vector2(0, 0), Vector2(1, 0), Vector2(0, 1)};
  EXPECT_EQ(on({h, -h, -h}, {h, h, -h}, {h, -h, h}), wanted);
  EXPECT_EQ(on({-h, h, -h}, {-h, -h, -h}, {-h, h, h}), wanted);
  EXPECT_EQ(on({h, h, -h}, {-h, h, -h}, {h, h, h}), wanted);
  EXPECT_EQ(on({-h, -h, -h}, {h, -h, -h}, {-h, -h, h}), wanted);
  EXPECT_EQ(on({-h, -h, h}, {h, -h, h}, {-h, h, h}), wanted);
  EXPECT_EQ(on({-h, h, -h}, {h, h, -h}, {-h, -h, -h}), wanted);
}

TEST(TextureProjection, BoxJudgesBySlantNotByTheBoxesSizes) {
  // In a flat box the slope of 40 degrees faces up, however steep it is in units of the box.
  TextureProjector projector{TextureProjection::Box};
  projector.mesh_from_projector.scale(Vector3(1, 1, 0.01));
  const double rise = std::tan(40 * pi / 180);
  const TriangleMesh slope{{{0, 0, 0}, {0.5, 0, 0.5 * rise}, {0, 0.5, 0}}, {{0, 1, 2}}};
  expect_near(project(slope, projector)[0][1], {1.0, 0.5});
}

TEST(TextureProjection, SlantedSquaresFaceOneSideWithBothHalves) {
  base::Random random(83);
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3 at = random.direction();
    TriangleMesh mesh;  // at exactly 45 degrees but for rounding
    for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      mesh.positions.push_back(at + 0.1 * x * Vector3(0, 1, 0) +
                               0.1 * y * Vector3(std::sqrt(0.5), 0, std::sqrt(0.5)));
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    const auto corners = project(mesh, {TextureProjection::Box});
    EXPECT_EQ(corners[0][0], corners[1][0]);
    EXPECT_EQ(corners[0][2], corners[1][1]);
  }
}

TEST(TextureProjection, CylinderKnowsItsQuarters) {
  const TriangleMesh mesh{{{0, -2, -0.5}, {3, 0, 0}, {0, 0.1, 0.5}}, {{0, 1, 2}}};
  const auto corners = project(mesh, {TextureProjection::Cylindrical});
  expect_near(corners[0][0], {0.25, 0});
  expect_near(corners[0][1], {0.5, 0.5});
  expect_near(corners[0][2], {0.75, 1});
}

TEST(TextureProjection, AcrossTheMeridianItCountsOnPastOne) {
  const double s = std::sqrt(0.5);
  const TriangleMesh mesh{{{-s, s, 0}, {-s, -s, 0}, {-1, 0.0, 0.5}, {-1, -0.0, 0.5}},
                          {{0, 1, 2}, {0, 1, 3}, {1, 2, 1}, {0, 3, 0}}};
  const auto corners = project(mesh, {TextureProjection::Cylindrical});
  for (const int t : {0, 1}) {  // whichever sign the zero has
    expect_near(corners[t][0], {0.875, 0.5});
    expect_near(corners[t][1], {1.125, 0.5});
    expect_near(corners[t][2], {1.0, 1.0});
  }
  expect_near(corners[2][0], {0.125, 0.5});
  expect_near(corners[2][1], {0.0, 1.0});
  expect_near(corners[3][1], {1.0, 1.0});
}

TEST(TextureProjection, ATubeTakesThePictureOnceWhateverTheMeridianCuts) {
  base::Random random(84);
  for (int trial = 0; trial < 100; ++trial) {
    TriangleMesh tube = lathe(3 + std::uint32_t(random.index(20)), 1 + std::uint32_t(random.index(4)), false,
                              trial == 0 ? pi : random.uniform(-9, 9));
    TextureProjector projector{TextureProjection::Cylindrical, somewhere(random)};
    for (Vector3& p : tube.positions) p = projector.mesh_from_projector * p;
    double taken = 0;
    for (const PictureCorners& corners : project(tube, projector)) {
      EXPECT_GT(picture_area(corners), 0.0);
      taken += picture_area(corners);
    }
    EXPECT_NEAR(taken, 1.0, 1e-10);
  }
}

TEST(TextureProjection, AGlobesPolesTakeTheMeanOfTheOtherCorners) {
  for (const std::uint32_t columns : {4U, 7U, 24U, 100U}) {
    const TriangleMesh globe = lathe(columns, 12, true, 0.3);
    const auto corners = project(globe, {TextureProjection::Spherical});
    int poles = 0;
    for (std::size_t t = 0; t < corners.size(); ++t) {
      EXPECT_LT(extent(corners[t]), 1.0 / columns + 1e-12);
      EXPECT_GT(picture_area(corners[t]), 0.0);
      for (int i = 0; i < 3; ++i) {
        const double z = globe.corner(t, i).z();
        EXPECT_NEAR(corners[t][i].y(), std::asin(std::clamp(z, -1.0, 1.0)) / pi + 0.5, 1e-7);
        if (std::abs(z) < 1.0 - 1e-9) continue;
        ++poles;
        EXPECT_EQ(corners[t][i].x(), 0.5 * (corners[t][(i + 1) % 3].x() + corners[t][(i + 2) % 3].x()));
      }
    }
    EXPECT_EQ(poles, int(2 * columns));
  }
}

TEST(TextureProjection, SphereKnowsItsLatitudes) {
  const TriangleMesh mesh{{{2, 0, 0}, {0, 3, 3}, {0, -1, -std::sqrt(3.0)}, {0, 0, 0}, {0, 0, -1}, {0, 0, 4}},
                          {{0, 1, 2}, {3, 3, 3}, {3, 4, 5}, {0, 4, 5}}};
  const auto corners = project(mesh, {TextureProjection::Spherical});
  expect_near(corners[0][0], {0.5, 0.5});
  expect_near(corners[0][1], {0.75, 0.75});
  expect_near(corners[0][2], {0.25, 1.0 / 6.0});
  expect_near(corners[1][0], {0.5, 0.5});  // the centre: anything, but a number
  expect_near(corners[2][1], {0.5, 0.0});
  expect_near(corners[3][1], {0.5, 0.0});  // both poles look where the third corner is
  expect_near(corners[3][2], {0.5, 1.0});
}

TEST(TextureProjection, RandomTrianglesHaveTheLeastExtentThereIs) {
  base::Random random(85);
  for (int trial = 0; trial < 20'000; ++trial) {
    TriangleMesh mesh{{}, {{0, 1, 2}}};
    const bool small = trial % 2 == 0;
    const Vector3 around = random.direction();
    for (int i = 0; i < 3; ++i)
      mesh.positions.push_back(small ? Vector3(around + 0.05 * random.direction()) : random.direction());
    const auto kind = trial % 4 < 2 ? TextureProjection::Cylindrical : TextureProjection::Spherical;
    const PictureCorners corners = project(mesh, {kind})[0];
    double least = 2;
    for (int shifts = 0; shifts < 8; ++shifts) {
      PictureCorners shifted;
      for (int i = 0; i < 3; ++i)
        shifted[i].x() =
            std::atan2(mesh.positions[i].y(), mesh.positions[i].x()) / (2 * pi) + (shifts >> i & 1);
      least = std::min(least, extent(shifted));
    }
    EXPECT_NEAR(extent(corners), least, 1e-12);
    if (small && std::hypot(around.x(), around.y()) > 0.1) {
      EXPECT_LT(extent(corners), 0.5);
    }
    const double first = std::min({corners[0].x(), corners[1].x(), corners[2].x()});
    EXPECT_TRUE(first >= 0.0 && first < 1.0);
  }
}

TEST(TextureProjection, AFittedProjectorTakesThePictureOverTheBox) {
  const TriangleMesh mesh = box_mesh({1, 2, 3}, {5, 2, 4});  // flat along y
  const Affine3 frame = fitted_projector(bounds(mesh));
  EXPECT_EQ(frame.linear().diagonal(), Vector3(4, 4, 1));
  EXPECT_EQ(frame.translation(), Vector3(3, 2, 3.5));
  EXPECT_TRUE(project_texture(mesh, {TextureProjection::Box, frame}));
  EXPECT_EQ(fitted_projector(Bounds()).matrix(), Affine3::Identity().matrix());
  EXPECT_EQ(fitted_projector(Bounds(Vector3(1, 1, 1), Vector3(1, 1, 1))).linear(), Matrix3::Identity());
}

TEST(TextureProjection, DoesNotDependOnTheUnitOfLength) {
  const TriangleMesh mesh = bumpy_geodesic_sphere(4, 1.0, 0.2, 2);
  for (const auto kind : {TextureProjection::Planar, TextureProjection::Box, TextureProjection::Cylindrical,
                          TextureProjection::Spherical}) {
    const auto metres = project(mesh, {kind});
    for (const double unit : {0x1p-900, 0x1p900}) {
      TriangleMesh scaled = mesh;
      for (Vector3& p : scaled.positions) p *= unit;
      TextureProjector projector{kind};
      projector.mesh_from_projector.scale(unit);
      const auto corners = project(scaled, projector);
      for (std::size_t t = 0; t < corners.size(); ++t)
        for (int i = 0; i < 3; ++i) expect_near(corners[t][i], metres[t][i]);
    }
  }
}

TEST(TextureProjection, DegenerateTrianglesGetNumbers) {
  const TriangleMesh mesh{{{0, 0, 0}, {0, 0, 1}, {1, 1, 1}, {2, 2, 2}},
                          {{0, 0, 0}, {0, 1, 0}, {0, 2, 3}, {1, 1, 2}}};
  for (const auto kind : {TextureProjection::Planar, TextureProjection::Box, TextureProjection::Cylindrical,
                          TextureProjection::Spherical}) {
    for (const PictureCorners& corners : project(mesh, {kind}))
      for (const Vector2& uv : corners) EXPECT_TRUE(uv.allFinite());
  }
}

TEST(TextureProjection, RefusesWhatHasNoAnswer) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const TriangleMesh box = unit_box();
  const auto message = [](const TriangleMesh& mesh, const TextureProjector& projector) {
    const auto result = project_texture(mesh, projector);
    return result ? std::string() : result.error().message;
  };
  for (const auto kind : {TextureProjection::Planar, TextureProjection::Box, TextureProjection::Cylindrical,
                          TextureProjection::Spherical}) {
    TextureProjector projector{kind};
    projector.mesh_from_projector.scale(Vector3(1, 0, 1));
    EXPECT_NE(message(box, projector).find("flat"), std::string::npos);
    projector.mesh_from_projector = Affine3::Identity();
    projector.mesh_from_projector.linear().col(2) = Vector3(1, 1, 0);
    projector.mesh_from_projector.linear().col(1) = Vector3(1, -1, 0);
    EXPECT_NE(message(box, projector).find("flat"), std::string::npos);
    projector.mesh_from_projector = Affine3::Identity();
    projector.mesh_from_projector.translation().x() = nan;
    EXPECT_NE(message(box, projector).find("not finite"), std::string::npos);

    projector = {kind};
    projector.corners[2].y() = nan;
    EXPECT_NE(message(box, projector).find("corner coordinate"), std::string::npos);

    const double far = std::numeric_limits<double>::max();
    projector = {kind};
    projector.mesh_from_projector.scale(1e-9);
    for (int axis = 0; axis < 3; ++axis) {
      TriangleMesh away = box;
      away.positions[away.triangles[4][1]][axis] = far;
      EXPECT_NE(message(away, projector).find("too far"), std::string::npos);
    }
    TriangleMesh broken = box;
    broken.positions[1].x() = nan;
    EXPECT_NE(message(broken, {kind}).find("vertex 1"), std::string::npos);
    broken = box;
    broken.triangles[2][2] = 50;
    EXPECT_NE(message(broken, {kind}).find("vertex 50"), std::string::npos);
  }
}

}  // namespace
}  // namespace icome::geometry
