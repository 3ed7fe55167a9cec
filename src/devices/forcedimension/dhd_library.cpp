#include "devices/forcedimension/dhd_library.h"

#include <array>

#include "devices/driver/shared_library.h"

namespace icome::devices {
namespace {

// libdrd, the library for robots of the same makers, has all functions of libdhd.
constexpr std::array<const char*, 6> kDhdFiles = {"libdhd.so",   "libdhd.so.3",   "libdrd.so",
                                                  "libdrd.so.3", "libdhdms.so.3", "libdrdms.so.3"};
constexpr LibrarySought kDhdSought = {
    "Force Dimension", "ICOME_LIBDHD", kDhdFiles,
    "install the Force Dimension SDK (for a Novint Falcon too), which its maker gives to owners"};

}  // namespace

base::Result<DhdLibrary> DhdLibrary::load() {
  const auto library = SharedLibrary::open(kDhdSought);
  if (!library) return tl::unexpected(library.error());
  DhdLibrary dhd;
  base::Result<void> got;
  const auto get = [&](const char* name, auto*& function) {
    if (got) got = library->get(name, function);
  };
  get("dhdGetDeviceCount", dhd.get_device_count);
  get("dhdOpenID", dhd.open_id);
  get("dhdClose", dhd.close);
  get("dhdStop", dhd.stop);
  get("dhdGetSystemName", dhd.get_system_name);
  get("dhdGetPositionAndOrientationFrame", dhd.get_position_and_orientation_frame);
  get("dhdGetLinearVelocity", dhd.get_linear_velocity);
  get("dhdGetButtonMask", dhd.get_button_mask);
  get("dhdSetForce", dhd.set_force);
  get("dhdSetForceAndTorqueAndGripperForce", dhd.set_force_and_torque_and_gripper_force);
  get("dhdEnableForce", dhd.enable_force);
  get("dhdSetGravityCompensation", dhd.set_gravity_compensation);
  get("dhdErrorGetLastStr", dhd.error_get_last_str);
  if (!got) return tl::unexpected(got.error());
  library->get_if_there("dhdHasGripper", dhd.has_gripper);
  library->get_if_there("dhdGetGripperAngleDeg", dhd.get_gripper_angle_deg);
  return dhd;
}

const char* DhdLibrary::last_error() const {
  const char* text = error_get_last_str();
  return text != nullptr && *text != '\0' ? text : "the library does not say why";
}

}  // namespace icome::devices
