#include "render/csg/scene_solids.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <functional>
#include <future>
#include <optional>
#include <utility>

#include "base/random.h"
#include "render/csg_scenes.h"
#include "render/drawn_world.h"
#include "render/gl/offscreen.h"
#include "repeats.h"
#include "world/shape/solid_geometry.h"

namespace icome::render {
namespace {

using geometry::Box;
using geometry::CsgOperator;
using geometry::CsgTree;
using geometry::Cylinder;
using geometry::Primitive;
using geometry::Sphere;
using geometry::Torus;
using world::at;
using world::box;

constexpr int kPictureSide = 160;  // pixels

world::GeometryPointer csg_shape(CsgTree tree) {
  return std::make_shared<world::CsgGeometry>(std::move(tree));
}

/// Draws picture after picture in one context, as a window does.
class Easel {
 public:
  static std::optional<Easel> create() {
    auto context = Offscreen::create();
    if (!context || !context->has_built_in_pipeline()) return std::nullopt;
    return Easel(std::move(*context));
  }

  charts::Image draw(const RenderScene& scene, const Camera& camera, SceneLook look, CsgWay way) {
    constexpr int kSide = kPictureSide;
    look.csg = way;
    EXPECT_TRUE(canvas_.fit(kSide, kSide, GL_RGBA8, 0).has_value());
    const auto done = renderer_.draw(scene, camera, look, {canvas_.frame.name(), kSide, kSide, {}});
    EXPECT_TRUE(done.has_value()) << (done ? "" : done.error().message);
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
    charts::Image upright{kSide, kSide, std::vector<std::uint8_t>(std::size_t{4} * kSide * kSide)};
    std::vector<std::uint8_t> rows(upright.rgba.size());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, canvas_.frame.name());
    glReadPixels(0, 0, kSide, kSide, GL_RGBA, GL_UNSIGNED_BYTE, rows.data());
    constexpr std::ptrdiff_t kRow = 4 * kSide;
    for (int y = 0; y < kSide; ++y)
      std::copy_n(rows.begin() + y * kRow, kRow, upright.rgba.begin() + (kSide - 1 - y) * kRow);
    return upright;
  }

 private:
  explicit Easel(Offscreen context) : context_(std::move(context)) {}

  Offscreen context_;
  SceneRenderer renderer_;
  SceneCanvas canvas_;
};

RenderScenePointer published(const DrawnWorld& it) { return ScenePublisher().publish(it.world); }

/// The share of pixels that differ by more than `most` in some channel.
double differing(const charts::Image& a, const charts::Image& b, int most = 24) {
  std::size_t differ = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    bool is = false;
    for (std::size_t c = 0; c < 3; ++c) is |= std::abs(int(a.rgba[i + c]) - int(b.rgba[i + c])) > most;
    differ += is;
  }
  return double(differ) / double(a.rgba.size() / 4);
}

void keep_for_the_eye(const charts::Image& image, const std::string& name) {
  const char* folder = std::getenv("ICOME_TEST_PICTURES");
  if (!folder) return;
  const auto png = charts::encode_png(image);
  std::ofstream out(std::string(folder) + "/" + name + ".png", std::ios::binary);
  if (png) out.write(reinterpret_cast<const char*>(png->data()), std::streamsize(png->size()));
}

class SolidPictures : public testing::Test {
 protected:
  void SetUp() override {
    easel_ = Easel::create();
    if (!easel_) GTEST_SKIP() << "no OpenGL compatibility context here; install libgl1-mesa-dri";
  }

  charts::Image shot(const DrawnWorld& it, const Camera& camera, const SceneLook& look,
                     CsgWay way = CsgWay::Images) {
    return easel_->draw(*published(it), camera, look, way);
  }

  /// Both ways show the same in all but two of a hundred pixels.
  void expect_alike(const RenderScenePointer& scene, const Camera& camera, const SceneLook& look,
                    const std::string& name) {
    const charts::Image images = easel_->draw(*scene, camera, look, CsgWay::Images);
    const charts::Image triangles = easel_->draw(*scene, camera, look, CsgWay::Triangles);
    keep_for_the_eye(images, name + "_images");
    keep_for_the_eye(triangles, name + "_triangles");
    EXPECT_LT(differing(images, triangles), 0.02) << name;
  }

 private:
  std::optional<Easel> easel_;
};

Camera oblique(const RenderScenePointer& scene) { return fit_scene(*scene, *view_direction("iso"), 1.0); }

SceneLook lit_look() {
  SceneLook look = plain_look();
  look.above = look.below = {0.5, 0.5, 0.5};
  look.shadows = look.ground = true;
  return look;
}

TEST_F(SolidPictures, Figure56LooksTheSameBothWays) {
  DrawnWorld it;
  it.add(csg_shape(figure_5_6(1.0)), at(0.0, 0.0, 0.0), coloured(kGreen));
  const auto scene = published(it);
  expect_alike(scene, oblique(scene), plain_look(), "figure");
  expect_alike(scene, oblique(scene), lit_look(), "figure_lit");
  SceneLook still = lit_look();
  still.passes = 6;
  expect_alike(scene, oblique(scene), still, "figure_still");
}

TEST_F(SolidPictures, NumbersOfOperandsLookTheSameBothWays) {
  for (const int dents : {0, 3, 15}) {
    DrawnWorld it;
    it.add(csg_shape(dented_ball(dents)), at(0.0, 0.0, 0.0), coloured({0.8F, 0.7F, 0.5F}));
    const auto scene = published(it);
    expect_alike(scene, oblique(scene), lit_look(), "dents" + std::to_string(dents));
  }
}

TEST_F(SolidPictures, HideOtherObjectsAndAreHidden) {
  DrawnWorld it;
  it.add(csg_shape(figure_5_6(1.0)), at(0.0, 0.0, 0.0), coloured(kGreen));
  it.add(box(0.8), at(0.4, 1.0, 0.7), coloured(kRed));      // goes through it
  it.add(box(0.6), at(0.2, 1.8, 2.0), coloured(kBlue));     // before
  it.add(box(2.6), at(-0.8, -1.0, -1.9), coloured(kBlue));  // behind, to be seen through the hole
  it.add(csg_shape(dented_ball(3)), at(1.0, 1.0, 1.0) * Eigen::UniformScaling<double>(6.0), coloured(kRed));
  const auto scene = published(it);
  expect_alike(scene, oblique(scene), plain_look(), "hiding");
  expect_alike(scene, oblique(scene), lit_look(), "hiding_lit");
  expect_alike(scene, fit_scene(*scene, *view_direction("front"), 1.0), lit_look(), "hiding_front");
}

TEST_F(SolidPictures, AreSeenThrough) {
  DrawnWorld it;
  it.add(square(), at(0.0, 0.0, -2.0), coloured(kBlue));
  it.add(csg_shape(figure_5_6(0.6)), at(0.0, 0.0, 0.0), coloured(kGreen, 0.5F));
  const Camera camera = camera_at({0.1, 0.25, 4.0});
  const charts::Image seen = shot(it, camera, plain_look());
  keep_for_the_eye(seen, "through");
  const auto colour_at = [&](const Vector3& p) {
    const auto where = project(camera, p);
    return at_share(seen, where->x, where->y);
  };
  const Rgb face = colour_at({0.45, 0.0, 0.6});
  EXPECT_GT(face.green, 60);
  EXPECT_GT(face.blue, 60);
  EXPECT_TRUE(is_blue(colour_at({0.0, 0.0, 0.6})));  // through the hole
}

TEST_F(SolidPictures, TransparentOnesLeaveDepthsAsTheyWere) {
  DrawnWorld it;
  it.add(csg_shape(figure_5_6(0.6)), at(0.0, 0.0, 0.0), coloured(kGreen, 0.6F));
  SceneLook look = plain_look();
  look.overlay.balls.push_back({{0.45, 0.0, 0.0}, 0.1, {1.0, 0.0, 0.0}});
  const Camera camera = camera_at({0.0, 0.0, 4.0});
  const charts::Image with = shot(it, camera, look, CsgWay::Images);
  const auto where = project(camera, {0.45, 0.0, 0.1});
  EXPECT_GT(at_share(with, where->x, where->y).red, 150);
}

TEST_F(SolidPictures, MirroredOnesLookTheSameBothWays) {
  for (const bool concave : {false, true}) {
    CsgTree tree;
    const auto base = tree.add_leaf(Primitive(Box{{1.0, 0.6, 0.4}}));
    const auto cut = concave ? tree.add_leaf(Primitive(Torus{0.6, 0.3}), moved_by(0.4, 0.1, 0.4))
                             : tree.add_leaf(Primitive(Sphere{0.5}), moved_by(0.6, 0.2, 0.4));
    tree.add(CsgOperator::Difference, base, cut);
    DrawnWorld it;
    base::Affine3 mirrored = at(0.0, 0.0, 0.0);
    mirrored.linear().diagonal() << -1.0, 1.2, 0.9;
    it.add(csg_shape(tree), mirrored, coloured(kGreen));
    const auto scene = published(it);
    expect_alike(scene, oblique(scene), lit_look(), concave ? "mirrored_concave" : "mirrored");
  }
}

TEST_F(SolidPictures, OperandsKeepTheirColours) {
  CsgTree tree;
  const auto plate = tree.add_leaf(Primitive(Box{{1.0, 1.0, 0.2}}));
  const auto hole = tree.add_leaf(Primitive(Sphere{0.35}), moved_by(0.0, 0.0, 0.2),
                                  CsgTree::Colour{1.0F, 0.0F, 0.0F, 1.0F});
  const auto dented = tree.add(CsgOperator::Difference, plate, hole);
  const auto knob =
      tree.add_leaf(Primitive(Sphere{0.3}), moved_by(0.7, 0.7, 0.2), CsgTree::Colour{0.0F, 0.0F, 1.0F, 1.0F});
  tree.add(CsgOperator::Union, dented, knob);
  DrawnWorld it;
  it.add(csg_shape(tree), at(0.0, 0.0, 0.0), coloured(kGreen));
  const Camera camera = camera_at({0.0, 0.0, 4.0});
  for (const CsgWay way : {CsgWay::Images, CsgWay::Triangles}) {
    const charts::Image image = shot(it, camera, plain_look(), way);
    keep_for_the_eye(image, way == CsgWay::Images ? "colours_images" : "colours_triangles");
    const auto colour_at = [&](const Vector3& p) {
      const auto where = project(camera, p);
      return at_share(image, where->x, where->y);
    };
    EXPECT_TRUE(is_red(colour_at({0.0, 0.0, -0.15})));
    EXPECT_TRUE(is_blue(colour_at({0.7, 0.7, 0.5})));
    EXPECT_TRUE(is_green(colour_at({-0.8, -0.8, 0.2})));
  }
}

TEST_F(SolidPictures, SelectedOnesHaveALineAround) {
  DrawnWorld it;
  const auto chosen = it.add(csg_shape(figure_5_6(1.0)), at(0.0, 0.0, 0.0), coloured(kBlue));
  SceneLook look = plain_look();
  look.outlines = {{{chosen}, {0.0, 1.0, 0.0}}};
  const auto scene = published(it);
  expect_alike(scene, oblique(scene), look, "selected");
  const charts::Image image = shot(it, camera_at({0.0, 0.0, 4.0}), look, CsgWay::Images);
  bool found = false;
  for (int x = 0; x < kPictureSide; ++x) found |= is_green(at_share(image, (x + 0.5) / kPictureSide, 0.5));
  EXPECT_TRUE(found);
}

TEST_F(SolidPictures, EmptyAndDegenerateOnesHarmNothing) {
  DrawnWorld it;
  CsgTree empty;
  const auto left = empty.add_leaf(Primitive(Sphere{0.2}), moved_by(-1.0, 0.0, 0.0));
  const auto right = empty.add_leaf(Primitive(Sphere{0.2}), moved_by(1.0, 0.0, 0.0));
  empty.add(CsgOperator::Intersection, left, right);
  it.add(csg_shape(empty), at(0.0, 0.0, 0.0), coloured(kGreen));
  it.add(csg_shape(CsgTree()), at(0.0, 0.0, 0.0), coloured(kGreen));
  CsgTree thin;
  const auto plate = thin.add_leaf(Primitive(Box{{1.0, 1.0, 1e-12}}), moved_by(0.0, -1.2, 0.0));
  const auto hole = thin.add_leaf(Primitive(Cylinder{0.0, 1.0}), moved_by(0.0, -1.2, 0.0));
  thin.add(CsgOperator::Difference, plate, hole);
  it.add(csg_shape(thin), at(0.0, 0.0, 0.0), coloured(kBlue));
  base::Affine3 flat = at(0.0, 0.0, -1.0);
  flat.linear().col(2) *= 1e-9;
  it.add(csg_shape(figure_5_6(0.3)), flat, coloured(kBlue));
  it.add(box(1.0), at(0.0, 0.0, 0.0), coloured(kRed));
  for (const CsgWay way : {CsgWay::Images, CsgWay::Triangles, CsgWay::Automatic})
    EXPECT_TRUE(is_red(middle(shot(it, camera_at({0.0, 0.0, 3.0}), lit_look(), way))));
}

TEST_F(SolidPictures, ThinPartsThrowShadowsToo) {
  // Far thinner than what sampling finds, so that there are no triangles of it.
  CsgTree tree;
  const auto plate = tree.add_leaf(Primitive(Box{{1.0, 0.0005, 1.0}}));
  const auto hole = tree.add_leaf(Primitive(Box{{0.3, 1.0, 0.3}}));
  tree.add(CsgOperator::Difference, plate, hole);
  DrawnWorld it;
  base::Affine3 down = base::Affine3::Identity();
  down.linear() = Eigen::AngleAxisd(-1.5707963, Vector3::UnitX()).toRotationMatrix();  // -z becomes -y
  it.add_fixture(world::Light{}, down);
  it.add(csg_shape(tree), at(0.0, 1.0, 0.0), coloured(kRed));
  it.add(box(4.0), at(0.0, -2.0, 0.0), coloured({0.8F, 0.8F, 0.8F}));
  Camera camera = camera_at({0.0, 0.0, 0.0});
  camera.camera_from_world.linear() = Eigen::AngleAxisd(0.4, Vector3::UnitX()).toRotationMatrix();
  camera.camera_from_world.translation() = -(camera.camera_from_world.linear() * Vector3(0.0, 2.0, 4.0));
  SceneLook look = plain_look();
  look.shadows = true;
  for (const int passes : {1, 4}) {
    look.passes = passes;
    const charts::Image image = shot(it, camera, look);
    keep_for_the_eye(image, "thin");
    const auto light_at = [&](const Vector3& p) {
      const auto where = project(camera, p);
      return at_share(image, where->x, where->y).light();
    };
    EXPECT_GT(light_at({1.4, 0.0, 0.5}), light_at({0.7, 0.0, 0.5}) + 60);  // beside and below it
    EXPECT_GT(light_at({0.0, 0.0, 0.0}), light_at({0.7, 0.0, 0.5}) + 60);  // through its hole
  }
}

/// Draws the scene some times in a context of its own; true when all pictures are alike.
bool draws_the_same_again(const RenderScene& scene, const Camera& camera, const charts::Image& expected) {
  auto easel = Easel::create();
  if (!easel) return false;
  for (int i = 0; i < 6; ++i) {
    if (easel->draw(scene, camera, lit_look(), CsgWay::Images).rgba != expected.rgba) return false;
  }
  return true;
}

TEST_F(SolidPictures, ContextsOnTwoThreadsDoNotDisturbEachOther) {
  RenderScenePointer scenes[2];
  Camera cameras[2];
  charts::Image expected[2];
  for (int i = 0; i < 2; ++i) {
    DrawnWorld it;
    it.add(csg_shape(i == 0 ? figure_5_6(1.0) : dented_ball(6)), at(0.0, 0.0, 0.0), coloured(kGreen));
    scenes[i] = published(it);
    cameras[i] = oblique(scenes[i]);
    expected[i] = Easel::create()->draw(*scenes[i], cameras[i], lit_look(), CsgWay::Images);
  }
  std::array<std::future<bool>, 4> same;
  for (std::size_t i = 0; i < same.size(); ++i)
    same[i] = std::async(std::launch::async, draws_the_same_again, std::cref(*scenes[i % 2]),
                         std::cref(cameras[i % 2]), std::cref(expected[i % 2]));
  for (auto& it : same) EXPECT_TRUE(it.get());
}

CsgTree random_tree(base::Random& random, int operands) {
  const auto within = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  CsgTree tree;
  std::vector<CsgTree::Index> open;
  for (int i = 0; i < operands; ++i) {
    base::Affine3 place = moved_by(within(-0.6, 0.6), within(-0.6, 0.6), within(-0.6, 0.6));
    place.linear() =
        Eigen::AngleAxisd(within(0.0, 3.0), Vector3(within(-1, 1), within(-1, 1), 1.0).normalized())
            .toRotationMatrix();
    const double size = within(0.3, 0.8);
    const Primitive shapes[] = {Box{{size, 0.7 * size, 0.5 * size}}, Sphere{size}, Cylinder{0.6 * size, size},
                                Torus{size, 0.35 * size}};
    open.push_back(tree.add_leaf(shapes[int(4.0 * random.uniform())], place));
  }
  while (open.size() > 1) {
    const auto op = static_cast<CsgOperator>(int(3.0 * random.uniform()));
    const std::size_t last = open.size() - 1;
    const std::size_t other = std::size_t(double(last) * random.uniform());
    open[other] = tree.add(op, open[other], open[last]);
    open.pop_back();
  }
  return tree;
}

TEST_F(SolidPictures, RandomTreesLookTheSameBothWays) {
  base::Random random(42);
  for (int i = 0; i < repeats(12); ++i) {
    DrawnWorld it;
    it.add(csg_shape(random_tree(random, 2 + i % 5)), at(0.0, 0.0, 0.0), coloured({0.8F, 0.7F, 0.5F}));
    it.add(box(0.3), at(1.0, -1.0, 0.0), coloured(kRed));
    const auto scene = published(it);
    expect_alike(scene, oblique(scene), lit_look(), "random" + std::to_string(i));
  }
}

}  // namespace
}  // namespace icome::render
