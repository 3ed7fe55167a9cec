#pragma once
#include <optional>

#include "interaction/mouse_hand.h"
#include "interaction/shaping/placed_part.h"
#include "interaction/shaping/shaping.h"
#include "session/display/part_outlines.h"

namespace icome::session {

struct SessionParts;

/// The stage of a session: the scene that is shown, whether motions play, and what a ray meets there. Main's.
class SessionStage {
 public:
  explicit SessionStage(SessionParts& parts) : parts_(parts) {}
  SessionStage(const SessionStage&) = delete;
  SessionStage& operator=(const SessionStage&) = delete;

  /// Shows and touches one scene of the world, or all of it.
  void show_scene(world::SceneId scene);
  world::SceneId shown_scene() const;
  /// Has any object a motion? Looks at all of them.
  bool has_motions() const;
  /// Shows and feels objects where their motions have them, from their beginning on and on; or, as at first
  /// and after another design was opened, where they are at rest. The world stays what it is, and an edit
  /// that puts a moving object elsewhere moves all of its way.
  void play(bool on);
  bool playing() const;
  /// The bounds of the selection (of everything, without one), stage frame.
  base::Bounds selection_bounds() const;
  /// Marks the handle that the mouse is over or holds; each hand marks its own.
  void mark_handle(const std::optional<interaction::MarkedHandle>& marked);
  /// Marks an operand or a projector of the selection, which the mouse is over, or which is dragged.
  void mark_part(const std::optional<MarkedPart>& marked);
  /// The marked part; with a motion, it is dragged, by the mouse or by a hand.
  const std::optional<MarkedPart>& marked_part() const;
  /// The first thing that a ray meets of those that can be touched, stage frame.
  struct Picked {
    world::ObjectId object;
    interaction::PickedPoint place;
  };
  std::optional<Picked> pick(const interaction::Ray& ray) const;
  /// The first thing that is seen on the ray: also a symbol of an effect that it passes by a few pixels.
  std::optional<Picked> pick_seen(const interaction::Ray& ray) const;
  /// The operand of a solid, or the projector of a picture, in the selection whose outline the ray passes by
  /// a few pixels, whatever is before it.
  std::optional<PartOutlines::Picked> pick_part(const interaction::Ray& ray) const;
  /// The part whose outline is nearest to a place of the stage, within `reach` (m).
  std::optional<interaction::PlacedPart> part_near(const base::Vector3& place, double reach) const;

 private:
  SessionParts& parts_;
};

}  // namespace icome::session
