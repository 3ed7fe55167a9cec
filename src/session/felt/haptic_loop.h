#pragma once
#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/mapped_device.h"
#include "devices/pointer_device.h"
#include "haptics/servo/servo.h"
#include "realtime/latest_value.h"
#include "realtime/loop.h"
#include "realtime/message_pipe.h"
#include "session/display/display_feed.h"
#include "session/felt/felt_servos.h"
#include "session/hands/pointer_view.h"

namespace icome::session {

/// A tick of a pointer, as a menu in the scene follows it.
struct PointerTick {
  std::size_t pointer = 0;
  std::int64_t time = 0;                      // ns, steady clock
  base::Vector3 tip = base::Vector3::Zero();  // m, stage frame
  std::uint32_t buttons = 0;                  // bit i: button i is down
};

/// The hands of a session: one thread that ticks a servo for each pointer device and tells main and display
/// after each tick where the pointers are. Pointers come and go while it runs, and nobody waits for that: the
/// force of one that goes is none before it is let go of, the forces of one that comes begin with the ramp,
/// and the others feel nothing of it. Owns devices, servos and thread.
class HapticLoop {
 public:
  static constexpr std::size_t kMostPointers = 8;

  /// Takes the devices, at most kMostPointers; those that are lost are asked again at every tick. The display
  /// outlives this.
  HapticLoop(std::vector<std::unique_ptr<devices::PointerDevice>> devices,
             const haptics::ServoSettings& settings, DisplayFeed& display);

  /// Starts to tick, once. Fails as LoopRunner does.
  base::Result<void> start(bool realtime_priority);
  /// Ends ticking; devices feel no force any more.
  void stop();

  // The main thread.
  std::size_t pointers() const { return hands_.size(); }
  /// May another pointer come now? False while there are too many, those on their way out included.
  bool has_room() const { return hands_.size() < kMostPointers && going_.size() < kMostPointers; }
  /// Lets a device take part from the next tick on, as the pointer of that place, at that pose of its
  /// workspace. While there is room.
  void add(std::size_t place, std::unique_ptr<devices::PointerDevice> device,
           const base::Pose& stage_from_device);
  void add(std::size_t place, std::unique_ptr<devices::MappedDevice> device,
           const base::Pose& stage_from_device);
  /// Takes a pointer out: the next ones move up. Its device, which this names, comes from take_gone() after
  /// some ticks, without force.
  const devices::PointerDevice* remove(std::size_t pointer);
  /// The devices that were taken out and are used no more.
  std::vector<std::unique_ptr<devices::PointerDevice>> take_gone();
  /// The mapping of a pointer's device; null where it has none that could be changed.
  devices::MappedDevice* mapped(std::size_t pointer) const { return hands_[pointer]->mapped; }
  /// Lets a mapped pointer go on with another mapping, as if it went and came: it keeps its place, and is
  /// away for some ticks.
  void remap(std::size_t pointer, const devices::DeviceMapping& mapping);
  /// Is the pointer on its way to another mapping?
  bool is_away(std::size_t pointer) const { return hands_[pointer]->wanted.has_value(); }
  const std::optional<devices::DeviceMapping>& wanted(std::size_t pointer) const {
    return hands_[pointer]->wanted;
  }

  const devices::DeviceInfo& info(std::size_t pointer) const { return hands_[pointer]->device->info(); }
  /// PointerDevice::condition() of a pointer's device.
  std::string condition(std::size_t pointer) const { return hands_[pointer]->device->condition(); }
  /// The servo's last report on a pointer, as update() took it in.
  const PointerView& view(std::size_t pointer) const { return hands_[pointer]->to_main.read(); }
  void update();
  /// Carries the device's workspace to a place of the stage; a pose that is not finite is passed over.
  void carry(std::size_t pointer, const base::Pose& stage_from_device);
  /// Sets the feel of the thing that the hand holds, from now on.
  void grip(std::size_t pointer, const haptics::GripFeel& feel);
  /// The place to which the workspace was carried last.
  const base::Pose& stage_from_device(std::size_t pointer) const {
    return hands_[pointer]->stage_from_device;
  }
  /// Servo::give_forces() of one pointer.
  void give_forces(std::size_t pointer, bool given);
  /// Samples of the first pointer's force since the last call, some 200 a second.
  std::vector<ForceSample> take_forces();
  /// Begins to keep every tick of the first pointer, or ends that.
  void trace(bool on) { traces_.store(on, std::memory_order_relaxed); }
  /// The ticks kept since the last call, oldest first.
  std::vector<PointerView> take_trace();
  /// Begins to keep the ticks of all pointers, or ends that.
  void watch(bool on) { watches_.store(on, std::memory_order_relaxed); }
  /// The ticks of all pointers since the last call, oldest first; where main has not called for seconds, the
  /// newest are not among them.
  std::vector<PointerTick> take_watched();
  /// Ticks that found no room, so far, as main had not called for seconds.
  std::uint64_t lost_ticks() const { return lost_ticks_.load(std::memory_order_relaxed); }
  /// The loop of the thread; null before the start.
  const realtime::LoopRunner* loop() const { return loop_.get(); }
  /// Ticks so far.
  std::uint64_t ticks() const { return ticks_.load(std::memory_order_acquire); }

  /// The servos, for those who publish to them.
  FeltServos& felt() { return felt_; }

 private:
  struct Hand {
    std::unique_ptr<devices::PointerDevice> device;
    devices::MappedDevice* mapped = nullptr;  // the device, where it is one with a mapping
    std::unique_ptr<haptics::Servo> servo;
    base::Pose stage_from_device = base::Pose::Identity();          // main's
    bool gives_forces = true;                                       // main's
    std::optional<devices::DeviceMapping> wanted = {};              // main's: it is on its way to this one
    std::uint64_t out_since = 0;                                    // main's: number of the roster without it
    realtime::LatestValue<PointerView> to_main;                     // from the servo
    std::uint64_t losses = 0;                                       // so far; the servo's
    devices::DeviceStatus status = devices::DeviceStatus::Stalled;  // at the last tick; the servo's
    double leaving = 0.0;                                           // s since it was let go of; the servo's
    std::atomic<bool> in_use = false;                               // by the servo
  };
  /// The pointers of one moment, by place; null: a place that is empty for now.
  struct Roster {
    std::uint64_t number = 0;
    std::array<Hand*, kMostPointers> hands = {};
  };

  void insert(std::size_t place, std::unique_ptr<Hand> hand, const base::Pose& stage_from_device);
  void make_servo(Hand& hand);
  void publish_roster();
  bool is_out(const Hand& hand) const;
  void finish_remaps();

  bool tick(const realtime::TickInfo& info);
  void take_roster();
  void tick_hand(std::size_t place, Hand& hand, double dt, std::int64_t time);
  void tick_leaving(double dt);
  void sample_force(const haptics::TickReport& report, std::int64_t time);

  haptics::ServoSettings settings_;
  DisplayFeed& display_;
  FeltServos felt_;
  std::vector<std::unique_ptr<Hand>> hands_;
  std::vector<std::unique_ptr<Hand>> going_;  // taken out, and perhaps still used by the servo
  std::uint64_t roster_number_ = 0;           // of the last one published
  realtime::LatestValue<Roster> roster_;
  std::atomic<std::uint64_t> roster_taken_ = 0;  // number of the one that the servo has
  // The servo's.
  Roster now_ = {};
  std::array<Hand*, 2 * kMostPointers> leaving_ = {};  // null: a free place
  realtime::MessagePipe<ForceSample> forces_;
  ForceSample sample_ = {};  // being gathered; the servo's, as the next two
  int ticks_of_sample_ = 0;
  int ticks_a_sample_;
  realtime::MessagePipe<PointerView> trace_;
  std::atomic<bool> traces_ = false;
  realtime::MessagePipe<PointerTick> watched_;
  std::atomic<bool> watches_ = false;
  std::atomic<std::uint64_t> lost_ticks_ = 0;
  std::atomic<std::uint64_t> ticks_ = 0;
  std::unique_ptr<realtime::LoopRunner> loop_;  // last: stops before the rest goes
};

}  // namespace icome::session
