#pragma once
#include "files/vrml_frames.h"

namespace icome::files {

/// Takes from this process what parsing does not need: memory and time beyond the limits, opening any file
/// or socket, new rights. What is open stays so. The process ends with its parent, and where it runs out of
/// memory or stack it ends with the code that says so.
void confine(const VrmlLimits& limits);

}  // namespace icome::files
