#pragma once
#include <span>
#include <vector>

#include "interaction/techniques/holding.h"
#include "interaction/techniques/travelling.h"

namespace icome::interaction {

/// An interaction technique: any way of selecting with any way of holding and any way of travelling.
struct Technique {
  Selecting selecting = Selecting::RayPointer;
  Holding holding = Holding::Hand;
  Travelling travelling = Travelling::None;
  SelectingSettings selecting_settings = {};
  HoldingSettings holding_settings = {};
  TravelSettings travel_settings = {};
};

/// Checks that all sizes are possible. The error names the one that is not.
base::Result<void> check(const Technique& technique);

/// All that a technique remembers from one step to the next. A plain value.
struct TechniqueState {
  base::Affine3 world_from_room = base::Affine3::Identity();  // a similarity
  std::optional<double> time = {};                            // s, of the last step
  bool grabbing = false;                                      // button of the first hand at the last step
  TargetId selected = 0;
  std::optional<Hold> hold = {};
  double room_growth = 1.0;  // since the world shrank for what is held
  base::Bounds shown = {};   // m, around the world when what is held was taken
  Travel travel{};
};

/// The sizes for the next step. While something is held, the miniature shows what it showed when that was
/// taken: else it would shrink with each step that leads outwards, and the held object would grow.
SelectingSettings sizes_now(const Technique& technique, const TechniqueState& state);

/// The state before the first step.
TechniqueState begun(const Technique& technique);

/// An object that a step has moved.
struct MovedTarget {
  TargetId id = 0;
  base::Affine3 world_from_target = base::Affine3::Identity();
};

/// The outcome of a step.
struct TechniqueOutcome {
  bool ignored = false;    // the input made no sense, or time went back: nothing has changed
  PointedAt pointed = {};  // the highlighted target; the held one, while something is held
  TargetId selected = 0;   // 0: nothing
  bool picked = false;     // the button went down at this step
  std::optional<MovedTarget> moved = {};
  base::Affine3 world_from_room = base::Affine3::Identity();
  std::optional<Pose> destination = {};  // of the eyes, to which one would travel
};

struct TechniqueStep {
  TechniqueState state;
  TechniqueOutcome outcome;
};

/// One step: a pure function. The caller puts the moved object at its place, in the scene and (as an edit)
/// in the world.
TechniqueStep step(const Technique& technique, const TechniqueState& state, const TechniqueInput& input,
                   const TechniqueScene& scene);

/// Lets go of the held object, as if the buttons had come up: to hold something again, they have to be
/// pressed anew. `input` is that of the last step.
TechniqueState let_go(TechniqueState state, const TechniqueInput& input);

/// The outcomes of all steps of a recorded session; moved objects are moved in the scene. The same stream
/// and scene give the same outcomes to the last bit.
std::vector<TechniqueOutcome> replay(const Technique& technique, std::span<const TechniqueInput> stream,
                                     TechniqueScene& scene);

/// A hash that is equal for outcomes equal to the last bit, and almost surely different for others.
std::uint64_t hash(std::span<const TechniqueOutcome> outcomes);

}  // namespace icome::interaction
