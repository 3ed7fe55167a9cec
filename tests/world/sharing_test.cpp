#include "world/sharing.h"

#include "world/sample_world.h"

namespace icome::world {
namespace {

TEST(Sharing, IsToldInWords) {
  World world;
  IdSource ids;
  const ObjectId leg = add_object(world, ids, "leg", box(1.0));
  const GeometryId shape = world.find(leg)->geometry;
  EXPECT_EQ(sharing(world, shape), "1 object uses this shape");
  std::vector<ObjectId> legs{leg};
  for (int i = 0; i < 3; ++i) legs.push_back(duplicated(world, ids, leg, Duplicate::CloneObject));
  EXPECT_EQ(sharing(world, shape), "4 objects use this shape");
  EXPECT_EQ(users(world, shape), legs);
  // A copy has a shape of its own.
  const ObjectId copy = duplicated(world, ids, leg, Duplicate::CopyObject);
  EXPECT_EQ(sharing(world, shape), "4 objects use this shape");
  EXPECT_EQ(sharing(world, world.find(copy)->geometry), "1 object uses this shape");
}

TEST(Sharing, CountsMaterialsAndTextures) {
  World world;
  IdSource ids;
  const TextureId picture = ids.next<TextureId>();
  const MaterialId wood = ids.next<MaterialId>();
  applied(world, CreateTexture{picture, {"wood.png", "image/png", std::make_shared<std::string>("bytes")}});
  EXPECT_EQ(sharing(world, picture), "no material shows this texture");
  applied(world, CreateMaterial{wood, {.texture = picture}});
  EXPECT_EQ(sharing(world, picture), "1 material shows this texture");
  EXPECT_EQ(sharing(world, wood), "no object has this material");
  const ObjectId table = add_object(world, ids, "table", box(1.0));
  applied(world, ChooseMaterial{table, wood});
  duplicated(world, ids, table, Duplicate::CopyObject);  // materials are shared always
  EXPECT_EQ(sharing(world, wood), "2 objects have this material");
  EXPECT_EQ(users(world, wood).size(), 2U);
  EXPECT_TRUE(users(world, MaterialId{}).empty());
}

}  // namespace
}  // namespace icome::world
