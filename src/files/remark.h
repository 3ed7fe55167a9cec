#pragma once
#include <string>

namespace icome::files {

/// A remark for people on a file that was read or written: something was skipped, repaired or cannot be
/// kept.
struct Remark {
  std::string file;  // that it is about; empty: the one that was asked for
  int line = 0;      // of a text file, from 1; 0: it belongs to no line
  std::string text;  // a sentence
  /// For a written file: does it lack anything seen, felt or chosen in the design? Not if only unused
  /// leftovers are gone, or other programs may not understand it.
  bool loses = true;

  bool operator==(const Remark&) const = default;
};

/// "part.wrl:12: A Script is kept but not run."; `file` is used where the remark names none.
std::string sentence(const Remark& remark, const std::string& file);

}  // namespace icome::files
