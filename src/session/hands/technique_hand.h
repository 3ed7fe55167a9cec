#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "interaction/techniques/technique_recording.h"
#include "session/revisions.h"

namespace icome::session {

class Session;
class TargetMaker;

/// The inputs of a technique from a session at one moment; stage frame.
struct TechniqueMoment {
  struct Hand {
    bool there = false;
    base::Pose stage_from_hand = base::Pose::Identity();  // it points along its -z
    std::uint32_t buttons = 0;                            // see TechniqueHand
  };
  double time = 0.0;                                         // s, rises
  base::Pose stage_from_eye = base::Pose::Identity();        // with the head
  base::Pose stage_from_workspace = base::Pose::Identity();  // of the first hand's device
  double distance = 0.6;                                     // m, from the eye to what is looked at
  std::array<Hand, 2> hands = {};
};

/// The techniques of thesis chapter 2 at work with the pointers of a session: button 0 of the first selects
/// and holds, that of the second holds with it; button 1 travels; 2 and 3 push an object on a ray away and
/// pull it nearer. The held object is moved as one action to undo, and let go when anything else changes
/// the world. One thread (main) uses it.
///
/// The room of the technique is where the pointers' workspace lies, as large as the view shows it: the point
/// looked at is 0.6 of its metres from the eye, as for UserInteraction. While a person holds something,
/// travels or records, the room is a place of its own that only the technique moves.
///
/// Solids, scans and other shapes that take long to be made into triangles are made on a thread of their own;
/// until they are there, the hands do nothing.
class TechniqueHand {
 public:
  /// The technique has to pass check(). `maker` outlives the technique, so that choosing another one does not
  /// wait for the shape that is being made.
  TechniqueHand(const interaction::Technique& technique, std::shared_ptr<TargetMaker> maker)
      : technique_(technique), maker_(std::move(maker)) {}

  /// To be called once for each update of the session. Gives the motion of the view and the
  /// workspaces when the person travels. `refused` gets the reason why something could not be moved.
  std::optional<base::Pose> update(Session& session, const TechniqueMoment& moment,
                                   const Revisions& revisions, std::string& refused);
  /// To be told of changes of the world; null: it is another one.
  void changed(const world::Changes* changes) { technique_.changed(changes); }

  /// Lets go of the held object; buttons have to be pressed anew.
  void let_go() {
    technique_.let_go();
    stale_ = {~0U, ~0U};
  }

  const interaction::Technique& technique() const { return technique_.technique(); }
  bool holds() const { return technique_.holds(); }
  /// Is nothing held, and nobody on the way?
  bool resting() const { return technique_.resting(); }
  /// Are targets that it may meet being made?
  bool is_getting_ready() const { return is_getting_ready_; }
  /// The outcome of the last step, in the stage's frame, and its input.
  const interaction::TechniqueOutcome& outcome() const { return outcome_; }
  const interaction::TechniqueInput& input() const { return input_; }
  /// The room's place by the technique, after the last step.
  const base::Affine3& stage_from_room() const { return technique_.state().world_from_room; }
  /// The map from the world to the miniature, wherever that is shown; nothing before the first step and where
  /// neither selecting, holding nor travelling needs one.
  std::optional<base::Affine3> copy_from_stage(const Session& session);

  /// Begins to record on this world; a recording under way is forgotten. A held object is let go.
  void record(const world::World& world);
  bool records() const { return recording_.has_value(); }
  /// Ends recording. A change of the world by others has ended it at that point: `is_whole` is false
  /// then, as it is after an hour.
  struct Recorded {
    world::World beginning;
    interaction::TechniqueRecording recording;
    bool is_whole = true;
  };
  std::optional<Recorded> stop_recording();

 private:
  struct Recording {
    world::World beginning = {};
    std::optional<interaction::TechniqueRecording> so_far = {};  // nothing before the first step
    bool is_over = false;
  };
  interaction::TechniqueInput input_of(const TechniqueMoment& moment);
  interaction::HandInput hand_of(const TechniqueMoment& moment, std::size_t which);
  void place_room(const TechniqueMoment& moment);
  bool get_ready(const world::World& world);
  void keep(const interaction::TechniqueInput& input);
  void perform(Session& session, const interaction::WorldTechnique::Step& step, std::string& refused);
  base::Pose carried(const base::Affine3& room_before) const;

  interaction::WorldTechnique technique_;
  std::shared_ptr<TargetMaker> maker_;
  bool is_getting_ready_ = false;
  interaction::TechniqueOutcome outcome_ = {};
  interaction::TechniqueInput input_ = {};
  std::array<std::uint32_t, 2> stale_ = {~0U, ~0U};  // buttons that have not come up since the hand is there
  std::optional<std::uint64_t> revision_ = {};       // of the world, as the last update left it
  std::optional<Recording> recording_ = {};
};

/// A technique with sizes for hands on a desk, whose devices reach `reach` (m) from the middle of their
/// workspace while the view looks from `distance` (m): what is shown of it fits the picture, and Go-Go's arm
/// begins to grow in the middle of the workspace and reaches five times as far as the device.
interaction::Technique desk_technique(interaction::Selecting selecting, interaction::Holding holding,
                                      interaction::Travelling travelling, double reach, double distance);

}  // namespace icome::session
