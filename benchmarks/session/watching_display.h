#pragma once
#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

#include "session/display/display_feed.h"

namespace icome::benchmarks {

/// A display thread that draws the scene of a session off the screen, and looks at the middle of each
/// picture. It ends with the object.
class WatchingDisplay {
 public:
  enum class Pace { WhenDue, Always };

  WatchingDisplay(session::DisplayFeed& feed, int width, int height, Pace pace);
  ~WatchingDisplay();
  WatchingDisplay(const WatchingDisplay&) = delete;
  WatchingDisplay& operator=(const WatchingDisplay&) = delete;

  /// The last picture in which the middle looked different from the picture before.
  struct Change {
    std::int64_t begun = 0, done = 0;  // ns, steady clock: of drawing it
    std::uint64_t frame = 0;           // its number, from 1
    bool is_red = false;               // more red than green in the middle
  };
  bool is_red() const { return red_.load(std::memory_order_acquire); }
  /// The newest change; valid while the middle stays as it is.
  Change last_change() const;
  std::uint64_t frames() const { return frames_.load(std::memory_order_acquire); }
  /// Time at which the newest frame was done, ns on the steady clock.
  std::int64_t last_done() const { return last_done_.load(std::memory_order_acquire); }

 private:
  void run();

  session::DisplayFeed& feed_;
  const int width_, height_;
  const Pace pace_;
  std::atomic<bool> stop_ = false, red_ = false;
  std::atomic<std::uint64_t> frames_ = 0, changed_frame_ = 0;
  std::atomic<std::int64_t> changed_begun_ = 0, changed_done_ = 0, last_done_ = 0;
  std::thread thread_;
};

}  // namespace icome::benchmarks
