#pragma once
#include <atomic>
#include <cstdint>
#include <mutex>

namespace icome::devices {

/// The turns of threads to call OpenHaptics' library, which has one current device and one queue of errors
/// for all of them. Nobody waits for a turn for ever, as a call of the library may hang. Any thread.
class HdTurns {
 public:
  /// A turn for as long as this lives; false: the turn did not come.
  using Turn = std::unique_lock<std::mutex>;
  /// Waits for a turn, `patience` (ns) at most. Takes no memory.
  Turn take(std::int64_t patience);

  /// Frames are left out from now on, until resume(). The holder of a turn calls both.
  void pause();
  void resume() { paused_.store(false, std::memory_order_release); }
  bool paused() const { return paused_.load(std::memory_order_acquire); }
  /// Pauses so far: after a new one, forces begin at none.
  std::uint64_t pauses() const { return pauses_.load(std::memory_order_acquire); }

 private:
  std::mutex guard_;
  std::atomic<bool> paused_ = false;
  std::atomic<std::uint64_t> pauses_ = 0;
};

}  // namespace icome::devices
