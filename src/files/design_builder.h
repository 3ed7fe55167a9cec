#pragma once
#include <cstdint>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "files/design.h"
#include "io/memory_budget.h"
#include "world/edit/edit.h"

namespace icome::files {

/// Puts a world together as a file is read. What the world refuses is remembered and told at the end, so
/// that readers ask once.
class DesignBuilder {
 public:
  /// All that is added counts as memory that is taken, a motion that many objects have once. Refers to the
  /// budget.
  explicit DesignBuilder(io::MemoryBudget& memory) : memory_(memory) {}

  /// Each is a shape of its own in the world; primitives that are equal lie in memory once.
  world::GeometryId add(world::GeometryPointer shape);
  world::MaterialId add(world::Material material);
  world::TextureId add(world::Texture texture);
  /// Behind the last child of its parent, or behind the last root.
  world::ObjectId add(world::PhysicalObject object);
  world::SceneId add_scene(const std::string& name, const std::vector<world::ObjectId>& roots);

  /// Has the world refused something, or is there no memory for it? Then all that follows is in vain.
  bool has_failed() const { return !refusal_.empty(); }
  const world::World& world() const { return design_.world; }
  void remark(std::string text, int line = 0) { design_.remarks.push_back({{}, line, std::move(text)}); }

  /// The design, unless the world refused a part of it; `name` is for that error. Leaves the builder empty.
  base::Result<LoadedDesign> take(std::string format, const std::string& name);

 private:
  /// Of its memory, `known_bytes` have been counted before.
  void put(const world::Edit& edit, std::size_t known_bytes = 0);
  world::GeometryPointer known(world::GeometryPointer shape);

  io::MemoryBudget& memory_;
  LoadedDesign design_;
  world::IdSource ids_;
  std::unordered_map<std::uint64_t, world::GeometryPointer> primitives_;  // by hash
  std::unordered_set<world::MotionPointer> motions_;
  std::string refusal_;
};

}  // namespace icome::files
