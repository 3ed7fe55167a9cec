#pragma once
#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <thread>

namespace icome::devices {

/// One event of spacenavd, in its own terms: counts, x right, y up, z away from the user.
struct SpnavEvent {
  enum class Kind : std::uint8_t { Motion, Button, Plugged, Unplugged };
  Kind kind = Kind::Motion;
  std::array<int, 6> axes = {};  // of Motion: pushed along x, y, z, turned about x, y, z
  int button = 0;                // of Button
  bool down = false;             // of Button
};

/// A connection to spacenavd by libspnav, which has one at a time in a program. Nothing here waits: libspnav
/// does its waiting in a thread of its own. One thread uses it.
class SpnavLink {
 public:
  /// Null while the program has another one.
  static std::unique_ptr<SpnavLink> claim();
  ~SpnavLink();

  /// Is there a spacenavd to connect to?
  static bool somebody_listens();

  enum class State : std::uint8_t { Closed, Opening, Open };
  /// The state of the connection; it closes by itself when spacenavd ends.
  State state();
  /// Begins to connect if Closed; stays Closed where the system has no thread to give.
  void open();
  /// The next event; nothing when none is left, the connection has ended, or many unknown events were
  /// skipped: later calls return those that follow.
  std::optional<SpnavEvent> next();

 private:
  SpnavLink() = default;
  void close();

  State state_ = State::Closed;
  std::thread opener_;
  std::atomic<bool> opened_ = false;  // the opener has done its work
  std::atomic<bool> succeeded_ = false;
};

}  // namespace icome::devices
