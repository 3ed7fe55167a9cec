#pragma once
#include "files/vrml/read/vrml_frames.h"

namespace icome::files {

/// Removes from this process all rights that parsing does not need: memory and time beyond the limits,
/// opening any file or socket, other programs and processes (starting, ending or watching them), new rights,
/// and, where Linux supports it for this processor, every system call but those to read and write open files
/// and to take memory. Open files stay open. The process ends with its parent, and where it runs out of
/// memory or stack it ends with the matching code. For icome-vrml-worker; there is no way back.
void confine(const VrmlLimits& limits);

}  // namespace icome::files
