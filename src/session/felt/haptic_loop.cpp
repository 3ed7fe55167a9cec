#include "session/felt/haptic_loop.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/clock.h"

namespace icome::session {
namespace {

constexpr double kForceSamples = 200.0;       // a second
constexpr std::size_t kForceRoom = 200 * 30;  // half a minute without main
constexpr double kTraceRoom = 4.0;            // s of ticks without main
constexpr double kLongestLeaving = 0.1;       // s, until a force is taken away that does not go by itself

PointerView view_of(const haptics::TickReport& report, std::uint64_t losses, std::int64_t time) {
  PointerView view;
  view.time = time;
  view.status = report.status;
  view.tip = report.tip;
  view.orientation = report.orientation;
  view.device_from_stylus = report.device_from_stylus;
  view.buttons = report.buttons;
  view.touching = report.contact.touching;
  view.scp = view.touching ? report.contact.scp : report.tip;
  view.force = report.force;
  if (view.touching) {
    view.touched = report.object;
    view.asked_stiffness = report.asked_stiffness;
    view.stiffness = report.stiffness;
  }
  view.losses = losses;
  return view;
}

}  // namespace

HapticLoop::HapticLoop(std::vector<std::unique_ptr<devices::PointerDevice>> devices,
                       const haptics::ServoSettings& settings, DisplayFeed& display)
    : settings_(settings),
      display_(display),
      forces_(kForceRoom),
      ticks_a_sample_(std::max(1, int(std::lround(settings.rate_hz / kForceSamples)))),
      trace_(std::size_t(std::ceil(settings.rate_hz * kTraceRoom))),
      watched_(std::size_t(std::ceil(settings.rate_hz * kTraceRoom))) {
  for (auto& device : devices) {
    auto hand = std::make_unique<Hand>();
    hand->device = std::move(device);
    hand->stage_from_device = settings.world_from_device;
    make_servo(*hand);
    hands_.push_back(std::move(hand));
    felt_.add(*hands_.back()->servo, hands_.size() - 1);
  }
  publish_roster();
}

base::Result<void> HapticLoop::start(bool realtime_priority) {
  realtime::LoopSettings settings;
  settings.rate_hz = settings_.rate_hz;
  settings.realtime_priority = realtime_priority;
  // Locking all memory that a desktop with its designs has mapped would starve other programs.
  settings.lock_memory = false;
  auto loop =
      realtime::LoopRunner::create(settings, [this](const realtime::TickInfo& info) { return tick(info); });
  if (!loop) return tl::unexpected(loop.error());
  loop_ = std::move(*loop);
  return {};
}

void HapticLoop::stop() {
  if (!loop_ || !loop_->running()) return;
  loop_->stop();
  for (const auto& hand : hands_) hand->device->write(base::Vector3::Zero());
  for (const auto& hand : going_) hand->device->write(base::Vector3::Zero());
}

void HapticLoop::make_servo(Hand& hand) {
  haptics::ServoSettings settings = settings_;
  settings.world_from_device = hand.stage_from_device;
  hand.servo = std::make_unique<haptics::Servo>(*hand.device, settings);
  hand.servo->give_forces(hand.gives_forces);
}

void HapticLoop::add(std::size_t place, std::unique_ptr<devices::PointerDevice> device,
                     const base::Pose& stage_from_device) {
  auto hand = std::make_unique<Hand>();
  hand->device = std::move(device);
  insert(place, std::move(hand), stage_from_device);
}

void HapticLoop::add(std::size_t place, std::unique_ptr<devices::MappedDevice> device,
                     const base::Pose& stage_from_device) {
  auto hand = std::make_unique<Hand>();
  hand->mapped = device.get();
  hand->device = std::move(device);
  insert(place, std::move(hand), stage_from_device);
}

void HapticLoop::insert(std::size_t place, std::unique_ptr<Hand> hand, const base::Pose& stage_from_device) {
  hand->stage_from_device = stage_from_device;
  make_servo(*hand);
  if (hand->mapped || loop_) hand->servo->begin_softly();
  felt_.add(*hand->servo, place);
  hands_.insert(hands_.begin() + std::ptrdiff_t(place), std::move(hand));
  publish_roster();
}

const devices::PointerDevice* HapticLoop::remove(std::size_t pointer) {
  auto hand = std::move(hands_[pointer]);
  hands_.erase(hands_.begin() + std::ptrdiff_t(pointer));
  felt_.remove(*hand->servo);
  const bool was_away = hand->wanted.has_value();
  going_.push_back(std::move(hand));
  publish_roster();
  if (!was_away) going_.back()->out_since = roster_number_;
  return going_.back()->device.get();
}

void HapticLoop::remap(std::size_t pointer, const devices::DeviceMapping& mapping) {
  Hand& hand = *hands_[pointer];
  const bool was_away = hand.wanted.has_value();
  hand.wanted = mapping;
  if (was_away) return;
  felt_.remove(*hand.servo);
  publish_roster();
  hand.out_since = roster_number_;
}

/// Pointers on their way to another mapping leave their places empty.
void HapticLoop::publish_roster() {
  Roster roster;
  roster.number = ++roster_number_;
  for (std::size_t i = 0; i < hands_.size(); ++i)
    roster.hands[i] = hands_[i]->wanted ? nullptr : hands_[i].get();
  roster_.publish(roster);
}

/// Has the servo done with a hand that is on no roster any more? Without a servo's thread it always has.
bool HapticLoop::is_out(const Hand& hand) const {
  if (!loop_ || !loop_->running()) return true;
  return roster_taken_.load(std::memory_order_acquire) >= hand.out_since &&
         !hand.in_use.load(std::memory_order_acquire);
}

std::vector<std::unique_ptr<devices::PointerDevice>> HapticLoop::take_gone() {
  std::vector<std::unique_ptr<devices::PointerDevice>> gone;
  std::erase_if(going_, [&](std::unique_ptr<Hand>& hand) {
    if (!is_out(*hand)) return false;
    gone.push_back(std::move(hand->device));
    return true;
  });
  return gone;
}

void HapticLoop::finish_remaps() {
  bool is_new = false;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    Hand& hand = *hands_[i];
    if (!hand.wanted || !is_out(hand)) continue;
    hand.mapped->set_mapping(*std::exchange(hand.wanted, std::nullopt));
    make_servo(hand);
    hand.servo->begin_softly();
    felt_.add(*hand.servo, i);
    is_new = true;
  }
  if (is_new) publish_roster();
}

bool HapticLoop::tick(const realtime::TickInfo& info) {
  const std::int64_t time = base::steady_nanoseconds();
  take_roster();
  for (std::size_t i = 0; i < now_.hands.size(); ++i)
    if (now_.hands[i]) tick_hand(i, *now_.hands[i], info.dt, time);
  tick_leaving(info.dt);
  ticks_.store(ticks_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  return true;
}

/// Goes over to the newest roster; hands that are not on it begin to leave.
void HapticLoop::take_roster() {
  if (!roster_.update()) return;
  const Roster& next = roster_.read();
  const auto is_on = [](const auto& hands, const Hand* hand) {
    return std::find(hands.begin(), hands.end(), hand) != hands.end();
  };
  for (std::size_t i = 0; i < now_.hands.size(); ++i) {
    Hand* const hand = now_.hands[i];
    if (hand && !next.hands[i]) display_.publish(i, PointerView{});
    if (!hand || is_on(next.hands, hand)) continue;
    hand->leaving = 0.0;
    hand->servo->give_forces(false);
    *std::find(leaving_.begin(), leaving_.end(), nullptr) = hand;
  }
  now_ = next;
  for (Hand* hand : now_.hands)
    if (hand) hand->in_use.store(true, std::memory_order_relaxed);
  roster_taken_.store(now_.number, std::memory_order_release);
}

void HapticLoop::tick_hand(std::size_t place, Hand& hand, double dt, std::int64_t time) {
  const haptics::TickReport& report = hand.servo->tick(dt);
  const bool lost = report.status == devices::DeviceStatus::Lost;
  if (lost && hand.status != devices::DeviceStatus::Lost) ++hand.losses;
  hand.status = report.status;
  PointerView view = view_of(report, hand.losses, time);
  view.spared = hand.servo->limiter().acted(haptics::LimiterAct::Continuous);
  hand.to_main.publish(view);
  display_.publish(place, view);
  if (watches_.load(std::memory_order_relaxed) && !lost)
    watched_.try_push({place, time, view.tip, view.buttons});
  if (place != 0) return;
  sample_force(report, time);
  if (traces_.load(std::memory_order_relaxed) && !trace_.try_push(view))
    lost_ticks_.fetch_add(1, std::memory_order_relaxed);
}

/// Leads the forces of those that leave down to none, and lets go of them.
void HapticLoop::tick_leaving(double dt) {
  for (Hand*& hand : leaving_) {
    if (!hand) continue;
    const bool pushes = !hand->servo->tick(dt).force.isZero(0.0);
    hand->leaving += dt;
    if (pushes && hand->leaving < kLongestLeaving) continue;
    hand->device->write(base::Vector3::Zero());
    hand->in_use.store(false, std::memory_order_release);
    hand = nullptr;
  }
}

void HapticLoop::sample_force(const haptics::TickReport& report, std::int64_t time) {
  sample_.time = time;
  sample_.force = std::max(sample_.force, float(report.force.norm()));
  sample_.touching = sample_.touching || report.contact.touching;
  if (++ticks_of_sample_ < ticks_a_sample_) return;
  forces_.try_push(sample_);  // when nobody has looked for long, the newest are lost
  sample_ = {};
  ticks_of_sample_ = 0;
}

void HapticLoop::update() {
  for (const auto& hand : hands_) hand->to_main.update();
  finish_remaps();
}

void HapticLoop::carry(std::size_t pointer, const base::Pose& stage_from_device) {
  Hand& hand = *hands_[pointer];
  if (!stage_from_device.matrix().allFinite()) return;
  if (stage_from_device.matrix() == hand.stage_from_device.matrix()) return;
  hand.stage_from_device = stage_from_device;
  hand.servo->carry(stage_from_device);
}

void HapticLoop::grip(std::size_t pointer, const haptics::GripFeel& feel) {
  hands_[pointer]->servo->grip(feel);
}

void HapticLoop::give_forces(std::size_t pointer, bool given) {
  Hand& hand = *hands_[pointer];
  hand.gives_forces = given;
  // One on its way to another mapping keeps none, and takes this over with its new servo.
  if (!hand.wanted) hand.servo->give_forces(given);
}

std::vector<PointerView> HapticLoop::take_trace() {
  std::vector<PointerView> ticks;
  while (const auto tick = trace_.try_pop()) ticks.push_back(*tick);
  return ticks;
}

std::vector<PointerTick> HapticLoop::take_watched() {
  std::vector<PointerTick> ticks;
  while (const auto tick = watched_.try_pop()) ticks.push_back(*tick);
  return ticks;
}

std::vector<ForceSample> HapticLoop::take_forces() {
  std::vector<ForceSample> samples;
  while (const auto sample = forces_.try_pop()) samples.push_back(*sample);
  return samples;
}

}  // namespace icome::session
