#pragma once
#include <optional>

#include "interaction/snapping/touches.h"

namespace icome::interaction {

/// The tolerance (m), or what rounding leaves of it.
double fit_tolerance(const Passing& passing, double tolerance);

/// Do the two overlap there? As a CollisionIndex says.
bool overlap_at(const Passing& passing, double share);

/// Where the moved shape, which does not overlap the other at `from`, begins to, up to `until`: it may stand
/// there, and from there on it goes in. Within `tolerance` (m, see fit_tolerance) before the true place,
/// never behind it. Nothing where it never does; what only slides along or touches goes on.
std::optional<double> first_contact(const Passing& passing, double from, double until, double tolerance);

/// Where the moved shape, which overlaps the other at share 0, is first free of it, up to `until`, going
/// forwards, or, with a passing turned around, backwards; gaps much narrower than the way to them may be
/// missed. Nothing where it is not.
std::optional<double> way_out(const Passing& passing, double until, double tolerance);

/// The first place at which the other keeps the moved shape from going on, up to `until` <= 1; nothing where
/// it may go. A shape that overlaps the other already may go where the way out along its line is not longer
/// than the way back; once out, it does not go in again. The step has a length.
std::optional<double> stop(const Passing& passing, double until, double tolerance);

}  // namespace icome::interaction
