#include "render/csg/csg_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "render/csg_scenes.h"
#include "render/pictures/studio.h"
#include "render/pictures/touch_view.h"

namespace icome::render {
namespace {

using base::Vector3;
using geometry::Box;
using geometry::CsgOperator;
using geometry::CsgTree;
using geometry::Cylinder;
using geometry::Primitive;
using geometry::Sphere;
using geometry::Torus;

constexpr int kWidth = 128;
constexpr int kHeight = 96;
constexpr float kNothing = std::numeric_limits<float>::infinity();

const Vector3 kOblique(0.5, -0.8, 0.6);
const Vector3 kFromTop(0.0, 0.0, 1.0);

/// A context that can draw CSG, or nothing after saying why the test is skipped.
std::optional<Offscreen> csg_context() {
  auto context = Offscreen::create();
  if (!context || !context->has_built_in_pipeline()) return std::nullopt;
  return std::move(*context);
}

#define SKIP_WITHOUT_CSG(context) \
  if (!(context)) GTEST_SKIP() << "no OpenGL compatibility context here; install libgl1-mesa-dri"

struct Shot {
  CsgGeometry geometry;
  ModelBall ball;
  Camera camera;
  StudioPicture picture;

  float distance(int x, int y) const {
    return picture.distance.at(static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x));
  }
};

Shot shoot(const Offscreen& context, const CsgTree& tree, const Vector3& toward_eye,
           const std::vector<StudioBody>& bodies = {}) {
  auto geometry = make_csg_geometry(tree);
  EXPECT_TRUE(geometry.has_value()) << geometry.error().message;
  Shot shot{std::move(*geometry), {}, {}, {}};
  shot.ball = model_ball(shot.geometry.surface, Vector3::UnitZ());
  FitOptions fit;
  fit.toward_eye = toward_eye;
  fit.up = Vector3::UnitZ();
  fit.aspect = static_cast<double>(kWidth) / kHeight;
  shot.camera = fit_camera(shot.geometry.surface, fit);
  StudioSettings settings;
  settings.width = kWidth;
  settings.height = kHeight;
  settings.passes = 4;
  settings.shadow_side = 128;
  settings.up = Vector3::UnitZ();
  settings.centre = shot.ball.centre;
  settings.radius = shot.ball.radius;
  settings.floor = shot.ball.lowest;
  auto picture = draw_studio(context, {bodies, {{shot.geometry}}}, shot.camera, settings);
  EXPECT_TRUE(picture.has_value()) << picture.error().message;
  if (picture) shot.picture = std::move(*picture);
  return shot;
}

/// How far along the view axis the ray through the pixel's middle enters the solid, by asking for membership
/// along it: finely, then by halving.
float cast_ray(const Shot& shot, const std::function<bool(const Vector3&)>& inside, int x, int y) {
  const Matrix4 world_from_clip = shot.camera.clip_from_world().inverse();
  const double u = 2.0 * (x + 0.5) / kWidth - 1.0;
  const double v = 1.0 - 2.0 * (y + 0.5) / kHeight;
  const Vector3 far = (world_from_clip * Eigen::Vector4d(u, v, 1.0, 1.0)).hnormalized();
  const Vector3 eye = shot.camera.eye();
  const Vector3 direction = (far - eye).normalized();
  const double middle = (shot.ball.centre - eye).dot(direction);
  const double step = shot.ball.radius / 80.0;
  double outside = middle - 1.05 * shot.ball.radius;
  for (double t = outside; t < middle + 1.05 * shot.ball.radius; t += step) {
    if (!inside(eye + t * direction)) {
      outside = t;
      continue;
    }
    double within = t;
    for (int i = 0; i < 20; ++i) {
      const double half = 0.5 * (outside + within);
      (inside(eye + half * direction) ? within : outside) = half;
    }
    return static_cast<float>(-(shot.camera.camera_from_world * Vector3(eye + within * direction)).z());
  }
  return kNothing;
}

/// The point of the world that the picture shows in a pixel.
Vector3 seen_point(const Shot& shot, int x, int y) {
  const Matrix4 camera_from_clip = shot.camera.clip_from_camera.inverse();
  const Eigen::Vector4d clip(2.0 * (x + 0.5) / kWidth - 1.0, 1.0 - 2.0 * (y + 0.5) / kHeight, 1.0, 1.0);
  const Vector3 far = (camera_from_clip * clip).hnormalized();
  return shot.camera.camera_from_world.inverse() * Vector3(shot.distance(x, y) / -far.z() * far);
}

/// Is the solid's surface within `reach` of the point, because there are points inside and outside so near?
bool near_surface(const std::function<bool(const Vector3&)>& inside, const Vector3& point, double reach) {
  bool in = false;
  bool out = false;
  for (int i = 0; i < 27; ++i) {
    const Vector3 toward(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    (inside(point + reach * toward.stableNormalized()) ? in : out) = true;
  }
  return in && out;
}

/// Holds the picture against rays: the share of pixels where both see the solid or both do not, and, of
/// those that see it, the share that show a point within a thousandth of the solid's radius of the surface
/// at about the ray's distance (where the surface is steep, distance says little).
struct Agreement {
  double silhouette, depth;
};

Agreement compare(const Shot& shot, const std::function<bool(const Vector3&)>& inside) {
  int same = 0;
  int both = 0;
  int near = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const float cast = cast_ray(shot, inside, x, y);
      const float seen = shot.distance(x, y);
      same += std::isinf(cast) == std::isinf(seen);
      if (std::isinf(cast) || std::isinf(seen)) continue;
      ++both;
      near += std::abs(cast - seen) < 0.03 * shot.ball.radius &&
              near_surface(inside, seen_point(shot, x, y), 1e-3 * shot.ball.radius);
    }
  }
  return {static_cast<double>(same) / (kWidth * kHeight), static_cast<double>(near) / std::max(1, both)};
}

/// `reference` is the same solid.
void expect_as_cast(const Offscreen& context, const CsgTree& tree, const Vector3& toward_eye,
                    const CsgTree& reference) {
  const Shot shot = shoot(context, tree, toward_eye);
  const Agreement agreement = compare(shot, [&](const Vector3& p) { return inside(reference, p); });
  EXPECT_GE(agreement.silhouette, 0.995) << "from " << toward_eye.transpose();
  EXPECT_GE(agreement.depth, 0.985) << "from " << toward_eye.transpose();
}

void expect_as_cast(const Offscreen& context, const CsgTree& tree, const Vector3& toward_eye) {
  expect_as_cast(context, tree, toward_eye, tree);
}

TEST(CsgView, ShowsFigure56AsRaysDo) {
  const auto context = csg_context();
  SKIP_WITHOUT_CSG(context);
  for (const Vector3& toward_eye : {kOblique, kFromTop, Vector3(-1.0, 0.2, 0.1), Vector3(0.2, 0.1, -1.0)}) {
    expect_as_cast(*context, figure_5_6(), toward_eye);
  }
}

TEST(CsgView, LooksThroughTheHoleAndOntoItsWall) {
  const auto context = csg_context();
  SKIP_WITHOUT_CSG(context);
  const Shot through = shoot(*context, figure_5_6(), kFromTop);
  EXPECT_EQ(through.distance(kWidth / 2, kHeight / 2), kNothing);
  // Seen at a slant the middle shows the far side of the wall: beyond the solid's middle, not its front.
  const Vector3 slanted(0.0, -0.6, 1.0);
  const Shot wall = shoot(*context, figure_5_6(), slanted);
  const auto middle = project(wall.camera, Vector3(0.0, 0.0, 0.05));
  ASSERT_TRUE(middle.has_value());
  const float seen =
      wall.distance(static_cast<int>(middle->x * kWidth), static_cast<int>(middle->y * kHeight));
  EXPECT_GT(seen, middle->distance + 0.01);
  EXPECT_FALSE(std::isinf(seen));
}

TEST(CsgView, DrawsTheSameAtAnySize) {
  const auto context = csg_context();
  SKIP_WITHOUT_CSG(context);
  const Shot reference = shoot(*context, figure_5_6(), kOblique);
  for (const double half : {1e-6, 2e4}) {
    const Shot other = shoot(*context, figure_5_6(half), kOblique);
    int differ = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        differ += std::isinf(reference.distance(x, y)) != std::isinf(other.distance(x, y));
      }
    }
    EXPECT_LE(differ, kWidth * kHeight / 1000) << "half side " << half;
  }
}

TEST(CsgView, UnitesProducts) {
  const auto context = csg_context();
  SKIP_WITHOUT_CSG(context);
  CsgTree tree;
  const auto bar = tree.add_leaf(Primitive(Box{{0.06, 0.015, 0.015}}));
  const auto ball = tree.add_leaf(Primitive(Sphere{0.03}), moved_by(0.03, 0.0, 0.01));
  const auto both = tree.add(CsgOperator::Union, bar, ball);
  const auto slot = tree.add_leaf(Primitive(Box{{0.01, 0.05, 0.05}}), moved_by(0.02, 0.0, 0.0));
  tree.add(CsgOperator::Difference, both, slot);
  expect_as_cast(*context, tree, kOblique);
}

// A hole that ends flush with the faces it goes through, and a slot flush with three more: the classic
// cases where images of CSG leave a speckled skin.
TEST(CsgView, OpensFlushHoles) {
  const auto context = csg_context();
  SKIP_WITHOUT_CSG(context);
  CsgTree tree;
  const auto block = tree.add_leaf(Primitive(Box{{0.05, 0.05, 0.05}}));
  const auto hole = tree.add_leaf(Primitive(Cylinder{0.028, 0.1}));
  const auto drilled = tree.add(CsgOperator::Difference, block, hole);
  const auto slot = tree.add_leaf(Primitive(Box{{0.05, 0.015, 0.025}}), moved_by(0.0, 0.0, 0.025));
  tree.add(CsgOperator::Difference, drilled, slot);
  // The reference has room where the skin would be, which is on the surface and so neither in nor out.
  CsgTree clear;
  const auto same = clear.add_leaf(Primitive(Box{{0.05, 0.05, 0.05}}));
  const auto longer = clear.add_leaf(Primitive(Cylinder{0.028, 0.12}));
  const auto through = clear.add(CsgOperator::Difference, same, longer);
  const auto higher = clear.add_leaf(Primitive(Box{{0.06, 0.015, 0.03}}), moved_by(0.0, 0.0, 0.03));
  clear.add(CsgOperator::Difference, through, higher);
  for (const Vector3& toward_eye : {Vector3(0.2, 0.1, 1.0), kOblique, Vector3(1.0, 0.1, 0.2)}) {
    expect_as_cast(*context, tree, toward_eye, clear);
  }
}

TEST(CsgView, IntersectsSolidsWithCommonFaces) {
  const auto context = csg_context();
  SKIP_WITHOUT_CSG(context);
  CsgTree tree;
  const auto left = tree.add_leaf(Primitive(Box{{0.05, 0.03, 0.03}}), moved_by(-0.02, 0.0, 0.0));
  const auto right = tree.add_leaf(Primitive(Box{{0.05, 0.03, 0.03}}), moved_by(0.02, 0.0, 0.0));
  const auto shared = tree.add(CsgOperator::Intersection, left, right);
  const auto again = tree.add_leaf(Primitive(Box{{0.03, 0.03, 0.03}}));
  tree.add(CsgOperator::Intersection, shared, again);
  expect_as_cast(*context, tree, kOblique);
}

TEST(CsgView, CutsConcaveOperands) {
  const auto context = csg_context();
  SKIP_WITHOUT_CSG(context);
  const auto ring =
      std::make_shared<const geometry::MeshSolid>(geometry::tessellate(Primitive(Torus{0.05, 0.02}), 2e-5));
  const auto cut = [](const geometry::CsgShape& shape) {
    CsgTree tree;
    const auto torus = tree.add_leaf(shape);
    const auto corner = tree.add_leaf(Primitive(Box{{0.03, 0.03, 0.03}}), moved_by(0.04, -0.03, 0.01));
    tree.add(CsgOperator::Difference, torus, corner);
    return tree;
  };
  const CsgTree exact = cut(Primitive(Torus{0.05, 0.02}));
  const Vector3 flat(0.3, -1.0, 0.15);  // up to four fronts of the ring lie one behind the other
  expect_as_cast(*context, exact, flat);
  expect_as_cast(*context, cut(ring), flat, exact);
}

TEST(CsgView, CutsWithHalfSpacesAndMirrors) {
  const auto context = csg_context();
  SKIP_WITHOUT_CSG(context);
  base::Affine3 mirrored = moved_by(0.0, 0.0, 0.01);
  mirrored.linear() << -1.0, 0.2, 0.0, 0.0, 1.5, 0.0, 0.0, 0.0, 0.8;
  base::Affine3 tilted = moved_by(0.0, 0.0, 0.02);
  tilted.rotate(Eigen::AngleAxisd(0.5, Vector3::UnitX()));
  CsgTree tree;
  const auto cone = tree.add_leaf(Primitive(geometry::Cone{0.05, 0.02, 0.08}), mirrored);
  const auto below = tree.add_leaf(Primitive(geometry::Plane{}), tilted);
  tree.add(CsgOperator::Intersection, cone, below);
  expect_as_cast(*context, tree, kOblique);
}

/// Which of red, green and blue is strongest where the point of the world is seen; -1 for grey.
int hue(const Shot& shot, const Vector3& point) {
  const auto at = project(shot.camera, point);
  if (!at) return -2;
  const std::uint8_t* p =
      shot.picture.image.pixel(static_cast<int>(at->x * kWidth), static_cast<int>(at->y * kHeight));
  const int strongest = static_cast<int>(std::max_element(p, p + 3) - p);
  const int others = std::max(p[(strongest + 1) % 3], p[(strongest + 2) % 3]);
  return p[strongest] > others + 30 ? strongest : -1;
}

TEST(CsgView, KeepsTheColoursOfOperands) {
  const auto context = csg_context();
  SKIP_WITHOUT_CSG(context);
  CsgTree tree;
  const auto red = tree.add_leaf(Primitive(Box{{0.03, 0.03, 0.02}}), moved_by(-0.03, 0.0, 0.0),
                                 CsgTree::Colour{0.9F, 0.1F, 0.1F, 1.0F});
  const auto plain = tree.add_leaf(Primitive(Box{{0.03, 0.03, 0.02}}), moved_by(0.03, 0.0, 0.0));
  const auto both = tree.add(CsgOperator::Union, red, plain);
  const auto blue = tree.add_leaf(Primitive(Box{{0.01, 0.01, 0.01}}), moved_by(0.03, 0.0, 0.02),
                                  CsgTree::Colour{0.1F, 0.1F, 0.9F, 1.0F});
  tree.add(CsgOperator::Difference, both, blue);
  const Shot shot = shoot(*context, tree, kFromTop);
  EXPECT_EQ(hue(shot, {-0.03, 0.0, 0.02}), 0);
  EXPECT_EQ(hue(shot, {0.05, 0.02, 0.02}), -1);
  EXPECT_EQ(hue(shot, {0.03, 0.0, 0.01}), 2);  // the bottom of the dent
}

TEST(CsgView, GivesCommonFacesOfAUnionToTheFirst) {
  const auto context = csg_context();
  SKIP_WITHOUT_CSG(context);
  CsgTree tree;
  const auto green = tree.add_leaf(Primitive(Box{{0.04, 0.02, 0.02}}), moved_by(0.0, 0.0, 0.0),
                                   CsgTree::Colour{0.1F, 0.8F, 0.1F, 1.0F});
  const auto red = tree.add_leaf(Primitive(Cylinder{0.035, 0.04}), moved_by(0.0, 0.0, 0.0),
                                 CsgTree::Colour{0.9F, 0.1F, 0.1F, 1.0F});
  tree.add(CsgOperator::Union, green, red);
  const Shot shot = shoot(*context, tree, kFromTop);
  for (double x = -0.036; x <= 0.036; x += 0.004) {
    for (double y = -0.016; y <= 0.016; y += 0.004) EXPECT_EQ(hue(shot, {x, y, 0.02}), 1) << x << " " << y;
  }
  EXPECT_EQ(hue(shot, {0.0, 0.03, 0.02}), 0);
}

TEST(CsgView, HidesAndIsHiddenByMeshes) {
  const auto context = csg_context();
  SKIP_WITHOUT_CSG(context);
  CsgTree tree;
  tree.add(CsgOperator::Difference, tree.add_leaf(Primitive(Box{{0.05, 0.05, 0.05}})),
           tree.add_leaf(Primitive(Cylinder{0.03, 0.2})));
  // A slab that stands in the hole: seen through it, hidden by what is left of the block, and above it.
  const geometry::TriangleMesh slab = geometry::tessellate(Primitive(Box{{0.045, 0.01, 0.055}}), 1e-4);
  const Shot shot = shoot(*context, tree, kFromTop, {{slab, base::Pose::Identity(), {0.1, 0.1, 0.9}}});
  EXPECT_EQ(hue(shot, {0.0, 0.0, 0.055}), 2);
  EXPECT_EQ(hue(shot, {0.04, 0.0, 0.055}), 2);
  EXPECT_EQ(hue(shot, {0.04, 0.04, 0.05}), -1);
  const geometry::TriangleMesh sunk = geometry::tessellate(Primitive(Box{{0.045, 0.01, 0.04}}), 1e-4);
  const Shot behind = shoot(*context, tree, kFromTop, {{sunk, base::Pose::Identity(), {0.1, 0.1, 0.9}}});
  EXPECT_EQ(hue(behind, {0.0, 0.0, 0.04}), 2);
  EXPECT_EQ(hue(behind, {0.04, 0.0, 0.05}), -1);
}

TEST(CsgView, DrawsNothingOfAnEmptySolid) {
  const auto context = csg_context();
  SKIP_WITHOUT_CSG(context);
  CsgTree tree;
  const auto left = tree.add_leaf(Primitive(Sphere{0.02}), moved_by(-0.1, 0.0, 0.0));
  const auto right = tree.add_leaf(Primitive(Sphere{0.02}), moved_by(0.1, 0.0, 0.0));
  tree.add(CsgOperator::Intersection, left, right);
  const Shot shot = shoot(*context, tree, kFromTop);
  for (const float distance : shot.picture.distance) ASSERT_EQ(distance, kNothing);
}

TEST(CsgView, FreesWhatItTookSoThatPicturesCanFollowOneAnother) {
  for (int i = 0; i < 3; ++i) {
    const auto context = csg_context();
    SKIP_WITHOUT_CSG(context);
    const Shot shot = shoot(*context, figure_5_6(), kFromTop);
    EXPECT_EQ(shot.distance(kWidth / 2, kHeight / 2), kNothing);
    EXPECT_NE(shot.distance(kWidth / 2, kHeight / 2 + kHeight / 3), kNothing);
  }
}

}  // namespace
}  // namespace icome::render
