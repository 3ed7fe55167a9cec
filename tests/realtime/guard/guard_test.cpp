#include "realtime/guard/guard.h"

#include <gtest/gtest.h>

#include <array>
#include <condition_variable>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <thread>
#include <vector>

namespace icome::realtime {
namespace {

// The compiler may leave out an allocation whose memory nobody looks at.
void look_at(const void* memory) { asm volatile("" : : "g"(memory) : "memory"); }

class RealtimeGuardTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!RealtimeGuard::available()) {
      GTEST_SKIP() << "the guard is off under sanitizers, which replace malloc themselves";
    }
  }
};

TEST_F(RealtimeGuardTest, CountsNothingForPlainArithmetic) {
  RealtimeGuard guard;
  std::array<double, 8> numbers{};
  for (double& number : numbers) number += 1.0;
  look_at(numbers.data());
  guard.stop();
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_EQ(guard.frees(), 0u);
  EXPECT_EQ(guard.locks(), 0u);
}

TEST_F(RealtimeGuardTest, CatchesAVectorThatGrows) {
  std::vector<int> numbers;
  RealtimeGuard guard;
  numbers.push_back(1);
  look_at(numbers.data());
  guard.stop();
  EXPECT_EQ(guard.allocations(), 1u);
  EXPECT_EQ(guard.frees(), 0u);
}

TEST_F(RealtimeGuardTest, CatchesALongStringAndItsEnd) {
  RealtimeGuard guard;
  {
    const std::string text(100, 'x');
    look_at(text.data());
  }
  guard.stop();
  EXPECT_EQ(guard.allocations(), 1u);
  EXPECT_EQ(guard.frees(), 1u);
}

TEST_F(RealtimeGuardTest, CatchesMallocAndItsKin) {
  RealtimeGuard guard;
  void* memory = std::malloc(10);
  look_at(memory);
  EXPECT_EQ(guard.allocations(), 1u);
  memory = std::realloc(memory, 1000);
  look_at(memory);
  EXPECT_EQ(guard.allocations(), 2u);
  EXPECT_EQ(guard.frees(), 1u);
  std::free(memory);
  memory = std::calloc(2, 10);
  look_at(memory);
  std::free(memory);
  EXPECT_EQ(guard.allocations(), 3u);
  memory = std::aligned_alloc(64, 128);
  look_at(memory);
  std::free(memory);
  EXPECT_EQ(guard.allocations(), 4u);
  ASSERT_EQ(posix_memalign(&memory, 64, 128), 0);
  look_at(memory);
  std::free(memory);
  guard.stop();
  EXPECT_EQ(guard.allocations(), 5u);
  EXPECT_EQ(guard.frees(), 5u);
}

TEST_F(RealtimeGuardTest, CatchesAlignedNew) {
  struct alignas(128) Wide {
    char bytes[128];
  };
  RealtimeGuard guard;
  auto wide = std::make_unique<Wide>();
  look_at(wide.get());
  guard.stop();
  EXPECT_EQ(guard.allocations(), 1u);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(wide.get()) % 128, 0u);
}

TEST_F(RealtimeGuardTest, CatchesDelete) {
  auto number = std::make_unique<int>(3);
  look_at(number.get());
  RealtimeGuard guard;
  number.reset();
  guard.stop();
  EXPECT_EQ(guard.frees(), 1u);
  EXPECT_EQ(guard.allocations(), 0u);
}

TEST_F(RealtimeGuardTest, CatchesAFunctionWithABigCapture) {
  std::array<double, 16> capture{};
  RealtimeGuard guard;
  const std::function<double()> function = [capture] { return capture[3]; };
  look_at(&function);
  guard.stop();
  EXPECT_EQ(guard.allocations(), 1u);
}

TEST_F(RealtimeGuardTest, CatchesAnAllocationInsideASharedLibrary) {
  RealtimeGuard guard;
  char* copy = strdup("made in the C library");
  look_at(copy);
  std::free(copy);
  guard.stop();
  EXPECT_EQ(guard.allocations(), 1u);
}

TEST_F(RealtimeGuardTest, CatchesAMutexHeldOrTried) {
  std::mutex mutex;
  RealtimeGuard guard;
  mutex.lock();
  mutex.unlock();
  EXPECT_EQ(guard.locks(), 1u);
  if (mutex.try_lock()) mutex.unlock();
  guard.stop();
  EXPECT_EQ(guard.locks(), 2u);
  EXPECT_EQ(guard.allocations(), 0u);
}

TEST_F(RealtimeGuardTest, CatchesAReadWriteLock) {
  std::shared_mutex mutex;
  RealtimeGuard guard;
  mutex.lock_shared();
  mutex.unlock_shared();
  mutex.lock();
  mutex.unlock();
  guard.stop();
  EXPECT_EQ(guard.locks(), 2u);
}

TEST_F(RealtimeGuardTest, CatchesAWaitOnACondition) {
  std::mutex mutex;
  std::condition_variable condition;
  bool ready = false;
  std::uint64_t waits = 0;
  std::unique_lock lock(mutex);
  // The other thread can only get the mutex, and so end the wait, once this one waits.
  std::thread other([&] {
    const std::scoped_lock held(mutex);
    ready = true;
    condition.notify_one();
  });
  RealtimeGuard guard;
  while (!ready) {
    condition.wait(lock);
    ++waits;
  }
  guard.stop();
  other.join();
  EXPECT_GE(waits, 1u);
  EXPECT_EQ(guard.locks(), waits);
}

TEST_F(RealtimeGuardTest, SeesItsOwnThreadOnly) {
  RealtimeGuard guard;
  std::uint64_t seen_there = 0;
  std::thread other;
  {
    RealtimeGuard starting;
    other = std::thread([&] {
      RealtimeGuard there;
      for (int i = 0; i < 5; ++i) look_at(std::make_unique<int>(i).get());
      seen_there = there.allocations();
    });
    other.join();
    // Starting a thread allocates a little by itself, but not five times and more.
    EXPECT_LT(starting.allocations(), 5u);
  }
  EXPECT_EQ(seen_there, 5u);
}

TEST_F(RealtimeGuardTest, KeepsItsCountsOnceStopped) {
  RealtimeGuard guard;
  look_at(std::make_unique<int>(1).get());
  guard.stop();
  look_at(std::make_unique<int>(2).get());
  EXPECT_EQ(guard.allocations(), 1u);
  EXPECT_EQ(guard.frees(), 1u);
}

}  // namespace
}  // namespace icome::realtime
