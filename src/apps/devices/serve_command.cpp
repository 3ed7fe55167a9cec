#include "apps/devices/serve_command.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>

#include "apps/design/design_work.h"
#include "apps/interrupt.h"
#include "apps/terminal.h"
#include "devices/catalogue.h"
#include "io/host_port.h"
#include "devices/simulated/simulated_device.h"
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
base::Result<devices::VrpnServerSettings> place_of(const std::string& text, std::size_t devices) {
  devices::VrpnServerSettings settings;
  const bool port_alone = text.find(':') == std::string::npos;
  const auto place = io::parse_host_port(port_alone ? ":" + text : text, {settings.host, settings.port});
  if (!place)
    return base::fail(
        fmt::format("--vrpn {}: say HOST:PORT, such as 127.0.0.1:3883; port 0 takes a free one.", text));
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
  const auto settings = place_of(options.vrpn, options.shared.size());
  if (!settings) return tl::unexpected(settings.error());
  auto devices = open_all(options);
  if (!devices) return tl::unexpected(devices.error());
  return session::DeviceSharing::create(std::move(*devices), *settings, options.rate_hz);
}

}  // namespace

int run_serve(const DevicesOptions& options) {
  catch_interrupts();
  StatusLine status;
  const auto sharing = start(options);
  if (!sharing) return end_without_result(sharing.error(), status);
  print(announcement(options, **sharing));
  std::fflush(stdout);
  std::vector<std::string> told((*sharing)->devices());
  while (!interrupted()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    for (std::size_t i = 0; i < told.size(); ++i) {
      const std::string condition = (*sharing)->device(i).condition();
      if (condition == std::exchange(told[i], condition) || condition.empty()) continue;
      tell((*sharing)->device(i).info().name + ": " + condition);
    }
  }
  return 0;
}

}  // namespace icome::apps
