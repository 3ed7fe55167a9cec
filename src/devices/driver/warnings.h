#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "devices/driver/driver_link.h"

namespace icome::devices {

/// Warnings of a device, which are counted, and told to people while they last. One thread notes them, and
/// one, which may be another, tells.
class Warnings {
 public:
  static constexpr std::size_t kMost = 8;
  static constexpr std::int64_t kLasting = 2'000'000'000;  // ns that a warning lasts after its last note

  /// `sentences`: one for each warning, kMost at most; they outlive this.
  explicit Warnings(std::span<const char* const> sentences) : sentences_(sentences) {}

  /// Notes that warning `which` is given now (ns). Real-time safe.
  void note(std::size_t which, std::int64_t now);
  /// Tells the link which warnings last, if others than at the last call; after a link was connected anew,
  /// forget() comes first.
  void tell(DriverLink& link, std::int64_t now);
  /// Forgets the warnings that last, and those that the link was told.
  void forget();

  /// Number of times that a warning was noted. Any thread.
  std::uint64_t count(std::size_t which) const { return counts_[which].load(std::memory_order_relaxed); }

 private:
  std::span<const char* const> sentences_;
  std::array<std::atomic<std::uint64_t>, kMost> counts_ = {};
  std::array<std::atomic<std::int64_t>, kMost> noted_ = {};  // ns, 0: never
  unsigned told_ = 0;                                        // bit i: the link was told of i
};

}  // namespace icome::devices
