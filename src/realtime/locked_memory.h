#pragma once

namespace icome::realtime {

/// Asks that nothing of what the program has in memory is ever paged out. What a tick may use before it was
/// ever used is brought in at once: the program itself, the libraries of the language, the heap, and the
/// calling thread's stack. Other libraries, of windows and pictures, are locked page by page as they are
/// used: bringing them in would take some 80 MB. Call it on the thread that ticks. False where the system
/// does not permit it.
bool lock_memory();

}  // namespace icome::realtime
