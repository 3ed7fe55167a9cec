#include "devices/openhaptics/hd_exchange.h"

#include <array>
#include <limits>

#include "base/clock.h"

namespace icome::devices {
namespace {

constexpr double kMetre = 0.001;                     // m in a millimetre
constexpr int kMostFailingFrames = 200;              // in a row, after which the device has failed
constexpr std::int64_t kFramePatience = 2'000'000;   // ns, longer than another device's frame takes
constexpr std::int64_t kRestPatience = 100'000'000;  // ns

}  // namespace

bool HdExchange::frame() {
  if (failure() != 0) return false;
  if (turns_.paused()) {
    warnings_->note(std::size_t(HdWarning::Paused), base::steady_nanoseconds());
    count_.fetch_add(1, std::memory_order_relaxed);
    return true;
  }
  const HdTurns::Turn turn = turns_.take(kFramePatience);
  if (!turn) return true;
  if (is_let_go()) return false;
  hd_.make_current_device(device_);
  hd_.begin_frame(device_);
  const PointerState reading = read();
  const std::int64_t now = base::steady_nanoseconds();
  send(pass(reading, now));
  hd_.end_frame(device_);
  take_errors(now);
  // It hung meanwhile; nobody else can put the device to rest.
  if (is_let_go()) rest_in_turn();
  count_.fetch_add(1, std::memory_order_relaxed);
  return failure() == 0;
}

/// Passes a reading on, and gives the force to send; none once the link was let go.
Vector3 HdExchange::pass(const PointerState& reading, std::int64_t now) {
  const std::lock_guard lock(link_guard_);
  if (link_ == nullptr) return Vector3::Zero();
  PointerState passed = reading;
  // The hand went on without force during a pause: that is a new beginning, with a ramp.
  const std::uint64_t pauses = turns_.pauses();
  passed.jumped = pauses != pauses_;
  pauses_ = pauses;
  link_->pass(passed, now);
  return link_->force(now);
}

void HdExchange::let_go() {
  const std::lock_guard lock(link_guard_);
  link_ = nullptr;
}

bool HdExchange::is_let_go() {
  const std::lock_guard lock(link_guard_);
  return link_ == nullptr;
}

PointerState HdExchange::read() const {
  // A part that the library does not set stays NaN, which the link refuses.
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  std::array<double, 3> position = {kNothing, kNothing, kNothing};
  std::array<double, 3> velocity = position;
  std::array<double, 16> columns;
  columns.fill(kNothing);
  int buttons = 0;
  hd_.get_doublev(HdLibrary::kPosition, position.data());
  hd_.get_doublev(HdLibrary::kVelocity, velocity.data());
  hd_.get_doublev(HdLibrary::kTransform, columns.data());
  hd_.get_integerv(HdLibrary::kButtons, &buttons);
  PointerState reading;
  reading.position = kMetre * Vector3(position[0], position[1], position[2]);
  reading.velocity = kMetre * Vector3(velocity[0], velocity[1], velocity[2]);
  const base::Matrix3 turned = Eigen::Map<const Eigen::Matrix4d>(columns.data()).topLeftCorner<3, 3>();
  reading.orientation = Quaternion(turned);
  reading.buttons = static_cast<std::uint32_t>(buttons);
  return reading;
}

void HdExchange::send(const Vector3& force) const {
  const std::array<double, 3> newtons = {force.x(), force.y(), force.z()};
  hd_.set_doublev(HdLibrary::kForce, newtons.data());
}

void HdExchange::take_errors(std::int64_t now) {
  bool is_failing = false;
  for (HdError error = hd_.get_error(); error.code != 0; error = hd_.get_error()) {
    switch (error.code) {
      case HdLibrary::kWarmMotors:
        warnings_->note(std::size_t(HdWarning::Hot), now);
        break;
      case HdLibrary::kExceededForce:
        warnings_->note(std::size_t(HdWarning::TooStrong), now);
        break;
      case HdLibrary::kDeviceFault:
      case HdLibrary::kCommunication:
        failure_.store(error.code, std::memory_order_release);
        return;
      default:
        warnings_->note(std::size_t(HdWarning::Other), now);
        if (!is_failing && ++failing_frames_ >= kMostFailingFrames) {
          failure_.store(error.code, std::memory_order_release);
          return;
        }
        is_failing = true;
    }
  }
  if (!is_failing) failing_frames_ = 0;
}

bool HdExchange::rest() {
  const HdTurns::Turn turn = turns_.take(kRestPatience);
  if (turn) rest_in_turn();
  return turn.owns_lock();
}

void HdExchange::rest_in_turn() {
  hd_.make_current_device(device_);
  hd_.begin_frame(device_);
  send(Vector3::Zero());
  hd_.end_frame(device_);
  hd_.disable(HdLibrary::kForceOutput);
  static_cast<void>(hd_.first_error());
}

std::optional<unsigned> HdExchange::calibration() {
  if (hd_.check_calibration == nullptr) return std::nullopt;
  const HdTurns::Turn turn = turns_.take(kFramePatience);
  if (!turn) return std::nullopt;
  hd_.make_current_device(device_);
  const unsigned state = hd_.check_calibration();
  static_cast<void>(hd_.first_error());
  return state;
}

}  // namespace icome::devices
