#include "devices/forcedimension/force_dimension_driver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/clock.h"
#include "devices/driver/pace.h"

namespace icome::devices {
namespace {

constexpr std::array<const char*, 2> kDhdWarnings = {
    "The device is asked more often than it answers (time guard; times so far: {}): lower ICOME_DHD_RATE if "
    "contact feels rough",
    "The motors give all they have (saturated; times so far: {}): the force is less than what was asked for"};

/// Does the model have motors that turn the hand or close the gripper? They are told to give nothing.
bool has_more_motors(std::string_view model) {
  return model.find(".7") != std::string_view::npos || model.find("delta.6") != std::string_view::npos;
}

}  // namespace

ForceDimensionDriver::ForceDimensionDriver(std::optional<int> index, const base::Matrix3& rotation,
                                           const ForceDimensionSettings& settings)
    : index_(index), rotation_(rotation), settings_(settings), warnings_(kDhdWarnings) {}

ForceDimensionDriver::~ForceDimensionDriver() { close(); }

base::Result<DeviceInfo> ForceDimensionDriver::open() {
  close();
  auto dhd = DhdLibrary::load();
  if (!dhd) return tl::unexpected(dhd.error());
  dhd_ = *dhd;
  auto device = DhdSession::instance().open(dhd_, index_, model_);
  if (!device) return tl::unexpected(device.error());
  device_ = *device;
  model_ = device->model;
  if (!prepare()) {
    const std::string why = model_ + " was found, but does not start: " + failure_ +
                            "; switch it off and on again, and calibrate it as its maker says";
    close();
    return base::fail(why);
  }
  DeviceInfo info = force_dimension_profile(model_);
  info.name = model_;
  // Of two alike people need to know which.
  if (device_->index > 0) info.name += " (" + identity() + ")";
  return info;
}

/// Readies motors and gripper of the open device; false where it cannot be used, with the failure.
bool ForceDimensionDriver::prepare() {
  has_wrist_motors_ = has_more_motors(model_);
  has_gripper_ =
      dhd_.has_gripper != nullptr && dhd_.get_gripper_angle_deg != nullptr && dhd_.has_gripper(device_->id);
  return take(dhd_.set_gravity_compensation(settings_.gravity_compensation ? 1 : 0, device_->id)) &&
         take(dhd_.enable_force(1, device_->id)) && send(Vector3::Zero());
}

std::string ForceDimensionDriver::run(DriverLink& link, const std::atomic<bool>& stop) {
  warnings_.forget();
  failure_.clear();
  Pace pace(settings_.rate);
  bool works = true;
  while (works && !stop.load(std::memory_order_relaxed)) {
    works = exchange(link);
    if (works) pace.wait();
  }
  const std::string why = failure_;
  send(Vector3::Zero());
  dhd_.stop(device_->id);
  if (works) return {};
  return "The connection to " + model_ + " is lost (" + why + "); plug it in and switch it on again";
}

bool ForceDimensionDriver::exchange(DriverLink& link) {
  PointerState reading;
  if (!read(reading)) return false;
  const std::int64_t now = base::steady_nanoseconds();
  link.pass(reading, now);
  if (!send(link.force(now))) return false;
  warnings_.tell(link, now);
  return true;
}

bool ForceDimensionDriver::read(PointerState& reading) {
  // A part that the library does not set stays NaN, which the link refuses.
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  Vector3 position = Vector3::Constant(kNothing);
  Vector3 velocity = Vector3::Constant(kNothing);
  double rows[3][3] = {
      {kNothing, kNothing, kNothing}, {kNothing, kNothing, kNothing}, {kNothing, kNothing, kNothing}};
  const char id = device_->id;
  if (!take(dhd_.get_position_and_orientation_frame(&position.x(), &position.y(), &position.z(), rows, id)))
    return false;
  if (!take(dhd_.get_linear_velocity(&velocity.x(), &velocity.y(), &velocity.z(), id))) return false;
  const base::Matrix3 frame = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&rows[0][0]);
  reading.position = rotation_ * position;
  reading.velocity = rotation_ * velocity;
  reading.orientation = Quaternion(rotation_ * frame * rotation_.transpose());
  reading.buttons = dhd_.get_button_mask(id);
  if (!has_gripper_) return true;
  double angle = kNothing;
  if (!take(dhd_.get_gripper_angle_deg(&angle, id))) return false;
  // The angle of a device for the left hand is negative.
  const double open = std::abs(angle) / settings_.grip_open;
  reading.grip = std::isfinite(open) ? 1.0 - std::min(open, 1.0) : kNothing;
  return true;
}

bool ForceDimensionDriver::send(const Vector3& force) {
  const Vector3 own = rotation_.transpose() * force;
  if (!has_wrist_motors_) return take(dhd_.set_force(own.x(), own.y(), own.z(), device_->id));
  return take(dhd_.set_force_and_torque_and_gripper_force(own.x(), own.y(), own.z(), 0.0, 0.0, 0.0, 0.0,
                                                          device_->id));
}

/// Counts a result that is a warning; false for an error, with the failure.
bool ForceDimensionDriver::take(int result) {
  if (result == DhdLibrary::kTimeGuard) warnings_.note(kTimeGuards, base::steady_nanoseconds());
  if (result == DhdLibrary::kSaturated) warnings_.note(kSaturations, base::steady_nanoseconds());
  if (result < 0) failure_ = dhd_.last_error();
  return result >= 0;
}

void ForceDimensionDriver::close() {
  if (!device_) return;
  DhdSession::instance().close(dhd_, *device_);
  device_.reset();
}

}  // namespace icome::devices
