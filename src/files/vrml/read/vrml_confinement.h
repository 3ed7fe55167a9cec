#pragma once
#include "files/vrml/read/vrml_frames.h"

namespace icome::files {

/// Takes from this process what parsing does not need: memory and time beyond the limits, opening any file
/// or socket, other programs and processes (starting, ending or watching them), new rights, and, where Linux
/// knows how for this processor, every call of the system but those to read and write what is open and to
/// take memory. What is open stays so. The process ends with its parent, and where it runs out of memory or
/// stack it ends with the code that says so. For icome-vrml-worker; there is no way back.
void confine(const VrmlLimits& limits);

}  // namespace icome::files
