#pragma once
#include <memory>
#include <string>
#include <string_view>

#include "base/result.h"
#include "devices/back_end.h"
#include "devices/driver/driver.h"

namespace icome::devices {

/// Settings of the devices of Force Dimension (omega, delta, sigma, lambda) and of the Novint Falcon.
struct ForceDimensionSettings {
  double rate = 4000.0;              // Hz, 1000 to 4000
  std::string axes = "yzx";          // its axes that point right, up and to the user (rotation_from_axes)
  bool gravity_compensation = true;  // the device carries its own weight
  double grip_open = 30.0;           // degrees between the fingers of an open gripper, 5 to 90
};

/// The settings by the environment: ICOME_DHD_RATE, ICOME_DHD_AXES, ICOME_DHD_GRAVITY (on, off),
/// ICOME_DHD_GRIP_DEGREES. The error names the variable that makes no sense.
base::Result<ForceDimensionSettings> force_dimension_settings();

/// The driver of the device of that address: a number, or empty for the first one that is not open yet. Fails
/// on an address or settings that make no sense; the library is looked for when the driver opens.
base::Result<std::unique_ptr<Driver>> force_dimension_driver(std::string_view address,
                                                             const ForceDimensionSettings& settings);

/// The profile of a device of that name ("omega.7", "Falcon"); of an unknown one the lowest limits of all of
/// them.
DeviceInfo force_dimension_profile(std::string_view model);

/// Back-end "forcedimension" with addresses "dhd" and "dhd:0"; settings from the environment.
extern const BackEnd kForceDimension;

}  // namespace icome::devices
