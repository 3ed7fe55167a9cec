#include "world/edits_of.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace icome::world {
namespace {

constexpr std::size_t kMostEditsOfGroup = 256;
constexpr std::size_t kMostBytesOfGroup = 1U << 20U;  // unless a single edit has more

/// Collects edits in groups.
class Grouper {
 public:
  /// `bytes`: about what the edit takes beside its kind's few fields.
  void add(Edit edit, std::size_t bytes = 0) {
    if (group_.edits.size() == kMostEditsOfGroup || bytes_ + bytes > kMostBytesOfGroup) close();
    group_.edits.push_back(std::move(edit));
    bytes_ += bytes;
  }
  std::vector<Edit> take() {
    close();
    return std::move(edits_);
  }

 private:
  void close() {
    if (!group_.edits.empty()) edits_.emplace_back(std::exchange(group_, {}));
    bytes_ = 0;
  }

  EditGroup group_;
  std::size_t bytes_ = 0;
  std::vector<Edit> edits_;
};

/// Tables keep no order: here it is that of the keys.
template <typename Key, typename Value, typename Take>
void each(const std::unordered_map<Key, Value>& table, Take&& take) {
  std::vector<Key> keys;
  keys.reserve(table.size());
  for (const auto& [key, value] : table) keys.push_back(key);
  std::sort(keys.begin(), keys.end());
  for (const Key& key : keys) take(key, table.at(key));
}

/// Copies that nobody has changed yet are made as copies again: one shape in memory and on disk.
void add_shapes(Grouper& edits, const World& world) {
  std::unordered_map<const Geometry*, GeometryId> first;
  each(world.geometries(), [&](GeometryId id, const GeometryObject& geometry) {
    const auto [found, fresh] = first.try_emplace(geometry.shape.get(), id);
    if (fresh) {
      edits.add(CreateGeometry{id, geometry.shape}, geometry.shape->bytes());
    } else {
      edits.add(CopyGeometry{id, found->second});
    }
  });
}

void add_objects(Grouper& edits, const World& world) {
  std::vector<ObjectId> parents{ObjectId{}};
  for (std::size_t i = 0; i < parents.size(); ++i) {
    const std::vector<ObjectId>& row = parents[i] ? world.find(parents[i])->children : world.roots();
    for (std::size_t place = 0; place < row.size(); ++place) {
      PhysicalObject object = *world.find(row[place]);
      if (!object.children.empty()) parents.push_back(row[place]);
      object.children.clear();
      const auto* inert = std::get_if<Inert>(object.fixture.get());
      const std::size_t bytes = object.name.size() + (inert ? inert->source.size() : 0);
      edits.add(CreateObject{row[place], place, std::move(object)}, bytes);
    }
  }
}

}  // namespace

std::vector<Edit> edits_of(const World& world) {
  Grouper edits;
  each(world.last_numbers(), [&](std::uint32_t author, std::uint64_t last) {
    edits.add(SpendNumbers{author, last});
  });
  each(world.textures(), [&](TextureId id, const Texture& texture) {
    edits.add(CreateTexture{id, texture}, texture.bytes->size());
  });
  each(world.materials(), [&](MaterialId id, const Material& material) {
    edits.add(CreateMaterial{id, material}, material.name.size());
  });
  add_shapes(edits, world);
  add_objects(edits, world);
  each(world.scenes(), [&](SceneId id, const Scene& scene) {
    edits.add(CreateScene{id, scene.name}, scene.name.size());
    for (std::size_t place = 0; place < scene.roots.size(); ++place)
      edits.add(EnterScene{id, scene.roots[place], place});
  });
  return edits.take();
}

}  // namespace icome::world
