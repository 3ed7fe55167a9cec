#include "apps/interrupt.h"

#include <signal.h>

namespace icome::apps {
namespace {

volatile sig_atomic_t asked_to_end = 0;

extern "C" void note_interrupt(int /*signal*/) { asked_to_end = 1; }

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = note_interrupt;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction hangup {};
  const bool outlives = sigaction(SIGHUP, nullptr, &hangup) == 0 && hangup.sa_handler == SIG_IGN;
  if (!outlives) sigaction(SIGHUP, &action, nullptr);
}

bool interrupted() { return asked_to_end != 0; }

}  // namespace icome::apps
