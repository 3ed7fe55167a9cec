#include "devices/haply/service_events.h"

#include <chrono>
#include <system_error>
#include <utility>

#include "base/clock.h"
#include "base/shown_text.h"
#include "base/terminal_text.h"
#include "devices/haply/wire/web_socket.h"

namespace icome::devices {
namespace {

constexpr double kChannelPatience = 1.0;  // s, to connect
constexpr auto kChannelRetry = std::chrono::seconds(2);
constexpr std::int64_t kForever = INT64_MAX / 2;  // ns

bool is_mild(const ServiceEvent& event) { return event.level == "info" || event.level == "notice"; }

/// Words of the service, as they may stand in a sentence.
std::string quoted_words(const ServiceEvent& event) {
  const std::string& words = event.message.empty() ? event.name : event.message;
  std::string line = base::terminal_text(base::shown_text(words));
  for (char& letter : line) {
    if (letter == '\n' || letter == '\t') letter = ' ';
  }
  return line;
}

}  // namespace

ServiceEvents::ServiceEvents(ServiceAddress channel, std::string device_id)
    : channel_(std::move(channel)), device_id_(std::move(device_id)) {
  try {
    thread_ = std::thread([this] { listen(); });
  } catch (const std::system_error&) {
    // Without a thread the device works, and the service's events about it are not heard.
  }
}

ServiceEvents::~ServiceEvents() {
  stop_.store(true, std::memory_order_relaxed);
  if (thread_.joinable()) thread_.join();
}

std::string ServiceEvents::sentence() const {
  const std::lock_guard lock(guard_);
  return sentence_;
}

void ServiceEvents::listen() {
  while (!stop_.load(std::memory_order_relaxed)) {
    hear_out();
    const auto end = std::chrono::steady_clock::now() + kChannelRetry;
    while (!stop_.load(std::memory_order_relaxed) && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

/// Takes events as long as the channel is there.
void ServiceEvents::hear_out() {
  auto channel = WebSocket::connect(channel_, kChannelPatience, &stop_);
  if (!channel) return;
  while ((*channel)->receive(kForever)) {
    if (const auto event = read_service_event((*channel)->text())) take(*event);
  }
}

bool ServiceEvents::concerns_device(const ServiceEvent& event) const {
  ServiceDeviceId id;
  return !id.set(event.device_id) || id.is(device_id_);
}

void ServiceEvents::take(const ServiceEvent& event) {
  const bool of_grip =
      !event.device_family.empty() && event.device_family != "inverse" && event.device_family != "inverse3";
  if (of_grip) {
    if (!is_mild(event)) say("A VerseGrip: \"" + quoted_words(event) + "\"");
    return;
  }
  if (!concerns_device(event)) return;
  const bool is_safety = event.name == "device-safety-triggered";
  if (is_safety && !is_mild(event)) return stop_for_safety(event);
  if (is_safety || event.name == "device-connected") {
    forget_safety_stop();
    return say({});
  }
  if (event.name == "device-disconnected") {
    // Whether it is true, and then why it is lost, is told once the service no longer lists it.
    disconnections_.fetch_add(1, std::memory_order_release);
    return say({});
  }
  if (event.category == "device" && !is_mild(event))
    say("Haply's service says: \"" + quoted_words(event) + "\"");
}

void ServiceEvents::stop_for_safety(const ServiceEvent& event) {
  {
    const std::lock_guard lock(guard_);
    safety_stop_ =
        "its safety stop has been triggered (\"" + quoted_words(event) +
        "\"); let go of it, see to what the service asks for, and switch it off and on if this stays";
  }
  is_safety_stop_.store(true, std::memory_order_release);
}

std::string ServiceEvents::safety_stop() const {
  const std::lock_guard lock(guard_);
  return safety_stop_;
}

void ServiceEvents::say(std::string sentence) {
  {
    const std::lock_guard lock(guard_);
    sentence_ = std::move(sentence);
  }
  version_.fetch_add(1, std::memory_order_release);
}

}  // namespace icome::devices
