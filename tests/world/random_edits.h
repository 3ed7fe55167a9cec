#pragma once
#include "world/motion.h"
#include "world/sample_world.h"

namespace icome::world {

/// Thinks of edits at random, of every kind, most of which the world allows.
class RandomEdits {
 public:
  /// New things get ids of this author, from `first` on.
  explicit RandomEdits(std::uint64_t seed, std::uint32_t author = 0, std::uint64_t first = 1)
      : random_(seed), ids_(author, first) {}

  Edit next(const World& world) {
    switch (random_.index(18)) {
      case 0:
      case 1:
        return create(world);
      case 2: {
        const ObjectId id = any(world.objects());
        return world.find(id) ? delete_subtree(world, id) : create(world);
      }
      case 3:
        return MoveObject{any(world.objects()), any_or_none(world.objects()), 0, frame()};
      case 4:
        return PlaceObject{any(world.objects()), frame()};
      case 5:
        return RenameObject{any(world.objects()), "name " + std::to_string(random_.index(100))};
      case 6:
        return ChooseGeometry{any(world.objects()), any_or_none(world.geometries())};
      case 7:
        return ChooseMaterial{any(world.objects()), any_or_none(world.materials())};
      case 8:
        return CreateGeometry{ids_.next<GeometryId>(), shape()};
      case 9:
        return ReplaceGeometry{any(world.geometries()), shape()};
      case 10:
        return MoveVertices{
            any(world.geometries()), {std::uint32_t(random_.index(4))}, {random_.direction()}};
      case 11:
        return CreateMaterial{ids_.next<MaterialId>(), material(world)};
      case 12:
        return ChangeMaterial{any(world.materials()), material(world)};
      case 13:
        return scene(world);
      case 14:
        return unused(world);
      case 15:
        return ChangeFixture{any(world.objects()), fixture()};
      case 16:
        return ChangeMotion{any(world.objects()), motion()};
      default: {
        auto made = duplicate(world, any(world.objects()), Duplicate(random_.index(6)),
                              any_or_none(world.objects()), ids_);
        return made && world.objects().size() < 500 ? made->edit : create(world);
      }
    }
  }

 private:
  /// In the order of ids, as tables keep none that could be repeated.
  template <typename Named>
  Id<Named> any(const World::Table<Named>& table) {
    if (table.empty()) return {};
    std::vector<Id<Named>> all;
    for (const auto& [id, named] : table) all.push_back(id);
    std::sort(all.begin(), all.end());
    return all[random_.index(all.size())];
  }
  template <typename Named>
  Id<Named> any_or_none(const World::Table<Named>& table) {
    return random_.index(4) == 0 ? Id<Named>{} : any(table);
  }

  Affine3 frame() {
    return Eigen::Translation3d(random_.direction()) *
           Eigen::AngleAxisd(random_.uniform(0.0, 3.0), random_.direction()) *
           Eigen::Scaling(random_.uniform(0.5, 2.0));
  }
  GeometryPointer shape() {
    const std::uint64_t kind = random_.index(4);
    if (kind % 2 == 0) return box(random_.uniform(0.1, 1.0));
    return kind == 1 ? one_triangle() : made_mesh();
  }
  Material material(const World& world) {
    return {
        .name = "material", .shininess = float(random_.uniform()), .texture = any_or_none(world.textures())};
  }
  Edit create(const World& world) {
    PhysicalObject object{.name = "object",
                          .parent = any_or_none(world.objects()),
                          .parent_from_object = frame(),
                          .geometry = any_or_none(world.geometries()),
                          .material = any_or_none(world.materials())};
    return CreateObject{ids_.next<ObjectId>(), 0, std::move(object)};
  }
  FixturePointer fixture() {
    switch (random_.index(5)) {
      case 0:
        return nullptr;
      case 1:
        return std::make_shared<const Fixture>(Light{.intensity = float(random_.uniform())});
      case 2:
        return std::make_shared<const Fixture>(Viewpoint{random_.uniform(0.1, 3.0)});
      case 3:
        return std::make_shared<const Fixture>(ForceEffect{"viscous:2", random_.index(2) == 0});
      default:
        return std::make_shared<const Fixture>(Inert{"Script", "Script {}"});
    }
  }
  MotionPointer motion() {
    if (random_.index(4) == 0) return nullptr;
    Motion motion;
    motion.translation = {.times = {0.0, 1.0}, .values = std::vector<double>(6, random_.uniform())};
    return std::make_shared<const Motion>(std::move(motion));
  }
  Edit scene(const World& world) {
    const SceneId one = any(world.scenes());
    switch (random_.index(5)) {
      case 0:
        return CreateScene{ids_.next<SceneId>(), "scene"};
      case 1:
        return DeleteScene{one};
      case 2:
        return RenameScene{one, "scene " + std::to_string(random_.index(9))};
      case 3:
        return LeaveScene{one, any(world.objects())};
      default:
        return EnterScene{one, any(world.objects()), 0};
    }
  }
  Edit unused(const World& world) {
    switch (random_.index(4)) {
      case 0:
        return DeleteGeometry{any(world.geometries())};
      case 1:
        return DeleteMaterial{any(world.materials())};
      case 2:
        return DeleteTexture{any(world.textures())};
      default:
        return CreateTexture{ids_.next<TextureId>(),
                             {"picture", "image/png", std::make_shared<std::string>("bytes")}};
    }
  }

  base::Random random_;
  IdSource ids_;
};

}  // namespace icome::world
