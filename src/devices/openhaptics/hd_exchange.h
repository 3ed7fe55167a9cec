#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>

#include "devices/driver/driver_link.h"
#include "devices/driver/warnings.h"
#include "devices/openhaptics/hd_library.h"

namespace icome::devices {

/// Warnings of a PHANToM or Touch.
enum class HdWarning : std::uint8_t { Hot, TooStrong, Calibrate, Inkwell, Other };

/// The frames of one device: readings and forces that pass through a link. One thread calls frame() and
/// rest(), any thread the others.
class HdExchange {
 public:
  /// All outlive the exchange. `frames`: held for the length of a frame.
  HdExchange(const HdLibrary& hd, unsigned device, DriverLink& link, Warnings& warnings, std::mutex& frames)
      : hd_(hd), device_(device), link_(link), warnings_(warnings), frames_(frames) {}

  /// Reads the device, passes the reading on and sends a force; false once the device has failed. Real-time
  /// safe, apart from a lock that is taken for a moment when a device is opened or looked at.
  bool frame();
  /// Makes a last frame without force; then the device's force is switched off.
  void rest();
  /// Notes whether the device wants to be calibrated.
  void check_calibration();

  /// The error that the device failed with; 0 while it works.
  unsigned failure() const { return failure_.load(std::memory_order_acquire); }
  /// Frames so far.
  std::uint64_t count() const { return count_.load(std::memory_order_relaxed); }

 private:
  PointerState read() const;
  void send(const Vector3& force) const;
  void take_errors(std::int64_t now);

  const HdLibrary& hd_;
  unsigned device_;
  DriverLink& link_;
  Warnings& warnings_;
  std::mutex& frames_;
  int failing_frames_ = 0;  // in a row, with an error that is neither a warning nor the end
  std::atomic<unsigned> failure_ = 0;
  std::atomic<std::uint64_t> count_ = 0;
};

}  // namespace icome::devices
