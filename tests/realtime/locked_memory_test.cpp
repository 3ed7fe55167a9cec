#include "realtime/locked_memory.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "realtime/guard/guard.h"

namespace icome::realtime {
namespace {

constexpr std::size_t kBytes = 4 << 20U;

/// How much of the mapping that begins there is in memory, in kB, as the kernel tells.
long kilobytes_there(const void* begin, const std::string& key = "Rss:") {
  char address[32];
  std::snprintf(address, sizeof address, "%lx-",
                static_cast<unsigned long>(reinterpret_cast<std::uintptr_t>(begin)));
  std::ifstream maps("/proc/self/smaps");
  bool found = false;
  for (std::string line; std::getline(maps, line);) {
    if (line.starts_with(address)) found = true;
    if (found && line.starts_with(key)) return std::atol(line.c_str() + key.size());
  }
  return -1;
}

// In a process of its own, since locks stay. Exits with 0 when memory that nobody has used yet is there
// afterwards, and a file that only lies in the address space is not.
[[noreturn]] void lock_and_look() {
  // Other protection than what may lie beside it, so that it is a mapping of its own.
  void* heap = mmap(nullptr, kBytes, PROT_READ | PROT_WRITE | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  std::FILE* file = std::tmpfile();
  if (!file || ftruncate(fileno(file), kBytes) != 0) std::_Exit(2);
  void* library = mmap(nullptr, kBytes, PROT_READ, MAP_PRIVATE, fileno(file), 0);
  if (heap == MAP_FAILED || library == MAP_FAILED) std::_Exit(3);
  if (kilobytes_there(heap) != 0 || kilobytes_there(library) != 0) std::_Exit(4);
  if (!lock_memory()) std::_Exit(5);
  if (kilobytes_there(heap) != kBytes / 1024) std::_Exit(6);
  if (kilobytes_there(library) != 0) std::_Exit(7);
  // From its first use on it stays.
  static_cast<void>(*static_cast<volatile char*>(library));
  std::_Exit(kilobytes_there(library, "Locked:") > 0 ? 0 : 8);
}

TEST(LockMemoryDeathTest, BringsInWhatATickMayUseAndNotEveryLibrary) {
  if (!RealtimeGuard::available()) GTEST_SKIP() << "sanitizers lock nothing";
  rlimit limit{};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  if (geteuid() != 0 && limit.rlim_cur != RLIM_INFINITY)
    GTEST_SKIP() << "locking memory is not permitted here";
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(lock_and_look(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace icome::realtime
