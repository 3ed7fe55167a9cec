#pragma once
#include <optional>
#include <vector>

#include "interaction/mouse_hand.h"
#include "render/scene/scene_renderer.h"
#include "world/edit/changes.h"
#include "world/world.h"

namespace icome::session {

/// The visible symbols of effects: lines in space where they act, a symbol for each kind. Springs show where
/// they hold, wells and recesses how far they reach, forces where they push; effects that act everywhere are
/// a small thing where their object stands. Effects that are off are faint. Main's.
class EffectSymbols {
 public:
  /// Follows an edit; null: another world.
  void follow(const world::World& world, const world::Changes* changes);

  /// The symbols of the scene, or of the whole world where there is none, the first 256. World frame.
  render::SceneOverlay overlay(const world::World& world, world::SceneId shown) const;

  /// The bounds of the symbols, world frame.
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
