#pragma once
#include "geometry/csg/csg_program.h"

namespace icome::geometry {

/// Is it certain that the solid has no volume: that its parts do not meet, or that what is taken away leaves
/// nothing but faces? The box around it is halved, breadth first, until each part is surely outside; faces
/// of several operands that coincide count as one. False where bounded work (some 50 ms) was inconclusive,
/// so that thin solids are never taken for empty; and for unlimited solids. Most solids are found not to be
/// empty in a few microseconds.
bool proved_empty(const CsgProgram& program);

}  // namespace icome::geometry
