#pragma once
#include <optional>
#include <vector>

#include "interaction/snapping/moving_objects.h"

namespace icome::interaction {

/// The way of objects that stop at surfaces.
struct StoppedWay {
  Vector3 from, at, wanted;  // m, world frame, off where they stand: where it began, ended, and was to end
  bool slide = true;         // they may leave the straight way
  double tolerance = 0.0;    // m
};

struct CloseFit {
  Vector3 offset;                 // m, world frame, off where they stand
  std::vector<Contact> contacts;  // what is in the way there
};

/// Corrects a stop at triangles to the stop next to it at the exact shapes: out of what the objects go
/// into, or on to where they touch, by no more than some deviations (MovingObjects::deviation). If that
/// leads nowhere, back on the way, to its beginning at the most. The least gap is sought downhill from each
/// place where triangles nearly touch, to a quarter of the tolerance; overlaps that the triangles have
/// already are left as they are. Nothing where triangles tell as much, and where the effort of the objects
/// is spent.
std::optional<CloseFit> close_fit(const MovingObjects& objects, const StoppedWay& way);

}  // namespace icome::interaction
