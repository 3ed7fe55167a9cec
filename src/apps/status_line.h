#pragma once
#include <string>

#include "apps/stopwatch.h"

namespace icome::apps {

/// A line on standard error that shows progress to a person who waits; silent where standard
/// error is no terminal, so that logs stay clean.
class StatusLine {
 public:
  StatusLine();
  ~StatusLine() { clear(); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// Replaces the line.
  void say(const std::string& text);
  /// Replaces the line by how much is done, at most ten times a second.
  void progress(const std::string& what, double done, double all, const char* unit);
  /// Removes the line.
  void clear();

 private:
  bool terminal_;
  bool shown_ = false;
  Stopwatch since_;
  double last_ = -1.0;  // s, of the last progress
};

}  // namespace icome::apps
