// A fake of Force Dimension's library: its functions, with arms of no material behind them. Written from
// what its makers publish; no real device was there to hold it against.
#include "devices/fakes/fake_dhd.h"

#include <algorithm>
#include <cstdlib>

namespace icome::devices::fakes {
namespace {

constexpr int kErrorResult = -1;
constexpr int kTimeGuardResult = 1;
constexpr int kSaturatedResult = 2;

thread_local const char* dhd_error = "no error";

int dhd_failed(const char* why) {
  dhd_error = why;
  return kErrorResult;
}

FakeDhd& dhd_from_environment() {
  static FakeDhd dhd;
  const FakeEnvironment environment("FAKE_DHD");
  dhd.set_up(std::clamp(int(environment.number("_DEVICES", 1.0)), 0, FakeDhd::kMost),
             environment.text("_MODEL", "omega.7"));
  for (FakeDhd::Device& device : dhd.devices) {
    const bool is_plugged = device.unit.is_plugged();
    environment.set_up(device.unit);
    device.unit.plug(is_plugged);
  }
  return dhd;
}

FakeDhd& the_dhd() {
  static FakeDhd& dhd = dhd_from_environment();
  return dhd;
}

/// The open device of that id; null, with the error, where it cannot be talked to.
FakeDhd::Device* talk_to(char id) {
  FakeDhd& dhd = the_dhd();
  if (id < 0 || id >= FakeDhd::kMost || !dhd.devices[std::size_t(id)].is_open) {
    ++dhd.misuses;
    dhd_failed("no such device is open");
    return nullptr;
  }
  FakeDhd::Device& device = dhd.devices[std::size_t(id)];
  if (device.unit.is_plugged()) return &device;
  dhd_failed("communication error");
  return nullptr;
}

int reading_result(const FakeDhd::Device& device) {
  return device.unit.fault() == UnitFault::TimeGuard ? kTimeGuardResult : 0;
}

int give_force(FakeDhd::Device& device, const base::Vector3& force) {
  device.unit.push(device.has_force ? force : base::Vector3::Zero());
  return device.unit.fault() == UnitFault::Saturated ? kSaturatedResult : 0;
}

}  // namespace
}  // namespace icome::devices::fakes

using namespace icome::devices::fakes;

#define FAKE_EXPORT extern "C" __attribute__((visibility("default")))

FAKE_EXPORT FakeDhd* fake_dhd() { return &the_dhd(); }

// Named as the real ones are.
// NOLINTBEGIN(readability-identifier-naming)

FAKE_EXPORT int dhdGetDeviceCount() {
  const auto& devices = the_dhd().devices;
  return int(std::count_if(devices.begin(), devices.end(),
                           [](const FakeDhd::Device& device) { return device.unit.is_plugged(); }));
}

FAKE_EXPORT int dhdOpenID(char index) {
  FakeDhd& dhd = the_dhd();
  int left = index;
  for (int id = 0; id < FakeDhd::kMost; ++id) {
    FakeDhd::Device& device = dhd.devices[std::size_t(id)];
    if (!device.unit.is_plugged() || left-- > 0) continue;
    if (device.unit.fault() == UnitFault::Broken) return dhd_failed("firmware error");
    device.is_open = true;
    return id;
  }
  return dhd_failed("no device found");
}

FAKE_EXPORT int dhdOpen() { return dhdOpenID(0); }

FAKE_EXPORT int dhdClose(char id) {
  FakeDhd& dhd = the_dhd();
  if (id < 0 || id >= FakeDhd::kMost || !dhd.devices[std::size_t(id)].is_open.exchange(false)) {
    ++dhd.misuses;
    return dhd_failed("no such device is open");
  }
  return 0;
}

FAKE_EXPORT int dhdStop(char id) {
  FakeDhd::Device* device = talk_to(id);
  if (device == nullptr) return kErrorResult;
  ++device->stops;
  device->has_force = false;
  device->unit.push(icome::base::Vector3::Zero());
  return 0;
}

FAKE_EXPORT int dhdGetSystemType(char id) { return talk_to(id) != nullptr ? 0 : kErrorResult; }

FAKE_EXPORT const char* dhdGetSystemName(char id) {
  return talk_to(id) != nullptr ? the_dhd().name() : nullptr;
}

FAKE_EXPORT int dhdGetPositionAndOrientationFrame(double* x, double* y, double* z, double frame[3][3],
                                                  char id) {
  FakeDhd::Device* device = talk_to(id);
  if (device == nullptr) return kErrorResult;
  const FakeUnit::Sample sample = device->unit.read();
  *x = sample.position.x();
  *y = sample.position.y();
  *z = sample.position.z();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) frame[row][column] = sample.rotation(row, column);
  }
  return reading_result(*device);
}

FAKE_EXPORT int dhdGetPosition(double* x, double* y, double* z, char id) {
  double frame[3][3];
  return dhdGetPositionAndOrientationFrame(x, y, z, frame, id);
}

FAKE_EXPORT int dhdGetLinearVelocity(double* x, double* y, double* z, char id) {
  FakeDhd::Device* device = talk_to(id);
  if (device == nullptr) return kErrorResult;
  const icome::base::Vector3 velocity = device->unit.last_velocity();
  *x = velocity.x();
  *y = velocity.y();
  *z = velocity.z();
  return reading_result(*device);
}

FAKE_EXPORT unsigned dhdGetButtonMask(char id) {
  const FakeDhd::Device* device = talk_to(id);
  return device != nullptr ? device->unit.buttons() : 0;
}

FAKE_EXPORT int dhdGetButton(int index, char id) {
  return index >= 0 && index < 32 ? int(dhdGetButtonMask(id) >> index & 1U) : dhd_failed("no such button");
}

FAKE_EXPORT bool dhdHasGripper(char id) {
  return talk_to(id) != nullptr && std::string(the_dhd().name()).find(".7") != std::string::npos;
}

FAKE_EXPORT int dhdGetGripperAngleDeg(double* angle, char id) {
  const FakeDhd::Device* device = talk_to(id);
  if (device == nullptr) return kErrorResult;
  *angle = device->unit.grip_degrees();
  return reading_result(*device);
}

FAKE_EXPORT int dhdSetForce(double x, double y, double z, char id) {
  FakeDhd::Device* device = talk_to(id);
  return device != nullptr ? give_force(*device, {x, y, z}) : kErrorResult;
}

FAKE_EXPORT int dhdSetForceAndTorqueAndGripperForce(double x, double y, double z, double torque_x,
                                                    double torque_y, double torque_z, double gripper,
                                                    char id) {
  FakeDhd::Device* device = talk_to(id);
  if (device == nullptr) return kErrorResult;
  for (const double other : {torque_x, torque_y, torque_z, gripper})
    device->other_motors = std::max(device->other_motors.load(), std::abs(other));
  return give_force(*device, {x, y, z});
}

FAKE_EXPORT int dhdEnableForce(unsigned char on, char id) {
  FakeDhd::Device* device = talk_to(id);
  if (device == nullptr) return kErrorResult;
  device->has_force = on != 0;
  return 0;
}

FAKE_EXPORT int dhdSetGravityCompensation(int on, char id) {
  FakeDhd::Device* device = talk_to(id);
  if (device == nullptr) return kErrorResult;
  device->has_gravity = on != 0;
  return 0;
}

FAKE_EXPORT double dhdGetComFreq(char id) { return talk_to(id) != nullptr ? 4.0 : 0.0; }

FAKE_EXPORT int dhdErrorGetLast() { return dhd_error != nullptr ? 1 : 0; }

FAKE_EXPORT const char* dhdErrorGetLastStr() { return dhd_error; }

FAKE_EXPORT void dhdGetSDKVersion(int* major, int* minor, int* release, int* revision) {
  *major = 3;
  *minor = *release = *revision = 0;
}

// NOLINTEND(readability-identifier-naming)
