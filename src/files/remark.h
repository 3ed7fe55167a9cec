#pragma once
#include <string>

namespace icome::files {

/// Something that a person should know about a file that was read or written: what was skipped, put right
/// or cannot be kept.
struct Remark {
  std::string file;  // whose name helps to find it; empty: the one that was asked for
  int line = 0;      // of a text file, from 1; 0: it belongs to no line
  std::string text;  // a sentence
  /// Of a file that was written: does it lack what is seen, felt or chosen in the design? Not where only
  /// leftovers that nothing uses are gone, or other programs may not understand it.
  bool loses = true;

  bool operator==(const Remark&) const = default;
};

/// "part.wrl:12: A Script is kept but not run."; `file` stands in where the remark names none.
std::string sentence(const Remark& remark, const std::string& file);

}  // namespace icome::files
