#include "haptics/servo/servo.h"

#include <algorithm>
#include <numeric>

#include "base/clock.h"
#include "haptics/effects/mass_shares.h"

namespace icome::haptics {
namespace {

DeviceLimits limits_of(const devices::DeviceInfo& device, double rate_hz) {
  return {device.nominal_stiffness, device.effective_mass, 1.0 / rate_hz, device.max_force};
}

/// Time in which the workspace moves to the pose it is carried to: longer than the main thread takes from
/// one call to the next, so that the tip goes on without a halt.
constexpr double kCarrySeconds = 0.02;  // s

/// Measures the stages of a tick, one after the other.
class StageClock {
 public:
  explicit StageClock(std::array<std::int64_t, kStages>& stages)
      : stages_(stages), last_(base::steady_nanoseconds()) {}

  void ends(Stage stage) {
    const std::int64_t now = base::steady_nanoseconds();
    stages_[std::size_t(stage)] = now - last_;
    last_ = now;
  }

 private:
  std::array<std::int64_t, kStages>& stages_;
  std::int64_t last_;
};

}  // namespace

std::int64_t TickReport::delay_ns() const {
  return std::accumulate(stage_ns.begin() + std::size_t(Stage::Scene),
                         stage_ns.begin() + std::size_t(Stage::Write), std::int64_t{0});
}

std::int64_t TickReport::own_ns() const { return delay_ns() + stage_ns[std::size_t(Stage::Ahead)]; }

Servo::Servo(devices::PointerDevice& device, const ServoSettings& settings)
    : device_(device),
      settings_(settings),
      feed_(limits_of(device.info(), settings.rate_hz)),
      effect_feed_(limits_of(device.info(), settings.rate_hz)),
      solver_(make_solver(settings.renderer, settings.scp)),
      limiter_(device.info(), settings.limiter),
      carried_(settings.world_from_device),
      world_from_device_(settings.world_from_device) {}

std::vector<CappedEffect> Servo::capped_effects() const {
  return effect_feed_.capped(feed_.published_mass_needed());
}

std::string Servo::capped_surface(const Surface& surface) const {
  const DeviceLimits limits = limits_of(device_.info(), settings_.rate_hz);
  const double asked = surface.stiffness > 0.0 ? surface.stiffness : limits.nominal_stiffness;
  const double needs = mass_needed(asked, surface.damping, limits.effective_mass, limits.dt);
  const double mass = mass_share(limits.effective_mass, needs, needs + effect_feed_.published_mass_needed());
  return capped_spring(mass, limits.dt, asked, surface.damping);
}

const TickReport& Servo::tick(double dt) {
  StageClock clock(report_.stage_ns);
  const bool fresh = read();
  const bool carried = move_workspace(dt);
  if (has_state_) report_stylus();
  clock.ends(Stage::Read);
  follow_scene(dt);
  effect_feed_.follow(dt);
  follow_grip();
  clock.ends(Stage::Scene);
  if (fresh || (has_state_ && (carried || state_.parked))) find_contact();
  clock.ends(Stage::Contact);
  Vector3 wanted = surface_force();
  wanted += effect_force(dt);
  if (!gives_forces_.load(std::memory_order_relaxed)) wanted.setZero();
  report_.force = limiter_.limit(
      wanted, dt, {fresh, report_.status != devices::DeviceStatus::Lost, report_.contact.started_inside});
  shading_.acts(wanted.isZero(0.0) ? 0.0 : std::min(1.0, report_.force.norm() / wanted.norm()));
  clock.ends(Stage::Force);
  const devices::DeviceStatus written =
      device_.write(world_from_device_.linear().transpose() * report_.force);
  if (written == devices::DeviceStatus::Lost) report_.status = written;
  clock.ends(Stage::Write);
  solver_->look_ahead();
  clock.ends(Stage::Ahead);
  time_ += dt;
  return report_;
}

/// True when the device gave a new, finite state.
bool Servo::read() {
  devices::PointerState state = state_;
  report_.status = device_.read(state);
  if (report_.status != devices::DeviceStatus::Ok) return false;
  if (!state.position.allFinite() || !state.velocity.allFinite()) {
    report_.status = devices::DeviceStatus::Stalled;
    return false;
  }
  const bool laid_aside = state.parked && !state_.parked;
  shading_.settle(state.jumped || !has_state_ ? Vector3::Zero() : Vector3(state.position - state_.position));
  state_ = state;
  has_state_ = true;
  if (laid_aside || (state.jumped && !state.parked)) {
    solver_->reset();
    effect_feed_.reset();
  }
  // The workspace's own speed is left out: it comes in jerks from the caller of carry(), which damping
  // would turn into jerks of the force.
  tip_velocity_ = world_from_device_.linear() * state.velocity;
  return true;
}

void Servo::report_stylus() {
  report_.tip = world_from_device_ * state_.position;
  report_.orientation = devices::Quaternion(world_from_device_.linear()) * state_.orientation;
  report_.device_from_stylus = Eigen::Translation3d(state_.position) * state_.orientation;
  report_.buttons = state_.buttons;
}

/// True when the workspace lies elsewhere than in the last tick.
bool Servo::move_workspace(double dt) {
  if (carried_.update()) carry_seconds_ = kCarrySeconds;
  if (carry_seconds_ <= 0.0) return false;
  const Pose& goal = carried_.read();
  const double share = dt < carry_seconds_ ? std::max(dt, 0.0) / carry_seconds_ : 1.0;
  carry_seconds_ -= dt;
  if (share == 1.0) {
    carry_seconds_ = 0.0;
    world_from_device_ = goal;
    return true;
  }
  world_from_device_ = between(world_from_device_, goal, share);
  return true;
}

void Servo::follow_scene(double dt) {
  elapsed_ += dt;
  const PublishedScene* newer = feed_.take();
  if (newer == nullptr) return;
  scene_ = newer;
  elapsed_ = 0.0;
  solver_->adopt(*newer->scene, newer->changes);
  report_.contact = solver_->state();  // names its object by its place in the new scene
  feed_.done_before(*newer);
}

/// A released thing is touched afresh, from the place of the tip.
void Servo::follow_grip() {
  const bool held = grip_.read().holds;
  if (grip_.update() && held && !grip_.read().holds) solver_->reset();
}

void Servo::find_contact() {
  if (state_.parked || grip_.read().holds) {
    report_.contact = {};
    report_.contact.scp = report_.tip;
    return;
  }
  report_.contact = solver_->step(report_.tip, elapsed_);
  report_.time = (scene_ == nullptr ? 0.0 : scene_->scene->moment()) + elapsed_;
  if (!report_.contact.touching) return;
  const HapticObject& object = scene_->scene->objects()[report_.contact.object];
  report_.object = object.id;
  const double asked = object.surface.stiffness;
  report_.asked_stiffness = asked > 0.0 ? asked : device_.info().nominal_stiffness;
  report_.stiffness = felt_surface().stiffness;
}

/// Stiffness and damping of the touched surface beside the effects. Holds no texture: the servo never owns
/// one.
Surface Servo::felt_surface() const {
  const Surface& made = (*scene_->surfaces)[report_.contact.object];
  Surface felt{.stiffness = made.stiffness, .damping = made.damping, .damping_depth = made.damping_depth};
  const double effects = effect_feed_.mass_needed();
  if (effects <= 0.0) return felt;
  const double mass = device_.info().effective_mass;
  const double dt = 1.0 / settings_.rate_hz;
  const double needs = mass_needed(made.stiffness, made.damping, mass, dt);
  make_stable(felt, made.stiffness, mass_share(mass, needs, needs + effects), dt);
  return felt;
}

/// Part of the device's mass, kg, for the grip or the surfaces. Surfaces count also where none is touched:
/// effects that gave way to a surface in the moment of touching it would give energy.
double Servo::mass_needed_beside_effects(double dt) const {
  if (grip_.read().holds) return grip_mass_needed(grip_.read(), device_.info().effective_mass, dt);
  return scene_ == nullptr ? 0.0 : scene_->mass_needed;
}

Vector3 Servo::surface_force() {
  const ScpState& contact = report_.contact;
  if (!contact.touching) return Vector3::Zero();
  const Surface surface = felt_surface();
  Vector3 force = spring_damper_force(
      {report_.tip, contact.scp, tip_velocity_, contact.surface_velocity, contact.normal}, surface);
  if (settings_.force_shading) force = shaded(force);
  const HapticTexture* const texture = (*scene_->surfaces)[contact.object].texture.get();
  if (texture == nullptr) return force;
  const Pose world_from_object = scene_->scene->pose(contact.object, elapsed_);
  const Pose object_from_world = world_from_object.inverse();
  TextureSample sample =
      texture->sample(object_from_world * contact.scp, object_from_world.linear() * contact.normal);
  sample.gradient = world_from_object.linear() * sample.gradient;
  return textured_force(force, contact.normal, surface.stiffness, sample);
}

/// The force with its normal part turned to the interpolated normal, as far as the tank pays for it: facets
/// feel round. (Round a convex facet the hand pays on the way to its middle what it gets back after it.)
Vector3 Servo::shaded(const Vector3& force) {
  const ScpState& contact = report_.contact;
  const HapticObject& object = scene_->scene->objects()[contact.object];
  const Pose world_from_object = scene_->scene->pose(contact.object, elapsed_);
  const Pose object_from_world = world_from_object.inverse();
  const Vector3 normal = world_from_object.linear() *
                         object.shape->shading_normal(contact.feature, object_from_world * contact.scp,
                                                      object_from_world.linear() * contact.normal);
  const double press = force.dot(contact.normal);
  const base::Matrix3 world_from_device = world_from_device_.linear();
  const Vector3 turn = world_from_device.transpose() * (press * (normal - contact.normal));
  return force + world_from_device * shading_.give(turn);
}

EffectInput Servo::effect_input(double dt) const {
  EffectInput input;
  input.time = time_;
  input.dt = dt;
  input.position = report_.tip;
  input.velocity = tip_velocity_;
  input.scp = report_.contact.touching ? report_.contact.scp : report_.tip;
  input.touching = report_.contact.touching;
  input.device_mass = device_.info().effective_mass;
  return input;
}

Vector3 Servo::effect_force(double dt) {
  if (state_.parked) return Vector3::Zero();
  const EffectInput input = effect_input(dt);
  const double beside = mass_needed_beside_effects(dt);
  EffectInput held = input;
  held.device_mass = mass_share(input.device_mass, beside, beside + effect_feed_.mass_needed());
  return grip_force(grip_.read(), held) + effect_feed_.force(input, beside);
}

}  // namespace icome::haptics
