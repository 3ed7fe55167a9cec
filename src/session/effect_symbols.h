#pragma once
#include <vector>

#include "render/scene_renderer.h"
#include "world/changes.h"
#include "world/world.h"

namespace icome::session {

/// What effects are seen as: lines in space where they act, a symbol for each kind. Springs show where they
/// hold, wells and recesses how far they reach, forces where they push; what acts everywhere is a small thing
/// where its object stands. One that is off is faint. Main's.
class EffectSymbols {
 public:
  /// Follows an edit; null: another world.
  void follow(const world::World& world, const world::Changes* changes);

  /// Those of the scene, or of the whole world where there is none, the first 256. World frame.
  render::SceneOverlay overlay(const world::World& world, world::SceneId shown) const;

  /// Around them, world frame.
  base::Bounds bounds(const world::World& world, world::SceneId shown) const;

  bool empty() const { return effects_.empty(); }

 private:
  void note(const world::World& world, world::ObjectId id);

  std::vector<world::ObjectId> effects_;  // sorted
};

}  // namespace icome::session
