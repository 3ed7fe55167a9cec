#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "devices/pointer_device.h"
#include "haptics/effects/energy_tank.h"
#include "haptics/effects/grip.h"
#include "haptics/servo/effect_feed.h"
#include "haptics/servo/force_limiter.h"
#include "haptics/servo/renderer.h"
#include "haptics/servo/scene_feed.h"
#include "realtime/latest_value.h"

namespace icome::haptics {

struct ServoSettings {
  double rate_hz = 1000.0;  // Hz, 500 to 10,000
  Renderer renderer = Renderer::Exact;
  ScpSettings scp;
  LimiterSettings limiter;
  Pose world_from_device = Pose::Identity();  // initial pose of the device's workspace
  /// Feel interpolated normals (Shape::shading_normal). Their force belongs to no shape and could feed the
  /// hand: an EnergyTank bounds it.
  bool force_shading = false;
};

/// The stages of a tick, in their order. There are no more than somebody asks for: reading the clock takes
/// as long as many a stage.
enum class Stage : std::uint8_t { Read, Scene, Contact, Force, Write, Ahead };
constexpr std::size_t kStages = 6;

/// Report of one tick; world frame.
struct TickReport {
  devices::DeviceStatus status = devices::DeviceStatus::Stalled;
  Vector3 tip = Vector3::Zero();                                // m
  base::Quaternion orientation = base::Quaternion::Identity();  // world_from_stylus
  Pose device_from_stylus = Pose::Identity();                   // m, as the device said it last
  std::uint32_t buttons = 0;                                    // bit i: button i is down
  Vector3 force = Vector3::Zero();                              // N, as written, in the world frame
  ScpState contact;
  double time = 0.0;             // s, on the scene's clock (HapticScene::moment): when the contact was found
  ObjectId object;               // touched object, when contact.touching
  double asked_stiffness = 0.0;  // N/m, asked for by the touched object, or the device's nominal one
  double stiffness = 0.0;        // N/m, as it is felt: no more than is stable
  std::array<std::int64_t, kStages> stage_ns{};  // time spent in each stage

  /// Time between device input and output, ns: the delay of the force.
  std::int64_t delay_ns() const;
  /// Time of the tick without device input and output, ns.
  std::int64_t own_ns() const;
};

/// The servo's tick: reads the device, goes over to the newest scene, finds the surface contact point,
/// makes a force of it, adds effects, limits, writes. Owns the solver and the limiter; the device is the
/// caller's and outlives it. One thread calls tick(), a loop or a test; another may call publish() and
/// publish_effects(), one carry() and one grip().
class Servo {
 public:
  Servo(devices::PointerDevice& device, const ServoSettings& settings);

  /// The scene to touch from the next tick on; check_renderer says whether the renderer can. From one
  /// thread, the main one.
  void publish(std::shared_ptr<const HapticScene> scene) { feed_.publish(std::move(scene)); }

  /// The effects that are felt from the next tick on. They share the stable range of the device with the
  /// surfaces and the held thing (mass_shares.h). From the same thread.
  void publish_effects(const std::vector<PlacedEffect>& effects) { effect_feed_.publish(effects); }

  /// The effects among those published last that are felt softer than they were asked for. From the
  /// same thread.
  std::vector<CappedEffect> capped_effects() const;
  /// Names the reductions of a surface felt beside these effects; empty: none. From the same thread.
  std::string capped_surface(const Surface& surface) const;

  /// Sets the pose of the device's workspace in the world: it moves there smoothly within some ticks,
  /// sweeping the tip along as a hand would. The pose is finite. From one thread, the main one.
  void carry(const Pose& world_from_device) { carried_.publish(world_from_device); }

  /// Sets the feel of the held thing from now on. While the hand holds something it touches nothing: the
  /// held thing goes along with the tip. From one thread, the main one.
  void grip(const GripFeel& feel) { grip_.publish(feel); }

  /// Switches all forces on or off from now on; contacts are found and reported in both cases. A force
  /// comes and goes as fast as the limiter lets it. Any thread. Real-time safe.
  void give_forces(bool given) { gives_forces_.store(given, std::memory_order_relaxed); }

  /// Lets forces grow from none, as for a device that has just come. Before the first tick.
  void begin_softly() { limiter_.restart(); }

  /// One turn of the servo loop, `dt` seconds after the last. Real-time safe.
  const TickReport& tick(double dt);

  const TickReport& last() const { return report_; }
  const ForceLimiter& limiter() const { return limiter_; }

 private:
  bool read();
  void report_stylus();
  bool move_workspace(double dt);
  void follow_scene(double dt);
  void follow_grip();
  void find_contact();
  Surface felt_surface() const;
  double mass_needed_beside_effects(double dt) const;
  Vector3 surface_force();
  Vector3 shaded(const Vector3& force);
  EffectInput effect_input(double dt) const;
  Vector3 effect_force(double dt);

  devices::PointerDevice& device_;
  ServoSettings settings_;
  SceneFeed feed_;
  EffectFeed effect_feed_;
  std::unique_ptr<ContactSolver> solver_;
  ForceLimiter limiter_;
  const PublishedScene* scene_ = nullptr;  // null until the first publish()
  double elapsed_ = 0.0;                   // s since the scene was taken
  double time_ = 0.0;                      // s since the first tick
  realtime::LatestValue<Pose> carried_;
  realtime::LatestValue<GripFeel> grip_;
  std::atomic<bool> gives_forces_ = true;
  Pose world_from_device_;
  double carry_seconds_ = 0.0;  // s, until it is at the pose it was carried to
  devices::PointerState state_;
  bool has_state_ = false;
  EnergyTank shading_;                      // device frame
  Vector3 tip_velocity_ = Vector3::Zero();  // m/s, world; of the hand, not of the workspace
  TickReport report_;
};

}  // namespace icome::haptics
