#include "world/edit/changes.h"

#include <set>

#include "world/random_edits.h"

namespace icome::world {
namespace {

template <typename AnyId>
bool names(const std::vector<AnyId>& ids, AnyId id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

/// Ids whose thing is another than before, as `same` tells.
template <typename Named, typename Same>
std::set<Id<Named>> differing(const World::Table<Named>& before, const World::Table<Named>& after,
                              const Same& same) {
  std::set<Id<Named>> ids;
  for (const auto& [id, it] : before) {
    const auto found = after.find(id);
    if (found == after.end() || !same(it, found->second)) ids.insert(id);
  }
  for (const auto& [id, it] : after) {
    if (before.count(id) == 0) ids.insert(id);
  }
  return ids;
}

TEST(Changes, NameEachThingOnce) {
  const ObjectId leg{3}, table{2};
  const Changes changes = changes_of(EditGroup{
      {RenameObject{leg, "leg"}, EditGroup{{PlaceObject{leg}, MoveObject{table, {}, 0}}}, DeleteGeometry{{9}},
       EnterScene{{4}, leg, 0}, LeaveScene{{4}, leg}, ChangeMaterial{{5}, {}}, DeleteTexture{{6}}}});
  EXPECT_EQ(changes.objects, (std::vector<ObjectId>{table, leg}));
  EXPECT_EQ(changes.geometries, std::vector<GeometryId>{{9}});
  EXPECT_EQ(changes.materials, std::vector<MaterialId>{{5}});
  EXPECT_EQ(changes.textures, std::vector<TextureId>{{6}});
  EXPECT_EQ(changes.scenes, std::vector<SceneId>{{4}});
}

TEST(Changes, NameAllThatDiffersAfterRandomEdits) {
  World world;
  RandomEdits edits(5);
  for (int i = 0; i < 3000; ++i) {
    const World before = world;
    const Edit edit = edits.next(world);
    const auto inverse = apply(world, edit);
    if (!inverse) continue;
    for (const Changes& changes : {changes_of(edit), changes_of(*inverse)}) {
      for (const ObjectId id : differing(before.objects(), world.objects(), [](const auto&a, const auto&b) {
             return a.name == b.name && a.parent == b.parent && a.geometry == b.geometry &&
                    a.material == b.material && a.fixture == b.fixture &&
                    a.parent_from_object.matrix() == b.parent_from_object.matrix();
           }))
        ASSERT_TRUE(names(changes.objects, id)) << edit.what.index();
      for (const GeometryId id : differing(before.geometries(), world.geometries(),
                                           [](const auto&a, const auto&b) { return a.shape == b.shape; }))
        ASSERT_TRUE(names(changes.geometries, id)) << edit.what.index();
      for (const SceneId id : differing(before.scenes(), world.scenes(), [](const auto&a, const auto&b) {
             return a.name == b.name && a.roots == b.roots;
           }))
        ASSERT_TRUE(names(changes.scenes, id)) << edit.what.index();
    }
  }
}

}  // namespace
}  // namespace icome::world
