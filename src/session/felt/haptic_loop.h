#pragma once
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "devices/pointer_device.h"
#include "haptics/servo/servo.h"
#include "realtime/latest_value.h"
#include "realtime/loop.h"
#include "realtime/message_pipe.h"
#include "session/display/display_feed.h"
#include "session/hands/pointer_view.h"

namespace icome::session {

/// The hands of a session: one thread that ticks a servo for each pointer device and tells main and display
/// after each tick where the pointers are. Owns devices, servos and thread.
class HapticLoop {
 public:
  /// Takes the devices; those that are lost are asked again at every tick. The display outlives this, and has
  /// as many pointers.
  HapticLoop(std::vector<std::unique_ptr<devices::PointerDevice>> devices,
             const haptics::ServoSettings& settings, DisplayFeed& display);

  /// Starts to tick, once. Fails as LoopRunner does.
  base::Result<void> start(bool realtime_priority);
  /// Ends ticking; devices feel no force any more.
  void stop();

  // The main thread.
  std::size_t pointers() const { return hands_.size(); }
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
  /// Ticks that found no room, so far, as main had not called for seconds.
  std::uint64_t lost_ticks() const { return lost_ticks_.load(std::memory_order_relaxed); }
  /// The loop of the thread; null before the start.
  const realtime::LoopRunner* loop() const { return loop_.get(); }
  /// Ticks so far.
  std::uint64_t ticks() const { return ticks_.load(std::memory_order_acquire); }

  /// The servos, for those who publish to them.
  std::vector<haptics::Servo*> servos();

 private:
  struct Hand {
    std::unique_ptr<devices::PointerDevice> device;
    std::unique_ptr<haptics::Servo> servo;
    base::Pose stage_from_device;                                   // main's
    realtime::LatestValue<PointerView> to_main;                     // from the servo
    std::uint64_t losses = 0;                                       // so far; the servo's
    devices::DeviceStatus status = devices::DeviceStatus::Stalled;  // at the last tick; the servo's
  };
  bool tick(const realtime::TickInfo& info);
  void sample_force(const haptics::TickReport& report, std::int64_t time);

  std::vector<std::unique_ptr<Hand>> hands_;
  double rate_hz_;
  DisplayFeed& display_;
  realtime::MessagePipe<ForceSample> forces_;
  ForceSample sample_ = {};  // being gathered; the servo's, as the next two
  int ticks_of_sample_ = 0;
  int ticks_a_sample_;
  realtime::MessagePipe<PointerView> trace_;
  std::atomic<bool> traces_ = false;
  std::atomic<std::uint64_t> lost_ticks_ = 0;
  std::atomic<std::uint64_t> ticks_ = 0;
  std::unique_ptr<realtime::LoopRunner> loop_;  // last: stops before the rest goes
};

}  // namespace icome::session
