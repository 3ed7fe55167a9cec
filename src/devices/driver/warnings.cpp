#include "devices/driver/warnings.h"

#include <cassert>

namespace icome::devices {

void Warnings::note(std::size_t which, std::int64_t now) {
  assert(which < sentences_.size() && sentences_.size() <= kMost);
  counts_[which].store(count(which) + 1, std::memory_order_relaxed);
  noted_[which].store(now, std::memory_order_relaxed);
}

void Warnings::tell(DriverLink& link, std::int64_t now) {
  unsigned lasting = 0;
  for (std::size_t i = 0; i < sentences_.size(); ++i) {
    const std::int64_t noted = noted_[i].load(std::memory_order_relaxed);
    if (noted != 0 && now - noted < kLasting) lasting |= 1U << i;
  }
  if (lasting == told_) return;
  told_ = lasting;
  std::string condition;
  for (std::size_t i = 0; i < sentences_.size(); ++i) {
    if ((lasting >> i & 1U) != 0) condition += (condition.empty() ? "" : ". ") + std::string(sentences_[i]);
  }
  link.tell(condition);
}

void Warnings::forget() {
  told_ = 0;
  for (std::atomic<std::int64_t>& noted : noted_) noted.store(0, std::memory_order_relaxed);
}

}  // namespace icome::devices
