#pragma once
#include <cstdint>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "files/design.h"
#include "io/memory_budget.h"
#include "world/edit/edit.h"

namespace icome::files {

/// Assembles a world while a file is read. The first refusal of the world is remembered and reported at
/// the end, so that readers check once.
class DesignBuilder {
 public:
  /// Everything added counts as memory taken, a motion that many objects share once. Refers to the
  /// budget.
  explicit DesignBuilder(io::MemoryBudget& memory) : memory_(memory) {}

  /// Each is a shape of its own in the world; equal primitives are stored once.
  world::GeometryId add(world::GeometryPointer shape);
  world::MaterialId add(world::Material material);
  world::TextureId add(world::Texture texture);
  /// Adds it behind the last child of its parent, or behind the last root.
  world::ObjectId add(world::PhysicalObject object);
  world::SceneId add_scene(const std::string& name, const std::vector<world::ObjectId>& roots);

  /// Has the world refused something, or is there no memory for it? Then all that follows is in vain.
  bool has_failed() const { return !refusal_.empty(); }
  const world::World& world() const { return design_.world; }
  void remark(std::string text, int line = 0) { design_.remarks.push_back({{}, line, std::move(text)}); }

  /// The design, unless the world refused a part of it; `name` is for that error. Leaves the builder empty.
  base::Result<LoadedDesign> take(std::string format, const std::string& name);

 private:
  /// Applies the edit; `known_bytes` of its memory have been counted before.
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
