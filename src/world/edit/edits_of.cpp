#include "world/edit/edits_of.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace icome::world {
namespace {

/// Visits a table in the order of its keys, as tables keep no order.
template <typename Key, typename Value, typename Take>
void each(const std::unordered_map<Key, Value>& table, Take&& take) {
  std::vector<Key> keys;
  keys.reserve(table.size());
  for (const auto& [key, value] : table) keys.push_back(key);
  std::sort(keys.begin(), keys.end());
  for (const Key& key : keys) take(key, table.at(key));
}

/// Copies that nobody has changed yet are made as copies again: one shape in memory and on disk.
void add_shapes(std::vector<Edit>& edits, const World& world) {
  std::unordered_map<const Geometry*, GeometryId> first;
  each(world.geometries(), [&](GeometryId id, const GeometryObject& geometry) {
    const auto [found, fresh] = first.try_emplace(geometry.shape.get(), id);
    if (fresh) {
      edits.emplace_back(CreateGeometry{id, geometry.shape});
    } else {
      edits.emplace_back(CopyGeometry{id, found->second});
    }
  });
}

void add_objects(std::vector<Edit>& edits, const World& world) {
  std::vector<ObjectId> parents{ObjectId{}};
  for (std::size_t i = 0; i < parents.size(); ++i) {
    const std::vector<ObjectId>& row = parents[i] ? world.find(parents[i])->children : world.roots();
    for (std::size_t place = 0; place < row.size(); ++place) {
      PhysicalObject object = *world.find(row[place]);
      if (!object.children.empty()) parents.push_back(row[place]);
      object.children.clear();
      edits.emplace_back(CreateObject{row[place], place, std::move(object)});
    }
  }
}

}  // namespace

std::vector<Edit> edits_of(const World& world) {
  std::vector<Edit> edits;
  each(world.last_numbers(), [&](std::uint32_t author, std::uint64_t last) {
    edits.emplace_back(ReserveIds{author, last});
  });
  each(world.textures(), [&](TextureId id, const Texture& texture) {
    edits.emplace_back(CreateTexture{id, texture});
  });
  each(world.materials(), [&](MaterialId id, const Material& material) {
    edits.emplace_back(CreateMaterial{id, material});
  });
  add_shapes(edits, world);
  add_objects(edits, world);
  each(world.scenes(), [&](SceneId id, const Scene& scene) {
    edits.emplace_back(CreateScene{id, scene.name});
    for (std::size_t place = 0; place < scene.roots.size(); ++place)
      edits.emplace_back(EnterScene{id, scene.roots[place], place});
  });
  return edits;
}

}  // namespace icome::world
