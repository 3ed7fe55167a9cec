#include "realtime/histogram.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace icome::realtime {
namespace {

// Each octave is split into 256 equal buckets: the middle of a bucket is at most 1/512 from any
// sample in it. The first 256 buckets are 1 ns wide. Durations beyond 2^36 ns (a minute) share the last.
constexpr int kOctaveBits = 8;
constexpr int kLargestBits = 36;
constexpr std::size_t kOctave = std::size_t{1} << kOctaveBits;
constexpr std::size_t kBuckets = kOctave * (kLargestBits - kOctaveBits + 1);

std::size_t bucket_of(std::uint64_t nanoseconds) {
  if (nanoseconds < kOctave) return nanoseconds;
  const int shift = std::bit_width(nanoseconds) - 1 - kOctaveBits;
  const std::size_t bucket = kOctave * static_cast<std::size_t>(shift) + (nanoseconds >> shift);
  return std::min(bucket, kBuckets - 1);
}

double middle_of(std::size_t bucket) {
  if (bucket < kOctave) return static_cast<double>(bucket);
  const std::size_t shift = bucket / kOctave - 1;
  const std::uint64_t lowest = std::uint64_t{bucket - kOctave * shift} << shift;
  const std::uint64_t width = std::uint64_t{1} << shift;
  return static_cast<double>(lowest) + 0.5 * static_cast<double>(width - 1);
}

}  // namespace

DurationHistogram::DurationHistogram() : buckets_(kBuckets) {}

void DurationHistogram::add(std::int64_t nanoseconds) {
  const std::int64_t value = std::max<std::int64_t>(nanoseconds, 0);
  if (value > max()) max_.store(value, std::memory_order_relaxed);
  sum_.store(sum_.load(std::memory_order_relaxed) + value, std::memory_order_relaxed);
  // Last and released: a reader that counts the sample also sees a maximum that is not below it.
  std::atomic<std::uint64_t>& bucket = buckets_[bucket_of(static_cast<std::uint64_t>(value))];
  bucket.store(bucket.load(std::memory_order_relaxed) + 1, std::memory_order_release);
}

std::uint64_t DurationHistogram::count() const {
  std::uint64_t total = 0;
  for (const auto& bucket : buckets_) total += bucket.load(std::memory_order_acquire);
  return total;
}

double DurationHistogram::mean() const {
  const std::uint64_t samples = count();
  if (samples == 0) return 0.0;
  return static_cast<double>(sum_.load(std::memory_order_relaxed)) / static_cast<double>(samples);
}

double DurationHistogram::quantile(double share) const {
  assert(share >= 0.0 && share <= 1.0);
  const std::uint64_t samples = count();
  if (samples == 0) return 0.0;
  const double wanted = std::ceil(share * static_cast<double>(samples));
  const std::uint64_t rank = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(wanted));
  std::uint64_t passed = 0;
  for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
    passed += buckets_[bucket].load(std::memory_order_acquire);
    if (passed >= rank) return std::min(middle_of(bucket), static_cast<double>(max()));
  }
  return static_cast<double>(max());
}

}  // namespace icome::realtime
