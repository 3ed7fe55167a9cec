#pragma once
#include <optional>

#include "interaction/snapping/touches.h"

namespace icome::interaction {

/// The tolerance (m), raised to what rounding permits.
double fit_tolerance(const Passing& passing, double tolerance);

/// Do the two overlap at that share of the way? Judged as by a CollisionIndex.
bool overlap_at(const Passing& passing, double share);

/// The share at which the moved shape, which does not overlap the other at `from`, begins to, up to `until`:
/// it may stand there, and goes in from there on. Within `tolerance` (m, see fit_tolerance) before the true
/// place, never behind it. Nothing where it never does; to slide along or to touch is not to overlap.
std::optional<double> first_contact(const Passing& passing, double from, double until, double tolerance);

/// The share at which the moved shape, which overlaps the other at share 0, is first free of it, up to
/// `until`; with a passing turned around, backwards. Gaps much narrower than the way to them may be
/// missed. Nothing where it is never free.
std::optional<double> way_out(const Passing& passing, double until, double tolerance);

/// The first share at which the other keeps the moved shape from going on, up to `until` <= 1; nothing where
/// it may go. A shape that overlaps the other already may go where the way out along its line is not longer
/// than the way back; once out, it does not go in again. The step has a length.
std::optional<double> stop(const Passing& passing, double until, double tolerance);

}  // namespace icome::interaction
