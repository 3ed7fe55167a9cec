#include "interaction/snapping/passage.h"

#include <algorithm>
#include <limits>

namespace icome::interaction {
namespace {

using world::Meeting;

constexpr std::size_t kTouchesAtOnce = 32;
constexpr int kMostLooks = 1000;  // of so many touches: more than solids that can be told apart have

/// Length of a way, in shares of the step, after which the moved shape has surely left the other behind.
double share_beyond(const Passing& passing) {
  const base::Bounds moved = passing.moved->bounds().transformed(passing.world_from_moved);
  const base::Bounds other = passing.other->bounds().transformed(passing.world_from_other);
  return 1.01 * moved.merged(other).diagonal().norm() / passing.step.norm();
}

/// The last place between one where the shape may stand and one where it may not, within `apart`.
double last_free(const Passing& passing, double free, double taken, double apart) {
  while (taken - free > apart) {
    const double middle = 0.5 * (free + taken);
    if (middle <= free || middle >= taken) break;
    (overlap_at(passing, middle) ? taken : free) = middle;
  }
  return free;
}

double share_of(const Passing& passing, double tolerance) { return tolerance / passing.step.norm(); }

/// Does the way lead out of the half-space that one of the two is, or along it?
bool leads_out_of_half_space(const Passing& passing) {
  constexpr double kAlong = 1e-12;
  const double length = passing.step.norm();
  if (const auto space = passing.other->half_space(passing.world_from_other))
    return space->normal.dot(passing.step) >= -kAlong * length;
  const auto space = passing.moved->half_space(passing.world_from_moved);
  return space->normal.dot(passing.step) <= kAlong * length;
}

Passing turned_around(Passing passing) {
  passing.step = -passing.step;
  return passing;
}

}  // namespace

double fit_tolerance(const Passing& passing, double tolerance) {
  constexpr double kRoundings = 20.0;
  constexpr double kOfStep = 1e-14;  // what a share can tell
  return std::max({tolerance, kRoundings * rounding_of(passing, 0.0), kOfStep * passing.step.norm()});
}

bool overlap_at(const Passing& passing, double share) {
  const Affine3 world_from_moved = passing.world_from_moved_at(share);
  return world::meeting({*passing.moved, world_from_moved}, {*passing.other, passing.world_from_other},
                        passing.effort) == Meeting::Overlapping;
}

std::optional<double> first_contact(const Passing& passing, double from, double until, double tolerance) {
  const double apart = share_of(passing, tolerance);
  double free = from;   // where it is known to be so
  double begin = from;  // of the piece of the way that is looked at: between touches nothing changes
  const auto found = [&] {
    if (!overlap_at(passing, begin)) return begin;
    return std::max(from, last_free(passing, free, begin, 0.5 * apart) - 0.25 * apart);
  };
  for (int look = 0; look < kMostLooks; ++look) {
    const std::vector<Touch> touches = first_touches(passing, begin, until, apart, kTouchesAtOnce);
    for (const Touch& touch : touches) {
      const double middle = 0.5 * (begin + touch.share);
      if (overlap_at(passing, middle)) return found();
      free = middle;
      begin = touch.share;
    }
    if (touches.size() == kTouchesAtOnce) continue;
    const double middle = 0.5 * (begin + until);
    if (overlap_at(passing, middle)) return found();
    // It goes in so slowly that half way it is within rounding.
    if (overlap_at(passing, until))
      return std::max(from, last_free(passing, middle, until, 0.5 * apart) - 0.25 * apart);
    return std::nullopt;
  }
  return free;
}

/// Tries places that lie farther apart the farther on they are: that is exact enough to compare the
/// ways ahead and back.
std::optional<double> way_out(const Passing& passing, double until, double tolerance) {
  constexpr double kGrowth = 1.25;
  const double apart = share_of(passing, tolerance);
  double taken = 0.0;
  for (double free = apart;; free *= kGrowth) {
    free = std::min(free, until);
    if (overlap_at(passing, free)) {
      if (free >= until) return std::nullopt;
      taken = free;
      continue;
    }
    while (free - taken > 0.5 * apart) {
      const double middle = 0.5 * (free + taken);
      if (middle <= taken || middle >= free) break;
      (overlap_at(passing, middle) ? taken : free) = middle;
    }
    return free;
  }
}

std::optional<double> stop(const Passing& passing, double until, double tolerance) {
  if (!overlap_at(passing, 0.0)) return first_contact(passing, 0.0, until, tolerance);
  if (passing.moved->unlimited() || passing.other->unlimited())
    return leads_out_of_half_space(passing) ? std::nullopt : std::optional(0.0);
  const double beyond = share_beyond(passing);
  const auto ahead = way_out(passing, beyond, tolerance);
  const auto back = way_out(turned_around(passing), beyond, tolerance);
  if (!ahead || (back && *back < *ahead)) return 0.0;
  if (*ahead >= until) return std::nullopt;
  return first_contact(passing, *ahead, until, tolerance);
}

}  // namespace icome::interaction
