#include "io/memory_budget.h"

#include <fmt/format.h>

namespace icome::io {
namespace {

constexpr std::uint64_t kBytesForAByte = 20;
constexpr std::uint64_t kBytesForAnyFile = 256'000'000;

}  // namespace

std::uint64_t MemoryBudget::allowed() const {
  return limit_.value_or(kBytesForAByte * files_ + kBytesForAnyFile);
}

bool MemoryBudget::add_file(std::uint64_t bytes) {
  files_ += bytes;
  return take(bytes);
}

bool MemoryBudget::has_room(std::uint64_t bytes) {
  exceeded_ = exceeded_ || bytes > left();
  return !exceeded_;
}

bool MemoryBudget::take(std::uint64_t bytes) {
  if (has_room(bytes)) taken_ += bytes;
  return !exceeded_;
}

base::Error MemoryBudget::too_much_memory(std::uint64_t allowed) {
  return {fmt::format(
      "reading it needs more than the {:.4g} MB of memory that a file of its size may take; for a file that "
      "you trust, \"icome convert --memory-limit\" allows more",
      1e-6 * double(allowed))};
}

}  // namespace icome::io
