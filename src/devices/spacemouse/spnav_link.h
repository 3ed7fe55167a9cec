#pragma once
#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <thread>

namespace icome::devices {

/// One thing that spacenavd says, as it says it: counts, x right, y up, z away from the user.
struct SpnavEvent {
  enum class Kind : std::uint8_t { Motion, Button, Plugged, Unplugged };
  Kind kind = Kind::Motion;
  std::array<int, 6> axes = {};  // of Motion: pushed along x, y, z, turned about x, y, z
  int button = 0;                // of Button
  bool down = false;             // of Button
};

/// A connection to spacenavd by libspnav, which knows one at a time in a program. Nothing here waits: what
/// libspnav waits for goes on in a thread. One thread uses it.
class SpnavLink {
 public:
  /// Null while the program has another one.
  static std::unique_ptr<SpnavLink> claim();
  ~SpnavLink();

  /// Is there a spacenavd to connect to?
  static bool somebody_listens();

  enum class State : std::uint8_t { Closed, Opening, Open };
  /// Of a connection that is asked for; it ends by itself when spacenavd does.
  State state();
  /// Begins to connect, from Closed; stays so where the system has no thread to give.
  void open();
  /// What was said next; nothing when all is taken, the connection has ended, or much was said that is not
  /// known here: what follows comes with later calls.
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
