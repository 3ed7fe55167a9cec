// A scene that comes of another by moving objects against one that is compiled of the same objects: whatever
// is asked, both answer the same. What is near is judged by measuring every object.
#include "haptics/contact/haptic_scene.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "haptics/contact_world.h"
#include "haptics/servo/scene_feed.h"

namespace icome::haptics {
namespace {

Vector3 in_cube(Random& random) {
  return {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
}

/// Boxes at random places of a room of 20 m.
std::vector<HapticObject> boxes(std::uint32_t count, Random& random) {
  const auto box = shape_of(primitive("box:0.2x0.3x0.4"));
  std::vector<HapticObject> objects;
  for (std::uint32_t i = 0; i < count; ++i) {
    // Ids come in any order.
    objects.push_back(object((i * 7919) % count, box, Pose(Eigen::Translation3d(10.0 * in_cube(random)))));
  }
  return objects;
}

std::set<std::uint32_t> found_near(const HapticScene& scene, const Vector3& a, const Vector3& b,
                                   double reach) {
  std::set<std::uint32_t> found;
  scene.near(a, b, reach, [&](std::uint32_t object) {
    EXPECT_TRUE(found.insert(object).second) << "visited twice";
    return true;
  });
  return found;
}

/// The box of each object against the box around the way, which misses nothing that comes near.
std::set<std::uint32_t> near_by_brute_force(const HapticScene& scene, const Vector3& point, double reach) {
  std::set<std::uint32_t> found;
  for (std::uint32_t i = 0; i < scene.objects().size(); ++i) {
    if (scene.object_bounds(i).squaredExteriorDistance(point) <= reach * reach) found.insert(i);
  }
  return found;
}

void expect_same_scene(const HapticScene& moved, std::vector<HapticObject> objects, Random& random) {
  const ScenePointer anew = HapticScene::compile(std::move(objects), moved.moment());
  ASSERT_EQ(moved.objects().size(), anew->objects().size());
  EXPECT_EQ(moved.extent(), anew->extent());
  EXPECT_EQ(moved.moves(), anew->moves());
  EXPECT_EQ(moved.bounds().min(), anew->bounds().min());
  EXPECT_EQ(moved.bounds().max(), anew->bounds().max());
  for (std::uint32_t i = 0; i < moved.objects().size(); ++i) {
    EXPECT_EQ(moved.find(anew->objects()[i].id), i);
    EXPECT_EQ(moved.objects()[i].world_from_object.matrix(), anew->objects()[i].world_from_object.matrix());
  }
  for (int i = 0; i < 20; ++i) {
    const Vector3 point = 12.0 * in_cube(random);
    const std::set<std::uint32_t> wanted = near_by_brute_force(moved, point, 3.0);
    for (const HapticScene* scene : {&moved, anew.get()}) {
      const std::set<std::uint32_t> found = found_near(*scene, point, point, 3.0);
      EXPECT_TRUE(std::ranges::includes(found, wanted));
      for (const std::uint32_t object : found)
        EXPECT_LT(scene->object_bounds(object).exteriorDistance(point), 3.0 * 1.8);  // a ball's box at most
    }
  }
}

/// Moves objects again and again, `most` of them at a time.
void expect_moving_is_compiling(std::uint32_t count, int rounds, std::size_t most) {
  Random random(count);
  std::vector<HapticObject> objects = boxes(count, random);
  ScenePointer scene = HapticScene::compile(objects);
  for (int round = 0; round < rounds; ++round) {
    std::vector<HapticScene::Move> moves = {{{count + 5, 1}, Pose::Identity(), {}}};  // not there
    for (std::size_t i = 0, end = 1 + random.index(most); i < end; ++i) {
      HapticObject& it = objects[random.index(objects.size())];
      it.world_from_object = Pose(Eigen::Translation3d(10.0 * in_cube(random)));
      it.motion = {};
      if (random.index(4) == 0) it.motion.linear = in_cube(random);
      moves.push_back({it.id, it.world_from_object, it.motion});
    }
    const ScenePointer before = std::exchange(scene, scene->moved(moves, 0.01 * round));
    expect_same_scene(*scene, objects, random);
    EXPECT_TRUE(scene->holds_the_same(*before));
    if (testing::Test::HasFailure()) FAIL() << "round " << round;
  }
}

TEST(HapticScene, MovedByFewIsWhatIsCompiledOfThem) { expect_moving_is_compiling(500, repeats(60), 3); }
TEST(HapticScene, MovedByManyIsWhatIsCompiledOfThem) { expect_moving_is_compiling(500, repeats(60), 200); }
TEST(HapticScene, OfFewObjectsMovesLikeALargeOne) { expect_moving_is_compiling(3, repeats(60), 3); }

TEST(HapticScene, SharesWhatIsNotMoved) {
  Random random(1);
  const ScenePointer before = HapticScene::compile(boxes(1000, random));
  const HapticScene::Move move{before->objects()[100].id, Pose::Identity(), {}};
  const ScenePointer after = before->moved({&move, 1});
  std::size_t shared = 0;
  for (std::size_t block = 0; block < after->objects().block_count(); ++block)
    shared += after->objects().shares_block(before->objects(), block);
  EXPECT_EQ(shared, after->objects().block_count() - 1);
  EXPECT_EQ(&after->objects()[0], &before->objects()[0]);
  EXPECT_NE(&after->objects()[100], &before->objects()[100]);
}

TEST(HapticScene, IsVisitedUntilTheVisitorHasEnough) {
  Random random(2);
  const ScenePointer before = HapticScene::compile(boxes(300, random));
  std::vector<HapticScene::Move> moves;
  for (std::uint32_t i = 0; i < 20; ++i) moves.push_back({before->objects()[i].id, Pose::Identity(), {}});
  const ScenePointer scene = before->moved(moves);
  const std::size_t all = found_near(*scene, Vector3::Zero(), Vector3::Zero(), 50.0).size();
  ASSERT_EQ(all, 300U);
  for (const std::size_t enough : {1U, 5U, 280U, 281U, 290U, 300U}) {
    std::size_t visited = 0;
    scene->near(Vector3::Zero(), Vector3::Zero(), 50.0, [&](std::uint32_t) { return ++visited < enough; });
    EXPECT_EQ(visited, enough);
  }
}

TEST(HapticScene, WithoutObjectsCanBeMoved) {
  const ScenePointer scene = HapticScene::compile({})->moved({}, 2.0);
  EXPECT_EQ(scene->moment(), 2.0);
  EXPECT_TRUE(found_near(*scene, Vector3::Zero(), Vector3::Zero(), 1e6).empty());
  EXPECT_EQ(scene->extent(), 1.0);
}

TEST(HapticScene, ThatHasNoEndIsFoundEverywhereAlsoWhenItWasMoved) {
  Random random(3);
  std::vector<HapticObject> objects = boxes(200, random);
  objects.push_back(object(1000, shape_of(primitive("plane"))));
  const ScenePointer before = HapticScene::compile(objects);
  const HapticScene::Move move{objects.back().id, translation(0, 0, -1), {}};
  for (const ScenePointer& scene : {before, before->moved({&move, 1})})
    EXPECT_TRUE(found_near(*scene, Vector3(1e4, 0, 1), Vector3(1e4, 0, 1), 0.1).contains(200));
}

// What the servo is told of: whatever moved, and what moves by itself.
TEST(HapticScene, ChangesAreTheSameByBlocksAndByIds) {
  Random random(4);
  std::vector<HapticObject> objects = boxes(500, random);
  objects[77].motion.linear = Vector3(0.1, 0, 0);  // goes on by itself
  ScenePointer before = HapticScene::compile(objects);
  for (int round = 0; round < repeats(100); ++round) {
    std::vector<HapticScene::Move> moves;
    std::set<base::ObjectId> expected = {objects[77].id};
    for (std::size_t i = random.index(5); i-- > 0;) {
      HapticObject& it = objects[random.index(objects.size())];
      if (random.index(3) > 0) it.world_from_object = Pose(Eigen::Translation3d(in_cube(random)));
      const std::uint32_t at = before->find(it.id).value();
      const bool differs = it.world_from_object.matrix() != before->objects()[at].world_from_object.matrix();
      if (differs) expected.insert(it.id);
      moves.push_back({it.id, it.world_from_object, it.motion});
    }
    const ScenePointer after = before->moved(moves);
    std::set<base::ObjectId> changed;
    for (const SceneChange& change : changes_between(*before, *after)) changed.insert(change.id);
    EXPECT_EQ(changed, expected) << round;
    std::set<base::ObjectId> by_ids;
    for (const SceneChange& change : changes_between(*before, *HapticScene::compile(objects)))
      by_ids.insert(change.id);
    EXPECT_EQ(by_ids, expected) << round;
    before = after;
  }
}

}  // namespace
}  // namespace icome::haptics
