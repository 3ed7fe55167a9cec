#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "devices/driver/driver_link.h"

namespace icome::devices {

/// Warnings of a device, which are counted, and told to people while they last. Any thread notes them; one at
/// a time tells and forgets, which may be another.
class Warnings {
 public:
  static constexpr std::size_t kMost = 8;
  static constexpr std::int64_t kLasting = 2'000'000'000;     // ns that a warning lasts after its last note
  static constexpr std::int64_t kCountShown = 1'000'000'000;  // ns from one telling of new counts to the next

  /// `sentences`: one for each warning, kMost at most; they outlive this. One with {} in it tells there how
  /// often the warning was noted.
  explicit Warnings(std::span<const char* const> sentences) : sentences_(sentences) {}

  /// Notes that warning `which` is given now (ns). Real-time safe.
  void note(std::size_t which, std::int64_t now);
  /// Tells the link which warnings last, if others than at the last call, and their new counts now and then;
  /// after a link was connected anew, forget() comes first.
  void tell(DriverLink& link, std::int64_t now);
  /// Forgets the warnings that last, and those that the link was told. Counts go on.
  void forget();

 private:
  unsigned lasting(std::int64_t now) const;
  std::uint64_t notes() const;
  std::string sentences_of(unsigned which) const;

  std::span<const char* const> sentences_;
  std::array<std::atomic<std::uint64_t>, kMost> counts_ = {};
  std::array<std::atomic<std::int64_t>, kMost> noted_ = {};  // ns, 0: never
  unsigned told_ = 0;                                        // bit i: the link was told of i
  std::uint64_t told_notes_ = 0;                             // notes() then
  std::int64_t told_time_ = 0;                               // ns
};

}  // namespace icome::devices
