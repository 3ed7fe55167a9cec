#pragma once
#include <algorithm>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "world/world.h"

namespace icome::world {

/// What does not hold together in a world: nothing, whatever edits it has been through. Looks at nothing
/// but the tables.
class Complaints {
 public:
  explicit Complaints(const World& world) : world_(world) {
    for (const ObjectId root : world.roots()) expect_child(root, {});
    for (const auto& [id, object] : world.objects()) look_at(id, object);
    expect(seen_.size() == world.objects().size(), "an object is on no list of children");
    expect(reached() == world.objects().size(), "objects go round in a circle");
    for (const auto& [id, material] : world.materials()) look_at(material);
    expect_users(world.geometries(), shapes_, "shape");
    expect_users(world.materials(), materials_, "material");
    expect_users(world.textures(), textures_, "texture");
    for (const auto& [id, scene] : world.scenes()) look_at(scene);
    expect_numbers(world.objects());
    expect_numbers(world.geometries());
    expect_numbers(world.materials());
    expect_numbers(world.textures());
    expect_numbers(world.scenes());
  }

  const std::vector<std::string>& all() const { return all_; }

 private:
  void expect(bool holds, const char* complaint) {
    if (!holds) all_.emplace_back(complaint);
  }

  void expect_child(ObjectId child, ObjectId parent) {
    const PhysicalObject* object = world_.find(child);
    expect(object != nullptr, "a child is not there");
    if (object) expect(object->parent == parent, "a child has another parent");
    expect(seen_.insert(child).second, "an object is a child twice");
  }

  void look_at(ObjectId id, const PhysicalObject& object) {
    for (const ObjectId child : object.children) expect_child(child, id);
    expect(!object.parent || world_.find(object.parent), "a parent is not there");
    expect(!object.geometry || world_.find(object.geometry), "the shape of an object is not there");
    expect(!object.material || world_.find(object.material), "the material of an object is not there");
    if (object.geometry) ++shapes_[object.geometry.value];
    if (object.material) ++materials_[object.material.value];
    const double volume = object.parent_from_object.linear().determinant();
    expect(object.parent_from_object.matrix().allFinite() && volume != 0.0, "an object is flattened");
  }

  void look_at(const Material& material) {
    expect(!material.texture || world_.find(material.texture), "the texture of a material is not there");
    if (material.texture) ++textures_[material.texture.value];
  }

  void look_at(const Scene& scene) {
    std::set<ObjectId> roots;
    for (const ObjectId root : scene.roots) {
      expect(world_.find(root) != nullptr, "a scene shows what is not there");
      expect(roots.insert(root).second, "a scene shows an object twice");
    }
  }

  std::size_t reached() const {
    std::set<ObjectId> there(world_.roots().begin(), world_.roots().end());
    std::vector<ObjectId> row = world_.roots();
    for (std::size_t i = 0; i < row.size(); ++i) {
      const PhysicalObject* object = world_.find(row[i]);
      if (!object) continue;
      for (const ObjectId child : object->children) {
        if (there.insert(child).second) row.push_back(child);
      }
    }
    return there.size();
  }

  using Counts = std::unordered_map<std::uint64_t, std::uint32_t>;
  template <typename Named>
  void expect_users(const World::Table<Named>& table, const Counts& counts, const std::string& what) {
    for (const auto& [id, shared] : table) {
      const auto found = counts.find(id.value);
      if (shared.users != (found == counts.end() ? 0 : found->second))
        all_.push_back("the users of a " + what + " are counted wrong");
    }
  }

  template <typename Named>
  void expect_numbers(const World::Table<Named>& table) {
    for (const auto& [id, named] : table) {
      expect(bool(id), "something has no id");
      const auto author = std::uint32_t(id.value >> IdSource::kNumberBits);
      expect(world_.next_number(author) > (id.value & IdSource::kNumberMask), "a number may be given again");
    }
  }

  const World& world_;
  std::vector<std::string> all_;
  std::set<ObjectId> seen_;
  Counts shapes_, materials_, textures_;
};

inline std::string complaints(const World& world) {
  std::string text;
  const Complaints found(world);
  for (const std::string& complaint : found.all()) text += complaint + "\n";
  return text;
}

}  // namespace icome::world
