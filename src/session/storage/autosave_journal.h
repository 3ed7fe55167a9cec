#pragma once
#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "realtime/latest_value.h"
#include "session/edited_queue.h"

namespace icome::session {

class AutosaveKeeper;

struct AutosaveSettings {
  std::filesystem::path folder = {};  // made where there is none
  /// The longest time until written work reaches the disk itself, and survives a loss of power.
  std::chrono::nanoseconds sync_period = std::chrono::seconds(1);
  /// The time between tries when work cannot be kept, and between checks that kept work is still there.
  std::chrono::nanoseconds retry_period = std::chrono::seconds(5);
};

/// Tells whether unsaved work would survive a crash.
struct AutosaveState {
  bool keeping = true;
  std::string text = {};  // a sentence or two for people, when it has changed
};

/// Keeps a session's unsaved work against crashes: takes every edit from the EditedQueue and has it in a
/// journal on disk before it takes the next. There is no file while nothing is unsaved: the first edit after
/// opening or saving makes one, of the world as it is then. A recovered world gets one at once; only then
/// the journal that it was recovered from goes. Owns journal and thread; main uses this.
class AutosaveJournal {
 public:
  /// The reader's queue outlives this.
  AutosaveJournal(EditedQueue::Reader& reader, AutosaveSettings settings);
  /// Takes what is left in the queue, which has been closed. Unsaved work stays on disk to be recovered,
  /// unless close() was called.
  ~AutosaveJournal();
  AutosaveJournal(const AutosaveJournal&) = delete;
  AutosaveJournal& operator=(const AutosaveJournal&) = delete;

  /// Drops unsaved work: nothing is kept of it in the end. To be called before the queue is closed.
  void close() { unwanted_.store(true, std::memory_order_relaxed); }

  /// The state, when work has begun or ceased to be kept since the last call.
  std::optional<AutosaveState> news();

  /// The number of the last post that is in the journal, or need not or cannot be. Any thread.
  std::uint64_t followed() const { return followed_.load(std::memory_order_acquire); }

 private:
  void run(const AutosaveSettings& settings);
  void take_all(AutosaveKeeper& keeper);
  void tell(const AutosaveKeeper& keeper);

  EditedQueue::Reader& reader_;
  std::atomic<bool> unwanted_ = false;
  std::atomic<std::uint64_t> followed_ = 0;
  bool kept_ = true;  // as the thread told last
  realtime::LatestValue<AutosaveState> state_;
  bool kept_seen_ = true;  // as main told last
  std::thread thread_;
};

}  // namespace icome::session
