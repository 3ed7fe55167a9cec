#pragma once
#include <optional>
#include <span>
#include <vector>

#include "interaction/shaping/placed_part.h"
#include "session/display/symbol_strokes.h"

namespace icome::session {

/// A marked part of an object, and the motion of a drag of it that is not an edit yet.
struct MarkedPart {
  interaction::PlacedPart part = {};
  std::optional<base::Affine3> motion = {};  // of the world, from where it is; none: it is not dragged
};

/// The outlines of parts of the selection with places of their own: operands of solids as ghosts of their
/// outlines (a hole has no surface to be seen), projectors of pictures as the frame that takes the picture
/// once. Main's.
class PartOutlines {
 public:
  /// Renews the outlines to those of these objects, as the world is; the first 128.
  void renew(const world::World& world, world::SceneId shown, std::span<const world::ObjectId> selection);

  /// The outlines as they are drawn, world frame.
  render::SceneOverlay overlay(const std::optional<MarkedPart>& marked) const;

  struct Picked {
    interaction::PlacedPart part;
    interaction::PickedPoint place;  // world frame, towards the ray's origin
  };
  /// The part whose lines the ray passes nearest, within `slack` (rad), whatever is before them.
  std::optional<Picked> pick(const interaction::Ray& ray, double slack) const;

  /// The part whose lines are nearest to a place, within `reach` (m).
  std::optional<interaction::PlacedPart> nearest(const base::Vector3& place, double reach) const;

  bool empty() const { return outlines_.empty(); }

 private:
  struct Outline {
    interaction::PlacedPart part;
    render::SceneOverlay strokes;  // world frame
  };
  std::vector<Outline> outlines_;
};

}  // namespace icome::session
