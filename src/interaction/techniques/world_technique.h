#pragma once
#include <memory>
#include <utility>
#include <vector>

#include "interaction/techniques/world_targets.h"

namespace icome::interaction {

/// A technique at work on a world, for a session at every update and for the replay of a recording. It
/// changes nothing by itself but gives the edit that would. The same inputs on the same world, each edit
/// performed before the next step, give the same edits to the last bit. Owns its targets.
class WorldTechnique {
 public:
  /// `world_from_room` is a similarity; the technique has to pass check().
  explicit WorldTechnique(const Technique& technique,
                          const base::Affine3& world_from_room = base::Affine3::Identity());

  struct Step {
    TechniqueOutcome outcome;
    /// Puts the held object at its place now. A press without movement only selects: there is no edit
    /// until the hand has moved.
    std::optional<world::Edit> edit = {};
    bool is_first = false;  // of the held object: begins another action
    std::string refused;    // the reason why the held object cannot go there; it was let go
  };
  Step step(const world::World& world, const TechniqueInput& input);

  /// Lets go of the held object, until the button is pressed anew.
  void let_go();
  /// To be told of changes of the world, by a step or otherwise; null: it is another one.
  void changed(const world::Changes* changes) { targets_.changed(changes); }
  /// Resets everything to before the first step, but for the room's place.
  void begin_anew();
  /// Puts the room there from now on. A held object would go along: to be called while resting().
  void place_room(const base::Affine3& world_from_room) { state_.world_from_room = world_from_room; }
  /// Is nothing held, and nobody on the way?
  bool resting() const;

  const Technique& technique() const { return technique_; }
  const TechniqueState& state() const { return state_; }
  bool holds() const { return state_.hold.has_value(); }
  /// Shapes that a step would have to make first, as WorldTargets says; a step waits for those not kept.
  std::vector<world::GeometryPointer> slow_shapes(const world::World& world) const {
    return targets_.slow_shapes(world);
  }
  void keep(const world::GeometryPointer& shape, std::shared_ptr<const TargetShape> made) {
    targets_.keep(shape, std::move(made));
  }
  /// The targets of the world as it is.
  const TechniqueScene& scene(const world::World& world) { return targets_.of(world); }

 private:
  struct Taken {
    TechniqueInput input;
    base::Affine3 world_from_room;
  };
  bool has_moved(const TechniqueInput& input);
  std::optional<world::Edit> edit_for(const world::World& world, const MovedTarget& moved, Step& result);

  Technique technique_;
  TechniqueState state_;
  WorldTargets targets_;
  TechniqueInput last_ = {};
  std::optional<Taken> taken_ = {};  // what is held, until the hand has moved
  bool performed_ = false;           // an edit of what is held
};

}  // namespace icome::interaction
