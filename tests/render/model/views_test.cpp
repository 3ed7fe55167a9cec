#include "render/model/views.h"

#include "base/decompositions.h"
#include "render/drawn_world.h"

namespace icome::render {
namespace {

/// Six plates around the origin, each of its own colour.
DrawnWorld six_sides() {
  DrawnWorld it;
  struct Side {
    Vector3 out;
    world::Colour colour;
  };
  for (const Side& side : {Side{{0, 0, 1}, {0.8F, 0.0F, 0.0F}}, Side{{0, 0, -1}, {0.0F, 0.8F, 0.0F}},
                           Side{{1, 0, 0}, {0.0F, 0.0F, 0.8F}}, Side{{-1, 0, 0}, {0.8F, 0.8F, 0.0F}},
                           Side{{0, 1, 0}, {0.8F, 0.0F, 0.8F}}, Side{{0, -1, 0}, {0.0F, 0.8F, 0.8F}}}) {
    base::Affine3 place = base::Affine3::Identity();
    place.linear() = base::rotation_between(Vector3::UnitZ(), side.out).toRotationMatrix();
    place.translation() = side.out;
    it.add(square(), place, coloured(side.colour));
  }
  return it;
}

TEST(Views, EachDirectionShowsItsSide) {
  const DrawnWorld it = six_sides();
  const auto scene = ScenePublisher().publish(it.world);
  const auto seen = [&](const char* name) {
    const Rgb c = middle(drawn(*scene, fit_scene(*scene, *view_direction(name), 1.0), plain_look()));
    return std::string() + (c.red > 60 ? "r" : "") + (c.green > 60 ? "g" : "") + (c.blue > 60 ? "b" : "");
  };
  EXPECT_EQ(seen("front"), "r");
  EXPECT_EQ(seen("back"), "g");
  EXPECT_EQ(seen("right"), "b");
  EXPECT_EQ(seen("left"), "rg");
  EXPECT_EQ(seen("top"), "rb");
  EXPECT_EQ(seen("bottom"), "gb");
  EXPECT_FALSE(view_direction("sideways").has_value());
}

TEST(Views, AllOfTheSceneIsSeenAtAnyShapeOfPicture) {
  DrawnWorld it;
  it.add(std::make_shared<world::PrimitiveGeometry>(geometry::Box{{5.0, 0.1, 2.0}}),
         world::at(100.0, 7.0, -4.0));
  const auto scene = ScenePublisher().publish(it.world);
  for (const ViewDirection& view : view_directions()) {
    for (const double aspect : {0.2, 1.0, 4.0}) {
      const Camera camera = fit_scene(*scene, view, aspect);
      double widest = 0.0;
      for (int corner = 0; corner < 8; ++corner) {
        const auto seen =
            project(camera, scene->bounds().corner(static_cast<base::Bounds::CornerType>(corner)));
        ASSERT_TRUE(seen.has_value());
        EXPECT_GT(seen->x, 0.0);
        EXPECT_LT(seen->x, 1.0);
        EXPECT_GT(seen->y, 0.0);
        EXPECT_LT(seen->y, 1.0);
        widest = std::max({widest, seen->x, seen->y});
      }
      EXPECT_GT(widest, 0.85) << view.name << aspect;
    }
  }
}

TEST(Views, AViewpointLooksAlongItsOwnZ) {
  DrawnWorld it = six_sides();
  base::Affine3 place = base::Affine3::Identity();
  place.linear() = Eigen::AngleAxisd(1.5707963, Vector3::UnitY()).toRotationMatrix() * 3.0;  // stretched, too
  place.translation() = Vector3(5.0, 0.0, 0.0);
  it.add_fixture(world::Viewpoint{0.8}, place, "from the right");
  const auto scene = ScenePublisher().publish(it.world);
  ASSERT_EQ(scene->viewpoints().size(), 1u);
  EXPECT_EQ(scene->viewpoints()[0].name, "from the right");
  const Camera camera = look_from(scene->viewpoints()[0], scene->bounds(), 1.5);
  EXPECT_TRUE(is_blue(middle(drawn(*scene, camera, plain_look()))));
  EXPECT_NEAR((camera.eye() - Vector3(5.0, 0.0, 0.0)).norm(), 0.0, 1e-9);
  // The shorter side has the angle.
  EXPECT_NEAR(camera.clip_from_camera(1, 1), 1.0 / std::tan(0.4), 1e-9);
}

}  // namespace
}  // namespace icome::render
