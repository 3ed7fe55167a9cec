#include "devices/vrpn/served_client.h"

#include <algorithm>
#include <utility>

namespace icome::devices::vrpn {
namespace {

constexpr std::int64_t kConnectWithin = 2'000'000'000;  // ns
constexpr std::int64_t kGreetWithin = 5'000'000'000;    // ns
constexpr std::int64_t kStuckFor = 2'000'000'000;       // ns in which it takes nothing
constexpr std::size_t kPiece = 1 << 14;                 // bytes that are read in one turn

std::int32_t number_of(std::size_t device) { return static_cast<std::int32_t>(device) + 1; }

}  // namespace

ServedClient::ServedClient(Socket socket, const Place& place, bool connecting, const ServedDevices& devices,
                           std::int64_t now)
    : socket_(std::move(socket)),
      place_(place),
      connecting_(connecting),
      devices_(devices),
      since_(now),
      wanted_(devices.names.size()),
      buttons_(devices.names.size(), 0),
      buttons_known_(devices.names.size(), false) {
  prepare(socket_, 1e-9 * static_cast<double>(kStuckFor));
  outbox_.put_cookie();
  outbox_.describe(kSenderDescription, 0, "VRPN Control");
  for (std::size_t i = 0; i < devices.names.size(); ++i)
    outbox_.describe(kSenderDescription, number_of(i), devices.names[i]);
  outbox_.describe_kinds();
}

bool ServedClient::serve(std::int64_t now) {
  if (connecting_) {
    if (!connected(socket_)) return !refused(socket_) && now - since_ < kConnectWithin;
    connecting_ = false;
    since_ = now;
  }
  if (!talks() && now - since_ > kGreetWithin) return false;
  return receive_some() && send_some(now);
}

bool ServedClient::receive_some() {
  floods_ = false;
  const std::span<char> room = decoder_.room().first(kPiece);
  std::size_t count = 0;
  const Flow flow = receive(socket_, room, count);
  if (flow == Flow::Ended) return false;
  if (flow == Flow::Later) return true;
  floods_ = count == room.size();
  decoder_.received(count);
  Message message;
  Decoder::Step step = decoder_.next(message);
  for (; step == Decoder::Step::Message && !left_; step = decoder_.next(message)) take(message);
  return step != Decoder::Step::Broken && !left_;
}

bool ServedClient::send_some(std::int64_t now) {
  while (!outbox_.waiting().empty()) {
    std::size_t count = 0;
    const Flow flow = send(socket_, outbox_.waiting(), count);
    if (flow == Flow::Ended) return false;
    if (flow == Flow::Later) {
      if (stuck_since_ == 0) stuck_since_ = now;
      return now - stuck_since_ < kStuckFor;
    }
    outbox_.sent(count);
    stuck_since_ = 0;
  }
  return true;
}

void ServedClient::take(const Message& message) {
  if (message.type < 0) {
    left_ = message.type == kDisconnect;
    names_.learn(message);
    return;
  }
  const auto& names = devices_.names;
  const auto found = std::find(names.begin(), names.end(), names_.sender(message.sender));
  if (found == names.end()) return;
  const auto device = static_cast<std::size_t>(found - names.begin());
  switch (names_.kind(message.type)) {
    case Kind::Ping:
      outbox_.put(number_of(device), Kind::Pong, {});
      break;
    case Kind::Plane:
      take_plane(device, message.payload);
      break;
    case Kind::ForceField:
      take_field(device, message.payload);
      break;
    default:
      break;
  }
}

void ServedClient::take_plane(std::size_t device, std::string_view payload) {
  auto plane = read_plane(payload);
  if (!plane || plane->index < 0 || static_cast<std::size_t>(plane->index) >= kPlanes) return;
  if (!tidy(*plane, devices_.forces)) return;
  plane->normal = devices_.frame.ours_from_theirs * plane->normal;
  plane->offset *= devices_.frame.scale;
  wanted_[device].planes[static_cast<std::size_t>(plane->index)] = {*plane, ++revision_};
  wishes_changed_ = true;
}

void ServedClient::take_field(std::size_t device, std::string_view payload) {
  auto field = read_force_field(payload);
  if (!field || !tidy(*field, devices_.forces)) return;
  const base::Matrix3& ours_from_theirs = devices_.frame.ours_from_theirs;
  field->origin = devices_.frame.position(field->origin);
  field->force = ours_from_theirs * field->force;
  field->jacobian = ours_from_theirs * field->jacobian * ours_from_theirs.transpose();
  field->radius *= devices_.frame.scale;
  wanted_[device].field = *field;
  wishes_changed_ = true;
}

void ServedClient::share(std::size_t device, const SharedState& shared) {
  const base::Matrix3 theirs_from_ours = devices_.frame.ours_from_theirs.transpose();
  const Quaternion turn(theirs_from_ours);
  const double scale = 1.0 / devices_.frame.scale;
  const std::int32_t number = number_of(device);
  const PointerState& state = shared.state;
  PosQuat pose;
  pose.position = scale * (theirs_from_ours * state.position);
  pose.orientation = turn * state.orientation * turn.conjugate();
  Velocity velocity;
  velocity.velocity = scale * (theirs_from_ours * state.velocity);
  outbox_.put(number, Kind::PosQuat, pack(pose).bytes());
  outbox_.put(number, Kind::Velocity, pack(velocity).bytes());
  outbox_.put(number, Kind::Force, Payload().put(Vector3(theirs_from_ours * shared.force)).bytes());
  share_buttons(device, state.buttons);
}

void ServedClient::share_buttons(std::size_t device, std::uint32_t buttons) {
  const std::int32_t number = number_of(device);
  if (!buttons_known_[device]) {
    outbox_.put(number, Kind::ButtonStates, pack_buttons(buttons, devices_.buttons).bytes());
    buttons_known_[device] = true;
    buttons_[device] = buttons;
    return;
  }
  const std::uint32_t changed = buttons ^ std::exchange(buttons_[device], buttons);
  for (std::int32_t i = 0; i < devices_.buttons; ++i) {
    if (((changed >> i) & 1U) == 0) continue;
    outbox_.put(number, Kind::ButtonChange, pack(Button{i, ((buttons >> i) & 1U) != 0}).bytes());
  }
}

void ServedClient::say_farewell() {
  if (connecting_) return;
  outbox_.put(0, kDisconnect, {});
  send_some(since_);
}

}  // namespace icome::devices::vrpn
