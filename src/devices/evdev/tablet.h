#pragma once
#include <cstddef>
#include <cstdint>

#include "base/result.h"
#include "devices/evdev/input_reader.h"
#include "devices/evdev/stepped_velocity.h"

namespace icome::devices {

struct TabletSettings {
  double depth = 0.005;          // m, of the tip below the tablet's plane at full pressure, 0 to 0.1
  double resolution = 1e5;       // counts/m, of tablets that do not tell theirs, usually 1e5 or 2e5
  double hover = 0.01;           // m, height at the largest distance, of tablets that do not tell its unit
  double lift = 0.002;           // m, height of a hovering pen whose tablet tells no distance
  double tilt = 1.117;           // rad, tilt at the end of the range, of tablets that do not tell its unit
  bool lies_as_on_desk = false;  // see Tablet
};

/// The pointer of a pen tablet. The middle of the tablet is the device's origin, its right is the device's
/// right. As a person at a screen expects, the tablet's plane is the screen's: the tablet's far edge is up,
/// and pressing goes into the screen (-z). With `lies_as_on_desk` it lies as the tablet does: its far edge is
/// away from the user (-z), and pressing goes down. An untilted pen's orientation is the identity when the
/// plane is the screen's; a stylus's z goes from tip to top. Buttons: 0 touch, 1 and 2 of the pen, 3 its
/// eraser is used. Parked while no pen is near. Lengths are by the tablet's own resolution where it tells it.
class Tablet final : public InputReader {
 public:
  explicit Tablet(const TabletSettings& settings = {}) : settings_(settings) {}

  DeviceInfo begin(const InputAbilities& abilities) override;
  void take(const InputEvent& event) override { state_.take(event); }
  void frame(std::int64_t time) override;
  void missed() override { jumped_ = true; }
  void pass(DriverLink& link, std::int64_t now) override;

  /// The state of the newest frame; its velocity is that of the last pass().
  const PointerState& pointer() const { return pointer_; }

 private:
  bool pen_is_near() const;
  bool touches() const;
  double share(std::size_t axis) const;
  double height();
  Vector3 place();
  Quaternion orientation() const;
  std::uint32_t buttons() const;

  TabletSettings settings_;
  InputAbilities abilities_;
  InputState state_;
  PointerState pointer_;
  Vector3 metres_per_count_ = Vector3::Zero();  // along x, y and height (of distance)
  double touch_distance_ = 0.0;                 // counts, of a pen that touches
  SteppedVelocity velocity_;
  bool jumped_ = false;
};

/// Settings as the environment variable ICOME_TABLET says: "depth=0.005 resolution=100000 hover=0.01
/// lift=0.002 tilt=1.117 desk=0"; desk: 0 or 1.
base::Result<TabletSettings> tablet_settings_from_environment();

}  // namespace icome::devices
