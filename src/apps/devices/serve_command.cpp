#include "apps/devices/serve_command.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "apps/design/design_work.h"
#include "apps/interrupt.h"
#include "apps/terminal.h"
#include "devices/catalogue.h"
#include "devices/device_news.h"
#include "devices/simulated/simulated_device.h"
#include "io/host_port.h"
#include "session/probe/device_sharing.h"

namespace icome::apps {
namespace {

using Devices = std::vector<std::unique_ptr<devices::PointerDevice>>;

/// A simulated hand that goes round, so that other programs have something to see and to stop.
std::unique_ptr<devices::PointerDevice> going_round(double rate_hz) {
  constexpr double kRadius = 0.02;  // m
  constexpr double kTurn = 4.0;     // s
  devices::SimulatedSettings settings;
  settings.rate = rate_hz;
  settings.trajectory = [](double t) -> base::Vector3 {
    const double angle = 2.0 * M_PI * t / kTurn;
    return {kRadius * std::cos(angle), kRadius * std::sin(angle), 0.0};
  };
  settings.start = {kRadius, 0.0, 0.0};
  return std::make_unique<devices::SimulatedDevice>(std::move(settings));
}

base::Result<Devices> open_all(const DevicesOptions& options) {
  Devices all;
  for (const std::string& name : options.shared) {
    if (name == "simulated") {
      all.push_back(going_round(options.rate_hz));
      continue;
    }
    auto device = devices::open_device(name);
    if (!device) return base::fail("--device: " + device.error().message);
    all.push_back(std::move(*device));
  }
  return all;
}

/// "HOST:PORT" or "PORT" understood.
base::Result<io::HostPort> place_of(const std::string& text) {
  const devices::VrpnServerSettings usual;
  const bool port_alone = text.find(':') == std::string::npos;
  const auto place = io::parse_host_port(port_alone ? ":" + text : text, {usual.host, usual.port});
  // Without a host it is not plain whether everybody or nobody elsewhere may come.
  if (!place || text.starts_with(':'))
    return base::fail(
        fmt::format("{}: say HOST:PORT, such as 127.0.0.1:3883; port 0 takes a free one.", text));
  return *place;
}

base::Result<devices::VrpnServerSettings> server_settings(const std::string& text, std::size_t devices) {
  const auto place = place_of(text);
  if (!place) return tl::unexpected(place.error());
  devices::VrpnServerSettings settings;
  settings.host = place->host;
  settings.port = place->port;
  settings.names.clear();
  for (std::size_t i = 0; i < devices; ++i) settings.names.push_back(fmt::format("Pointer{}", i));
  return settings;
}

std::string announcement(const DevicesOptions& options, const session::DeviceSharing& sharing) {
  const devices::VrpnServer& server = sharing.server();
  if (options.json) {
    nlohmann::ordered_json json;
    json["listening"] = server.listening();
    json["names"] = server.names();
    return json.dump() + "\n";
  }
  std::string text;
  for (std::size_t i = 0; i < sharing.devices(); ++i)
    text +=
        fmt::format("{}@{} is {}\n", server.names()[i], server.listening(), sharing.device(i).info().name);
  if (server.listening().starts_with("0.0.0.0:"))
    text += "0.0.0.0 stands for every address of this computer; programs elsewhere give one of them.\n";
  return text + "Ctrl-C ends sharing.\n";
}

base::Result<std::unique_ptr<session::DeviceSharing>> start(const DevicesOptions& options) {
  const auto settings = server_settings(options.vrpn, options.shared.size());
  if (!settings) return tl::unexpected(settings.error());
  auto devices = open_all(options);
  if (!devices) return tl::unexpected(devices.error());
  return session::DeviceSharing::create(std::move(*devices), *settings, options.rate_hz);
}

}  // namespace

std::string names_place(const std::string& text) {
  const auto place = place_of(text);
  return place ? std::string() : place.error().message;
}

int run_serve(const DevicesOptions& options) {
  catch_interrupts();
  StatusLine status;
  const auto sharing = start(options);
  if (!sharing) return end_without_result(sharing.error(), status);
  // Who starts it would wait for ever for what it says.
  if (const int printed = print_answer(announcement(options, **sharing)); printed != 0) return printed;
  std::vector<devices::DeviceNews> news;
  for (std::size_t i = 0; i < (*sharing)->devices(); ++i)
    news.emplace_back((*sharing)->device(i).info().name);
  while (!interrupted()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    for (std::size_t i = 0; i < news.size(); ++i)
      for (const auto& item : news[i].look((*sharing)->is_lost(i), (*sharing)->device(i).condition()))
        tell(item.text);
  }
  return 0;
}

}  // namespace icome::apps
