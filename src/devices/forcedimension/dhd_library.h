#pragma once
#include "base/result.h"

namespace icome::devices {

/// The functions of Force Dimension's library that are called here, as it exports them. m, N; `id` names the
/// device; a negative result is an error, a positive one a warning.
struct DhdLibrary {
  static constexpr int kTimeGuard = 1;  // the reading is an old one, as it was asked for too soon
  static constexpr int kSaturated = 2;  // the motors give less than the force that was asked for

  int (*get_device_count)() = nullptr;
  int (*open_id)(char index) = nullptr;  // the device's id
  int (*close)(char id) = nullptr;
  int (*stop)(char id) = nullptr;
  const char* (*get_system_name)(char id) = nullptr;
  int (*get_position_and_orientation_frame)(double* x, double* y, double* z, double frame[3][3],
                                            char id) = nullptr;
  int (*get_linear_velocity)(double* x, double* y, double* z, char id) = nullptr;
  unsigned (*get_button_mask)(char id) = nullptr;
  int (*set_force)(double x, double y, double z, char id) = nullptr;
  int (*set_force_and_torque_and_gripper_force)(double x, double y, double z, double torque_x,
                                                double torque_y, double torque_z, double gripper,
                                                char id) = nullptr;
  int (*enable_force)(unsigned char on, char id) = nullptr;
  int (*set_gravity_compensation)(int on, char id) = nullptr;
  const char* (*error_get_last_str)() = nullptr;
  // Functions that not every library has; null where they are missing.
  bool (*has_gripper)(char id) = nullptr;
  int (*get_gripper_angle_deg)(double* angle, char id) = nullptr;

  /// Loads the library: ICOME_LIBDHD, or one of the names that it is installed by.
  static base::Result<DhdLibrary> load();
  /// The error of the last call that failed on this thread.
  const char* last_error() const;
};

}  // namespace icome::devices
