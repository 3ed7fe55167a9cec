#include "world/collision/collisions.h"

#include <set>

#include "world/random_edits.h"

namespace icome::world {
namespace {

using geometry::Corners;
using geometry::Primitive;

GeometryPointer solid(const Primitive& it) { return std::make_shared<PrimitiveGeometry>(it); }
GeometryPointer mesh_of(const Primitive& it) {
  return std::make_shared<MeshGeometry>(geometry::tessellate(it, 0.01));
}
Affine3 turned(double angle, const Vector3& axis) {
  return Affine3(Eigen::AngleAxisd(angle, axis.normalized()));
}

Meeting met(const GeometryPointer& one, const Affine3& at_one, const GeometryPointer& other,
            const Affine3& at_other) {
  CollisionShape a(one), b(other);
  const Meeting found = meeting({a, at_one}, {b, at_other});
  EXPECT_EQ(found, meeting({b, at_other}, {a, at_one}));
  return found;
}

TEST(CollisionShapes, OfBoxesTouchWhereFacesMeetAndOverlapWhereTheyGoThrough) {
  const GeometryPointer box = solid(geometry::Box{{0.5, 0.5, 0.5}});
  const Affine3 here = Affine3::Identity();
  // Far from the origin and turned, too: what touches, touches within rounding.
  for (const Affine3& frame : {here, Affine3(at(7.0, 3.0, -2.0) * turned(0.7, {1.0, 2.0, 3.0})),
                               Affine3(Eigen::Scaling(1e-3) * turned(1.1, {3.0, 1.0, 0.0}))}) {
    const auto found = [&](const Affine3& other) { return met(box, frame, box, frame * other); };
    EXPECT_EQ(found(at(0.0, 0.0, 1.0)), Meeting::Touching);  // face on face
    EXPECT_EQ(found(at(0.3, 0.4, 1.0)), Meeting::Touching);  // a part of a face
    EXPECT_EQ(found(at(1.0, 1.0, 0.0)), Meeting::Touching);  // edge on edge
    EXPECT_EQ(found(at(1.0, 1.0, 1.0)), Meeting::Touching);  // corner on corner
    EXPECT_EQ(found(at(0.0, 0.0, 1.0 + 1e-6)), Meeting::Apart);
    EXPECT_EQ(found(at(0.0, 0.0, 1.0 - 1e-6)), Meeting::Overlapping);
    EXPECT_EQ(found(here), Meeting::Overlapping);               // the same place
    EXPECT_EQ(found(at(0.5, 0.0, 0.0)), Meeting::Overlapping);  // four faces in common planes
    EXPECT_EQ(found(at(0.1, 0.2, 0.3)), Meeting::Overlapping);
    EXPECT_EQ(found(Affine3(Eigen::Scaling(0.5))), Meeting::Overlapping);              // one within the other
    EXPECT_EQ(found(at(0.0, 0.0, 0.25) * Eigen::Scaling(0.5)), Meeting::Overlapping);  // within, on a face
    EXPECT_EQ(found(at(0.0, 0.0, 0.75) * Eigen::Scaling(0.5)), Meeting::Touching);     // outside, on a face
    EXPECT_EQ(found(Affine3(Eigen::Scaling(-1.0, 1.0, 1.0)) * at(0.0, 0.0, 1.0)), Meeting::Touching);
    EXPECT_EQ(found(Affine3(Eigen::Scaling(-1.0, 1.0, 1.0))), Meeting::Overlapping);  // mirrored
    EXPECT_EQ(found(at(0.0, 0.0, 0.5 + std::sqrt(0.5)) * turned(std::acos(-1.0) / 4.0, {1.0, 0.0, 0.0})),
              Meeting::Touching);  // an edge on a face
  }
}

TEST(CollisionShapes, OfSpheresAndHalfSpacesAreAskedAsWhatTheyAre) {
  const GeometryPointer ball = solid(geometry::Sphere{1.0});
  const GeometryPointer ground = solid(geometry::Plane{});
  const GeometryPointer box = solid(geometry::Box{{1.0, 1.0, 1.0}});
  const Affine3 here = Affine3::Identity();
  EXPECT_EQ(met(ball, here, ball, at(2.0, 0.0, 0.0)), Meeting::Touching);
  EXPECT_EQ(met(ball, here, ball, at(2.0 + 1e-8, 0.0, 0.0)), Meeting::Apart);
  EXPECT_EQ(met(ball, here, ball, at(2.0 - 1e-8, 0.0, 0.0)), Meeting::Overlapping);
  EXPECT_EQ(met(ball, here, ball, Affine3(Eigen::Scaling(0.1))), Meeting::Overlapping);
  EXPECT_EQ(met(ball, at(2.0, 0.0, 0.0), box, here), Meeting::Touching);
  EXPECT_EQ(met(ball, at(2.0 - 1e-8, 0.0, 0.0), box, here), Meeting::Overlapping);
  EXPECT_EQ(met(ball, here, box, Affine3(Eigen::Scaling(0.1))), Meeting::Overlapping);
  EXPECT_EQ(met(ball, Affine3(Eigen::Scaling(0.1)), box, here), Meeting::Overlapping);
  for (const Affine3& frame : {here, Affine3(turned(0.4, {1.0, 2.0, 0.0}) * at(1.0, 2.0, 3.0))}) {
    EXPECT_EQ(met(ball, frame * at(5.0, 6.0, 1.0), ground, frame), Meeting::Touching);
    EXPECT_EQ(met(ball, frame * at(5.0, 6.0, 1.1), ground, frame), Meeting::Apart);
    EXPECT_EQ(met(ball, frame * at(5.0, 6.0, -9.0), ground, frame), Meeting::Overlapping);
    EXPECT_EQ(met(box, frame * at(5.0, 6.0, 1.0), ground, frame), Meeting::Touching);
    EXPECT_EQ(met(box, frame * at(5.0, 6.0, 0.9), ground, frame), Meeting::Overlapping);
    EXPECT_EQ(met(box, frame * at(5.0, 6.0, 1.1), ground, frame), Meeting::Apart);
  }
  const Affine3 facing = turned(std::acos(-1.0), {1.0, 0.0, 0.0});
  EXPECT_EQ(met(ground, here, ground, at(0.0, 0.0, 1.0) * facing), Meeting::Apart);
  EXPECT_EQ(met(ground, here, ground, at(0.0, 0.0, -1.0) * facing), Meeting::Overlapping);
  EXPECT_EQ(met(ground, here, ground, at(0.0, 0.0, 1.0) * turned(0.1, {1.0, 0.0, 0.0})),
            Meeting::Overlapping);
}

TEST(CollisionShapes, OfSheetsHaveNoInside) {
  const GeometryPointer box = solid(geometry::Box{{2.0, 2.0, 2.0}});
  const GeometryPointer sheet = one_triangle();
  const Affine3 here = Affine3::Identity();
  EXPECT_EQ(met(box, here, sheet, here), Meeting::Overlapping);  // it lies within the box
  EXPECT_EQ(met(box, here, sheet, at(0.0, 0.0, 2.0)), Meeting::Touching);
  EXPECT_EQ(met(sheet, here, sheet, here), Meeting::Touching);
  EXPECT_EQ(met(sheet, here, sheet, turned(1.0, {1.0, 0.0, 0.0})), Meeting::Touching);  // along an edge
  EXPECT_EQ(met(sheet, at(0.0, 0.25, -0.1), sheet, at(0.0, 0.5, 0.0) * turned(1.5, {1.0, 0.0, 0.0})),
            Meeting::Apart);
  EXPECT_EQ(met(sheet, here, sheet, at(0.2, 0.2, -0.5) * turned(1.5, {1.0, 0.0, 0.0})), Meeting::Overlapping);
}

TEST(CollisionShapes, InPartsAreAskedPartByPart) {
  // Two small boxes: one is outside of the large one, one within.
  geometry::TriangleMesh two = geometry::tessellate(Primitive(geometry::Box{Vector3::Constant(0.1)}), 1.0);
  const geometry::TriangleMesh other = two;
  const auto first = std::uint32_t(two.positions.size());
  for (const Vector3& it : other.positions) two.positions.push_back(it + Vector3(5.0, 0.0, 0.0));
  for (const auto& it : other.triangles)
    two.triangles.push_back({it[0] + first, it[1] + first, it[2] + first});
  const GeometryPointer parts = std::make_shared<MeshGeometry>(two);
  const GeometryPointer large = solid(geometry::Box{Vector3::Ones()});
  EXPECT_EQ(met(large, Affine3::Identity(), parts, Affine3::Identity()), Meeting::Overlapping);
  EXPECT_EQ(met(large, Affine3::Identity(), parts, at(-5.0, 0.0, 0.0)), Meeting::Overlapping);
  EXPECT_EQ(met(large, Affine3::Identity(), parts, at(-2.5, 0.0, 0.0)), Meeting::Apart);
}

TEST(CollisionShapes, WithoutTrianglesCountAsTheirBoxOrAsNothing) {
  const GeometryPointer box = solid(geometry::Box{Vector3::Ones()});
  const Affine3 here = Affine3::Identity();
  EXPECT_EQ(met(box, here, std::make_shared<MeshGeometry>(geometry::TriangleMesh{}), here), Meeting::Apart);
  const geometry::TriangleMesh fin{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}},
                                   {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}};
  const auto broken = std::make_shared<LoopGeometry>(geometry::ControlMesh{fin, {}, {}});
  EXPECT_EQ(met(box, at(1.9, 1.9, 1.9), broken, here), Meeting::Overlapping);
  geometry::CsgTree endless;
  endless.add_leaf(Primitive(geometry::Plane{}));
  EXPECT_EQ(met(box, here, std::make_shared<CsgGeometry>(endless), here), Meeting::Apart);
}

// ---- Against brute force: other questions, of all triangles and points --------------------------------

/// Six times the volume of a tetrahedron, positive where `d` is above the triangle of the others.
double volume(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  return (b - a).cross(c - a).dot(d - a);
}

bool crosses(const Vector3& from, const Vector3& to, const Corners& corners) {
  if ((volume(corners[0], corners[1], corners[2], from) > 0.0) ==
      (volume(corners[0], corners[1], corners[2], to) > 0.0))
    return false;
  const bool s0 = volume(from, to, corners[0], corners[1]) > 0.0;
  const bool s1 = volume(from, to, corners[1], corners[2]) > 0.0;
  const bool s2 = volume(from, to, corners[2], corners[0]) > 0.0;
  return s0 == s1 && s1 == s2;
}

/// A placed convex shape as triangles, and what is in them.
struct Placed {
  std::vector<Corners> triangles;
  std::function<bool(const Vector3&)> inside;
};

Placed placed(const Geometry& shape, const Affine3& frame) {
  Placed result;
  const auto mesh = *shape.triangles(1e-3 * shape.bounds().sizes().maxCoeff());
  for (std::size_t t = 0; t < mesh->mesh.triangles.size(); ++t)
    result.triangles.push_back(
        {frame * mesh->mesh.corner(t, 0), frame * mesh->mesh.corner(t, 1), frame * mesh->mesh.corner(t, 2)});
  result.inside = [mesh, back = Affine3(frame.inverse())](const Vector3& point) {
    const Vector3 local = back * point;
    for (std::size_t t = 0; t < mesh->mesh.triangles.size(); ++t) {
      const auto corner = [&](int i) { return mesh->mesh.corner(t, i); };
      if (volume(corner(0), corner(1), corner(2), local) > -1e-12) return false;
    }
    return true;
  };
  return result;
}

bool brute_force(const Placed& one, const Placed& other) {
  for (const auto& [a, b] : {std::pair(&one, &other), std::pair(&other, &one)}) {
    for (const Corners& edge : a->triangles) {
      if (b->inside(edge[0])) return true;
      for (const Corners& triangle : b->triangles) {
        for (int i = 0; i < 3; ++i) {
          if (crosses(edge[i], edge[(i + 1) % 3], triangle)) return true;
        }
      }
    }
  }
  return false;
}

Affine3 random_frame(base::Random& random, double reach) {
  return Affine3(Eigen::Translation3d(reach * random.uniform() * random.direction())) *
         turned(random.uniform(0.0, 3.0), random.direction()) *
         Affine3(Eigen::Scaling(random.uniform(0.5, 1.5), random.uniform(0.5, 1.5),
                                random.index(2) == 0 ? -random.uniform(0.5, 1.5) : random.uniform(0.5, 1.5)));
}

/// A world of boxes and wedges at random, some below others, and what brute force needs of it.
struct RandomWorld {
  RandomWorld(std::uint64_t seed, int count, double reach) {
    base::Random random(seed);
    const std::vector<Primitive> kinds{geometry::Box{{0.3, 0.2, 0.1}}, geometry::Box{{0.05, 0.5, 0.05}},
                                       geometry::Cone{0.3, 0.1, 0.4}};
    std::vector<ObjectId> ids_so_far;
    for (int i = 0; i < count; ++i) {
      const Primitive& kind = kinds[random.index(kinds.size())];
      const bool as_mesh = random.index(2) == 0;
      GeometryPointer shape = as_mesh ? mesh_of(kind) : solid(kind);
      if (random.index(8) == 0) shape = nullptr;  // a group
      const ObjectId parent = !ids_so_far.empty() && random.index(3) != 0
                                  ? ids_so_far[random.index(ids_so_far.size())]
                                  : ObjectId{};
      // Below others everything is as large as above.
      const Affine3 frame = parent ? Affine3(Eigen::Translation3d(0.5 * random.direction())) *
                                         turned(random.uniform(0.0, 3.0), random.direction())
                                   : random_frame(random, reach);
      ids_so_far.push_back(add_object(world, ids, "", shape, parent, frame));
      if (shape) solids.push_back(ids_so_far.back());
    }
  }

  Placed placed_as(ObjectId id, const Affine3& frame) const {
    return placed(*world.find(world.find(id)->geometry)->shape, frame);
  }

  World world;
  IdSource ids;
  std::vector<ObjectId> solids;
};

using Pairs = std::set<std::pair<ObjectId, ObjectId>>;

Pairs overlapping(const std::vector<Collision>& collisions) {
  Pairs pairs;
  for (const Collision& it : collisions) {
    if (it.meeting != Meeting::Overlapping) continue;
    EXPECT_TRUE(pairs.emplace(it.one, it.other).second);
  }
  return pairs;
}

TEST(Collisions, OfAllObjectsAreThoseOfBruteForce) {
  std::size_t found = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const RandomWorld random(seed, 40, 2.0);
    CollisionIndex index(random.world);
    std::map<ObjectId, Placed> shapes;
    for (const ObjectId id : random.solids)
      shapes.emplace(id, random.placed_as(id, world_from_object(random.world, id)));
    Pairs expected;
    for (const auto& [one, a] : shapes) {
      for (const auto& [other, b] : shapes) {
        if (one < other && brute_force(a, b)) expected.emplace(one, other);
      }
    }
    EXPECT_EQ(overlapping(index.collisions_within()), expected);
    found += expected.size();
  }
  EXPECT_GT(found, 100U);
}

TEST(Collisions, OfASubtreeElsewhereAreThoseOfBruteForce) {
  std::size_t found = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const RandomWorld random(100 + seed, 30, 1.0);
    CollisionIndex index(random.world);
    base::Random choice(seed);
    for (int k = 0; k < 3; ++k) {
      const ObjectId root = random.solids[choice.index(random.solids.size())];
      const Affine3 was = world_from_object(random.world, root);
      const Affine3 place =
          Affine3(Eigen::Translation3d(0.5 * choice.direction())) * was * turned(0.5, choice.direction());
      Pairs expected;
      for (const ObjectId one : random.solids) {
        if (!is_within(random.world, one, root)) continue;
        const Placed moved =
            random.placed_as(one, place * was.inverse() * world_from_object(random.world, one));
        for (const ObjectId other : random.solids) {
          if (is_within(random.world, other, root)) continue;
          if (brute_force(moved, random.placed_as(other, world_from_object(random.world, other))))
            expected.emplace(one, other);
        }
      }
      EXPECT_EQ(overlapping(index.collisions(root, place)), expected);
      EXPECT_EQ(index.overlaps(root, place), !expected.empty());
      found += expected.size();
    }
  }
  EXPECT_GT(found, 30U);
}

TEST(Collisions, FollowRandomEdits) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    World world;
    RandomEdits edits(seed);
    CollisionIndex index(world);
    for (int i = 0; i < 400; ++i) {
      const Edit edit = edits.next(world);
      if (!apply(world, edit)) continue;
      index.follow(world, changes_of(edit));
      if (i % 20 != 0) continue;
      CollisionIndex fresh(world);
      for (const auto& [id, object] : world.objects()) {
        const Bounds kept = index.bounds(id), expected = bounds(world, id);
        ASSERT_EQ(kept.isEmpty(), expected.isEmpty()) << seed;
        if (kept.isEmpty()) continue;
        EXPECT_TRUE(kept.min().isApprox(expected.min(), 1e-9) && kept.max().isApprox(expected.max(), 1e-9));
      }
      if (world.objects().size() > 60) continue;
      EXPECT_EQ(index.collisions_within(), fresh.collisions_within());
    }
  }
}

TEST(Collisions, FollowHalfSpaces) {
  World world;
  IdSource ids;
  const ObjectId ball = add_object(world, ids, "ball", solid(geometry::Sphere{1.0}), {}, at(0.0, 0.0, 1.0));
  const ObjectId ground = add_object(world, ids, "ground", solid(geometry::Plane{}));
  CollisionIndex index(world);
  const auto one = [](ObjectId a, ObjectId b, Meeting how) { return std::vector<Collision>{{a, b, how}}; };
  EXPECT_EQ(index.collisions(ball), one(ball, ground, Meeting::Touching));
  EXPECT_EQ(index.collisions(ground), one(ground, ball, Meeting::Touching));
  EXPECT_EQ(index.collisions_within(), one(ball, ground, Meeting::Touching));
  EXPECT_FALSE(index.overlaps(ball));
  EXPECT_TRUE(index.overlaps(ball, at(5.0, 5.0, 0.5)));
  EXPECT_TRUE(index.overlaps(ground, at(0.0, 0.0, 0.5)));
  EXPECT_TRUE(index.collisions(ball, at(0.0, 0.0, 5.0)).empty());
  const GeometryId shape = world.find(ground)->geometry;
  const auto edit = [&](const Edit& it) {
    applied(world, it);
    index.follow(world, changes_of(it));
  };
  edit(ReplaceGeometry{shape, solid(geometry::Sphere{0.5})});
  EXPECT_EQ(index.collisions(ball), one(ball, ground, Meeting::Overlapping));
  edit(ReplaceGeometry{shape, solid(geometry::Plane{})});
  edit(PlaceObject{ball, at(0.0, 0.0, 0.0)});
  EXPECT_EQ(index.collisions(ball), one(ball, ground, Meeting::Overlapping));
  edit(delete_subtree(world, ground));
  EXPECT_TRUE(index.collisions(ball).empty());
  EXPECT_TRUE(index.collisions(ground).empty());
}

TEST(Collisions, EnterOnlySubtreesWhoseBoundsMeet) {
  World world;
  IdSource ids;
  // 100 rooms side by side, 20 chairs in each, of a seat and four legs.
  ObjectId chair;
  for (int room = 0; room < 100; ++room) {
    const ObjectId group = add_object(world, ids, "room", nullptr, {}, at(100.0 * room, 0.0, 0.0));
    for (int i = 0; i < 20; ++i) {
      chair = add_object(world, ids, "chair", box(1.0), group, at(3.0 * i, 0.0, 0.0));
      for (int leg = 0; leg < 4; ++leg)
        add_object(world, ids, "leg", box(0.2), chair, at(leg % 2 - 0.5, leg / 2 - 0.5, -0.7));
    }
  }
  CollisionIndex index(world);
  EXPECT_TRUE(index.collisions(chair).empty());
  // The chair, its room, and the world that holds them.
  EXPECT_LE(index.work().entered, 4U);
  EXPECT_EQ(index.work().shapes, 0U);
  const auto before = index.work();
  // Onto the next one: entered are world, room and both chairs, and its shapes are looked at.
  EXPECT_TRUE(index.overlaps(chair, at(9900.0 + 54.3, 0.0, 0.0)));
  EXPECT_LE(index.work().entered - before.entered, 10U);
  EXPECT_LE(index.work().shapes - before.shapes, 10U);
  EXPECT_GE(index.work().shapes - before.shapes, 1U);
}

TEST(Collisions, OfVeryManyObjectsLookAtFew) {
  World world;
  IdSource ids;
  const GeometryId shape{1'000'000};
  applied(world, CreateGeometry{shape, solid(geometry::Sphere{0.4})});
  ObjectId middle;
  for (int i = 0; i < 100'000; ++i) {
    const ObjectId id = ids.next<ObjectId>();
    applied(world,
            CreateObject{id,
                         std::size_t(i),
                         {.parent_from_object = at(i % 50, i / 50 % 50, i / 2500), .geometry = shape}});
    if (i == 51'275) middle = id;
  }
  CollisionIndex index(world);
  const Affine3 between = world_from_object(world, middle) * at(0.5, 0.5, 0.5);
  EXPECT_TRUE(index.collisions(middle).empty());
  EXPECT_EQ(index.collisions(middle, between).size(), 0U);
  EXPECT_EQ(index.collisions(middle, world_from_object(world, middle) * at(0.5, 0.0, 0.0)).size(), 1U);
  EXPECT_LE(index.work().shapes, 20U);
  const Edit step = PlaceObject{middle, between * at(0.2, 0.0, 0.0)};
  applied(world, step);
  index.follow(world, changes_of(step));
  EXPECT_EQ(index.collisions(middle).size(), 4U);
}

TEST(Collisions, KnowWhatStandsWhere) {
  World world;
  IdSource ids;
  const ObjectId group = add_object(world, ids, "", nullptr, {}, at(10.0, 0.0, 0.0));
  const ObjectId near = add_object(world, ids, "", box(1.0), group);
  const ObjectId far = add_object(world, ids, "", box(1.0), group, at(5.0, 0.0, 0.0));
  const ObjectId ground = add_object(world, ids, "", solid(geometry::Plane{}));
  add_object(world, ids, "", std::make_shared<MeshGeometry>(geometry::TriangleMesh{}));
  CollisionIndex index(world);
  const auto named = [](const std::vector<CollisionIndex::Standing>& standing) {
    std::vector<ObjectId> found;
    for (const auto& it : standing) found.push_back(it.id);
    return found;
  };
  EXPECT_EQ(named(index.standing()), (std::vector{near, far, ground}));
  EXPECT_EQ(named(index.standing(group)), (std::vector{near, far}));
  EXPECT_EQ(named(index.standing(far)), std::vector{far});
  EXPECT_TRUE(index.standing(ObjectId{12345}).empty());
  EXPECT_EQ(index.standing(near).at(0).world_from_object.translation(), Vector3(10.0, 0.0, 0.0));
  EXPECT_EQ(named(index.standing_in({Vector3(9.0, -1.0, 0.4), Vector3(9.6, 1.0, 0.5)})),
            (std::vector{near, ground}));
  EXPECT_EQ(named(index.standing_in({Vector3::Constant(100.0), Vector3::Constant(101.0)})),
            std::vector{ground});
}

}  // namespace
}  // namespace icome::world
