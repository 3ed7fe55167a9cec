#include "devices/vrpn/vrpn_address.h"

#include <cmath>

#include "base/parse_number.h"
#include "devices/axes.h"
#include "devices/device_profiles.h"
#include "devices/vrpn/protocol.h"
#include "io/host_port.h"

namespace icome::devices {
namespace vrpn {
namespace {

constexpr const char* kExample = "; a VRPN device is NAME@HOST:PORT, such as Tracker0@localhost:3883";

/// Takes the text up to the next separator off the front.
std::string_view take_until(std::string_view& text, char separator) {
  const std::size_t end = text.find(separator);
  const std::string_view taken = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return taken;
}

/// Takes an option of an address. Returns the fault that it has; empty: none.
std::string take_option(VrpnAddress& address, std::string_view key, std::string_view value) {
  const std::string text(value);
  const auto number = base::parse_number<double>(value);
  const auto integer = base::parse_number<int>(value);
  const auto positive = [&](double& setting) -> std::string {
    if (!number || !(*number > 0.0) || !std::isfinite(*number))
      return std::string(key) + "=" + text + ": this must be a number above 0";
    setting = *number;
    return {};
  };
  if (key == "axes") {
    auto frame = VrpnFrame::parse(value, address.frame.scale);
    if (!frame) return frame.error().message;
    address.frame = *frame;
    return {};
  }
  if (key == "scale") return positive(address.frame.scale);
  if (key == "unit") return positive(address.spring_unit);
  if (key == "radius") return positive(address.info.workspace_radius);
  if (key == "sensor" || key == "grip") {
    if (!integer || *integer < 0) return std::string(key) + "=" + text + ": this must be 0, 1, 2 ...";
    (key == "grip" ? address.grip : address.sensor) = *integer;
    return {};
  }
  if (key == "forces") {
    if (value == "planes")
      address.forces = VrpnForces::Planes;
    else if (value == "fields")
      address.forces = VrpnForces::Fields;
    else if (value == "none")
      address.forces = VrpnForces::Off;
    else
      return "forces=" + text + ": there are planes, fields and none";
    return {};
  }
  if (key == "profile") {
    auto profile = find_device_profile(value);
    if (!profile) return profile.error().message;
    address.info = *profile;
    return {};
  }
  return "'" + std::string(key) +
         "' is no setting of a VRPN device; there are axes, scale, sensor, grip, forces, unit, profile, "
         "radius";
}

}  // namespace
}  // namespace vrpn

base::Result<VrpnFrame> VrpnFrame::parse(std::string_view axes, double scale) {
  const auto rotation = rotation_from_axes(axes);
  if (!rotation) return base::fail("axes=" + rotation.error().message);
  return VrpnFrame{*rotation, scale};
}

Quaternion VrpnFrame::orientation(const Quaternion& theirs) const {
  const Quaternion turn(ours_from_theirs);
  return turn * theirs * turn.conjugate();
}

base::Result<VrpnAddress> VrpnAddress::parse(std::string_view text) {
  VrpnAddress address;
  std::string_view options = text;
  std::string_view place = vrpn::take_until(options, '?');
  if (const auto name = vrpn::take_until(place, '@'); !name.empty()) address.name = name;
  if (address.name.size() > vrpn::kLongestName)
    return base::fail("'" + address.name + "': names of VRPN devices have 100 letters at most");
  if (place.starts_with("tcp://")) place.remove_prefix(6);  // as programs of VRPN write it
  const auto server = io::parse_host_port(place, {address.host, address.port});
  if (!server) return base::fail(server.error().message + vrpn::kExample);
  if (server->port == 0) return base::fail("no server is at port 0" + std::string(vrpn::kExample));
  address.host = server->host;
  address.port = server->port;
  while (!options.empty()) {
    std::string_view value = vrpn::take_until(options, '&');
    const std::string_view key = vrpn::take_until(value, '=');
    const std::string wrong = vrpn::take_option(address, key, value);
    if (!wrong.empty()) return base::fail(wrong);
  }
  address.info.name = address.name + "@" + address.host + ":" + std::to_string(address.port);
  return address;
}

}  // namespace icome::devices
