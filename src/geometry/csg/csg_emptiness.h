#pragma once
#include "geometry/csg/csg_program.h"

namespace icome::geometry {

/// Is it certain that the solid has no volume: that its parts do not meet, or that what is taken away leaves
/// nothing but faces? By halving the box around it, breadth first, until each part is surely outside; faces
/// of several operands that lie in one another are known as one. False where bounded work (some 50 ms) did
/// not tell, so what is thin is never taken for empty; and for unlimited solids. Most solids show in a few
/// microseconds that they are not.
bool proved_empty(const CsgProgram& program);

}  // namespace icome::geometry
