#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

#include "devices/driver/driver_link.h"
#include "devices/driver/warnings.h"
#include "devices/openhaptics/hd_library.h"
#include "devices/openhaptics/hd_turns.h"

namespace icome::devices {

/// Warnings of a PHANToM or Touch.
enum class HdWarning : std::uint8_t { Hot, TooStrong, Other, Paused };

/// The frames of one device: readings and forces that pass through a link. One thread calls frame(), any
/// thread the others.
class HdExchange {
 public:
  /// The link is used until let_go(); `turns` outlives the exchange.
  HdExchange(const HdLibrary& hd, unsigned device, DriverLink& link, std::shared_ptr<Warnings> warnings,
             HdTurns& turns)
      : hd_(hd), device_(device), link_(&link), warnings_(std::move(warnings)), turns_(turns) {}

  /// Reads the device, passes the reading on and sends a force; false once the device has failed. Where the
  /// turn does not come within 2 ms, or another device is being opened, the frame is left out. Real-time
  /// safe, apart from that wait.
  bool frame();
  /// Makes a last frame without force; then the device's force is switched off. False, and nothing is done,
  /// where the turn does not come within 0.1 s.
  bool rest();
  /// The state of calibration that the library tells; nothing where it has no such function, or where the
  /// turn does not come.
  std::optional<unsigned> calibration();
  /// Uses the link no more once this returns. A frame that hangs in the library gives no force when it goes
  /// on, and puts the device to rest.
  void let_go();

  /// The error that the device failed with; 0 while it works.
  unsigned failure() const { return failure_.load(std::memory_order_acquire); }
  /// Frames so far, with those that were left out while another device was opened.
  std::uint64_t count() const { return count_.load(std::memory_order_relaxed); }

 private:
  PointerState read() const;
  Vector3 pass(const PointerState& reading, std::int64_t now);
  bool is_let_go();
  void send(const Vector3& force) const;
  void take_errors(std::int64_t now);
  void rest_in_turn();

  const HdLibrary hd_;
  const unsigned device_;
  std::mutex link_guard_;
  DriverLink* link_;  // null: it was let go
  std::shared_ptr<Warnings> warnings_;
  HdTurns& turns_;
  std::uint64_t pauses_ = turns_.pauses();  // those after which forces began at none
  int failing_frames_ = 0;                  // in a row, with an error that is neither a warning nor the end
  std::atomic<unsigned> failure_ = 0;
  std::atomic<std::uint64_t> count_ = 0;
};

}  // namespace icome::devices
