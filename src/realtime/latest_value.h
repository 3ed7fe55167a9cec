#pragma once
#include <array>
#include <atomic>
#include <cstdint>

#include "realtime/cache_line.h"

namespace icome::realtime {

/// The newest value that one thread has published for one other thread: a triple buffer that owns
/// three values of T. One thread writes, one thread reads, and neither ever waits; values that the
/// reader did not fetch in time are replaced. For every value in order, use MessagePipe.
template <typename T>
class LatestValue {
 public:
  /// The reader sees `initial` until the first publish().
  explicit LatestValue(const T& initial = T{}) : slots_{Slot{initial}, Slot{initial}, Slot{initial}} {}

  LatestValue(const LatestValue&) = delete;
  LatestValue& operator=(const LatestValue&) = delete;

  /// Writer: the slot to fill before publish(). It holds some older value: overwrite all that the
  /// reader looks at. Real-time safe.
  T& write_slot() { return slots_[writing_].value; }

  /// Writer: makes the write slot the newest value. Real-time safe.
  void publish() {
    const std::uint8_t given = static_cast<std::uint8_t>(writing_ | kFresh);
    writing_ = shared_.exchange(given, std::memory_order_acq_rel) & kIndex;
  }

  /// Writer: publishes a copy. Real-time safe when copying a T is.
  void publish(const T& value) {
    write_slot() = value;
    publish();
  }

  /// Reader: moves on to the newest value; false when nothing was published since. Real-time safe.
  bool update() {
    if ((shared_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    reading_ = shared_.exchange(reading_, std::memory_order_acq_rel) & kIndex;
    return true;
  }

  /// Reader: the value of the last update(); it stays as it is until the next. Real-time safe.
  const T& read() const { return slots_[reading_].value; }

 private:
  static constexpr std::uint8_t kIndex = 3;  // the bits of shared_ that name a slot
  static constexpr std::uint8_t kFresh = 4;  // set by the writer, cleared by the reader

  struct alignas(kCacheLine) Slot {
    T value;
  };

  // Each slot belongs to the writer, to the reader or lies in the middle; exchanges swap the roles.
  std::array<Slot, 3> slots_;
  alignas(kCacheLine) std::uint8_t writing_ = 0;              // touched by the writer only
  alignas(kCacheLine) std::atomic<std::uint8_t> shared_ = 1;  // the middle slot, perhaps fresh
  alignas(kCacheLine) std::uint8_t reading_ = 2;              // touched by the reader only
};

}  // namespace icome::realtime
