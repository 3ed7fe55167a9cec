#pragma once
#include <cstdint>
#include <string>

#include "base/result.h"

namespace icome::devices {

/// An error of OpenHaptics, as the library lays it out.
struct HdError {
  unsigned code = 0;  // 0: nothing
  int internal_code = 0;
  unsigned device = 0;
};

/// The functions of OpenHaptics' device library that are called here, as it exports them. mm and N; most of
/// them are about the current device.
struct HdLibrary {
  static constexpr unsigned kInvalidDevice = 0xFFFFFFFF;
  // Results of a callback.
  static constexpr unsigned kDone = 0;
  static constexpr unsigned kContinue = 1;
  static constexpr std::uint16_t kMaxPriority = 0xFFFF;

  // Values that can be asked for and set.
  static constexpr unsigned kButtons = 0x2000;          // bits 0 to 3
  static constexpr unsigned kPosition = 0x2050;         // mm
  static constexpr unsigned kVelocity = 0x2051;         // mm/s
  static constexpr unsigned kTransform = 0x2052;        // 4 x 4, column by column
  static constexpr unsigned kModel = 0x2501;            // text
  static constexpr unsigned kVendor = 0x2503;           // text
  static constexpr unsigned kSerial = 0x2504;           // text
  static constexpr unsigned kUsableWorkspace = 0x2551;  // mm, least x, y, z, then most
  static constexpr unsigned kMaxStiffness = 0x2602;     // N/mm
  static constexpr unsigned kMaxForce = 0x2603;         // N
  static constexpr unsigned kContinuousForce = 0x2604;  // N
  static constexpr unsigned kForce = 0x2700;            // N
  // Abilities.
  static constexpr unsigned kForceOutput = 0x4000;
  static constexpr unsigned kForceClamping = 0x4001;
  static constexpr unsigned kForceRamping = 0x4002;
  // Errors.
  static constexpr unsigned kWarmMotors = 0x0200;
  static constexpr unsigned kExceededForce = 0x0201;
  static constexpr unsigned kDeviceFault = 0x0300;
  static constexpr unsigned kCommunication = 0x0302;
  // States of calibration.
  static constexpr unsigned kCalibrationNeedsUpdate = 0x5001;
  static constexpr unsigned kCalibrationNeedsHand = 0x5002;

  unsigned (*init_device)(const char* name) = nullptr;  // null: the default one
  void (*disable_device)(unsigned device) = nullptr;
  void (*make_current_device)(unsigned device) = nullptr;
  void (*begin_frame)(unsigned device) = nullptr;
  void (*end_frame)(unsigned device) = nullptr;
  void (*enable)(unsigned ability) = nullptr;
  void (*disable)(unsigned ability) = nullptr;
  void (*get_integerv)(unsigned what, int* values) = nullptr;
  void (*get_doublev)(unsigned what, double* values) = nullptr;
  void (*set_doublev)(unsigned what, const double* values) = nullptr;
  void (*start_scheduler)() = nullptr;
  void (*stop_scheduler)() = nullptr;
  void (*set_scheduler_rate)(unsigned long hertz) = nullptr;
  unsigned long (*schedule_asynchronous)(unsigned (*callback)(void*), void* context,
                                         std::uint16_t priority) = nullptr;
  void (*unschedule)(unsigned long callback) = nullptr;
  HdError (*get_error)() = nullptr;
  const char* (*get_error_string)(unsigned code) = nullptr;
  // Functions that not every library has; null where they are missing.
  const char* (*get_string)(unsigned what) = nullptr;
  unsigned (*check_calibration)() = nullptr;

  /// Loads the library: ICOME_LIBHD, or one of the names that it is installed by.
  static base::Result<HdLibrary> load();
  /// The meaning of an error, in the library's words.
  std::string text_of(unsigned code) const;
  /// The first error since it was asked for last; all others are forgotten. Real-time safe.
  unsigned first_error() const;
};

}  // namespace icome::devices
