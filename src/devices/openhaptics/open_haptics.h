#pragma once
#include <memory>
#include <string>
#include <string_view>

#include "base/result.h"
#include "devices/back_end.h"
#include "devices/driver/driver.h"

namespace icome::devices {

/// Settings of PHANToM and Touch.
struct OpenHapticsSettings {
  /// The clock that frames follow.
  enum class Mode : std::uint8_t {
    Drives,   // OpenHaptics' scheduler calls us
    Follows,  // a thread of ours makes frames
  };
  Mode mode = Mode::Drives;
  double rate = 1000.0;  // Hz, of the scheduler and of our thread, 500 to 4000
};

/// The settings by the environment: ICOME_HD_MODE (drives, follows), ICOME_HD_RATE. The error names the
/// variable that makes no sense.
base::Result<OpenHapticsSettings> open_haptics_settings();

/// The driver of the device of that name in the settings of the makers' driver; empty: the default one. The
/// library is looked for when it opens.
std::unique_ptr<Driver> open_haptics_driver(std::string_view name, const OpenHapticsSettings& settings);

/// The profile of a device of that name ("PHANTOM Omni", "Touch"); of an unknown one that of the weakest.
DeviceInfo open_haptics_profile(std::string_view model);

/// Back-end "openhaptics" with addresses "hd", the default device, and "hd:Left"; settings from the
/// environment, where ICOME_HD_NAMES lists more names to look for, with commas between.
extern const BackEnd kOpenHaptics;

}  // namespace icome::devices
