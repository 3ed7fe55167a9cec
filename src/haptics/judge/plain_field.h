#pragma once
#include "geometry/implicit/plain_formula.h"
#include "haptics/judge/contact_judge.h"

namespace icome::haptics {

/// The solid in which a formula is negative in a box, for the judge. It knows nothing but values: the nearest
/// place is searched for in parts of the box, which are left out where the value and the slope in the middle
/// show that nothing as near is solid, if slopes fall by no more than 1.6 times as much as samples in the
/// part show. Parts are kept for the next question; of a formula that `changes` with time, for the questions
/// about the same moment. Functions share this, and the formula's state: one thread at a time.
MembershipSolid plain_solid(const geometry::PlainFormula& value, const base::Bounds& box,
                            bool changes = true);

}  // namespace icome::haptics
