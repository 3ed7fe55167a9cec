// Lock/unlock pairs per second of the Bakery lock (thesis section 5.6.1), std::mutex and a spin lock
// at 1, 2 and 4 threads that do nothing else: one table, ratios to std::mutex of the same run.
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "realtime/locks.h"

namespace {

using icome::realtime::BakeryLock;
using icome::realtime::SpinLock;

constexpr std::size_t kMostThreads = 4;
constexpr int kRounds = 7;
constexpr auto kRoundTime = std::chrono::milliseconds(200);

// A common interface to the three locks; only the Bakery lock uses the number of the thread.
struct Bakery {
  static constexpr const char* kName = "Bakery";
  BakeryLock<kMostThreads> lock;
  void enter(std::size_t thread) { lock.lock(thread); }
  void leave(std::size_t thread) { lock.unlock(thread); }
};
struct Mutex {
  static constexpr const char* kName = "std::mutex";
  std::mutex lock;
  void enter(std::size_t) { lock.lock(); }
  void leave(std::size_t) { lock.unlock(); }
};
struct Spin {
  static constexpr const char* kName = "spin";
  SpinLock lock;
  void enter(std::size_t) { lock.lock(); }
  void leave(std::size_t) { lock.unlock(); }
};

// Pairs per second of all threads together in one round. Ends the program when two threads were ever
// in the locked section at once: such a lock's speed would mean nothing.
template <typename Lock>
double measure(std::size_t thread_count) {
  Lock lock;
  std::uint64_t protected_count = 0;
  std::atomic<std::uint64_t> pairs = 0;
  std::atomic<std::size_t> arrived = 0;
  std::atomic<bool> stop = false;
  std::vector<std::thread> threads;
  for (std::size_t thread = 0; thread < thread_count; ++thread) {
    threads.emplace_back([&, thread] {
      ++arrived;
      while (arrived < thread_count) std::this_thread::yield();
      std::uint64_t mine = 0;
      for (; !stop.load(std::memory_order_relaxed); ++mine) {
        lock.enter(thread);
        ++protected_count;
        lock.leave(thread);
      }
      pairs += mine;
    });
  }
  while (arrived < thread_count) std::this_thread::yield();
  const std::int64_t begin = icome::base::steady_nanoseconds();
  std::this_thread::sleep_for(kRoundTime);
  stop = true;
  for (std::thread& thread : threads) thread.join();
  const double seconds = static_cast<double>(icome::base::steady_nanoseconds() - begin) * 1e-9;
  if (protected_count != pairs) {
    std::fprintf(stderr, "%s let two threads in at once\n", Lock::kName);
    std::exit(EXIT_FAILURE);
  }
  return static_cast<double>(pairs) / seconds;
}

double median(std::array<double, kRounds> rates) {
  std::sort(rates.begin(), rates.end());
  return rates[kRounds / 2];
}

void print_row(const char* name, std::size_t threads, double rate, double mutex_rate) {
  std::printf("%-12s %7zu %16.2f %21.2f\n", name, threads, rate * 1e-6, rate / mutex_rate);
}

void compare(std::size_t threads) {
  std::array<double, kRounds> bakery{};
  std::array<double, kRounds> mutex{};
  std::array<double, kRounds> spin{};
  // In turns, so that a busy moment of the machine hits all of them.
  for (std::size_t round = 0; round < kRounds; ++round) {
    bakery[round] = measure<Bakery>(threads);
    mutex[round] = measure<Mutex>(threads);
    spin[round] = measure<Spin>(threads);
  }
  print_row(Mutex::kName, threads, median(mutex), median(mutex));
  print_row(Bakery::kName, threads, median(bakery), median(mutex));
  print_row(Spin::kName, threads, median(spin), median(mutex));
}

}  // namespace

int main() {
  std::printf("%-12s %7s %16s %21s\n", "lock", "threads", "million pairs/s", "times std::mutex");
  for (std::size_t threads : {1, 2, 4}) compare(threads);
}
