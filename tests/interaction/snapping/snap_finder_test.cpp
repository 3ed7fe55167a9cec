#include "interaction/snapping/snap_finder.h"

#include <algorithm>
#include <functional>

#include "geometry/csg/csg_tree.h"
#include "geometry/implicit/implicit_surface.h"
#include "geometry/loop/loop_surface.h"
#include "interaction/snapping/clutter.h"
#include "repeats.h"
#include "world/shape/solid_geometry.h"

namespace icome::interaction {
namespace {

using geometry::TriangleMesh;

constexpr double kRadians = std::numbers::pi / 180.0;

SnapSettings only(SnapKind kind, double radius) {
  SnapSettings settings{radius, false, false, false, false, false, 0.01};
  if (kind == SnapKind::Vertex) settings.vertices = true;
  if (kind == SnapKind::Middle) settings.middles = true;
  if (kind == SnapKind::Edge) settings.edges = true;
  if (kind == SnapKind::Face) settings.faces = true;
  if (kind == SnapKind::Grid) settings.grid = true;
  return settings;
}

/// One object, and questions about it.
struct Asked {
  Clutter clutter;
  ObjectId object;
  CollisionIndex index;
  SnapFinder finder;

  explicit Asked(world::GeometryPointer shape, const Affine3& place = Affine3::Identity(),
                 double sharp_angle = SnapFinder::kSharpAngle)
      : object(clutter.add(std::move(shape), place)), index(clutter.world), finder(sharp_angle) {}

  std::optional<Snap> nearest(SnapKind kind, const Vector3& point, double radius = 100.0) {
    return finder.nearest(clutter.world, index, point, only(kind, radius));
  }
  Vector3 point(SnapKind kind, const Vector3& from) {
    const auto snap = nearest(kind, from);
    return snap ? snap->point : Vector3::Constant(NAN);
  }
};

Vector3 somewhere(base::Random& random, double far) {
  return {random.uniform(-far, far), random.uniform(-far, far), random.uniform(-far, far)};
}

Affine3 any_affine(base::Random& random, bool even) {
  Affine3 map = Clutter::anywhere(random);
  if (even) return map * Eigen::Scaling(random.uniform(0.5, 2.0));
  map = map * Eigen::Scaling(random.uniform(0.3, 2.0), random.uniform(0.3, 2.0), -random.uniform(0.3, 2.0));
  return map * turned(random.uniform(0.0, 3.0), random.direction()) * Eigen::Scaling(1.0, 1.5, 0.7);
}

/// Triangles that share nothing: all their corners and edges are their own.
TriangleMesh soup(base::Random& random, std::uint32_t count) {
  TriangleMesh mesh;
  for (std::uint32_t t = 0; t < count; ++t) {
    const Vector3 middle = somewhere(random, 1.0);
    for (int i = 0; i < 3; ++i) mesh.positions.push_back(middle + somewhere(random, 0.1));
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return mesh;
}

Vector3 on_line(const Vector3& a, const Vector3& b, const Vector3& point) {
  return a + std::clamp((point - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0) * (b - a);
}

/// By looking at everything.
double least_distance(const TriangleMesh& mesh, const Affine3& place, SnapKind kind, const Vector3& point) {
  double least = INFINITY;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    geometry::Corners corners;
    for (int i = 0; i < 3; ++i) corners[i] = place * mesh.corner(t, i);
    const auto take = [&](const Vector3& there) { least = std::min(least, (there - point).norm()); };
    for (int i = 0; i < 3; ++i) {
      const Vector3 &a = corners[i], &b = corners[(i + 1) % 3];
      if (kind == SnapKind::Vertex) take(a);
      if (kind == SnapKind::Middle) take(0.5 * (a + b));
      if (kind == SnapKind::Edge) take(on_line(a, b, point));
    }
    if (kind == SnapKind::Face) take(geometry::nearest_point(corners, point));
  }
  return least;
}

TEST(SnapFinder, FindsTheNearestOfRandomMeshes) {
  base::Random random(21);
  for (int round = 0; round < 12; ++round) {
    const TriangleMesh mesh = soup(random, 1 + std::uint32_t(random.index(400)));
    const Affine3 place = any_affine(random, round % 2 == 0);
    Asked asked(std::make_shared<world::MeshGeometry>(mesh), place);
    for (int i = 0; i < 50; ++i) {
      const Vector3 point = somewhere(random, 2.0);
      for (const SnapKind kind : {SnapKind::Vertex, SnapKind::Middle, SnapKind::Edge, SnapKind::Face}) {
        const double least = least_distance(mesh, place, kind, point);
        const auto snap = asked.nearest(kind, point, 1.5 * least);
        ASSERT_TRUE(snap);
        EXPECT_EQ(snap->kind, kind);
        EXPECT_EQ(snap->object, asked.object);
        EXPECT_NEAR(snap->distance, least, 1e-12);
        EXPECT_NEAR((snap->point - point).norm(), least, 1e-12);
        EXPECT_FALSE(asked.nearest(kind, point, 0.999 * least));
        EXPECT_TRUE(asked.nearest(kind, point, 1.001 * least));
      }
    }
  }
}

TEST(SnapFinder, PrefersVerticesThenMiddlesEdgesFacesAndTheGrid) {
  Asked asked(solid(geometry::Box{{0.5, 0.5, 0.5}}));
  SnapSettings settings{0.1, true, true, true, true, true, 0.3};
  const auto kind = [&](const Vector3& point) {
    return asked.finder.nearest(asked.clutter.world, asked.index, point, settings)->kind;
  };
  EXPECT_EQ(kind({0.45, 0.45, 0.5}), SnapKind::Vertex);  // though the face is nearer
  EXPECT_EQ(kind({0.05, 0.45, 0.5}), SnapKind::Middle);
  EXPECT_EQ(kind({0.3, 0.45, 0.5}), SnapKind::Edge);
  EXPECT_EQ(kind({0.3, 0.3, 0.45}), SnapKind::Face);
  EXPECT_EQ(kind({0.3, 0.35, 0.0}), SnapKind::Grid);
  settings.vertices = settings.middles = false;
  EXPECT_EQ(kind({0.45, 0.45, 0.5}), SnapKind::Edge);
  settings.edges = false;
  EXPECT_EQ(kind({0.45, 0.45, 0.5}), SnapKind::Face);
  settings.faces = settings.grid = false;
  EXPECT_FALSE(asked.finder.nearest(asked.clutter.world, asked.index, {0.45, 0.45, 0.5}, settings));
}

TEST(SnapFinder, SaysAlongWhatAndOutOfWhat) {
  Asked asked(solid(geometry::Box{{1.0, 2.0, 3.0}}), at(5.0, 0.0, 0.0) * Eigen::Scaling(1.0, 1.0, -1.0));
  const auto edge = asked.nearest(SnapKind::Edge, {6.1, 2.1, 0.7});
  EXPECT_LT((edge->point - Vector3(6.0, 2.0, 0.7)).norm(), 1e-12);
  EXPECT_NEAR(std::abs(edge->direction.z()), 1.0, 1e-12);
  EXPECT_NEAR((edge->to - edge->from).norm(), 6.0, 1e-12);
  const auto face = asked.nearest(SnapKind::Face, {5.2, 0.3, 3.1});
  EXPECT_LT((face->point - Vector3(5.2, 0.3, 3.0)).norm(), 1e-12);
  EXPECT_LT((face->direction - Vector3::UnitZ()).norm(), 1e-12);  // out of it, though it is mirrored
}

TEST(SnapFinder, KnowsRoundShapesAsTheyAre) {
  base::Random random(22);
  const geometry::Primitive ball = geometry::Sphere{0.7}, ring = geometry::Torus{1.0, 0.3};
  for (const geometry::Primitive& shape : {ball, ring, geometry::Primitive(geometry::Capsule{0.2, 1.0})}) {
    const Affine3 place = any_affine(random, true);
    Asked asked(solid(shape), place);
    for (int i = 0; i < 100; ++i) {
      const Vector3 point = place * somewhere(random, 1.5);
      const auto face = asked.nearest(SnapKind::Face, point);
      ASSERT_TRUE(face);
      const Vector3 own = place.inverse() * point;
      EXPECT_NEAR(face->distance,
                  std::abs(signed_distance(shape, own)) * std::cbrt(place.linear().determinant()), 1e-12);
      EXPECT_LT(std::abs(signed_distance(shape, place.inverse() * face->point)), 1e-12);
      // No corners or edges, though it is drawn with triangles.
      for (const SnapKind kind : {SnapKind::Vertex, SnapKind::Middle, SnapKind::Edge})
        EXPECT_FALSE(asked.nearest(kind, point));
    }
  }
}

TEST(SnapFinder, FindsTheNearestPlaceOfStretchedRoundShapes) {
  base::Random random(23);
  const std::vector<geometry::Primitive> shapes = {
      geometry::Sphere{0.7}, geometry::Torus{1.0, 0.3}, geometry::Cylinder{0.4, 1.0},
      geometry::Cone{0.6, 0.2, 1.0}, geometry::Capsule{0.2, 1.0}};
  for (const geometry::Primitive& shape : shapes) {
    const geometry::TriangleMesh samples = geometry::tessellate(shape, 1e-3);
    for (int round = 0; round < 3; ++round) {
      const Affine3 place = turned(random.uniform(0.0, 3.0), random.direction()) *
                            Eigen::Scaling(1.0, random.uniform(0.3, 3.0), random.uniform(0.3, 3.0));
      Asked asked(solid(shape), place);
      for (int i = 0; i < 20; ++i) {
        const Vector3 point = place * somewhere(random, 1.5);
        const auto face = asked.nearest(SnapKind::Face, point);
        ASSERT_TRUE(face);
        EXPECT_LT(std::abs(signed_distance(shape, place.inverse() * face->point)), 1e-9);
        double least = 1e9;
        for (const Vector3& it : samples.positions) least = std::min(least, (place * it - point).norm());
        // Both are of the surface, and no sample is nearer than the nearest place.
        EXPECT_LE(face->distance, least + 1e-9) << shape.index() << ", " << round << ", " << i;
      }
    }
  }
}

/// Solids that are no meshes, with the question that judges.
struct SnapSolid {
  world::GeometryPointer shape;
  std::function<bool(const Vector3&)> inside;
};

std::vector<SnapSolid> snap_solids() {
  std::vector<SnapSolid> all;
  geometry::CsgTree tree;
  const auto block = tree.add_leaf(geometry::Primitive(geometry::Box{{0.2, 0.1, 0.2}}));
  const auto hollow = tree.add_leaf(geometry::Primitive(geometry::Sphere{0.15}), at(0.0, 0.12, 0.0));
  tree.add(geometry::CsgOperator::Difference, block, hollow);
  all.push_back({std::make_shared<world::CsgGeometry>(tree),
                 [tree](const Vector3& place) { return geometry::inside(tree, place); }});
  const auto formula =
      *world::ImplicitGeometry::create("x^2+y^2+z^2-0.04+0.003*sin(50*x)*sin(50*y)",
                                       base::Bounds(Vector3::Constant(-0.3), Vector3::Constant(0.3)));
  all.push_back({formula, [formula](const Vector3& place) {
                   return formula->surface()->box().contains(place) && formula->surface()->inside(place);
                 }});
  const geometry::ControlMesh control{geometry::tessellate(geometry::Box{{0.3, 0.2, 0.4}}, 1.0), {}, {}};
  const std::shared_ptr<const geometry::LoopSurface> loop = *geometry::LoopSurface::create(control);
  all.push_back({std::make_shared<world::LoopGeometry>(control), [loop](const Vector3& place) {
                   return loop->bounds().contains(place) && loop->inside(place);
                 }});
  return all;
}

TEST(SnapFinder, FindsFacesOfSolidsFormulasAndSubdivisionSurfacesAsTheyAre) {
  constexpr int kTries = kSanitizerShare > 1 ? 8 : 40;
  base::Random random(24);
  for (const SnapSolid& it : snap_solids()) {
    for (const bool even : {true, false}) {
      const Affine3 place = even ? any_affine(random, true)
                                 : Affine3(Clutter::anywhere(random) * Eigen::Scaling(1.0, 1.5, 0.7));
      Asked asked(it.shape, place);
      int found = 0;
      for (int i = 0; i < kTries; ++i) {
        const Vector3 point = place * Vector3(0.4 * random.direction());
        const auto snap = asked.nearest(SnapKind::Face, point, 0.4);
        if (!snap) continue;
        ++found;
        EXPECT_NEAR((snap->point - point).norm(), snap->distance, 1e-12);
        // A place a little above is out, and one next to it is in: below it, but for edges and corners.
        const Affine3 solid_from_world = place.inverse();
        const auto in = [&](const Vector3& off) {
          return it.inside(solid_from_world * Vector3(snap->point + off));
        };
        bool is_solid = in(-1e-8 * snap->direction);
        for (int k = 0; k < 100 && !is_solid; ++k) is_solid = in(2e-8 * random.direction());
        EXPECT_TRUE(is_solid) << it.shape->kind() << " " << i;
        EXPECT_FALSE(in(1e-8 * snap->direction)) << it.shape->kind() << " " << i;
        if (!even) continue;
        // Nothing of the solid is nearer: not on ways that are nearly straight there either.
        for (int k = 0; k < 50; ++k) {
          const Vector3 way =
              (snap->point - point).normalized() + 0.1 * random.uniform() * random.direction();
          EXPECT_FALSE(
              !it.inside(solid_from_world * point) &&
              it.inside(solid_from_world * Vector3(point + (snap->distance - 1e-7) * way.normalized())));
        }
      }
      EXPECT_GT(found, kTries / 4) << it.shape->kind();
    }
  }
}

TEST(SnapFinder, SnapsToRimsAndTips) {
  Asked can(solid(geometry::Cylinder{0.5, 2.0}), at(1.0, 0.0, 0.0) * Eigen::Scaling(2.0));
  const Vector3 out = Vector3(1.0, 1.0, 0.0).normalized();
  const auto rim = can.nearest(SnapKind::Edge, Vector3(1.0, 0.0, 1.9) + 1.2 * out);
  ASSERT_TRUE(rim);
  EXPECT_LT((rim->point - (Vector3(1.0, 0.0, 2.0) + out)).norm(), 1e-9);
  EXPECT_NEAR(std::abs(rim->direction.dot(Vector3(1.0, -1.0, 0.0).normalized())), 1.0, 1e-9);
  EXPECT_FALSE(can.nearest(SnapKind::Vertex, {1.0, 0.0, 2.0}));
  EXPECT_FALSE(can.nearest(SnapKind::Middle, {1.0, 0.0, 2.0}));
  Asked hat(solid(geometry::Cone{0.5, 0.0, 2.0}));
  EXPECT_LT((hat.point(SnapKind::Vertex, {0.2, 0.1, 1.1}) - Vector3(0.0, 0.0, 1.0)).norm(), 1e-12);
  // Stretched to an ellipse: next to its long axis.
  Asked oval(solid(geometry::Cylinder{0.5, 2.0}), Affine3(Eigen::Scaling(3.0, 1.0, 1.0)));
  const auto end = oval.nearest(SnapKind::Edge, {1.7, 0.0, 1.2});
  EXPECT_LT((end->point - Vector3(1.5, 0.0, 1.0)).norm(), 1e-8);
}

TEST(SnapFinder, TellsTheEdgesOfMeshesFromSmoothPlaces) {
  const Vector3 middle_of_face(0.0, 0.0, 0.5);
  Asked crate(tessellated(geometry::Box{{0.5, 0.5, 0.5}}));
  EXPECT_LT((crate.point(SnapKind::Vertex, {0.1, 0.1, 0.5}) - Vector3(0.5, 0.5, 0.5)).norm(), 1e-12);
  // The diagonals of its faces are none of its edges.
  EXPECT_NEAR((crate.point(SnapKind::Edge, middle_of_face) - middle_of_face).norm(), 0.5, 1e-12);
  EXPECT_NEAR((crate.point(SnapKind::Middle, middle_of_face) - middle_of_face).norm(), 0.5, 1e-12);
  Asked all(tessellated(geometry::Box{{0.5, 0.5, 0.5}}), Affine3::Identity(), 0.0);
  EXPECT_LT((all.point(SnapKind::Edge, middle_of_face) - middle_of_face).norm(), 1e-12);
  const auto fine = tessellated(geometry::Sphere{1.0}, 1e-3),
             coarse = tessellated(geometry::Sphere{1.0}, 0.1);
  EXPECT_FALSE(Asked(fine).nearest(SnapKind::Vertex, Vector3::Zero()));
  EXPECT_TRUE(Asked(coarse).nearest(SnapKind::Vertex, Vector3::Zero()));
  EXPECT_TRUE(Asked(fine, Affine3::Identity(), 0.5 * kRadians).nearest(SnapKind::Vertex, Vector3::Zero()));
}

TEST(SnapFinder, SnapsToTheGrid) {
  const auto snap = snap_to_grid({0.123, -0.26, 0.049}, 0.1, 0.2);
  ASSERT_TRUE(snap);
  EXPECT_LT((snap->point - Vector3(0.1, -0.3, 0.0)).norm(), 1e-15);
  EXPECT_FALSE(snap->object);
  EXPECT_FALSE(snap_to_grid({0.05, 0.05, 0.05}, 0.1, 0.08));
  for (const double bad : {0.0, -1.0, double(NAN), double(INFINITY)})
    EXPECT_FALSE(snap_to_grid({1, 2, 3}, bad, 1.0));
}

TEST(SnapFinder, LeavesOutWhatMovesAndFollowsEdits) {
  Asked asked(solid(geometry::Box{{0.5, 0.5, 0.5}}));
  const ObjectId lid =
      asked.clutter.add(solid(geometry::Box{{0.5, 0.5, 0.1}}), at(0.0, 0.0, 2.0), asked.object);
  asked.index = CollisionIndex(asked.clutter.world);
  world::World& world = asked.clutter.world;
  const SnapSettings vertices = only(SnapKind::Vertex, 0.5);
  const Vector3 by_lid(0.55, 0.5, 2.2);
  EXPECT_EQ(asked.finder.nearest(world, asked.index, by_lid, vertices)->object, lid);
  EXPECT_FALSE(asked.finder.nearest(world, asked.index, by_lid, vertices, std::vector{asked.object}));
  EXPECT_FALSE(asked.finder.nearest(world, asked.index, by_lid, vertices, std::vector{lid}));
  EXPECT_EQ(asked.finder.kept(), 1U);
  const world::Edit edit =
      world::ReplaceGeometry{world.find(lid)->geometry, solid(geometry::Box{{0.4, 0.5, 0.1}})};
  applied(world, edit);
  asked.index.follow(world, changes_of(edit));
  asked.finder.follow(changes_of(edit));
  EXPECT_EQ(asked.finder.kept(), 0U);
  EXPECT_NEAR(asked.finder.nearest(world, asked.index, by_lid, vertices)->point.x(), 0.4, 1e-12);
}

TEST(SnapFinder, SnapsHandlesOfObjects) {
  Asked asked(solid(geometry::Box{{0.5, 0.5, 0.5}}));
  const ObjectId cube = asked.clutter.add(solid(geometry::Box{{0.1, 0.1, 0.1}}), at(0.0, 0.0, 5.0));
  asked.index = CollisionIndex(asked.clutter.world);
  const auto found = [&](const Vector3& offset, const SnapHandles& handles) {
    return asked.finder.of_objects(asked.clutter.world, asked.index, std::vector{cube}, offset,
                                   only(SnapKind::Vertex, 0.05), handles);
  };
  // Its lower corner comes next to a corner of the large one.
  const Vector3 offset(0.61, 0.62, -4.38);
  const auto snaps = found(offset, {});
  ASSERT_FALSE(snaps.empty());
  EXPECT_LT((snaps[0].offset() - Vector3(-0.01, -0.02, -0.02)).norm(), 1e-12);
  EXPECT_TRUE(found(offset, {.origins = true, .box = false, .vertices = false}).empty());
  EXPECT_EQ(found({0.51, 0.5, -4.5}, {.origins = true, .box = false, .vertices = false}).size(), 1U);
  EXPECT_EQ(asked.finder.handles_of(asked.clutter.world, asked.index, std::vector{cube}).size(),
            1U + 9U + 8U);
  const ObjectId rough = asked.clutter.add(tessellated(geometry::Torus{1.0, 0.3}, 1e-3), at(0.0, 0.0, 50.0));
  asked.index = CollisionIndex(asked.clutter.world);
  SnapFinder every(0.0);
  const std::size_t most =
      every.handles_of(asked.clutter.world, asked.index, std::vector{rough}, {false, false, true}).size();
  EXPECT_GT(most, 6U);
  EXPECT_LE(most, 26U);
}

TEST(SnapFinder, AnswersNothingToWhatCannotBe) {
  Asked asked(solid(geometry::Box{{0.5, 0.5, 0.5}}));
  for (const double bad : {double(NAN), double(INFINITY)}) {
    EXPECT_FALSE(asked.nearest(SnapKind::Vertex, {bad, 0.0, 0.0}));
    EXPECT_FALSE(asked.nearest(SnapKind::Face, Vector3::Zero(), bad));
  }
  EXPECT_FALSE(asked.nearest(SnapKind::Face, Vector3::Zero(), -1.0));
  // Squeezed flat.
  const world::GeometryPointer box = solid(geometry::Box{{0.5, 0.5, 0.5}});
  const SnapShape shape(box, SnapFinder::kSharpAngle);
  world::CollisionShape ready(box);
  const Affine3 flat(Eigen::Scaling(1.0, 1.0, 0.0));
  EXPECT_FALSE(shape.corner(flat, Vector3::Zero(), 9.0));
  EXPECT_FALSE(shape.edge(flat, Vector3::Zero(), 9.0));
  EXPECT_FALSE(shape.face(flat, Vector3::Zero(), 9.0, ready));
  Asked plane(solid(geometry::Plane{}));
  EXPECT_LT((plane.point(SnapKind::Face, {3.0, 4.0, 0.2}) - Vector3(3.0, 4.0, 0.0)).norm(), 1e-12);
  EXPECT_FALSE(
      Asked(std::make_shared<world::MeshGeometry>(TriangleMesh{})).nearest(SnapKind::Face, {0, 0, 0}));
}

}  // namespace
}  // namespace icome::interaction
