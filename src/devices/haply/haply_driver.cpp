#include "devices/haply/haply_driver.h"

#include <algorithm>
#include <utility>

#include "base/clock.h"
#include "devices/device_profiles.h"
#include "devices/driver/pace.h"

namespace icome::devices {
namespace {

constexpr std::int64_t kEventShown = 30'000'000'000;  // ns

HaplySettings bounded_settings(HaplySettings settings) {
  settings.rate = std::clamp(settings.rate, 250.0, 8000.0);
  settings.patience = std::clamp(settings.patience, 0.02, 60.0);
  settings.connect_patience = std::clamp(settings.connect_patience, 0.05, 60.0);
  return settings;
}

}  // namespace

HaplyDriver::HaplyDriver(const HaplySettings& settings, std::string device_id)
    : settings_(bounded_settings(settings)), frame_(settings_), device_id_(std::move(device_id)) {}

HaplyDriver::~HaplyDriver() = default;

base::Result<DeviceInfo> HaplyDriver::open() {
  auto info = find_device_profile("Haply Inverse3");
  if (!info) return info;
  auto service = InverseService::connect(settings_, stop_);
  if (!service) return tl::unexpected(service.error());
  const auto id = choose_arm(**service);
  if (!id) return tl::unexpected(id.error());
  // Kept while the device is away: another part of the program would find it back at the same time.
  if (!claim_) {
    auto claim = DeviceClaim::of("haply:" + *id);
    if (!claim) return tl::unexpected(claim.error());
    claim_ = std::move(*claim);
  }
  device_id_ = *id;
  service_ = std::move(*service);
  info->name += " " + device_id_;
  return info;
}

/// Chooses the arm of our id or, before there is one, the first that is free, or else the first.
base::Result<std::string> HaplyDriver::choose_arm(InverseService& service) const {
  if (!device_id_.empty()) return service.choose(device_id_);
  for (const ServiceArm& arm : service.state().arms())
    if (!DeviceClaim::is_taken("haply:" + std::string(arm.id.text()))) return service.choose(arm.id.text());
  return service.choose({});
}

void HaplyDriver::close() {
  events_.reset();
  service_.reset();
}

std::string HaplyDriver::run(DriverLink& link, const std::atomic<bool>& stop) {
  stop_ = &stop;
  service_->stop_by(stop_);
  shown_ = {};
  withheld_ = {};
  disconnections_ = heard_ = 0;
  if (settings_.events_port != 0)
    events_.emplace(ServiceAddress{settings_.service.host, settings_.events_port}, device_id_);
  Pace pace(settings_.rate);
  while (!stop.load(std::memory_order_relaxed) && exchange(link)) pace.wait();
  service_->let_go();
  return stop.load(std::memory_order_relaxed) ? std::string() : service_->why();
}

bool HaplyDriver::exchange(DriverLink& link) {
  withhold(link);
  if (events_ && events_->disconnections() != disconnections_) {
    disconnections_ = events_->disconnections();
    service_->doubt();
  }
  const InverseService::Answer answer =
      service_->exchange([&] { return frame_.service_force(link.force(base::steady_nanoseconds())); });
  if (answer == InverseService::Answer::Lost) return false;
  const std::int64_t now = base::steady_nanoseconds();
  if (service_->took_force_away()) link.take_force_away();
  if (answer == InverseService::Answer::Fresh)
    link.pass(frame_.state_of(service_->arm(), service_->grip()), now);
  else
    link.leave_out(now);
  tell(link, now);
  return true;
}

/// Tells people of changes, and only of these, as a sentence takes memory.
void HaplyDriver::tell(DriverLink& link, std::int64_t now) {
  const ServiceArm& arm = service_->arm();
  if (const std::uint64_t version = events_ ? events_->version() : 0; version != heard_) {
    heard_ = version;
    heard_time_ = now;
  }
  const Shown due = {arm.calibrated, arm.powered, arm.ready, heard_, now - heard_time_ < kEventShown};
  if (due == shown_) return;
  // A stop that was triggered before is over with the power.
  if (events_ && due.powered && !shown_.powered) events_->forget_safety_stop();
  shown_ = due;
  withhold(link);
  link.tell(shown_.is_news && events_ ? events_->sentence() : std::string());
}

/// Keeps forces away while the device may not push, at once and before people are told.
void HaplyDriver::withhold(DriverLink& link) {
  const bool stopped = events_ && events_->is_safety_stop();
  const Withheld due = {stopped, shown_.powered, shown_.calibrated, shown_.ready};
  if (due == withheld_) return;
  withheld_ = due;
  link.withhold(why_withheld());
}

std::string HaplyDriver::why_withheld() const {
  if (withheld_.stopped) return events_->safety_stop();
  if (!withheld_.powered) return "it has no power; plug in its power supply";
  if (!withheld_.calibrated) return "it is not calibrated; do what the Haply Hub asks for";
  if (!withheld_.ready) return "it is not ready yet; wait, or do what the Haply Hub asks for";
  return {};
}

}  // namespace icome::devices
