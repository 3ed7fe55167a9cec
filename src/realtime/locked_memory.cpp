#include "realtime/locked_memory.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "base/parse_number.h"

namespace icome::realtime {
namespace {

constexpr std::size_t kStack = 256 * 1024;  // bytes that ticks may use of the thread's stack

/// Takes a word and the blanks behind it off the text.
std::string_view take_word(std::string_view& text) {
  const std::size_t length = std::min(text.find(' '), text.size());
  const std::string_view word = text.substr(0, length);
  text.remove_prefix(std::min(text.find_first_not_of(' ', length), text.size()));
  return word;
}

/// A line of /proc/self/maps.
struct Mapping {
  std::uintptr_t begin = 0, end = 0;
  std::string access;  // such as "rw-p"
  std::string path;    // empty for memory without a file

  static Mapping of(std::string_view line) {
    Mapping mapping;
    const auto begin = base::number_at_front<std::uintptr_t>(take_word(line), 16);
    const auto end = base::number_at_front<std::uintptr_t>(begin.rest.substr(begin.good() ? 1 : 0), 16);
    mapping.begin = begin.value;
    mapping.end = end.value;
    mapping.access = take_word(line);
    for (int i = 0; i < 3; ++i) take_word(line);  // offset, device, inode
    mapping.path = line;
    return mapping;
  }
};

/// Libraries that any code of ours may call into.
bool is_of_the_language(const std::string& path) {
  constexpr std::string_view kNames[] = {"libc.so", "libm.so", "libstdc++.so", "libgcc_s.so", "ld-linux"};
  const std::string name = std::filesystem::path(path).filename().string();
  return std::any_of(std::begin(kNames), std::end(kNames), [&](auto it) { return name.starts_with(it); });
}

/// Thread stacks begin behind an inaccessible page. Each has 8 MB, of which little is ever used.
bool is_stack(const Mapping& mapping, const Mapping& before) {
  return mapping.path.empty() && before.path.empty() && before.access.starts_with("---") &&
         before.end == mapping.begin;
}

bool may_be_needed_by_a_tick(const Mapping& mapping, const Mapping& before, const std::string& program) {
  if (!mapping.access.starts_with("r")) return false;
  if (mapping.path.empty()) return !is_stack(mapping, before);
  return mapping.path == "[heap]" || mapping.path == program || is_of_the_language(mapping.path);
}

/// Writes to the stack once, so that its pages are in memory.
[[gnu::noinline]] void touch_stack() {
  char stack[kStack];
  volatile char* bytes = stack;
  for (std::size_t i = 0; i < kStack; i += 1024) bytes[i] = 0;
}

}  // namespace

bool lock_memory() {
  // Not MCL_FUTURE: under a limit, every later allocation of the whole program could then fail.
  if (mlockall(MCL_CURRENT | MCL_ONFAULT) != 0) return false;
  touch_stack();
  std::error_code unknown;
  const std::string program = std::filesystem::read_symlink("/proc/self/exe", unknown).string();
  std::ifstream maps("/proc/self/maps");
  Mapping before;
  for (std::string line; std::getline(maps, line);) {
    const Mapping mapping = Mapping::of(line);
    if (may_be_needed_by_a_tick(mapping, before, program)) {
      // Fails for memory that another thread has freed meanwhile, which no tick needs.
      static_cast<void>(mlock(reinterpret_cast<const void*>(mapping.begin), mapping.end - mapping.begin));
    }
    before = mapping;
  }
  return true;
}

}  // namespace icome::realtime
