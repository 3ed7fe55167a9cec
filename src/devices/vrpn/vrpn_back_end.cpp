#include "devices/vrpn/vrpn_back_end.h"

#include <algorithm>
#include <cstdlib>
#include <set>

#include "base/clock.h"
#include "devices/driver/driven_device.h"
#include "devices/vrpn/vrpn_driver.h"

namespace icome::devices {
namespace {

constexpr std::string_view kVrpn = "vrpn";
constexpr std::int64_t kListen = 1'000'000'000;  // ns: slow trackers report twice a second
constexpr double kPatience = 0.5;                // s

std::vector<std::string> servers() {
  const char* variable = std::getenv("ICOME_VRPN");
  std::string text = variable != nullptr && *variable != '\0' ? variable : "localhost:3883";
  std::vector<std::string> all;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(','), text.size());
    if (end > 0) all.push_back(text.substr(0, end));
    text.erase(0, end + 1);
  }
  return all;
}

DeviceEntry entry(std::string name, bool present, std::string why) {
  return {std::move(name), "pointer", std::string(kVrpn), present, std::move(why)};
}

/// The names of devices that told a pose while we listened.
std::set<std::string> heard_trackers(vrpn::ClientLink& link) {
  std::set<std::string> trackers;
  const auto listen = [&](const vrpn::Message& message, vrpn::Kind kind, bool) {
    if (kind == vrpn::Kind::PosQuat) trackers.emplace(link.names().sender(message.sender));
  };
  const std::int64_t deadline = base::steady_nanoseconds() + kListen;
  while (base::steady_nanoseconds() < deadline && link.receive(10'000'000, listen)) {
  }
  trackers.erase("");
  return trackers;
}

void add_devices_of(const std::string& server, std::vector<DeviceEntry>& entries) {
  const auto address = VrpnAddress::parse("@" + server);
  if (!address) return entries.push_back(entry(std::string(kVrpn), false, address.error().message));
  auto link = vrpn::ClientLink::connect(*address, kPatience);
  if (!link) {
    return entries.push_back(
        entry(std::string(kVrpn), false,
              link.error().message + "; servers elsewhere are named in the environment variable ICOME_VRPN"));
  }
  const std::string place = address->host + ":" + std::to_string(address->port);
  const std::set<std::string> trackers = heard_trackers(**link);
  const bool forces = (*link)->names().knows(vrpn::Kind::Plane);
  for (const std::string& name : trackers) {
    VrpnAddress named = *address;
    named.name = name;
    entries.push_back(entry(std::string(kVrpn) + ":" + name + "@" + place, true,
                            forces ? "a tracker of a VRPN server that takes forces; also for the head"
                                   : "a tracker of a VRPN server, without forces; also for the head"));
    entries.back().identity = vrpn_identity(named);
  }
  if (trackers.empty()) {
    entries.push_back(
        entry(std::string(kVrpn), false,
              "the VRPN server at " + place + " has no tracker that reports; look at its devices"));
  }
  (*link)->leave();
}

std::vector<DeviceEntry> list_vrpn() {
  std::vector<DeviceEntry> entries;
  for (const std::string& server : servers()) add_devices_of(server, entries);
  return entries;
}

/// The address of the first tracker there is.
base::Result<std::string> first_vrpn() {
  std::string why;
  for (const DeviceEntry& it : list_vrpn()) {
    if (it.present) return it.name.substr(kVrpn.size() + 1);
    if (why.empty()) why = it.why;
  }
  return base::fail(why);
}

base::Result<std::unique_ptr<PointerDevice>> open_vrpn(std::string_view text) {
  std::string first;
  if (text.empty()) {
    const auto found = first_vrpn();
    if (!found) return tl::unexpected(found.error());
    text = first = *found;
  }
  auto address = VrpnAddress::parse(text);
  if (!address) return tl::unexpected(address.error());
  auto device = DrivenDevice::create(std::make_unique<VrpnDriver>(std::move(*address)));
  if (!device) return tl::unexpected(device.error());
  return std::unique_ptr<PointerDevice>(std::move(*device));
}

}  // namespace

BackEnd vrpn_back_end() { return {kVrpn, kVrpn, list_vrpn, open_vrpn}; }

}  // namespace icome::devices
