#include "world/edit/history.h"

#include "world/edit/edit_bytes.h"
#include "world/random_edits.h"

namespace icome::world {
namespace {

TEST(History, UndoesAndRedoesByAction) {
  World world;
  IdSource ids;
  const ObjectId leg = add_object(world, ids, "leg", box(1.0));
  History history;
  const std::uint64_t before = hash(world);
  ASSERT_TRUE(history.perform(world, PlaceObject{leg, at(1.0, 0.0, 0.0)}, "Move leg"));
  ASSERT_TRUE(history.extend(world, PlaceObject{leg, at(2.0, 0.0, 0.0)}));
  ASSERT_TRUE(history.extend(world, PlaceObject{leg, at(3.0, 0.0, 0.0)}));
  const std::uint64_t moved = hash(world);
  ASSERT_TRUE(history.perform(world, RenameObject{leg, "foot"}, "Rename leg"));
  EXPECT_EQ(history.undo_name(), "Rename leg");
  ASSERT_TRUE(history.undo(world));
  EXPECT_EQ(hash(world), moved);
  ASSERT_TRUE(history.undo(world));
  EXPECT_EQ(hash(world), before);
  EXPECT_FALSE(history.undo(world));
  EXPECT_EQ(history.redo_name(), "Move leg");
  ASSERT_TRUE(history.redo(world));
  EXPECT_EQ(hash(world), moved);
}

TEST(History, ForgetsWhatWasUndoneWhenSomethingElseIsDone) {
  World world;
  IdSource ids;
  const ObjectId leg = add_object(world, ids, "leg", box(1.0));
  History history;
  ASSERT_TRUE(history.perform(world, RenameObject{leg, "one"}, "Rename"));
  ASSERT_TRUE(history.undo(world));
  ASSERT_TRUE(history.perform(world, RenameObject{leg, "two"}, "Rename"));
  EXPECT_FALSE(history.can_redo());
}

TEST(History, LeavesWhatOthersHaveBuiltOn) {
  World world;
  IdSource ids;
  History history;
  const ObjectId table = ids.next<ObjectId>();
  ASSERT_TRUE(history.perform(world, CreateObject{table, 0, {.name = "table"}}, "Create table"));
  add_object(world, ids, "somebody's leg", box(1.0), table);
  const std::uint64_t before = hash(world);
  const auto undone = history.undo(world);
  ASSERT_FALSE(undone);
  EXPECT_NE(undone.error().message.find("\"Create table\" stays"), std::string::npos);
  EXPECT_EQ(hash(world), before);
  EXPECT_TRUE(history.can_undo());
}

TEST(History, PerformsThroughASink) {
  World world;
  IdSource ids;
  const ObjectId leg = add_object(world, ids, "leg", box(1.0));
  std::vector<Edit> performed;
  const EditSink sink([&](const Edit& edit) {
    performed.push_back(edit);
    return apply(world, edit);
  });
  History history;
  ASSERT_TRUE(history.perform(sink, RenameObject{leg, "foot"}, "Rename"));
  ASSERT_TRUE(history.extend(sink, PlaceObject{leg, at(1.0, 0.0, 0.0)}));
  ASSERT_TRUE(history.undo(sink));
  ASSERT_TRUE(history.redo(sink));
  EXPECT_EQ(performed.size(), 4u);
  EXPECT_EQ(world.find(leg)->name, "foot");
}

TEST(History, DoesNotGrowByUndoingAndRedoing) {
  World world;
  IdSource ids;
  const ObjectId leg = add_object(world, ids, "leg", box(1.0));
  History history;
  ASSERT_TRUE(history.perform(world, RenameObject{leg, "foot"}, "Change leg"));
  ASSERT_TRUE(history.extend(world, PlaceObject{leg, at(1.0, 0.0, 0.0)}));
  std::size_t bytes = 0;
  for (int i = 0; i < 100; ++i) {
    const auto undone = history.undo(world);
    ASSERT_TRUE(undone);
    const auto written = to_bytes(*undone);
    ASSERT_TRUE(written) << written.error().message;
    if (i == 0) bytes = written->size();
    EXPECT_EQ(written->size(), bytes);
    ASSERT_TRUE(history.redo(world));
  }
}

TEST(History, KeepsOnlyWhatTakesAnActionBack) {
  World world;
  IdSource ids;
  const ObjectId leg = add_object(world, ids, "leg", box(1.0));
  const ObjectId lamp = add_object(world, ids, "lamp", box(1.0));
  const auto bytes_of = [&](const std::vector<Edit>& steps) {
    const std::uint64_t before = hash(world);
    History history;
    EXPECT_TRUE(history.perform(world, steps.front(), "Change"));
    for (std::size_t i = 1; i < steps.size(); ++i) EXPECT_TRUE(history.extend(world, steps[i]));
    const auto undone = history.undo(world);
    EXPECT_EQ(hash(world), before);
    return to_bytes(*undone)->size();
  };
  const Edit one = PlaceObject{leg, at(1.0, 0.0, 0.0)}, other = PlaceObject{lamp, at(1.0, 0.0, 0.0)};
  const Edit group = EditGroup{{one}}, both = EditGroup{{one, other}};
  EXPECT_EQ(bytes_of({one, group, one}), bytes_of({one}));
  EXPECT_EQ(bytes_of({both, both, both}), bytes_of({both}));
  // These are undone step by step.
  EXPECT_GT(bytes_of({one, other}), bytes_of({one}));
  EXPECT_GT(bytes_of({one, both}), bytes_of({both}));
  EXPECT_GT(bytes_of({both, Edit(EditGroup{{one, RenameObject{lamp, "light"}}})}), bytes_of({both}));
}

/// A world with a shape of one triangle, and drags of its vertices.
struct DraggedTriangle {
  World world;
  IdSource ids;
  GeometryId shape = ids.next<GeometryId>();

  explicit DraggedTriangle(const std::string& recipe = "") {
    auto mesh = std::make_shared<MeshGeometry>(
        geometry::TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    mesh->recipe = recipe;
    EXPECT_TRUE(apply(world, CreateGeometry{shape, mesh}));
  }
  Edit drag(std::vector<std::uint32_t> vertices, double way) const {
    const std::vector<Vector3> positions(vertices.size(), Vector3(way, way, 1.0));
    return MoveVertices{shape, std::move(vertices), positions};
  }
  /// The bytes of what takes all of it back, which it must do.
  std::size_t taken_back(const std::vector<Edit>& steps) {
    const std::uint64_t before = hash(world);
    History history;
    EXPECT_TRUE(history.perform(world, steps.front(), "Drag"));
    for (std::size_t i = 1; i < steps.size(); ++i) EXPECT_TRUE(history.extend(world, steps[i]));
    const std::uint64_t after = hash(world);
    const auto undone = history.undo(world);
    EXPECT_EQ(hash(world), before);
    EXPECT_TRUE(history.redo(world));
    EXPECT_EQ(hash(world), after);
    EXPECT_TRUE(history.undo(world));
    return to_bytes(*undone)->size();
  }
};

TEST(History, KeepsOfADragOfVerticesWhereTheyWereAtFirst) {
  DraggedTriangle it;
  const std::size_t once = it.taken_back({it.drag({0, 2}, 1.0)});
  EXPECT_EQ(it.taken_back({it.drag({0, 2}, 1.0), it.drag({0, 2}, 2.0), it.drag({0, 2}, 3.0)}), once);
  EXPECT_GT(it.taken_back({it.drag({0, 2}, 1.0), it.drag({0, 1}, 2.0)}), once) << "others move";
  // The first step of a shape with a recipe is taken back by all of the shape.
  DraggedTriangle made("{}");
  EXPECT_EQ(made.taken_back({made.drag({1}, 1.0), made.drag({2}, 2.0)}),
            made.taken_back({made.drag({1}, 1.0)}));
}

TEST(History, GoesBackThroughRandomEdits) {
  for (int seed = 0; seed < 200; ++seed) {
    World world;
    RandomEdits edits{std::uint64_t(seed)};
    History history;
    std::vector<std::uint64_t> hashes{hash(world)};
    for (int i = 0; i < 50; ++i) {
      const Edit edit = edits.next(world);
      if (history.perform(world, edit, "edit")) {
        hashes.push_back(hash(world));
      } else {
        ASSERT_EQ(hash(world), hashes.back()) << "a refused edit changed the world";
      }
    }
    ASSERT_GT(hashes.size(), 15u);
    for (std::size_t i = hashes.size() - 1; i-- > 0;) {
      ASSERT_TRUE(history.undo(world)) << seed;
      ASSERT_EQ(hash(world), hashes[i]) << seed;
    }
    for (std::size_t i = 1; i < hashes.size(); ++i) ASSERT_TRUE(history.redo(world)) << seed;
    ASSERT_EQ(hash(world), hashes.back()) << seed;
  }
}

TEST(History, ForgetsTheOldestActionsBeyondItsMemoryButNeverTheLast) {
  World world;
  IdSource ids;
  const ObjectId object = add_object(world, ids, std::string(1000, 'a'), box(1.0));
  History history(5000);
  for (int i = 0; i < 50; ++i)
    ASSERT_TRUE(
        history.perform(world, RenameObject{object, std::string(1000, char('b' + i % 20))}, "Rename"));
  int undone = 0;
  while (history.can_undo()) {
    ASSERT_TRUE(history.undo(world));
    ++undone;
  }
  EXPECT_GE(undone, 2);
  EXPECT_LE(undone, 4) << "names of 1,000 bytes in 5,000";
  History small(1);
  ASSERT_TRUE(small.perform(world, RenameObject{object, std::string(9000, 'x')}, "Rename"));
  EXPECT_TRUE(small.undo(world)) << "what was done last can always be taken back";
}

}  // namespace
}  // namespace icome::world
