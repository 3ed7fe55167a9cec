#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/design/design_options.h"
#include "interaction/operations/operation_runner.h"

namespace icome::apps {

/// A line of a script that could not be done, and why.
struct EditError {
  std::size_t line;       // from 1
  std::string operation;  // its name; empty where there is none
  std::string message;    // a sentence
};

/// A note for people on a line that was done.
struct EditNote {
  std::size_t line;       // from 1
  std::string operation;  // its name
  std::string text;
};

/// The outcome of a script.
struct EditOutcome {
  std::size_t operations = 0;  // that were done
  std::vector<EditNote> notes = {};
  std::vector<EditError> errors = {};
  bool stopped = false;  // on request, before the end
};

/// The text of a script: a file, or standard input for "-".
base::Result<std::string> script_text(const std::filesystem::path& apply);
/// The text of the script of `icome edit`, or of the recording in its place.
base::Result<std::string> script_text(const EditOptions& options);

/// Performs one operation; `line` is its number, from 1.
using PerformLine =
    std::function<base::Result<interaction::Performed>(const interaction::Value& command, std::size_t line)>;

/// Performs the operations of a text, one JSON object a line; empty lines and those that begin with # are
/// skipped. Ends with the first that is wrong, or goes on to the end. `progress` gets the part done, in
/// [0, 1], before every line; false stops.
EditOutcome perform_script(const PerformLine& perform, std::string_view text, bool keep_going,
                           const std::function<bool(double part)>& progress);

}  // namespace icome::apps
