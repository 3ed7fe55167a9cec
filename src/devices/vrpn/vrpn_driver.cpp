#include "devices/vrpn/vrpn_driver.h"

#include <algorithm>
#include <utility>

#include "base/clock.h"

namespace icome::devices {
namespace {

using vrpn::ClientLink;
using vrpn::Kind;
using vrpn::Message;

constexpr std::int64_t kLook = 250'000;             // ns between two looks at the servo's force
constexpr std::int64_t kMoreNames = 100'000'000;    // ns without a word after which all names are told
constexpr std::int64_t kAllNames = 1'000'000'000;   // ns in which they are told at the latest
constexpr std::int64_t kFirstPose = 3'000'000'000;  // ns without a pose after which people are told
constexpr double kFieldRadius = 0.02;    // m: a field that is held in vain does not push farther than this
constexpr double kUnforcedRadius = 1.0;  // m, workspace of a tracker that moves freely
constexpr std::int32_t kRecovery = 1;

/// The names of a server's devices, for people.
std::string listed(const std::vector<std::string>& names) {
  constexpr int kMostListed = 10;
  std::string text;
  int count = 0;
  for (const std::string& name : names) {
    // The server itself goes by the first; a name that is not told yet is empty.
    if (name.empty() || name == "VRPN Control" || ++count > kMostListed) continue;
    text += (text.empty() ? "" : ", ") + name;
  }
  if (count > kMostListed) text += " and " + std::to_string(count - kMostListed) + " more";
  return text.empty() ? "none" : text;
}

/// Waits until the server has told the names of its devices and of its messages, our device among them.
bool learn_names(ClientLink& link) {
  const std::int64_t deadline = base::steady_nanoseconds() + kAllNames;
  std::int64_t last = base::steady_nanoseconds();
  std::size_t count = 0;
  bool talks = false;
  const auto listen = [&](const Message&, Kind, bool) { talks = true; };
  while (base::steady_nanoseconds() < deadline) {
    if (!link.receive(10'000'000, listen)) return false;
    const std::int64_t now = base::steady_nanoseconds();
    if (link.names().senders().size() != count) last = now;
    count = link.names().senders().size();
    if (link.has_device() && (talks || now - last > kMoreNames)) return true;
  }
  return link.has_device();
}

}  // namespace

std::string vrpn_identity(const VrpnAddress& address) {
  const auto place = vrpn::find_host(address.host, address.port);
  std::string identity = "vrpn:" + address.name + "@";
  identity += place ? vrpn::shown(*place) : address.host + ":" + std::to_string(address.port);
  return address.sensor == 0 ? identity : identity + "?sensor=" + std::to_string(address.sensor);
}

std::string VrpnDriver::place() const { return address_.host + ":" + std::to_string(address_.port); }

base::Result<DeviceInfo> VrpnDriver::open() {
  auto link = ClientLink::connect(address_);
  if (!link) return tl::unexpected(link.error());
  if (!learn_names(**link)) {
    if (!(*link)->why().empty()) return base::fail((*link)->why());
    return base::fail("the VRPN server at " + place() + " has no device '" + address_.name + "'; it has " +
                      listed((*link)->names().senders()));
  }
  gives_force_ = address_.forces != VrpnForces::Off && (*link)->names().knows(force_kind());
  // Places may be read by several; forces of two would fight. Kept while the server is away.
  if (gives_force_ && !claim_) {
    auto claim = DeviceClaim::of(identity());
    if (!claim) return tl::unexpected(claim.error());
    claim_ = std::move(*claim);
  }
  link_ = std::move(*link);
  if (gives_force_)
    link_->introduce({force_kind()});
  else
    link_->introduce({});
  DeviceInfo info = address_.info;
  if (!gives_force_) {
    info.max_force = info.continuous_force = 0.0;
    info.workspace_radius = std::max(info.workspace_radius, kUnforcedRadius);
  }
  return info;
}

std::string VrpnDriver::run(DriverLink& link, const std::atomic<bool>& stop) {
  vrpn::TrackerReadings readings(address_);
  tip_ = said_force_ = said_tip_ = Vector3::Zero();
  bool fresh = false;
  bool posed = false;
  bool complained = false;
  std::int64_t now = base::steady_nanoseconds();
  const std::int64_t begin = now;
  const auto listen = [&](const Message& message, Kind kind, bool ours) {
    if (ours && readings.take(kind, message, now)) fresh = true;
  };
  while (!stop.load(std::memory_order_relaxed)) {
    if (!link_->receive(kLook, listen)) return link_->why();
    now = base::steady_nanoseconds();
    // The force was made for an earlier reading than the one that has just come; held against a later place
    // the plane would go along with the tip and give energy.
    const Vector3 force = link.force(now);
    if (posed) send_force(force);
    if (!posed && !complained && now - begin > kFirstPose) {
      complained = true;
      link.tell("the VRPN server at " + place() + " tells no pose of '" + address_.name +
                "'; look whether its tracker runs, and check the name and the sensor");
    }
    if (!std::exchange(fresh, false)) continue;
    const std::uint64_t passed = link.counts().passed;
    link.pass(readings.state(), now);
    if (link.counts().passed == passed) continue;
    tip_ = readings.state().position;
    if (!std::exchange(posed, true)) link.tell({});
  }
  if (gives_force_)
    link_->leave_with(force_kind(), force_payload(Vector3::Zero()));
  else
    link_->leave();
  return {};
}

Kind VrpnDriver::force_kind() const {
  return address_.forces == VrpnForces::Fields ? Kind::ForceField : Kind::Plane;
}

void VrpnDriver::send_force(const Vector3& force) {
  if (!gives_force_) return;
  const bool none = force.isZero();
  if (force == said_force_ && (none || tip_ == said_tip_)) return;
  if (!link_->say(force_kind(), force_payload(force))) return;
  said_force_ = force;
  said_tip_ = tip_;
}

vrpn::Payload VrpnDriver::force_payload(const Vector3& force) const {
  return address_.forces == VrpnForces::Fields ? field(force) : plane(force);
}

vrpn::Payload VrpnDriver::plane(const Vector3& force) const {
  vrpn::Plane plane;
  if (!force.isZero()) {
    const double stiffness = std::max(1.0, address_.info.nominal_stiffness);
    const Vector3 normal = force.normalized();
    const Vector3 on_it = (tip_ + force / stiffness) / address_.frame.scale;
    plane.normal = address_.frame.ours_from_theirs.transpose() * normal;
    plane.offset = -normal.dot(on_it);
    plane.spring = stiffness / address_.spring_unit;
    plane.recovery = kRecovery;
  }
  return vrpn::pack(plane);
}

vrpn::Payload VrpnDriver::field(const Vector3& force) const {
  vrpn::ForceField field;
  if (!force.isZero()) {
    const base::Matrix3 theirs_from_ours = address_.frame.ours_from_theirs.transpose();
    field.origin = theirs_from_ours * tip_ / address_.frame.scale;
    field.force = theirs_from_ours * force;
    field.radius = kFieldRadius / address_.frame.scale;
  }
  return vrpn::pack(field);
}

}  // namespace icome::devices
