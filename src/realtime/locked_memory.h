#pragma once

namespace icome::realtime {

/// Asks the system never to page out the program's memory. Pages that a tick may be the first to use are
/// brought in at once: the program itself, the libraries of the language, the heap, and the
/// calling thread's stack. Other libraries, of windows and pictures, are locked page by page as they are
/// used: bringing them in would take some 80 MB. Call it on the thread that ticks. False where the system
/// does not permit it.
bool lock_memory();

}  // namespace icome::realtime
