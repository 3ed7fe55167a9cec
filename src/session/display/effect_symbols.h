#pragma once
#include <optional>
#include <vector>

#include "interaction/mouse_hand.h"
#include "render/scene/scene_renderer.h"
#include "world/edit/changes.h"
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

  struct Picked {
    world::ObjectId object;
    interaction::PickedPoint place;  // world frame, towards the ray's origin
  };
  /// The symbol, of those that overlay() gives, whose lines the ray passes nearest, within `slack` (rad);
  /// nothing where there is none.
  std::optional<Picked> pick(const world::World& world, world::SceneId shown, const interaction::Ray& ray,
                             double slack) const;

  bool empty() const { return effects_.empty(); }

 private:
  void note(const world::World& world, world::ObjectId id);
  std::vector<world::ObjectId> seen(const world::World& world, world::SceneId shown) const;

  std::vector<world::ObjectId> effects_;  // sorted
};

}  // namespace icome::session
