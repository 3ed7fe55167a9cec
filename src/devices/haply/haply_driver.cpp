#include "devices/haply/haply_driver.h"

#include <algorithm>
#include <utility>

#include "base/clock.h"
#include "devices/device_profiles.h"
#include "devices/driver/pace.h"

namespace icome::devices {
namespace {

constexpr std::int64_t kNonsenseShown = 5'000'000'000;  // ns
constexpr std::int64_t kEventShown = 30'000'000'000;    // ns
constexpr std::int64_t kTooOld = 3600'000'000'000;      // ns, age of no force that is still given

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
  const auto id = (*service)->choose(device_id_);
  if (!id) return tl::unexpected(id.error());
  device_id_ = *id;
  service_ = std::move(*service);
  return info;
}

void HaplyDriver::close() {
  events_.reset();
  service_.reset();
}

std::string HaplyDriver::run(DriverLink& link, const std::atomic<bool>& stop) {
  stop_ = &stop;
  service_->stop_by(stop_);
  shown_ = {};
  disconnections_ = heard_ = 0;
  refused_time_ = 0;
  if (settings_.events_port != 0)
    events_.emplace(ServiceAddress{settings_.service.host, settings_.events_port}, device_id_);
  Pace pace(settings_.rate);
  while (!stop.load(std::memory_order_relaxed) && exchange(link)) pace.wait();
  service_->let_go();
  return stop.load(std::memory_order_relaxed) ? std::string() : service_->why();
}

bool HaplyDriver::exchange(DriverLink& link) {
  if (events_ && events_->disconnections() != disconnections_) {
    disconnections_ = events_->disconnections();
    service_->doubt();
  }
  const InverseService::Answer answer =
      service_->exchange([&] { return frame_.service_force(link.force(base::steady_nanoseconds())); });
  if (answer == InverseService::Answer::Lost) return false;
  const std::int64_t now = base::steady_nanoseconds();
  // Asked for the force of a time when each is too old, the link begins again with its ramp.
  if (service_->took_force_away()) static_cast<void>(link.force(now + kTooOld));
  if (answer == InverseService::Answer::Fresh)
    link.pass(frame_.state_of(service_->arm(), service_->grip()), now);
  else
    refused_time_ = now;
  tell(link, now);
  return true;
}

/// Tells people of changes, and only of these, as a sentence takes memory.
void HaplyDriver::tell(DriverLink& link, std::int64_t now) {
  const ServiceArm& arm = service_->arm();
  const bool sense = refused_time_ == 0 || now - refused_time_ > kNonsenseShown;
  if (const std::uint64_t version = events_ ? events_->version() : 0; version != heard_) {
    heard_ = version;
    heard_time_ = now;
  }
  const std::uint64_t heard = now - heard_time_ < kEventShown ? heard_ : 0;
  const Shown due = {arm.calibrated, arm.powered, arm.ready, sense, heard};
  if (due == shown_) return;
  shown_ = due;
  link.tell(sentences());
}

std::string HaplyDriver::sentences() const {
  const std::string name = "Haply Inverse3 " + device_id_;
  std::string all;
  const auto add = [&](const std::string& sentence) {
    all += (all.empty() ? "" : " ") + name + ": " + sentence + ".";
  };
  if (!shown_.powered) add("it has no power; plug in its power supply");
  if (!shown_.calibrated) add("it is not calibrated; do what the Haply Hub asks for");
  if (!shown_.ready) add("it is not ready yet");
  if (const std::string said = shown_.events != 0 ? events_->sentence() : ""; !said.empty()) add(said);
  if (!shown_.sense) add("some of what the Inverse Service sends makes no sense and is left out");
  return all;
}

}  // namespace icome::devices
