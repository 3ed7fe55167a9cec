#include "devices/driver/warnings.h"

#include <fmt/format.h>

#include <cassert>

namespace icome::devices {

void Warnings::note(std::size_t which, std::int64_t now) {
  assert(which < sentences_.size() && sentences_.size() <= kMost);
  counts_[which].fetch_add(1, std::memory_order_relaxed);
  noted_[which].store(now, std::memory_order_relaxed);
}

void Warnings::tell(DriverLink& link, std::int64_t now) {
  const unsigned last = lasting(now);
  const std::uint64_t count = notes();
  const bool is_counted = last != 0 && count != told_notes_ && now - told_time_ >= kCountShown;
  if (last == told_ && !is_counted) return;
  told_ = last;
  told_notes_ = count;
  told_time_ = now;
  link.tell(sentences_of(last));
}

/// Bit i: warning i lasts.
unsigned Warnings::lasting(std::int64_t now) const {
  unsigned last = 0;
  for (std::size_t i = 0; i < sentences_.size(); ++i) {
    const std::int64_t noted = noted_[i].load(std::memory_order_relaxed);
    if (noted != 0 && now - noted < kLasting) last |= 1U << i;
  }
  return last;
}

std::uint64_t Warnings::notes() const {
  std::uint64_t sum = 0;
  for (const std::atomic<std::uint64_t>& count : counts_) sum += count.load(std::memory_order_relaxed);
  return sum;
}

std::string Warnings::sentences_of(unsigned which) const {
  std::string all;
  for (std::size_t i = 0; i < sentences_.size(); ++i) {
    if ((which >> i & 1U) == 0) continue;
    all += all.empty() ? "" : "\n";
    all += fmt::format(fmt::runtime(sentences_[i]), counts_[i].load(std::memory_order_relaxed));
  }
  return all;
}

void Warnings::forget() {
  told_ = 0;
  for (std::atomic<std::int64_t>& noted : noted_) noted.store(0, std::memory_order_relaxed);
}

}  // namespace icome::devices
