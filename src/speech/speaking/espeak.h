#pragma once
#include <mutex>

namespace icome::speech {

/// The library espeak-ng, speaking American English, for as long as this lives: it has one state for all, so
/// other threads wait.
class Espeak {
 public:
  Espeak();

  /// Are the library and its data there?
  bool is_there() const { return rate() > 0; }
  /// Samples a second of what it speaks; 0 where it is not there.
  int rate() const;

 private:
  std::unique_lock<std::mutex> lock_;
};

}  // namespace icome::speech
