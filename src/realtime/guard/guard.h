#pragma once
#include <cstdint>
#include <thread>

namespace icome::realtime {

/// Counts what the calling thread does that a servo must not: allocate, free, take a lock. For tests:
/// linking icome_realtime_guard replaces malloc and its kin and the locks of pthread in the whole
/// program, shared libraries included, so operator new, std::string, std::mutex and Eigen are seen
/// too. Not seen: waits that bypass pthread (std::atomic::wait), system calls, other threads.
///
///   RealtimeGuard guard;
///   servo.tick();
///   guard.stop();
///   EXPECT_EQ(guard.allocations(), 0u);
class RealtimeGuard {
 public:
  /// False under address and thread sanitizers, which need these functions for themselves; all counts
  /// then stay 0, and a test that relies on them should be skipped.
  static bool available();

  /// Starts counting for the calling thread, which alone may use this object. Guards may overlap.
  RealtimeGuard();

  /// Ends counting; the counts stay as they are.
  void stop();

  /// Calls of malloc, calloc, realloc, aligned_alloc and so on since the start.
  std::uint64_t allocations() const { return counts().allocations; }
  /// Calls of free (not of a null pointer) and of realloc that gave memory back.
  std::uint64_t frees() const { return counts().frees; }
  /// Calls that took or tried to take a mutex, read/write lock, spin lock or semaphore, or waited on
  /// a condition, contended or not.
  std::uint64_t locks() const { return counts().locks; }

 private:
  struct Counts {
    std::uint64_t allocations = 0;
    std::uint64_t frees = 0;
    std::uint64_t locks = 0;
  };

  static Counts counts_of_thread();
  Counts counts() const;

  std::thread::id thread_;
  Counts before_;
  Counts stopped_;
  bool running_ = true;
};

}  // namespace icome::realtime
