#pragma once
#include <optional>
#include <vector>

#include "interaction/snapping/moving_objects.h"

namespace icome::interaction {

/// Where objects were taken that stop at surfaces.
struct StoppedWay {
  Vector3 from, at, wanted;  // m, world frame, off where they stand: where it began, ended, and was to end
  bool slide = true;         // they may leave the straight way
  double tolerance = 0.0;    // m
};

struct CloseFit {
  Vector3 offset;                 // m, world frame, off where they stand
  std::vector<Contact> contacts;  // what is in the way there
};

/// What stopped at triangles is put to where it stops at the shapes as they are, next to that: out of what it
/// goes into, or on to where it touches, by no more than some deviations (MovingObjects::deviation). If that
/// leads nowhere, back on the way, to where it began at the most. Found by looking for the least gap
/// downhill from each place where triangles nearly touch, to a quarter of the tolerance; what they overlap by
/// their triangles already is left as it is. Nothing where triangles tell as much, and where the effort of
/// the objects is spent.
std::optional<CloseFit> close_fit(const MovingObjects& objects, const StoppedWay& way);

}  // namespace icome::interaction
