#include "render/model/render_scene.h"

#include <set>

#include "render/drawn_world.h"

namespace icome::render {
namespace {

using world::at;
using world::box;
using world::changes_of;

std::vector<RenderItem> items_of(const RenderScene& scene) {
  std::vector<RenderItem> items;
  scene.for_each([&](const RenderItem& item) { items.push_back(item); });
  std::sort(items.begin(), items.end(), [](const auto& a, const auto& b) { return a.object < b.object; });
  return items;
}

/// A version that was brought up to date shows what one made anew shows.
void expect_equal(const RenderScene& updated, const RenderScene& anew) {
  const auto a = items_of(updated), b = items_of(anew);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].object, b[i].object);
    EXPECT_EQ(a[i].shape->triangle_count(), b[i].shape->triangle_count());
    EXPECT_EQ(a[i].material->diffuse, b[i].material->diffuse);
    EXPECT_TRUE(a[i].world_from_object.matrix().isApprox(b[i].world_from_object.matrix(), 1e-9) ||
                a[i].world_from_object.matrix().isZero());
  }
  EXPECT_EQ(updated.object_count(), anew.object_count());
  EXPECT_EQ(updated.triangle_count(), anew.triangle_count());
  EXPECT_EQ(updated.lights().size(), anew.lights().size());
  EXPECT_EQ(updated.viewpoints().size(), anew.viewpoints().size());
  EXPECT_EQ(updated.remarks(), anew.remarks());
}

std::size_t shapes_in(const RenderScene& scene) {
  std::set<const RenderShape*> shapes;
  scene.for_each([&](const RenderItem& item) { shapes.insert(item.shape.get()); });
  return shapes.size();
}

TEST(RenderScene, ClonesAndCopiesShareOneShape) {
  DrawnWorld it;
  const auto first = it.add(box(1.0));
  world::duplicated(it.world, it.ids, first, world::Duplicate::CloneObject);
  const auto copy = world::duplicated(it.world, it.ids, first, world::Duplicate::CopyObject);
  ScenePublisher publisher;
  const auto scene = publisher.publish(it.world);
  EXPECT_EQ(scene->object_count(), 3u);
  EXPECT_EQ(shapes_in(*scene), 1u);
  EXPECT_EQ(scene->triangle_count(), 36u);
  // A copy goes its own way when it is edited.
  const world::Edit edit = world::ReplaceGeometry{it.world.find(copy)->geometry, box(2.0)};
  world::applied(it.world, edit);
  const auto after = publisher.update(it.world, changes_of(edit));
  EXPECT_EQ(shapes_in(*after), 2u);
  expect_equal(*after, *ScenePublisher().publish(it.world));
}

TEST(RenderScene, AnEditReplacesOnlyWhatItTouched) {
  DrawnWorld it;
  std::vector<world::ObjectId> objects;
  for (int i = 0; i < 1000; ++i) objects.push_back(it.add(box(1.0), at(double(i), 0.0, 0.0)));
  ScenePublisher publisher;
  const auto before = publisher.publish(it.world);
  const world::Edit edit = world::PlaceObject{objects[500], at(0.0, 9.0, 0.0)};
  world::applied(it.world, edit);
  const auto after = publisher.update(it.world, changes_of(edit));
  std::size_t replaced = 0;
  for (std::size_t i = 0; i < before->blocks().size(); ++i)
    replaced += before->blocks()[i] != after->blocks()[i] ? 1 : 0;
  EXPECT_EQ(replaced, 1u);
  EXPECT_EQ(before->bounds().max().y(), 0.5);  // who draws the old version goes on with it
  EXPECT_EQ(after->bounds().max().y(), 9.5);
  expect_equal(*after, *ScenePublisher().publish(it.world));
}

TEST(RenderScene, WhatIsBelowGoesAlong) {
  DrawnWorld it;
  const auto table = it.add(box(1.0));
  world::add_object(it.world, it.ids, "leg", box(0.5), table, at(0.0, -1.0, 0.0));
  ScenePublisher publisher;
  publisher.publish(it.world);
  const world::Edit edit = world::PlaceObject{table, at(5.0, 0.0, 0.0)};
  world::applied(it.world, edit);
  const auto after = publisher.update(it.world, changes_of(edit));
  for (const RenderItem& item : items_of(*after)) EXPECT_EQ(item.world_from_object.translation().x(), 5.0);
}

TEST(RenderScene, UpdatesShowWhatMakingAnewShows) {
  DrawnWorld it;
  ScenePublisher publisher;
  publisher.publish(it.world);
  base::Random random(11);
  std::vector<world::Edit> undo;
  for (int step = 0; step < 300; ++step) {
    std::vector<world::ObjectId> all;
    for (const auto& [id, object] : it.world.objects()) all.push_back(id);
    std::sort(all.begin(), all.end());
    const auto any = [&] { return all[random.index(all.size())]; };
    std::vector<world::Edit> edits;
    switch (all.empty() ? 0 : random.index(9)) {
      case 0:
      case 1: {
        const auto shape = it.ids.next<world::GeometryId>();
        edits.emplace_back(world::CreateGeometry{shape, box(random.uniform(0.5, 2.0))});
        world::PhysicalObject object;
        object.geometry = shape;
        if (!all.empty() && random.index(2) == 0) object.parent = any();
        const std::size_t place =
            object.parent ? it.world.find(object.parent)->children.size() : it.world.roots().size();
        edits.emplace_back(world::CreateObject{it.ids.next<world::ObjectId>(), place, object});
        break;
      }
      case 2:
        edits.push_back(world::delete_subtree(it.world, any()));
        break;
      case 3:
        edits.emplace_back(world::PlaceObject{any(), at(random.uniform(), random.uniform(), 0.0)});
        break;
      case 4: {
        const auto made = it.ids.next<world::MaterialId>();
        edits.emplace_back(world::CreateMaterial{made, coloured({float(random.uniform()), 0.0F, 0.0F})});
        edits.emplace_back(world::ChooseMaterial{any(), made});
        break;
      }
      case 5: {
        const auto id = it.world.find(any())->material;
        if (id)
          edits.emplace_back(world::ChangeMaterial{id, coloured({0.0F, float(random.uniform()), 0.0F})});
        break;
      }
      case 6: {
        const auto id = it.world.find(any())->geometry;
        if (id)
          edits.emplace_back(world::ReplaceGeometry{
              id, random.index(3) == 0 ? std::make_shared<world::PrimitiveGeometry>(geometry::Plane{})
                                       : std::make_shared<world::PrimitiveGeometry>(geometry::Sphere{1.0})});
        break;
      }
      case 7:
        edits.emplace_back(world::ChangeFixture{
            any(), random.index(2) == 0 ? nullptr : std::make_shared<const world::Fixture>(world::Light{})});
        break;
      default:
        if (!undo.empty()) edits.push_back(undo.back());
        undo.clear();
    }
    const world::Edit group = world::EditGroup{edits};
    auto inverse = world::apply(it.world, group);
    if (!inverse) continue;
    undo.push_back(std::move(*inverse));
    const auto updated = publisher.update(it.world, changes_of(group));
    if (step % 7 == 0) expect_equal(*updated, *ScenePublisher().publish(it.world));
  }
}

TEST(RenderScene, OneSceneOfAWorldCanBeShown) {
  DrawnWorld it;
  const auto in = it.add(box(1.0)), out = it.add(box(2.0));
  const auto scene = it.ids.next<world::SceneId>();
  world::applied(it.world, world::CreateScene{scene, "kitchen"});
  world::applied(it.world, world::EnterScene{scene, in, 0});
  ScenePublisher publisher(scene);
  EXPECT_EQ(publisher.publish(it.world)->object_count(), 1u);
  const world::Edit enter = world::EnterScene{scene, out, 1};
  world::applied(it.world, enter);
  EXPECT_EQ(publisher.update(it.world, changes_of(enter))->object_count(), 2u);
  const world::Edit leave = world::LeaveScene{scene, in};
  world::applied(it.world, leave);
  const auto last = publisher.update(it.world, changes_of(leave));
  ASSERT_EQ(last->object_count(), 1u);
  EXPECT_EQ(items_of(*last)[0].object, out);
  const world::Edit place = world::PlaceObject{in, at(1.0, 0.0, 0.0)};
  world::applied(it.world, place);
  EXPECT_EQ(publisher.update(it.world, changes_of(place))->object_count(), 1u);
}

TEST(RenderScene, AnotherSceneIsShownOfTheSameShapes) {
  DrawnWorld it;
  const auto in = it.add(box(1.0));
  it.add(box(2.0));
  const auto scene = it.ids.next<world::SceneId>();
  world::applied(it.world, world::CreateScene{scene, "kitchen"});
  world::applied(it.world, world::EnterScene{scene, in, 0});
  ScenePublisher publisher;
  const auto all = publisher.publish(it.world);
  const auto one = publisher.show_scene(it.world, scene);
  expect_equal(*one, *ScenePublisher(scene).publish(it.world));
  EXPECT_EQ(items_of(*one)[0].shape, items_of(*all)[0].shape);
  const auto again = publisher.show_scene(it.world, {});
  expect_equal(*again, *all);
  EXPECT_EQ(items_of(*again)[1].shape, items_of(*all)[1].shape);
}

world::FixturePointer lamp(world::Light::Kind kind, bool scoped = false) {
  return std::make_shared<const world::Fixture>(world::Light{.kind = kind, .scoped = scoped});
}

TEST(RenderScene, AGroupsLightFollowsWhatComesIntoTheGroup) {
  DrawnWorld it;
  const auto group = it.ids.next<world::ObjectId>(), light = it.ids.next<world::ObjectId>();
  const auto sun = lamp(world::Light::Kind::Directional, true);
  world::applied(it.world, world::CreateObject{group, 0, {.name = "group"}});
  world::applied(it.world, world::CreateObject{light, 0, {.parent = group, .fixture = sun}});
  const auto moved = it.add(box(1.0));
  ScenePublisher publisher;
  const auto before = publisher.publish(it.world);
  ASSERT_TRUE(before->lights()[0].group);
  EXPECT_FALSE(before->lights()[0].group->contains(moved));
  const world::Edit edit = world::MoveObject{moved, group, 0, at(0.0, 0.0, 0.0)};
  world::applied(it.world, edit);
  const auto after = publisher.update(it.world, changes_of(edit));
  EXPECT_TRUE(after->lights()[0].group->contains(moved));
}

TEST(RenderScene, LightsThatAreTooManyAreTold) {
  DrawnWorld it;
  const auto add_light = [&](world::Light::Kind kind) {
    world::applied(it.world, world::CreateObject{it.ids.next<world::ObjectId>(), 0, {.fixture = lamp(kind)}});
  };
  for (int i = 0; i < 8; ++i) add_light(world::Light::Kind::Directional);
  for (int i = 0; i < 16; ++i) add_light(i % 2 == 0 ? world::Light::Kind::Point : world::Light::Kind::Spot);
  EXPECT_TRUE(ScenePublisher().publish(it.world)->remarks().empty());
  add_light(world::Light::Kind::Point);
  const auto remarks = ScenePublisher().publish(it.world)->remarks();
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_NE(remarks[0].find("Of 8 directional lights and 17 lamps"), std::string::npos) << remarks[0];
}

TEST(RenderScene, WhatCannotBeDrawnIsToldAndTheRestDrawn) {
  DrawnWorld it;
  it.add(std::make_shared<world::PrimitiveGeometry>(geometry::Plane{}));
  world::Material look = coloured(kRed);
  look.texture = it.texture("no picture at all");
  it.add(square(), at(0.0, 0.0, 0.0), look);
  const auto scene = ScenePublisher().publish(it.world);
  EXPECT_EQ(scene->object_count(), 1u);
  ASSERT_EQ(scene->remarks().size(), 2u);
  EXPECT_NE(scene->remarks()[0].find("thing is not drawn"), std::string::npos);
  EXPECT_NE(scene->remarks()[1].find("The texture picture is not shown"), std::string::npos);
  EXPECT_TRUE(is_red(middle(drawn(*scene, camera_at({0.0, 0.0, 3.0}), plain_look()))));
}

}  // namespace
}  // namespace icome::render
