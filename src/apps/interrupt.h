#pragma once

namespace icome::apps {

/// From here on Ctrl-C (or a request to terminate, or a terminal that is closed) ends the run early instead
/// of killing the program; a second one kills it. A program that outlives its terminal (nohup) goes on. Call
/// once.
void catch_interrupts();

/// Was the run asked to end?
bool interrupted();

}  // namespace icome::apps
