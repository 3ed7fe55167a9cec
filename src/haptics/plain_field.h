#pragma once
#include "geometry/plain_formula.h"
#include "haptics/contact_judge.h"

namespace icome::haptics {

/// The solid where a formula is negative in a box, for the judge. It knows nothing but values: what is
/// nearest to a place is looked for in cubes, which are left out where the middle's value is higher than the
/// formula can fall to the corners, at 1.4 times the steepest slope that samples around the place show.
/// Functions share the formula's state: one thread at a time.
MembershipSolid plain_solid(const geometry::PlainFormula& value, const base::Bounds& box);

}  // namespace icome::haptics
