#include "interaction/techniques/world_targets.h"

#include "interaction/techniques/technique_cases.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::interaction {
namespace {

/// A world whose objects are made as the test says.
struct TargetWorld {
  world::World world;
  world::IdSource ids{1};

  world::GeometryId shape(const world::GeometryPointer& made) {
    const auto id = ids.next<world::GeometryId>();
    EXPECT_TRUE(apply(world, world::CreateGeometry{id, made}));
    return id;
  }
  world::ObjectId object(world::GeometryId geometry, const base::Affine3& place,
                         world::ObjectId parent = {}) {
    const auto id = ids.next<world::ObjectId>();
    world::PhysicalObject made;
    made.parent = parent;
    made.geometry = geometry;
    made.parent_from_object = place;
    EXPECT_TRUE(apply(world, world::CreateObject{id, 0, made}));
    return id;
  }
};

base::Affine3 stretched_frame(base::Random& random) {
  return base::Affine3(random_pose(random, 2.0)) *
         Eigen::Scaling(random.uniform(0.3, 2.0), random.uniform(0.3, 2.0), random.uniform(-2.0, -0.3));
}

world::GeometryPointer random_triangles(base::Random& random, int count) {
  geometry::TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const Vector3 at = random.uniform(0.0, 0.5) * random.direction();
    for (int corner = 0; corner < 3; ++corner) mesh.positions.emplace_back(at + 0.2 * random.direction());
    const auto first = std::uint32_t(3 * i);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return std::make_shared<world::MeshGeometry>(mesh);
}

/// The triangles of an object in the world's frame.
std::vector<geometry::Corners> world_triangles(const world::World& world, world::ObjectId id) {
  const auto& mesh =
      dynamic_cast<const world::MeshGeometry&>(*world.find(world.find(id)->geometry)->shape).mesh;
  std::vector<geometry::Corners> all;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    geometry::Corners corners;
    for (int i = 0; i < 3; ++i) corners[std::size_t(i)] = world_from_object(world, id) * mesh.corner(t, i);
    all.push_back(corners);
  }
  return all;
}

/// How far along the ray the triangle is crossed; nothing where it is not.
std::optional<double> crossing(const geometry::Corners& corners, const Ray& ray) {
  base::Matrix3 sides;
  sides << corners[1] - corners[0], corners[2] - corners[0], -ray.direction;
  const Vector3 solved = sides.fullPivLu().solve(ray.origin - corners[0]);
  if (solved.x() < 0.0 || solved.y() < 0.0 || solved.x() + solved.y() > 1.0 || solved.z() < 0.0)
    return std::nullopt;
  return solved.z();
}

TEST(WorldTargets, AreMetAsBruteForceOverTheirTrianglesSays) {
  base::Random random(12);
  int hits = 0, lit = 0;
  for (int i = 0; i < 60; ++i) {
    TargetWorld shop;
    const auto shape = shop.shape(random_triangles(random, 30));
    const auto group = shop.object({}, stretched_frame(random));
    const auto id = shop.object(shape, stretched_frame(random), group);
    const TechniqueScene scene = targets_of(shop.world);
    ASSERT_EQ(scene.targets().size(), 1u);
    ASSERT_EQ(scene.targets()[0].id, id.value);
    const auto triangles = world_triangles(shop.world, id);
    const Vector3 middle = scene.ball(0).centre;
    const Vector3 eye = middle + 4.0 * random.direction();
    const Ray ray{eye, (middle + 0.3 * random.direction() - eye).normalized()};
    const SelectionCone cone{eye, (middle + 1.5 * random.direction() - eye).normalized(), 0.1};
    double nearest = 1e9, first = 1e9;
    bool meets = false;
    for (const geometry::Corners& corners : triangles) {
      nearest = std::min(nearest, (geometry::nearest_point(corners, eye) - eye).norm());
      first = std::min(first, crossing(corners, ray).value_or(1e9));
      meets = meets || cone_meets_triangle(cone, corners);
    }
    ASSERT_TRUE(scene.nearest(eye));
    EXPECT_NEAR(scene.nearest(eye)->distance, nearest, 1e-9);
    const auto hit = scene.first_hit(ray);
    ASSERT_EQ(hit.has_value(), first < 1e9) << i;
    if (hit) {
      EXPECT_NEAR(hit->distance, first, 1e-9);
    }
    EXPECT_EQ(!scene.lit_by(cone).empty(), meets) << i;
    hits += hit ? 1 : 0;
    lit += meets ? 1 : 0;
  }
  EXPECT_GT(hits, 10);
  EXPECT_GT(lit, 10);
  EXPECT_LT(lit, 60);
}

TEST(WorldTargets, AHeldObjectIsMovedByAnEditThatCanBeUndone) {
  TargetWorld shop;
  const auto ball = shop.shape(std::make_shared<world::PrimitiveGeometry>(geometry::Sphere{0.1}));
  const auto plane = shop.shape(std::make_shared<world::PrimitiveGeometry>(geometry::Plane{}));
  base::Affine3 group_place =
      base::Affine3(pose_at(Vector3(1.0, 0.0, 0.0), turn_about(Vector3::UnitY(), 0.5)));
  group_place.linear() *= 2.0;
  const auto group = shop.object({}, group_place);
  const Vector3 at(0.0, 1.3, -1.0);
  const base::Affine3 place = group_place.inverse() * Eigen::Translation3d(at);
  const auto object = shop.object(ball, place, group);
  shop.object(plane, base::Affine3::Identity());  // endless: cannot be pointed at
  TechniqueScene scene = targets_of(shop.world);
  ASSERT_EQ(scene.targets().size(), 1u);
  const std::uint64_t before = hash(shop.world);
  std::vector<world::Edit> undo;
  std::vector<TechniqueInput> stream;
  for (int i = 0; i < 3; ++i) {
    TechniqueInput input = person_with(pose_at(Vector3(0.1 * std::max(0, i - 1), 1.3, 0.0)), 0.01 * i);
    input.hands[0].grab = i > 0;
    stream.push_back(input);
  }
  for (const TechniqueOutcome& it : replay(Technique(), stream, scene)) {
    if (!it.moved) continue;
    EXPECT_EQ(it.moved->id, object.value);
    const auto edit = edit_of(shop.world, *it.moved);
    ASSERT_TRUE(edit) << edit.error().message;
    auto inverse = apply(shop.world, *edit);
    ASSERT_TRUE(inverse);
    undo.push_back(std::move(*inverse));
  }
  EXPECT_TRUE(
      world_from_object(shop.world, object).translation().isApprox(at + Vector3(0.1, 0.0, 0.0), 1e-12));
  EXPECT_NE(hash(shop.world), before);
  ASSERT_FALSE(undo.empty());
  for (; !undo.empty(); undo.pop_back()) ASSERT_TRUE(apply(shop.world, undo.back()));
  EXPECT_EQ(hash(shop.world), before);
  // Within a solid the distance is negative; its triangles lie within it, by 1/1000 of its size at most.
  EXPECT_NEAR(targets_of(shop.world).nearest(at + Vector3(0.0, 0.05, 0.0))->distance, -0.05, 1e-3);
  EXPECT_FALSE(edit_of(shop.world, {999, base::Affine3::Identity()}));
}

}  // namespace
}  // namespace icome::interaction
