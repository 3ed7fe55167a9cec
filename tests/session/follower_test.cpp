// Replicas of the world that follow main's, each in its own time.
#include "session/follower.h"

#include <gtest/gtest.h>

#include <new>
#include <semaphore>

#include "world/edit/shared_edit.h"
#include "world/random_edits.h"

namespace icome::session {
namespace {

using world::World;

/// What a representation was told.
struct Diary {
  std::vector<std::uint64_t> hashes;           // of the world, at every call
  std::vector<std::size_t> changed;            // objects, at every follow()
  std::vector<world::SceneId> scenes;          // at every open() and show()
  std::vector<const world::Geometry*> shapes;  // that the world had at last
};

class Noting : public Representation {
 public:
  explicit Noting(Diary& diary) : diary_(diary) {}
  void open(const World& world, world::SceneId shown) override {
    diary_.scenes.push_back(shown);
    note(world);
  }
  void show(const World& world, world::SceneId shown) override {
    diary_.scenes.push_back(shown);
    note(world);
  }
  void follow(const World& world, const world::Changes& changes) override {
    diary_.changed.push_back(changes.objects.size());
    note(world);
  }

 private:
  void note(const World& world) {
    diary_.hashes.push_back(world::hash(world));
    diary_.shapes.clear();
    for (const auto& [id, geometry] : world.geometries()) diary_.shapes.push_back(geometry.shape.get());
    std::sort(diary_.shapes.begin(), diary_.shapes.end());
  }
  Diary& diary_;
};

/// Stays in its first follow() until it is told to go on.
class HeldUp final : public Noting {
 public:
  explicit HeldUp(Diary& diary, std::binary_semaphore& entered, std::binary_semaphore& go_on)
      : Noting(diary), entered_(entered), go_on_(go_on) {}
  void follow(const World& world, const world::Changes& changes) override {
    if (std::exchange(first_, false)) {
      entered_.release();
      go_on_.acquire();
    }
    Noting::follow(world, changes);
  }

 private:
  std::binary_semaphore &entered_, &go_on_;
  bool first_ = true;
};

/// Main's side: performs and posts.
struct Main {
  World world;
  EditedQueue queue;

  bool perform(const world::Edit& edit, world::Edit* inverse = nullptr) {
    auto done = world::perform_shared(world, edit);
    if (!done) return false;
    Edited edited;
    edited.edit = std::make_shared<const world::Edit>(edit);
    edited.for_replicas = std::make_shared<const world::Edit>(done->for_replicas);
    queue.post(std::move(edited));
    if (inverse) *inverse = done->inverse;
    return true;
  }
  void open(World other) {
    world = std::move(other);
    Edited edited;
    edited.whole = std::make_shared<const World>(world);
    queue.post(std::move(edited));
  }
};

/// Closes a queue before its followers go, also when a test fails.
struct Closing {
  EditedQueue& queue;
  ~Closing() { queue.close(); }
};

void wait_for(const Follower& follower, EditedQueue& queue) {
  while (follower.followed() != queue.posted()) {
    queue.pump();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

std::vector<const world::Geometry*> shapes_of(const World& world) {
  std::vector<const world::Geometry*> shapes;
  for (const auto& [id, geometry] : world.geometries()) shapes.push_back(geometry.shape.get());
  std::sort(shapes.begin(), shapes.end());
  return shapes;
}

TEST(Follower, ReplicasEqualTheWorldAfterRandomEditsAndUndos) {
  Main main;
  Diary one, other;
  Follower felt(main.queue, std::make_unique<Noting>(one), "one");
  Follower seen(main.queue, std::make_unique<Noting>(other), "other");
  const Closing closing{main.queue};
  world::RandomEdits edits(20261121);
  base::Random random(7);
  std::vector<world::Edit> undo;
  for (int i = 0; i < 3000; ++i) {
    if (!undo.empty() && random.index(4) == 0) {
      ASSERT_TRUE(main.perform(undo.back()));
      undo.pop_back();
      continue;
    }
    world::Edit inverse = world::EditGroup{};
    if (main.perform(edits.next(main.world), &inverse)) undo.push_back(std::move(inverse));
    if (i == 1500) {
      main.open(World(main.world));
      undo.clear();
    }
    if (i % 500 == 499) {
      wait_for(felt, main.queue);
      ASSERT_EQ(one.hashes.back(), world::hash(main.world));
    }
  }
  wait_for(felt, main.queue);
  wait_for(seen, main.queue);
  EXPECT_EQ(one.hashes.back(), world::hash(main.world));
  EXPECT_EQ(other.hashes.back(), world::hash(main.world));
  // The very same shapes: nobody has made one again.
  EXPECT_EQ(one.shapes, shapes_of(main.world));
  EXPECT_EQ(other.shapes, shapes_of(main.world));
}

TEST(Follower, TakesTogetherWhatQueuedUpWhileItWasHeldUp) {
  Main main;
  Diary held, free;
  std::binary_semaphore entered(0), go_on(0);
  Follower slow(main.queue, std::make_unique<HeldUp>(held, entered, go_on), "slow");
  Follower quick(main.queue, std::make_unique<Noting>(free), "quick");
  const Closing closing{main.queue};
  world::IdSource ids;
  const auto first = ids.next<world::ObjectId>();
  ASSERT_TRUE(main.perform(world::CreateObject{first, 0, {}}));
  entered.acquire();
  // More than the queue holds; that this goes on at all shows that nobody waits for the slow one.
  for (int i = 1; i <= 3000; ++i)
    ASSERT_TRUE(main.perform(world::CreateObject{ids.next<world::ObjectId>(), 0, {}}));
  wait_for(quick, main.queue);
  EXPECT_EQ(free.hashes.back(), world::hash(main.world));
  EXPECT_EQ(slow.followed(), 0U);
  EXPECT_TRUE(held.hashes.empty());
  go_on.release();
  wait_for(slow, main.queue);
  EXPECT_EQ(held.hashes.back(), world::hash(main.world));
  EXPECT_LT(slow.rounds(), 100U);
  std::size_t changed = 0;
  for (const std::size_t it : held.changed) changed += it;
  EXPECT_EQ(changed, 3001U);
}

TEST(Follower, ShowsTheSceneThatWasAskedForLast) {
  Main main;
  Diary diary;
  Follower follower(main.queue, std::make_unique<Noting>(diary), "one");
  const Closing closing{main.queue};
  world::IdSource ids;
  const auto scene = ids.next<world::SceneId>();
  ASSERT_TRUE(main.perform(world::CreateScene{scene, "scene"}));
  Edited edited;
  edited.shown = scene;
  main.queue.post(edited);
  wait_for(follower, main.queue);
  EXPECT_EQ(diary.scenes.back(), scene);
  main.open({});
  wait_for(follower, main.queue);
  EXPECT_EQ(diary.scenes.back(), world::SceneId{});
}

TEST(Follower, LeavesWhatIsLeftWhenItIsGivenUp) {
  Main main;
  Diary diary;
  std::binary_semaphore entered(0), go_on(0);
  {
    Follower follower(main.queue, std::make_unique<HeldUp>(diary, entered, go_on), "slow");
    world::IdSource ids;
    ASSERT_TRUE(main.perform(world::CreateObject{ids.next<world::ObjectId>(), 0, {}}));
    entered.acquire();
    for (int i = 0; i < 100; ++i)
      ASSERT_TRUE(main.perform(world::CreateObject{ids.next<world::ObjectId>(), 0, {}}));
    follower.give_up();
    main.queue.close();
    go_on.release();
  }
  EXPECT_EQ(diary.changed, std::vector<std::size_t>{1});
}

/// Has no memory for some time.
class Starved final : public Noting {
 public:
  Starved(Diary& diary, std::atomic<bool>& hungry) : Noting(diary), hungry_(hungry) {}
  void open(const World& world, world::SceneId shown) override {
    if (hungry_) throw std::bad_alloc();
    Noting::open(world, shown);
  }
  void follow(const World& world, const world::Changes& changes) override {
    if (hungry_) throw 1;
    Noting::follow(world, changes);
  }

 private:
  std::atomic<bool>& hungry_;
};

TEST(Follower, GoesOnWhenTheRepresentationThrows) {
  Main main;
  Diary diary;
  std::atomic<bool> hungry = true;
  Follower follower(main.queue, std::make_unique<Starved>(diary, hungry), "felt world");
  const Closing closing{main.queue};
  world::IdSource ids;
  const auto grow = [&] {
    EXPECT_TRUE(main.perform(world::CreateObject{ids.next<world::ObjectId>(), 0, {}}));
    wait_for(follower, main.queue);
  };
  EXPECT_FALSE(follower.news());
  main.open({});
  wait_for(follower, main.queue);
  const auto told = follower.news();
  ASSERT_TRUE(told);
  EXPECT_NE(told->find("felt world"), std::string::npos);
  EXPECT_NE(told->find(std::bad_alloc().what()), std::string::npos);
  grow();
  EXPECT_FALSE(follower.news()) << "it is told once";
  hungry = false;
  const std::size_t before = diary.scenes.size();
  grow();
  EXPECT_EQ(diary.scenes.size(), before + 1) << "what may be half-way is opened anew";
  EXPECT_EQ(diary.hashes.back(), world::hash(main.world)) << "what it missed is there";
  const auto again = follower.news();
  ASSERT_TRUE(again);
  EXPECT_NE(again->find("follows the design again"), std::string::npos);
  grow();
  EXPECT_EQ(diary.changed.size(), 1U) << "and from there it is followed";
  EXPECT_FALSE(follower.news());
  hungry = true;
  grow();
  EXPECT_TRUE(follower.news());
}

TEST(SharedEdit, GroupsDoTheSameToReplicasStepByStep) {
  World main, replica;
  world::IdSource ids;
  const auto id = ids.next<world::GeometryId>(), copy = ids.next<world::GeometryId>();
  for (World* it : {&main, &replica}) world::applied(*it, world::CreateGeometry{id, world::one_triangle()});
  // The copy is of the shape in between.
  const world::Edit group =
      world::EditGroup{{world::MoveVertices{id, {0}, {{5.0, 0.0, 0.0}}}, world::CopyGeometry{copy, id},
                        world::EditGroup{{world::MoveVertices{id, {1}, {{7.0, 0.0, 0.0}}}}}}};
  const auto done = world::perform_shared(main, group);
  ASSERT_TRUE(done);
  world::applied(replica, done->for_replicas);
  EXPECT_EQ(world::hash(replica), world::hash(main));
  EXPECT_EQ(shapes_of(replica).size(), 2U);
  for (const auto it : {id, copy}) EXPECT_EQ(replica.find(it)->shape, main.find(it)->shape);
  world::applied(main, done->inverse);
  EXPECT_EQ(main.find(id)->shape->hash(), world::one_triangle()->hash());
  EXPECT_EQ(main.geometries().size(), 1U);
}

TEST(SharedEdit, AGroupThatIsRefusedChangesNothing) {
  World main;
  world::IdSource ids;
  const auto id = ids.next<world::GeometryId>();
  world::applied(main, world::CreateGeometry{id, world::one_triangle()});
  const std::uint64_t before = world::hash(main);
  EXPECT_FALSE(
      world::perform_shared(main, world::EditGroup{{world::MoveVertices{id, {0}, {{5.0, 0.0, 0.0}}},
                                                    world::MoveVertices{id, {9}, {{7.0, 0.0, 0.0}}}}}));
  EXPECT_EQ(world::hash(main), before);
}

}  // namespace
}  // namespace icome::session
