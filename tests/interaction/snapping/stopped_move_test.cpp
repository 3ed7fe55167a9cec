#include "interaction/snapping/stopped_move.h"

#include <functional>

#include "geometry/implicit/implicit_surface.h"
#include "geometry/loop/loop_surface.h"
#include "interaction/object_move.h"
#include "interaction/snapping/clutter.h"
#include "interaction/snapping/moving_objects.h"
#include "repeats.h"
#include "world/shape/solid_geometry.h"

namespace icome::interaction {
namespace {

using world::World;

StoppedMove moved(CollisionIndex& index, const std::vector<ObjectId>& objects, const Vector3& wanted,
                  const StopSettings& settings = {}) {
  const auto found = stopped_move(index, objects, wanted, settings);
  if (!found) throw std::runtime_error(found.error().message);
  return *found;
}

/// Moves the objects and tells the index.
void go(World& world, CollisionIndex& index, const std::vector<ObjectId>& objects, const Vector3& offset) {
  const world::Edit edit = ObjectMove(world, objects).by(offset);
  applied(world, edit);
  index.follow(world, changes_of(edit));
}

/// A table whose top is 0.7 m above y = 0, and a vase above it.
struct Room {
  Clutter clutter;
  ObjectId table = clutter.add(nullptr, at(0.2, 0.0, 0.1) * turned(0.4, Vector3::UnitY()));
  ObjectId top = clutter.add(solid(geometry::Box{{0.6, 0.02, 0.4}}), at(0.0, 0.68, 0.0), table);
  ObjectId leg = clutter.add(solid(geometry::Box{{0.03, 0.33, 0.03}}), at(0.5, 0.33, 0.3), table);
  ObjectId vase_on = clutter.add(vase(), at(0.25, 1.1, 0.05) * turned(1.0, Vector3::UnitY()));
  CollisionIndex index{clutter.world};
};

TEST(StoppedMove, PutsTheVaseOnTheTableAndNotThroughIt) {
  Room room;
  for (const double below : {0.5, 1.0, 1000.0}) {
    const StoppedMove move = moved(room.index, {room.vase_on}, {0.0, -below, 0.0});
    EXPECT_TRUE(move.stopped);
    EXPECT_NEAR(move.offset.y(), -0.4, 1e-9);
    EXPECT_EQ(move.offset.x(), 0.0);
    ASSERT_EQ(move.contacts.size(), 1U);
    EXPECT_EQ(move.contacts[0].moved, room.vase_on);
    EXPECT_EQ(move.contacts[0].other, room.top);
    EXPECT_LT((move.contacts[0].normal - Vector3::UnitY()).norm(), 1e-9);
  }
  const StoppedMove free = moved(room.index, {room.vase_on}, {0.0, -0.3, 0.0});
  EXPECT_FALSE(free.stopped);
  EXPECT_EQ(free.offset, Vector3(0.0, -0.3, 0.0));
  EXPECT_TRUE(free.contacts.empty());
}

TEST(StoppedMove, LeavesWhatIsMovedTouchingAndFreeToGoOn) {
  Room room;
  const auto landed = landing(room.index, std::vector{room.vase_on});
  ASSERT_TRUE(landed);
  EXPECT_NEAR(landed->offset.y(), -0.4, 1e-9);
  go(room.clutter.world, room.index, {room.vase_on}, landed->offset);
  EXPECT_FALSE(room.index.overlaps(room.vase_on));
  EXPECT_FALSE(room.index.collisions(room.vase_on).empty());  // it touches
  // Along the table as far as one likes, up, but not down; over the edge, and down beside it.
  EXPECT_EQ(moved(room.index, {room.vase_on}, {0.1, 0.0, 0.1}).offset, Vector3(0.1, 0.0, 0.1));
  EXPECT_EQ(moved(room.index, {room.vase_on}, {0.0, 0.2, 0.0}).offset, Vector3(0.0, 0.2, 0.0));
  EXPECT_LT(moved(room.index, {room.vase_on}, {0.0, -0.2, 0.0}).offset.norm(), 1e-9);
  EXPECT_EQ(moved(room.index, {room.vase_on}, {2.0, 0.0, 0.0}).offset, Vector3(2.0, 0.0, 0.0));
  go(room.clutter.world, room.index, {room.vase_on}, {2.0, 0.0, 0.0});
  EXPECT_FALSE(moved(room.index, {room.vase_on}, {0.0, -1.0, 0.0}).stopped);
  // Sideways into the table top's side.
  go(room.clutter.world, room.index, {room.vase_on}, {0.0, -0.15, 0.0});
  EXPECT_TRUE(moved(room.index, {room.vase_on}, {-2.0, 0.0, 0.0}, {.slide = false}).stopped);
}

TEST(StoppedMove, SlidesAlongAnInclinedPlane) {
  for (const bool endless : {true, false}) {
    Clutter clutter;
    const Affine3 frame = turned(0.5, {1.0, 0.3, 0.2});
    const Vector3 normal = frame * Vector3::UnitZ();
    clutter.add(endless ? solid(geometry::Plane{}) : solid(geometry::Box{{5.0, 5.0, 0.5}}),
                endless ? frame : Affine3(frame * at(0.0, 0.0, -0.5)));
    for (const auto& shape : {solid(geometry::Sphere{0.1}), tessellated(geometry::Box{{0.1, 0.2, 0.3}})}) {
      const ObjectId thing = clutter.add(shape, at(0.1, 0.9, 0.9) * turned(0.3, {1.0, 2.0, 3.0}));
      CollisionIndex index(clutter.world);
      const Vector3 wanted(0.3, -0.2, -1.7);
      const StoppedMove sliding = moved(index, {thing}, wanted);
      const StoppedMove stopping = moved(index, {thing}, wanted, {.slide = false});
      EXPECT_TRUE(sliding.stopped && stopping.stopped);
      EXPECT_LT(stopping.offset.normalized().cross(wanted.normalized()).norm(), 1e-9);
      // From where it stops it goes along the plane, to next to where it is wanted.
      const Vector3 along = sliding.offset - stopping.offset;
      EXPECT_GT(along.norm(), 0.1);
      EXPECT_LT(std::abs(normal.dot(along)), 2e-6);
      const Vector3 missing = wanted - sliding.offset;
      EXPECT_LT(missing.normalized().cross(normal).norm(), 1e-5);
      ASSERT_EQ(sliding.contacts.size(), 1U);
      EXPECT_LT((sliding.contacts[0].normal - normal).norm(), 1e-9);
      applied(clutter.world, world::DeleteObject{thing});
    }
  }
}

TEST(StoppedMove, SlidesAlongTheGrooveBetweenTwoSlopes) {
  Clutter clutter;
  clutter.add(solid(geometry::Plane{}), turned(1.0, Vector3::UnitX()));
  clutter.add(solid(geometry::Plane{}), turned(-1.0, Vector3::UnitX()));
  const ObjectId ball = clutter.add(solid(geometry::Sphere{0.1}), at(0.0, 0.05, 1.0));
  CollisionIndex index(clutter.world);
  const StoppedMove move = moved(index, {ball}, {0.7, 0.1, -3.0});
  // It ends at the bottom of the groove, whose sides are as far from it as it is large.
  EXPECT_NEAR(move.offset.x(), 0.7, 1e-5);
  EXPECT_NEAR(0.05 + move.offset.y(), 0.0, 1e-5);
  EXPECT_NEAR(1.0 + move.offset.z(), 0.1 / std::cos(1.0), 1e-5);
  EXPECT_EQ(move.contacts.size(), 2U);
}

TEST(StoppedMove, LetsWhatIsStuckComeOutButNotGoDeeper) {
  Clutter clutter;
  clutter.add(solid(geometry::Box{{1.0, 1.0, 1.0}}), Affine3::Identity());
  const ObjectId wall = clutter.add(solid(geometry::Box{{0.1, 5.0, 5.0}}), at(3.0, 0.0, 0.0));
  (void)wall;
  for (const auto& shape : {solid(geometry::Box{{0.2, 0.2, 0.2}}), solid(geometry::Sphere{0.2}),
                            tessellated(geometry::Sphere{0.2})}) {
    const ObjectId stuck = clutter.add(shape, at(0.9, 0.05, 0.02));
    CollisionIndex index(clutter.world);
    EXPECT_EQ(moved(index, {stuck}, {0.1, 0.0, 0.0}).offset, Vector3(0.1, 0.0, 0.0));  // still in it
    EXPECT_EQ(moved(index, {stuck}, {1.0, 0.0, 0.0}).offset, Vector3(1.0, 0.0, 0.0));
    EXPECT_TRUE(moved(index, {stuck}, {-0.1, 0.0, 0.0}).offset.isZero(0.0));
    EXPECT_TRUE(moved(index, {stuck}, {-0.1, 0.0, 0.0}).stopped);
    // Out, and then up to the wall.
    EXPECT_NEAR(moved(index, {stuck}, {9.0, 0.0, 0.0}).offset.x(), 2.9 - 0.2 - 0.9, 1e-3);
    applied(clutter.world, world::DeleteObject{stuck});
  }
  const ObjectId floor = clutter.add(solid(geometry::Plane{}), at(0.0, 0.0, -1.5));
  (void)floor;
  const ObjectId sunk = clutter.add(solid(geometry::Sphere{0.2}), at(-3.0, 0.0, -1.5));
  CollisionIndex index(clutter.world);
  EXPECT_FALSE(moved(index, {sunk}, {0.0, 0.0, 1.0}).stopped);
  EXPECT_FALSE(moved(index, {sunk}, {0.0, 0.5, 0.0}).stopped);
  EXPECT_TRUE(moved(index, {sunk}, {0.0, 0.0, -1.0}).stopped);
}

TEST(StoppedMove, MovesObjectsTogether) {
  Room room;
  const ObjectId lamp = room.clutter.add(solid(geometry::Sphere{0.05}), at(0.25, 1.05, 0.05));
  const ObjectId shade = room.clutter.add(solid(geometry::Sphere{0.05}), at(0.0, -0.07, 0.0), lamp);
  CollisionIndex index(room.clutter.world);
  // The lamp stands in the vase: both go until the shade below it meets the table.
  const StoppedMove move = moved(index, {room.vase_on, lamp, shade}, {0.0, -1.0, 0.0});
  EXPECT_NEAR(move.offset.y(), 0.7 - (1.05 - 0.07 - 0.05), 1e-9);
  ASSERT_EQ(move.contacts.size(), 1U);
  EXPECT_EQ(move.contacts[0].moved, shade);
}

TEST(StoppedMove, NeverEndsOverlappingInRandomClutter) {
  base::Random random(6);
  int stops = 0, tried = 0;
  while (tried < repeats(200)) {
    Clutter clutter;
    clutter.fill(random, 30);
    if (random.index(4) == 0) clutter.add(solid(geometry::Plane{}), at(0.0, 0.0, -1.2));
    const ObjectId thing =
        clutter.add(random.index(3) == 0 ? vase() : Clutter::any_shape(random), Clutter::anywhere(random));
    CollisionIndex index(clutter.world);
    for (int i = 0; i < 25; ++i) {
      const Affine3 place = Clutter::anywhere(random);
      const world::Edit edit = world::PlaceObject{thing, place};
      applied(clutter.world, edit);
      index.follow(clutter.world, changes_of(edit));
      if (index.overlaps(thing)) continue;
      ++tried;
      const double far = std::pow(10.0, random.uniform(-2.0, 4.0));
      const Vector3 inwards = (random.direction() - 2.0 * place.translation()).normalized();
      const StoppedMove move = moved(index, {thing}, far * inwards, {.slide = i % 2 == 0});
      stops += int(move.stopped);
      go(clutter.world, index, {thing}, move.offset);
      ASSERT_FALSE(index.overlaps(thing)) << tried;
    }
  }
  EXPECT_GT(stops, repeats(60));
}

TEST(StoppedMove, MissesNothingThatFineStepsFind) {
  base::Random random(7);
  int stops = 0;
  for (int round = 0; round < 150; ++round) {
    Clutter clutter;
    clutter.fill(random, 8);
    const ObjectId thing = clutter.add(Clutter::any_shape(random), Clutter::anywhere(random));
    CollisionIndex index(clutter.world);
    if (index.overlaps(thing)) continue;
    const Affine3 place = world_from_object(clutter.world, thing);
    const Vector3 wanted = 1.5 * (0.3 * random.direction() - place.translation());
    const StoppedMove move = moved(index, {thing}, wanted, {.slide = false});
    stops += int(move.stopped);
    const double share = move.offset.norm() / wanted.norm();
    constexpr int kSteps = 200;
    for (int i = 0; i <= kSteps; ++i) {
      const Affine3 there = Eigen::Translation3d(share * i / kSteps * wanted) * place;
      ASSERT_FALSE(index.overlaps(thing, there)) << round << " at " << i;
    }
    if (!move.stopped) continue;
    // And it has not stopped early: a little further on it is in something, unless it only grazes.
    const double size = index.bounds(thing).diagonal().norm();
    // It stops at what is stretched itself; the triangles that overlap may be this far behind.
    const double behind = MovingObjects(index, std::vector{thing}).deviation(move.offset);
    bool in = false;
    for (const double on : {1e-5 * size, 1e-4 * size, 1e-3 * size + 3.0 * behind})
      in = in || index.overlaps(thing, Eigen::Translation3d((share + on / wanted.norm()) * wanted) * place);
    EXPECT_TRUE(in) << round;
  }
  EXPECT_GT(stops, 30);
}

TEST(StoppedMove, DoesNotPassSheetsOfNoThickness) {
  Clutter clutter;
  clutter.add(world::one_triangle(), at(-0.3, -0.3, 0.0) * turned(0.2, Vector3::UnitX()));
  for (const auto& shape :
       {solid(geometry::Sphere{1e-4}), tessellated(geometry::Box{Vector3::Constant(1e-4)})}) {
    const ObjectId thing = clutter.add(shape, at(0.0, 0.0, 50.0));
    CollisionIndex index(clutter.world);
    const StoppedMove move = moved(index, {thing}, {0.0, 0.0, -90.0}, {.slide = false});
    EXPECT_TRUE(move.stopped);
    EXPECT_GT(move.offset.z(), -50.1);
    applied(clutter.world, world::DeleteObject{thing});
  }
}

TEST(StoppedMove, GivesTheSameTwice) {
  for (int run = 0; run < 2; ++run) {
    static Vector3 before;
    base::Random random(11);
    Clutter clutter;
    clutter.fill(random, 30);
    const ObjectId thing = clutter.add(vase(), at(0.0, 3.0, 0.0));
    CollisionIndex index(clutter.world);
    const Vector3 offset = moved(index, {thing}, {0.2, -4.0, 0.1}).offset;
    if (run == 0) before = offset;
    EXPECT_EQ(offset, before);
  }
}

TEST(StoppedMove, RefusesWhatCannotBe) {
  Room room;
  const std::vector<ObjectId> thing = {room.vase_on};
  for (const double bad : {double(NAN), double(INFINITY), 1e300})
    EXPECT_FALSE(stopped_move(room.index, thing, {bad, 0.0, 0.0}));
  EXPECT_FALSE(stopped_move(room.index, thing, {1.0, 0.0, 0.0}, {.tolerance = 0.0}));
  EXPECT_FALSE(stopped_move(room.index, thing, {1.0, 0.0, 0.0}, {.tolerance = std::nan("")}));
  // Nobody is there: nothing is in the way.
  EXPECT_EQ(moved(room.index, {ObjectId{}, ObjectId{77}}, {1.0, -2.0, 0.0}).offset, Vector3(1.0, -2.0, 0.0));
  EXPECT_EQ(moved(room.index, {}, Vector3::Zero()).offset, Vector3::Zero());
}

/// 70,000 triangles, about as many as a scan has, with bumps all over.
world::GeometryPointer scan() {
  std::vector<std::pair<double, double>> profile;
  constexpr int kRings = 140;
  for (int i = 0; i <= kRings; ++i) {
    const double angle = std::numbers::pi * (i + 0.5) / (kRings + 1);
    profile.emplace_back(0.06 * std::sin(angle) * (1.0 + 0.05 * std::sin(40.0 * angle)),
                         -0.06 * std::cos(angle));
  }
  return lathe(profile, 250);
}

/// A scan that stands on a plinth, a little sunk into it, and a wall beside them.
struct Sculpture {
  Clutter clutter;
  ObjectId figure;
  ObjectId plinth = clutter.add(
      std::make_shared<world::PrimitiveGeometry>(geometry::Cylinder{0.068, 0.015}, world::Axis::Y),
      at(0.0, 0.0075, 0.0));
  ObjectId wall = clutter.add(solid(geometry::Box{{0.01, 0.5, 0.5}}), at(0.2, 0.0, 0.0));
  CollisionIndex index;
  explicit Sculpture(double sunk)
      : figure(clutter.add(scan(), at(0.0, 0.015 + 0.06 - sunk, 0.0))), index(clutter.world) {}
};

TEST(StoppedMove, OfAPlinthUnderAScanTakesNoLongEffort) {
  base::Random random(3);
  for (const double sunk : {0.0, 2e-5, 0.004}) {
    Sculpture sculpture(sunk);
    const std::vector<ObjectId> plinth = {sculpture.plinth};
    for (int i = 0; i < (kSanitizerShare > 1 ? 3 : 10); ++i) {
      const Vector3 wanted = random.uniform(0.001, 0.3) * random.direction();
      world::Effort effort(100'000'000);
      const auto move =
          stopped_move(MovingObjects(sculpture.index, plinth, &effort), Vector3::Zero(), wanted);
      ASSERT_TRUE(move);
      EXPECT_FALSE(move->spent);
      EXPECT_LT(effort.spent(), 20'000'000U) << sunk << " " << i;
      const Affine3 there = Eigen::Translation3d(move->offset) * at(0.0, 0.0075, 0.0);
      if (sunk < 1e-3) {
        EXPECT_FALSE(sculpture.index.overlaps(sculpture.plinth, there)) << sunk << " " << i;
      }
    }
  }
}

TEST(StoppedMove, WithLittleEffortIsNeverIn) {
  base::Random random(5);
  int spent = 0;
  for (const std::uint64_t units : {1U, 100U, 10'000U, 100'000U, 300'000U}) {
    Sculpture sculpture(-0.001);
    for (int i = 0; i < 40; ++i) {
      const Vector3 wanted = random.uniform(0.001, 0.5) * random.direction();
      world::Effort effort(units);
      const auto move = stopped_move(MovingObjects(sculpture.index, std::vector{sculpture.plinth}, &effort),
                                     Vector3::Zero(), wanted);
      ASSERT_TRUE(move);
      spent += int(move->spent);
      const Affine3 there = Eigen::Translation3d(move->offset) * at(0.0, 0.0075, 0.0);
      EXPECT_FALSE(sculpture.index.overlaps(sculpture.plinth, there)) << units << " " << i;
      EXPECT_EQ(move->spent, effort.is_spent());
    }
  }
  EXPECT_GT(spent, 60);
}

TEST(StoppedMove, TakesOutWhatIsSunkInByALittleAndThenSlides) {
  Clutter clutter;
  clutter.add(solid(geometry::Box{{1.0, 0.1, 1.0}}), at(0.0, -0.1, 0.0));
  for (const double sunk : {1e-6, 1e-4, 0.007}) {
    const ObjectId thing = clutter.add(tessellated(geometry::Box{{0.1, 0.1, 0.1}}), at(0.0, 0.1 - sunk, 0.0));
    CollisionIndex index(clutter.world);
    for (const Vector3& way : {Vector3(0.4, 0.0, 0.1), Vector3(-0.4, 0.0, 0.1), Vector3(0.3, -0.2, 0.0)}) {
      const StoppedMove move = moved(index, {thing}, way);
      EXPECT_LT((move.offset - Vector3(way.x(), sunk, way.z())).norm(), 1e-5) << sunk;
      EXPECT_FALSE(index.overlaps(thing, Eigen::Translation3d(move.offset) * at(0.0, 0.1 - sunk, 0.0)));
    }
    applied(clutter.world, world::DeleteObject{thing});
  }
}

/// A plate 1 m x 1 m, its top at z = 0, with holes of 30 mm in rows 200 mm apart.
geometry::CsgTree drilled_plate(double thickness, int rows) {
  geometry::CsgTree tree;
  auto root = tree.add_leaf(geometry::Primitive(geometry::Box{{0.5, 0.5, 0.5 * thickness}}),
                            at(0.0, 0.0, -0.5 * thickness));
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < rows; ++k) {
      const double x = 0.2 * (i - 0.5 * (rows - 1)), y = 0.2 * (k - 0.5 * (rows - 1));
      const auto hole = tree.add_leaf(geometry::Primitive(geometry::Cylinder{0.015, 0.1}), at(x, y, 0.0));
      root = tree.add(geometry::CsgOperator::Difference, root, hole);
    }
  }
  return tree;
}

/// Where a ball rests on it, m: on its face, or on the rim of a hole that its lowest place is over.
double height_on_plate(const Vector3& centre, int rows, double radius) {
  constexpr double kHole = 0.015;
  double least = INFINITY;
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < rows; ++k) {
      const double x = 0.2 * (i - 0.5 * (rows - 1)), y = 0.2 * (k - 0.5 * (rows - 1));
      least = std::min(least, std::hypot(centre.x() - x, centre.y() - y));
    }
  }
  const double to_rim = std::max(0.0, kHole - least);
  return std::sqrt(radius * radius - to_rim * to_rim);
}

TEST(Landing, OfBallsOnADrilledPlateIsOnItHoweverThinItIs) {
  base::Random random(12);
  for (const double thickness : {0.018, 0.005, 0.0005}) {
    for (const int rows : {1, 3}) {
      const geometry::CsgTree tree = drilled_plate(thickness, rows);
      Clutter clutter;
      clutter.add(std::make_shared<world::CsgGeometry>(tree), Affine3::Identity());
      const double radius = 0.05;
      const ObjectId ball = clutter.add(solid(geometry::Sphere{radius}), at(0.0, 0.0, 0.4));
      CollisionIndex index(clutter.world);
      for (int i = 0; i < (kSanitizerShare > 1 ? 3 : 20); ++i) {
        SCOPED_TRACE(testing::Message() << thickness << " " << rows << " " << i);
        const Vector3 above(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), 0.4);
        const world::Edit edit = world::PlaceObject{ball, Affine3(Eigen::Translation3d(above))};
        applied(clutter.world, edit);
        index.follow(clutter.world, changes_of(edit));
        const auto landed = landing(index, std::vector{ball}, {.direction = -Vector3::UnitZ()});
        ASSERT_TRUE(landed) << landed.error().message;
        // Above a hole it dips in by less than 2.4 mm.
        const Vector3 centre = above + landed->offset;
        EXPECT_NEAR(centre.z(), height_on_plate(centre, rows, radius), 3e-7);
        // By the tree itself: nothing of the ball is in the plate, something below it is.
        bool below = false;
        for (int k = 0; k < 400; ++k) {
          const Vector3 way = random.direction();
          EXPECT_FALSE(geometry::inside(tree, centre + (radius - 2e-7) * way));
          below = below ||
                  geometry::inside(tree, centre + (radius + 2e-3) * (way - Vector3::UnitZ()).normalized());
        }
        EXPECT_TRUE(below);
        if (HasFailure()) return;
      }
    }
  }
}

/// Solids that are no meshes, 0.2 to 1 m large, each with the question that judges: is a place in it, by what
/// it is itself?
struct ExactSolid {
  world::GeometryPointer shape;
  std::function<bool(const Vector3&)> inside;
};

std::vector<ExactSolid> exact_solids() {
  std::vector<ExactSolid> all;
  const auto add_tree = [&](const geometry::CsgTree& tree) {
    all.push_back({std::make_shared<world::CsgGeometry>(tree),
                   [tree](const Vector3& at) { return geometry::inside(tree, at); }});
  };
  add_tree(drilled_plate(0.005, kSanitizerShare > 1 ? 1 : 3));
  geometry::CsgTree hollow;
  auto root =
      hollow.add(geometry::CsgOperator::Intersection,
                 hollow.add_leaf(geometry::Primitive(geometry::Box{{0.1, 0.1, 0.1}}), Affine3::Identity()),
                 hollow.add_leaf(geometry::Primitive(geometry::Sphere{0.13}), Affine3::Identity()));
  for (const Vector3& axis : {Vector3(Vector3::UnitX()), Vector3(Vector3::UnitY())}) {
    const auto hole = hollow.add_leaf(geometry::Primitive(geometry::Cylinder{0.055, 0.5}),
                                      turned(0.5 * std::numbers::pi, axis));
    root = hollow.add(geometry::CsgOperator::Difference, root, hole);
  }
  add_tree(hollow);
  const geometry::ControlMesh control{geometry::tessellate(geometry::Box{{0.15, 0.1, 0.2}}, 1.0), {}, {}};
  const std::shared_ptr<const geometry::LoopSurface> loop = *geometry::LoopSurface::create(control);
  all.push_back({std::make_shared<world::LoopGeometry>(control),
                 [loop](const Vector3& at) { return loop->bounds().contains(at) && loop->inside(at); }});
  const auto formula =
      *world::ImplicitGeometry::create("x^2+y^2+z^2-0.01+0.003*sin(50*x)*sin(50*y)",
                                       base::Bounds(Vector3::Constant(-0.15), Vector3::Constant(0.15)));
  all.push_back({formula, [formula](const Vector3& at) {
                   return formula->surface()->box().contains(at) && formula->surface()->inside(at);
                 }});
  return all;
}

/// Places of the surface of what is moved, made smaller or larger by a length, m.
std::vector<Vector3> shell(bool is_ball, double by, base::Random& random) {
  std::vector<Vector3> places;
  for (int i = 0; i < 300; ++i) {
    const Vector3 way = random.direction();
    places.push_back(is_ball ? Vector3((0.04 + by) * way)
                             : Vector3((0.03 + by) / way.cwiseAbs().maxCoeff() * way));
  }
  return places;
}

TEST(StoppedMove, NeverEndsInSolidsFormulasAndSubdivisionSurfacesAsTheyAre) {
  base::Random random(21);
  const std::vector<ExactSolid> solids = exact_solids();
  int stops = 0, straight = 0, seen = 0;
  for (const bool is_ball : {true, false}) {
    Clutter clutter;
    std::vector<Affine3> places;
    for (std::size_t i = 0; i < solids.size(); ++i) {
      places.push_back(at(0.5 * double(i), 0.0, 0.0) * turned(random.uniform(0.0, 3.0), random.direction()));
      clutter.add(solids[i].shape, places.back());
    }
    const auto is_in = [&](const std::vector<Vector3>& shell, const Affine3& place) {
      for (std::size_t i = 0; i < solids.size(); ++i) {
        const Affine3 solid_from_thing = places[i].inverse() * place;
        for (const Vector3& it : shell)
          if (solids[i].inside(solid_from_thing * it)) return true;
      }
      return false;
    };
    const ObjectId thing =
        clutter.add(is_ball ? solid(geometry::Sphere{0.04}) : solid(geometry::Box{{0.03, 0.03, 0.03}}),
                    Affine3::Identity());
    CollisionIndex index(clutter.world);
    for (int i = 0; i < repeats(60); ++i) {
      SCOPED_TRACE(testing::Message() << is_ball << " " << i);
      const Affine3 place =
          at(random.uniform(-0.3, 1.8), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)) *
          turned(random.uniform(0.0, 3.0), random.direction());
      const world::Edit edit = world::PlaceObject{thing, place};
      applied(clutter.world, edit);
      index.follow(clutter.world, changes_of(edit));
      if (index.overlaps(thing)) continue;
      const Vector3 wanted =
          2.0 * (at(random.uniform(0.0, 1.5), 0.0, 0.0).translation() - place.translation());
      const bool slides = i % 2 == 0;
      const StoppedMove move = moved(index, {thing}, wanted, {.slide = slides});
      stops += int(move.stopped);
      const Affine3 there = Eigen::Translation3d(move.offset) * place;
      constexpr double kOff = 2e-7;  // m
      EXPECT_FALSE(is_in(shell(is_ball, -kOff, random), there));
      if (slides) continue;
      // On the way triangles tell, which are this far off at most.
      constexpr double kOffOnTheWay = 4e-4;  // m
      for (int step = 0; step < 10; ++step)
        ASSERT_FALSE(is_in(shell(is_ball, -kOffOnTheWay, random),
                           Eigen::Translation3d(step / 10.0 * move.offset) * place));
      if (!move.stopped) continue;
      ++straight;
      seen +=
          int(is_in(shell(is_ball, 2e-3, random), Eigen::Translation3d(2e-3 * wanted.normalized()) * there));
    }
  }
  EXPECT_GE(stops, repeats(41));
  EXPECT_GT(seen, 0.7 * straight) << "they stop at something; corners are missed by such places, and edges";
}

TEST(Landing, FallsAlongAnyDirectionAndToTheFloor) {
  Room room;
  const std::vector<ObjectId> thing = {room.vase_on};
  EXPECT_FALSE(landing(room.index, thing, {.direction = Vector3::UnitY()}));
  EXPECT_FALSE(landing(room.index, thing, {.direction = Vector3::Zero()}));
  EXPECT_FALSE(landing(room.index, thing, {.direction = {std::nan(""), 0.0, 0.0}}));
  EXPECT_FALSE(landing(room.index, std::vector<ObjectId>{}));
  go(room.clutter.world, room.index, thing, {3.0, 0.0, 0.0});
  const auto nothing = landing(room.index, thing);
  ASSERT_FALSE(nothing);
  EXPECT_NE(nothing.error().message.find("nothing below"), std::string::npos);
  const auto floor = landing(room.index, thing, {.floor = true});
  ASSERT_TRUE(floor);
  EXPECT_NEAR(floor->offset.y(), -1.1, 1e-9);
  EXPECT_FALSE(floor->contacts.at(0).other);
  // Already there: it stays.
  go(room.clutter.world, room.index, thing, floor->offset);
  EXPECT_LT(landing(room.index, thing, {.floor = true})->offset.norm(), 1e-6);
  // Below the floor, or in the table, it cannot fall.
  go(room.clutter.world, room.index, thing, {0.0, -0.1, 0.0});
  EXPECT_FALSE(landing(room.index, thing, {.floor = true}));
  go(room.clutter.world, room.index, thing, {-3.0, 0.7, 0.0});
  EXPECT_FALSE(landing(room.index, thing));
}

}  // namespace
}  // namespace icome::interaction
