#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <thread>

#include "realtime/cache_line.h"

namespace icome::realtime {

/// Waits a little: at first by telling the processor that this is a spin loop, later by giving the
/// core away, since the thread that is waited for may need it.
class SpinWait {
 public:
  void pause() {
    if (turns_ >= kTurnsBeforeYield) {
      std::this_thread::yield();
      return;
    }
    ++turns_;
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    asm volatile("yield" ::: "memory");
#endif
  }

 private:
  static constexpr int kTurnsBeforeYield = 64;
  int turns_ = 0;
};

/// Lamport's Bakery lock (thesis section 5.6.1, after Silberschatz and Galvin 1998) for a fixed number
/// of threads, kept beside the others for comparison. It needs no atomic read-modify-write; threads are
/// served in the order in which they come. Each passes its own number, 0 to kThreads - 1.
template <std::size_t kThreads>
class BakeryLock {
 public:
  /// Waits for every thread that drew a ticket before; the calling thread does not hold the lock.
  void lock(std::size_t thread) {
    assert(thread < kThreads);
    Customer& self = customers_[thread];
    // Two of the stores below must reach the others before this thread looks at their values, which
    // only sequentially consistent order promises; the rest is acquire and release.
    self.choosing.store(true, std::memory_order_seq_cst);
    const std::uint64_t ticket = highest_ticket() + 1;
    self.ticket.store(ticket, std::memory_order_seq_cst);
    self.choosing.store(false, std::memory_order_release);
    for (std::size_t other = 0; other < kThreads; ++other) {
      if (other != thread) wait_for(other, ticket, thread);
    }
  }

  /// Hands the lock on; called by the thread that holds it.
  void unlock(std::size_t thread) {
    assert(thread < kThreads);
    customers_[thread].ticket.store(0, std::memory_order_release);
  }

 private:
  struct alignas(kCacheLine) Customer {
    std::atomic<bool> choosing = false;
    std::atomic<std::uint64_t> ticket = 0;  // 0: not waiting; 64 bits do not run out
  };

  std::uint64_t highest_ticket() const {
    std::uint64_t highest = 0;
    for (const Customer& customer : customers_) {
      highest = std::max(highest, customer.ticket.load(std::memory_order_seq_cst));
    }
    return highest;
  }

  // Equal tickets are served by thread number.
  void wait_for(std::size_t other, std::uint64_t ticket, std::size_t thread) const {
    const Customer& customer = customers_[other];
    SpinWait spin;
    while (customer.choosing.load(std::memory_order_seq_cst)) spin.pause();
    for (;;) {
      const std::uint64_t theirs = customer.ticket.load(std::memory_order_seq_cst);
      if (theirs == 0 || theirs > ticket || (theirs == ticket && other > thread)) return;
      spin.pause();
    }
  }

  std::array<Customer, kThreads> customers_;
};

/// A spin lock (test and test-and-set) for sections of a few instructions. Usable with
/// std::scoped_lock. The servo takes no lock, not even this one.
class SpinLock {
 public:
  void lock() {
    SpinWait spin;
    while (!try_lock()) spin.pause();
  }

  bool try_lock() {
    // Looking first keeps waiting threads from taking the cache line away from the holder.
    return !locked_.load(std::memory_order_relaxed) && !locked_.exchange(true, std::memory_order_acquire);
  }

  void unlock() { locked_.store(false, std::memory_order_release); }

 private:
  std::atomic<bool> locked_ = false;
};

}  // namespace icome::realtime
