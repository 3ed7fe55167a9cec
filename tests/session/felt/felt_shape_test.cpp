#include "session/felt/felt_shape.h"

#include "base/random.h"
#include "haptics/shapes/mesh_shape.h"
#include "session/felt/stretched.h"
#include "world/sample_world.h"

namespace icome::session {
namespace {

using base::Affine3;
using base::Matrix3;
using base::Vector3;
using world::GeometryPointer;

Affine3 turned(double angle, const Vector3& axis) { return Affine3(Eigen::AngleAxisd(angle, axis)); }

GeometryPointer primitive(const geometry::Primitive& it, world::Axis axis = world::Axis::Z) {
  return std::make_shared<world::PrimitiveGeometry>(it, axis);
}

Affine3 random_place(base::Random& random) {
  Affine3 place = Affine3::Identity();
  for (double& entry : place.linear().reshaped()) entry = random.uniform(-2.0, 2.0);
  place.translation() = 5.0 * random.direction();
  return place;
}

TEST(RigidPart, IsThePlaceWhereThatIsRigid) {
  const Affine3 place = world::at(1.0, 2.0, 3.0) * turned(0.7, Vector3(1.0, 2.0, 3.0).normalized());
  const RigidPart part = rigid_part(place);
  EXPECT_TRUE(part.rigid());
  EXPECT_EQ(part.world_from_felt.matrix(), place.matrix());
}

TEST(RigidPart, AndTheRestMakeThePlace) {
  base::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Affine3 place = random_place(random);
    const RigidPart part = rigid_part(place);
    const Matrix3 turn = part.world_from_felt.linear();
    EXPECT_NEAR(turn.determinant(), 1.0, 1e-12);
    EXPECT_TRUE((turn * turn.transpose()).isIdentity(1e-12));
    EXPECT_TRUE((turn * part.felt_from_shape).isApprox(place.linear(), 1e-11));
    EXPECT_EQ(part.world_from_felt.translation(), place.translation());
  }
}

TEST(RigidPart, LeavesTheSameRestHoweverAPlaceIsTurned) {
  base::Random random(2);
  const Matrix3 stretch = Vector3(0.5, 2.0, 3.0).asDiagonal();
  for (int i = 0; i < 1000; ++i) {
    const Affine3 place =
        world::at(1.0, 0.0, 0.0) * turned(random.uniform(0.1, 3.0), random.direction()) * Affine3(stretch);
    EXPECT_EQ(rigid_part(place).felt_from_shape, stretch);
  }
}

TEST(FeltShape, StaysAPrimitiveWhereItsImageIsOne) {
  const auto image = [](const geometry::Primitive& it, const Vector3& along) {
    const auto felt = make_felt_shape(*primitive(it), along.asDiagonal(), {});
    return felt->primitive ? geometry::name(*felt->primitive) : std::string("none");
  };
  EXPECT_EQ(image(geometry::Sphere{0.5}, {2.0, 2.0, 2.0}), "sphere:1");
  EXPECT_EQ(image(geometry::Sphere{0.5}, {-2.0, 2.0, 2.0}), "sphere:1");
  EXPECT_EQ(image(geometry::Sphere{0.5}, {2.0, 2.0, 1.0}), "none");
  EXPECT_EQ(image(geometry::Box{{1.0, 1.0, 1.0}}, {0.5, 1.0, -2.0}), "box:1x2x4");
  EXPECT_EQ(image(geometry::Cylinder{0.5, 1.0}, {2.0, 2.0, 3.0}), "cylinder:1x3");
  EXPECT_EQ(image(geometry::Cylinder{0.5, 1.0}, {2.0, 1.0, 3.0}), "none");
  EXPECT_EQ(image(geometry::Cone{0.5, 0.25, 1.0}, {2.0, 2.0, -3.0}), "cone:0.5x1x3");
  EXPECT_EQ(image(geometry::Torus{0.5, 0.25}, {2.0, 2.0, 2.0}), "torus:1x0.5");
  EXPECT_EQ(image(geometry::Capsule{0.5, 1.0}, {2.0, 2.0, 2.0}), "capsule:1x2");
}

TEST(FeltShape, OfAnUprightCylinderThatGrowsUpwardsIsACylinder) {
  const GeometryPointer shape = primitive(geometry::Cylinder{0.5, 1.0}, world::Axis::Y);
  const FeltPlace place = felt_place(*shape, Affine3(Eigen::Scaling(1.0, 3.0, 1.0)));
  const auto felt = make_felt_shape(*shape, place.felt_from_geometry, {});
  ASSERT_TRUE(felt->primitive);
  EXPECT_EQ(geometry::name(*felt->primitive), "cylinder:0.5x3");
  // The felt z points up, along the shape's y.
  EXPECT_TRUE(Vector3(place.world_from_felt.linear() * Vector3::UnitZ()).isApprox(Vector3::UnitY(), 1e-12));
}

/// The surface that is felt lies where the shape's own surface is: asked for by what is inside.
void expect_same_inside(const world::Geometry& shape, const std::function<bool(const Vector3&)>& inside,
                        const Affine3& place, std::uint64_t seed) {
  const FeltPlace there = felt_place(shape, place);
  const auto felt = make_felt_shape(shape, there.felt_from_geometry, {});
  ASSERT_TRUE(felt->shape) << felt->remark;
  base::Random random(seed);
  int within = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector3 point = random.uniform(0.0, 1.5) * random.direction();  // in the shape's own frame
    // So far from the surface that rounding does not tell.
    const bool expected = inside(point);
    if (expected != inside(0.999 * point) || expected != inside(1.001 * point)) continue;
    const Vector3 at = there.world_from_felt.inverse() * (place * point);
    EXPECT_EQ(felt->shape->way_out(at, 0.0).has_value(), expected) << point.transpose();
    within += expected;
  }
  EXPECT_GT(within, 20);
}

TEST(FeltShape, IsWhereTheStretchedShapeIs) {
  base::Random random(3);
  geometry::CsgTree tree;
  const auto cut = tree.add_leaf(geometry::Primitive(geometry::Cylinder{0.3, 3.0}));
  const auto block = tree.add_leaf(geometry::Primitive(geometry::Box{Vector3(0.8, 0.6, 0.7)}));
  tree.add(geometry::CsgOperator::Difference, block, cut);
  for (int i = 0; i < 20; ++i) {
    const Affine3 place = random_place(random);  // half of them mirror
    for (const geometry::Primitive& it :
         {geometry::Primitive(geometry::Box{Vector3(0.5, 0.6, 0.7)}),
          geometry::Primitive(geometry::Sphere{0.8}), geometry::Primitive(geometry::Cone{0.9, 0.2, 1.2}),
          geometry::Primitive(geometry::Cylinder{0.7, 1.0}), geometry::Primitive(geometry::Torus{0.7, 0.3}),
          geometry::Primitive(geometry::Capsule{0.5, 0.6})}) {
      expect_same_inside(
          *primitive(it), [&](const Vector3& p) { return geometry::inside(it, p); }, place, std::uint64_t(i));
    }
    expect_same_inside(
        world::CsgGeometry(tree), [&](const Vector3& p) { return geometry::inside(tree, p); }, place,
        std::uint64_t(i));
    const geometry::Primitive box = geometry::Box{Vector3(0.5, 0.6, 0.7)};
    expect_same_inside(
        world::MeshGeometry(geometry::tessellate(box, 0.1)),
        [&](const Vector3& p) { return geometry::inside(box, p); }, place, std::uint64_t(i));
  }
}

TEST(FeltShape, OfAHalfSpaceIsAHalfSpaceWhereverItGoes) {
  base::Random random(4);
  const GeometryPointer shape = primitive(geometry::Plane{}, world::Axis::Y);  // solid below y = 0
  for (int i = 0; i < 100; ++i) {
    const Affine3 place = random_place(random);
    const FeltPlace there = felt_place(*shape, place);
    const auto felt = make_felt_shape(*shape, there.felt_from_geometry, {});
    ASSERT_TRUE(felt->primitive) << felt->remark;
    for (int k = 0; k < 20; ++k) {
      const Vector3 point = random.uniform(0.0, 3.0) * random.direction();
      if (std::abs(point.y()) < 1e-6) continue;
      const Vector3 at = there.world_from_felt.inverse() * (place * point);
      EXPECT_EQ(geometry::inside(*felt->primitive, at), point.y() < 0.0);
    }
  }
}

TEST(FeltShape, OfALoopSurfaceIsTheLimitOfTheStretchedControlMesh) {
  const world::LoopGeometry shape(geometry::ControlMesh{
      {{{1.0, 0.0, 0.0},
        {-1.0, 0.0, 0.0},
        {0.0, 1.0, 0.0},
        {0.0, -1.0, 0.0},
        {0.0, 0.0, 1.0},
        {0.0, 0.0, -1.0}},
       {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}},
      {},
      {}});
  const auto surface = *geometry::LoopSurface::create(shape.control);
  base::Random random(5);
  for (int i = 0; i < 10; ++i)
    expect_same_inside(
        shape, [&](const Vector3& p) { return surface->inside(p); }, random_place(random), 6);
}

TEST(FeltShape, OfAnImplicitSurfaceIsExactUntilItIsStretched) {
  const auto shape = *world::ImplicitGeometry::create("x^2 + y^2 + z^2 - 1",
                                                      base::Bounds(Vector3(-2, -2, -2), Vector3(2, 2, 2)));
  const auto turned_only = felt_place(*shape, world::at(1, 2, 3) * turned(1.0, Vector3::UnitX()));
  EXPECT_TRUE(make_felt_shape(*shape, turned_only.felt_from_geometry, {})->exact);
  const Affine3 flat(Eigen::Scaling(1.0, 1.0, 0.5));
  const auto felt = make_felt_shape(*shape, felt_place(*shape, flat).felt_from_geometry, {});
  EXPECT_FALSE(felt->exact);
  EXPECT_NE(felt->remark.find("stretched implicit surface"), std::string::npos);
  ASSERT_TRUE(felt->mesh);
  EXPECT_TRUE(felt->closed);
  for (const Vector3& position : felt->mesh->positions)
    EXPECT_NEAR((flat.inverse() * position).norm(), 1.0, 4.0 / 2000.0);
}

TEST(FeltShape, ThatMovesWithTimeIsFeltAsItIsSeen) {
  // A floor that rises by a tenth of a metre a second.
  const auto shape =
      *world::ImplicitGeometry::create("z - 0.1*t", base::Bounds(Vector3(-1, -1, -1), Vector3(1, 1, 1)));
  const auto height_at = [](const FeltShape& felt, double time) {
    const auto hit = felt.shape->cast(Vector3(0.1, 0.2, 0.9), Vector3(0, 0, -1.5), time);
    return hit ? hit->point.z() : -1.0;
  };
  const auto still = make_felt_shape(*shape, Matrix3::Identity(), {});
  const auto moving = make_felt_shape(*shape, Matrix3::Identity(), {.with_time = true});
  EXPECT_FALSE(still->shape->changes());
  EXPECT_TRUE(moving->shape->changes());
  for (const double time : {0.0, 1.0, 5.0}) {
    EXPECT_NEAR(height_at(*still, time), 0.0, 1e-12);
    EXPECT_NEAR(height_at(*moving, time), 0.1 * time, 1e-12);
    EXPECT_FALSE(still->inside(Vector3(0, 0, 0.05), time));
    EXPECT_EQ(moving->inside(Vector3(0, 0, 0.05), time), time > 0.5);
    const auto out = still->shape->way_out(Vector3(0, 0, -0.01), time);
    ASSERT_TRUE(out);
    EXPECT_NEAR(out->point.z(), 0.0, 1e-12);
  }
}

TEST(FeltShape, SaysWhatCannotBeTouched) {
  const Matrix3 one = Matrix3::Identity();
  const auto expect = [](const FeltShapePointer& felt, const std::string& why) {
    EXPECT_FALSE(felt->shape);
    EXPECT_NE(felt->remark.find(why), std::string::npos) << felt->remark;
  };
  expect(make_felt_shape(world::MeshGeometry({}), one, {}), "is empty");
  expect(make_felt_shape(world::CsgGeometry({}), one, {}), "is empty");
  expect(make_felt_shape(world::LoopGeometry({}), one, {}), "is empty");
  geometry::TriangleMesh line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
  expect(make_felt_shape(world::MeshGeometry(line), one, {}), "no triangle with an area");
  line.triangles = {{0, 1, 7}};
  expect(make_felt_shape(world::MeshGeometry(line), one, {}), "damaged");
  const GeometryPointer box = world::box(1.0);
  Affine3 endless = Affine3::Identity();
  endless.linear() *= std::numeric_limits<double>::infinity();
  expect(make_felt_shape(*box, felt_place(*box, endless).felt_from_geometry, {}), "too far away");
  // An edge of which three triangles have a part is no surface to subdivide.
  const geometry::TriangleMesh fin{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}},
                                   {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}};
  expect(make_felt_shape(world::LoopGeometry({fin, {}, {}}), one, {}), "cannot be touched");
}

TEST(FeltShape, OfAFormulaUnderASphereTipIsExactWhereThatCanBe) {
  const FeltSettings settings{.tip_radius = 0.01};
  const base::Bounds box(Vector3::Constant(-0.1), Vector3::Constant(0.1));
  const auto felt_of = [&](const std::string& formula) {
    return make_felt_shape(**world::ImplicitGeometry::create(formula, box), Matrix3::Identity(), settings);
  };
  const auto ball = felt_of("x^2 + y^2 + z^2 - 0.05^2");
  EXPECT_FALSE(ball->mesh);
  EXPECT_EQ(ball->remark, "");
  EXPECT_NEAR(ball->shape->cast({0.0, 0.0, 0.2}, {0.0, 0.0, -0.3}, 0.0)->point.z(), 0.06, 1e-9);
  const auto cone = felt_of("x^2 + y^2 - z^2");
  EXPECT_TRUE(cone->mesh);
  EXPECT_NE(cone->remark.find("comes to a point"), std::string::npos) << cone->remark;
}

TEST(FeltShape, OfASolidUnderASphereTipIsExactWhereThatCanBe) {
  const FeltSettings settings{.tip_radius = 0.01};
  geometry::CsgTree round;
  round.add_leaf(geometry::Primitive(geometry::Sphere{1.0}));
  const auto exact = make_felt_shape(world::CsgGeometry(round), Matrix3::Identity(), settings);
  EXPECT_TRUE(exact->shape);
  EXPECT_FALSE(exact->mesh);
  EXPECT_EQ(exact->remark, "");
  geometry::CsgTree oval;
  oval.add_leaf(geometry::Primitive(geometry::Sphere{1.0}), Affine3(Eigen::Scaling(1.0, 1.0, 2.0)));
  const auto solid = make_felt_shape(world::CsgGeometry(oval), Matrix3::Identity(), settings);
  EXPECT_TRUE(solid->mesh);
  EXPECT_NE(solid->remark.find("curved primitives are stretched"), std::string::npos) << solid->remark;
  const auto ellipsoid =
      make_felt_shape(*primitive(geometry::Sphere{1.0}), Vector3(1.0, 2.0, 3.0).asDiagonal(), settings);
  EXPECT_TRUE(ellipsoid->mesh);
  EXPECT_TRUE(make_felt_shape(*primitive(geometry::Sphere{1.0}), Matrix3::Identity(), settings)->primitive);
}

TEST(FeltShape, OfALoopSurfaceUnderASphereTipIsExact) {
  const world::LoopGeometry shape(
      geometry::ControlMesh{{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}}, {}, {}});
  const auto felt = make_felt_shape(shape, Matrix3::Identity(), {.tip_radius = 0.01});
  ASSERT_TRUE(felt->shape);
  EXPECT_FALSE(felt->mesh);
  EXPECT_EQ(felt->remark, "");
  const auto hit = felt->shape->cast(Vector3(0.5, 0.5, 1.0), Vector3(0, 0, -2), 0.0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->point.z(), 0.01, 1e-9);  // where the tip's centre is
}

TEST(FeltShape, FarOffIsMadeAboutTheOrigin) {
  const Vector3 far(0x1p20, -0x1p19, 0x1p10);
  geometry::CsgTree tree;
  tree.add_leaf(geometry::Primitive(geometry::Sphere{1.0}), Affine3(Eigen::Translation3d(far)));
  const auto solid = make_felt_shape(world::CsgGeometry(tree), Matrix3::Identity(), {});
  EXPECT_EQ(solid->middle, far);
  EXPECT_TRUE(solid->inside(Vector3(0, 0, 0.999), 0.0));
  EXPECT_FALSE(solid->inside(Vector3(0, 0, 1.001), 0.0));
  geometry::ControlMesh sheet{{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}}, {}, {}};
  for (Vector3& position : sheet.mesh.positions) position += far;
  const auto surface = make_felt_shape(world::LoopGeometry(sheet), Matrix3::Identity(), {});
  EXPECT_LT((surface->middle - far).norm(), 2.0);
  EXPECT_LT(surface->shape->bounds().max().norm(), 4.0);
}

TEST(FeltShape, OfAnOpenMeshIsTouchedFromBothSides) {
  const auto felt = make_felt_shape(*world::one_triangle(), Matrix3::Identity(), {});
  EXPECT_FALSE(felt->closed);
  EXPECT_EQ(felt->remark, "");
}

/// A ball of triangles, and what becomes of it when each of its vertices moves.
template <typename Move>
world::MeshGeometry ball(Move&& move) {
  geometry::TriangleMesh mesh = geometry::tessellate(geometry::Primitive(geometry::Sphere{0.5}), 0.002);
  for (Vector3& position : mesh.positions) position = move(position);
  return world::MeshGeometry(std::move(mesh));
}

const geometry::TriangleTree& tree_of(const FeltShapePointer& felt) {
  return dynamic_cast<const haptics::MeshShape&>(*felt->shape).tree();
}

/// Is the one made of the other? Made anew, it would have another order, as it lies otherwise.
bool follows(const FeltShapePointer& felt, const FeltShapePointer& before) {
  bool same = tree_of(felt).size() == tree_of(before).size();
  for (std::uint32_t slot = 0; same && slot < tree_of(felt).size(); ++slot)
    same = tree_of(felt).triangle(slot) == tree_of(before).triangle(slot);
  return same;
}

Vector3 stays(const Vector3& place) { return place; }
Vector3 turns_over(const Vector3& place) {
  return {place.y(), 3.0 + place.z(), (1.0 + 0.2 * place.y()) * place.x()};
}

TEST(FeltShape, FollowsItsVerticesToWhereItWouldBeMadeAnew) {
  const Matrix3 stretch = Vector3(1.0, 2.0, -1.5).asDiagonal();
  for (const double tip : {0.0, 0.01}) {
    const FeltSettings settings{.tip_radius = tip, .interpolate_normals = true};
    const auto before = make_felt_shape(ball(stays), stretch, settings);
    const auto moved = ball(turns_over);
    const auto felt = make_felt_shape(moved, stretch, settings, before.get());
    const auto anew = make_felt_shape(moved, stretch, settings);
    EXPECT_TRUE(follows(felt, before));
    EXPECT_FALSE(follows(anew, before));
    EXPECT_TRUE(felt->closed);
    EXPECT_EQ(felt->mesh->positions, anew->mesh->positions);
    base::Random random(9);
    int hits = 0;
    for (int i = 0; i < 300; ++i) {
      const Vector3 start = stretch * (Vector3(0.0, 3.0, 0.0) + 0.7 * random.direction());
      const Vector3 step = 2.0 * random.direction();
      const auto hit = felt->shape->cast(start, step, 0.0), same_hit = anew->shape->cast(start, step, 0.0);
      ASSERT_EQ(hit.has_value(), same_hit.has_value());
      if (hit) {
        EXPECT_TRUE(hit->point.isApprox(same_hit->point, 1e-12));
        ++hits;
      }
      const auto out = felt->shape->way_out(start, 0.0), same_out = anew->shape->way_out(start, 0.0);
      ASSERT_EQ(out.has_value(), same_out.has_value());
      if (out) {
        EXPECT_NEAR((out->point - start).norm(), (same_out->point - start).norm(), 1e-12);
      }
    }
    EXPECT_GT(hits, 30);
  }
}

TEST(FeltShape, IsMadeAnewWhereFollowingIsNotEnough) {
  const Matrix3 one = Matrix3::Identity();
  const auto before = make_felt_shape(ball(stays), one, {});
  auto moved = ball(turns_over);
  EXPECT_TRUE(follows(make_felt_shape(moved, one, {}, before.get()), before));
  EXPECT_FALSE(follows(make_felt_shape(moved, 2.0 * one, {}, before.get()), before));
  // Another surface over as many vertices.
  auto turned_face = moved;
  std::swap(turned_face.mesh.triangles[5][0], turned_face.mesh.triangles[5][1]);
  EXPECT_FALSE(follows(make_felt_shape(turned_face, one, {}, before.get()), before));
  // A triangle that has lost its area is repaired, and what comes out is not the shape's own mesh.
  const auto& corners = moved.mesh.triangles[7];
  moved.mesh.positions[corners[0]] = moved.mesh.positions[corners[1]];
  const auto repaired = make_felt_shape(moved, one, {}, before.get());
  EXPECT_LT(repaired->mesh->triangles.size(), moved.mesh.triangles.size());
  EXPECT_FALSE(repaired->sound);
  EXPECT_FALSE(follows(make_felt_shape(ball(turns_over), one, {}, repaired.get()), repaired));
}

}  // namespace
}  // namespace icome::session
