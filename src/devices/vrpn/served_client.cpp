#include "devices/vrpn/served_client.h"

#include <algorithm>
#include <utility>

namespace icome::devices::vrpn {
namespace {

constexpr std::int64_t kConnectWithin = 2'000'000'000;  // ns
constexpr std::int64_t kGreetWithin = 5'000'000'000;    // ns
constexpr std::int64_t kStuckFor = 2'000'000'000;       // ns in which it takes nothing
constexpr std::int64_t kPingEvery = 1'000'000'000;      // ns
constexpr std::int64_t kForcesLast = 3'000'000'000;     // ns, from a ping without an answer
constexpr std::int64_t kDropAfter = 10'000'000'000;     // ns, the same
constexpr std::size_t kPiece = 1 << 14;                 // bytes that are read in one turn
constexpr std::int32_t kToldButtons = 8;                // that clients are told

std::int32_t number_of(std::size_t device) { return static_cast<std::int32_t>(device) + 1; }

bool wants_force(const ClientForces& forces) {
  const auto is_there = [](const ClientForces::PlaneSlot& slot) { return !slot.plane.normal.isZero(); };
  return forces.field.radius > 0.0 || std::any_of(forces.planes.begin(), forces.planes.end(), is_there);
}

}  // namespace

ServedClient::ServedClient(Socket socket, const Place& place, bool connecting,
                           const std::vector<std::string>& devices, std::uint64_t number, std::int64_t now)
    : socket_(std::move(socket)),
      place_(place),
      connecting_(connecting),
      devices_(devices),
      number_(number),
      since_(now),
      wanted_(devices.size(), ClientForces{number, {}, {}}),
      buttons_(devices.size(), 0),
      buttons_known_(devices.size(), false) {
  prepare(socket_, 1e-9 * static_cast<double>(kStuckFor));
  outbox_.put_cookie();
  outbox_.describe(kSenderDescription, 0, "VRPN Control");
  for (std::size_t i = 0; i < devices.size(); ++i)
    outbox_.describe(kSenderDescription, number_of(i), devices[i]);
  outbox_.describe_kinds();
}

bool ServedClient::serve(std::int64_t now) {
  if (connecting_) {
    if (!connected(socket_)) return !refused(socket_) && now - since_ < kConnectWithin;
    connecting_ = false;
    since_ = now;
  }
  if (!talks() && now - since_ > kGreetWithin) return false;
  return receive_some() && is_alive(now) && send_some(now);
}

bool ServedClient::is_alive(std::int64_t now) {
  if (!has_forces_) return true;
  if (now - pinged_ > kPingEvery) {
    pinged_ = now;
    if (quiet_since_ == 0) quiet_since_ = now;
    outbox_.put(number_of(forced_), Kind::Ping, {});
  }
  if (!answers_ || quiet_since_ == 0) return true;
  if (now - quiet_since_ > kForcesLast) drop_wishes();
  return now - quiet_since_ <= kDropAfter;
}

void ServedClient::drop_wishes() {
  for (ClientForces& forces : wanted_) {
    if (!wants_force(forces)) continue;
    forces = {number_, {}, {}};
    wishes_changed_ = true;
  }
}

bool ServedClient::receive_some() {
  floods_ = false;
  const std::span<char> room = decoder_.room().first(kPiece);
  std::size_t count = 0;
  const Flow flow = receive(socket_, room, count);
  if (flow == Flow::Ended) return false;
  if (flow == Flow::Later) return true;
  quiet_since_ = 0;
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
  const auto found = std::find(devices_.begin(), devices_.end(), names_.sender(message.sender));
  if (found == devices_.end()) return;
  const auto device = static_cast<std::size_t>(found - devices_.begin());
  switch (names_.kind(message.type)) {
    case Kind::Ping:
      outbox_.put(number_of(device), Kind::Pong, {});
      break;
    case Kind::Pong:
      answers_ = true;
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
  if (!tidy(*plane, RemoteForceSettings())) return;
  wanted_[device].planes[static_cast<std::size_t>(plane->index)] = {*plane, ++revision_};
  note_wish(device);
}

void ServedClient::take_field(std::size_t device, std::string_view payload) {
  auto field = read_force_field(payload);
  if (!field || !tidy(*field, RemoteForceSettings())) return;
  wanted_[device].field = *field;
  note_wish(device);
}

void ServedClient::note_wish(std::size_t device) {
  wishes_changed_ = true;
  forced_ = device;
  has_forces_ = std::any_of(wanted_.begin(), wanted_.end(), wants_force);
}

void ServedClient::share(std::size_t device, const SharedState& shared) {
  const std::int32_t number = number_of(device);
  const PointerState& state = shared.state;
  outbox_.put(number, Kind::PosQuat, pack(PosQuat{0, state.position, state.orientation}).bytes());
  outbox_.put(number, Kind::Velocity, pack(Velocity{0, state.velocity}).bytes());
  outbox_.put(number, Kind::Force, Payload().put(shared.force).bytes());
  share_buttons(device, state.buttons);
}

void ServedClient::share_buttons(std::size_t device, std::uint32_t buttons) {
  const std::int32_t number = number_of(device);
  if (!buttons_known_[device]) {
    outbox_.put(number, Kind::ButtonStates, pack_buttons(buttons, kToldButtons).bytes());
    buttons_known_[device] = true;
    buttons_[device] = buttons;
    return;
  }
  const std::uint32_t changed = buttons ^ std::exchange(buttons_[device], buttons);
  for (std::int32_t i = 0; i < kToldButtons; ++i) {
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
