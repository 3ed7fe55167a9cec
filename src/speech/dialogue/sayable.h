#pragma once
#include <string>
#include <vector>

#include "speech/dialogue/dialogue.h"

namespace icome::speech {

/// Sentences that can be said now, of one command.
struct Sayable {
  std::string command;
  std::string help;
  std::vector<std::string> forms;      // patterns
  std::vector<std::string> sentences;  // each would be done, or asked about, now
};

/// Sentences of each command that can be said now, a few of each form, the same ones each time. A command
/// that has none now is left out.
std::vector<Sayable> sayable_now(Dialogue& dialogue);

}  // namespace icome::speech
