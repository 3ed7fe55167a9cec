#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "devices/pointer_device.h"
#include "haptics/servo/servo.h"
#include "interaction/shaping/shaping.h"
#include "realtime/loop.h"
#include "session/felt/haptic_representation.h"
#include "session/hands/hand_grab.h"
#include "session/hands/pointer_connection.h"
#include "session/hands/pointer_view.h"
#include "session/hands/surroundings.h"

namespace icome::session {

struct SessionParts;

/// The state of the servo loop.
struct ServoHealth {
  bool running = false;
  double rate_hz = 0.0;  // as asked for
  realtime::LoopSummary summary = {};
  std::array<std::uint64_t, realtime::LoopRecorder::kLoadBins> load_histogram = {};  // since the start
  std::string notice = {};  // what the system refused; or empty
};

/// A pointer's device as a person knows it.
struct PointerUse {
  std::uint64_t number = 0;   // of the pointer, which keeps it wherever its index goes
  std::string address = {};   // by which it was opened; empty: it was not connected by one
  std::string identity = {};  // devices::identity_of() of it; empty: not known
  /// The mapping that it is used through; its scale is the one of now. None: it has none to change.
  std::optional<devices::DeviceMapping> mapping = {};
  double own_radius = 0.0;     // m, of its workspace in the device's frame
  std::string condition = {};  // PointerDevice::condition()
  bool is_mouse = false;       // the mouse drives it
  bool clutched = false;       // its clutch is held
  bool shows_workspace = false;
};

/// The pointers of a session: what they touch and hold, how things are dragged, the hand that the mouse
/// drives, and how the servo is doing. Main's.
class SessionHands {
 public:
  explicit SessionHands(SessionParts& parts) : parts_(parts) {}
  SessionHands(const SessionHands&) = delete;
  SessionHands& operator=(const SessionHands&) = delete;

  std::size_t pointers() const;
  const PointerView& pointer(std::size_t index) const;
  const devices::DeviceInfo& pointer_info(std::size_t index) const;
  /// Effects that the first pointer feels softer than they were asked for, so that they are stable.
  const std::vector<haptics::CappedEffect>& capped_effects() const;
  /// The object that a pointer touches.
  std::optional<world::ObjectId> touched(std::size_t index) const;
  /// Does the pointer hold something? While button 0 is down, the object that it touched goes along with it
  /// (HandGrab), or the one that the technique holds, with the first pointer.
  bool holds(std::size_t index) const;
  /// Lets hands take hold of points of shapes, not of objects (PointGrab), and shows these; without settings,
  /// not any more. Fails as Shaping::set() does, changing nothing.
  base::Result<void> set_shaping(const std::optional<interaction::ShapingSettings>& settings);
  /// The handles of shapes; null while objects are dragged, not points.
  interaction::Shaping* shaping();
  /// Sets how things are moved from now on, and how that feels.
  void set_grab(const GrabSettings& settings);
  const GrabSettings& grab() const;
  /// The surroundings that moved things stop at and snap to.
  Surroundings& surroundings();
  /// Is the first pointer the simulated hand that the mouse drives?
  bool is_mouse_driven() const;
  /// The pointer that the mouse drives: the last one; none where the session was given its pointers.
  std::optional<std::size_t> mouse() const;

  /// Takes a device in while all goes on: its forces begin with the ramp, its workspace lies where those of
  /// the others do, and it is shown for two seconds. The devices come in the order of connecting, then the
  /// mouse's hand. Gives its index. Fails where there are too many.
  base::Result<std::size_t> connect(PointerConnection connection);
  /// Lets go of a pointer, and of what it holds: the next ones move up. Its device is without force some
  /// ticks later, and is closed by a thread of its own. The last pointer makes place for the mouse's hand.
  /// Fails for that hand.
  base::Result<void> disconnect(std::size_t index);
  /// Is the device of this address, or of this identity where it is known, still being closed? Until then it
  /// cannot be opened again.
  bool is_closing(const std::string& address, const std::string& identity = {}) const;
  /// How a pointer's device is used.
  PointerUse use(std::size_t index) const;
  /// Changes the mapping of a connected device: it is let go of, and comes back softly some ticks later.
  /// Fails where it has none, and on values out of the ranges of DeviceMapping.
  base::Result<void> set_mapping(std::size_t index, const devices::DeviceMapping& mapping);
  /// Shows the workspace of a pointer in the scene, or only for two seconds after it has come or changed, and
  /// while its clutch is held.
  void show_workspace(std::size_t index, bool shown);
  /// Keeps the first pointer at a place of the stage by springs, where it touches nothing, or lets it go.
  /// Only with GrabSettings::takes_hold set to false: hands that take hold have springs of their own.
  void hold_pointer(const std::optional<base::Vector3>& place);
  /// Servo::give_forces() for all pointers.
  void give_forces(bool given);
  /// Begins to keep every tick of the first pointer, or ends that.
  void trace(bool on);
  /// Ticks since the last call, oldest first, of which some seconds are kept.
  struct Ticks {
    std::vector<PointerView> ticks;
    std::uint64_t lost = 0;                     // ticks in all that found no room
    std::shared_ptr<const TouchedNames> names;  // for PointerView::touched; null before the first
  };
  Ticks take_trace();
  /// Sets the place that the hand of the mouse-driven pointer aims at, stage frame; surfaces may keep it
  /// away. Without effect on other devices.
  void aim(const base::Vector3& position);
  /// Puts that hand there without a way in between, as a pen is lifted and set down elsewhere.
  void put(const base::Vector3& position);
  /// Holds these buttons of that hand down (bit i: button i).
  void hold_buttons(std::uint32_t buttons);
  /// Puts it at the eye, out of sight and touching nothing, and keeps it there until it is aimed or put
  /// again.
  void park();
  ServoHealth servo() const;
  /// Samples of the first pointer's force since the last call, oldest first, some 200 a second.
  std::vector<ForceSample> take_forces();

 private:
  SessionParts& parts_;
};

}  // namespace icome::session
