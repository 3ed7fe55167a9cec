// The bytes of a VRPN peer, a client's or a server's.
#include <algorithm>
#include <array>

#include "devices/vrpn/protocol.h"
#include "devices/vrpn/remote_forces.h"
#include "devices/vrpn/tracker_readings.h"
#include "fuzz/harness.h"

namespace icome::fuzz {
namespace {

using namespace devices::vrpn;

/// Takes in one message as a server and a client of ours do.
void take_in(const Message& message, PeerNames& names, TrackerReadings& readings, WantedForces& wanted) {
  const RemoteForceSettings settings;
  if (message.type < 0) return names.learn(message);
  const Kind kind = names.kind(message.type);
  readings.take(kind, message, message.time);
  const std::string_view payload = message.payload;
  if (auto plane = kind == Kind::Plane ? read_plane(payload) : std::nullopt; plane && tidy(*plane, settings))
    wanted.clients[0].planes[0] = {*plane, wanted.clients[0].planes[0].revision + 1};
  if (auto field = kind == Kind::ForceField ? read_force_field(payload) : std::nullopt;
      field && tidy(*field, settings))
    wanted.clients[0].field = *field;
}

void run_vrpn(std::string_view bytes) {
  Decoder decoder;
  PeerNames names;
  TrackerReadings readings((devices::VrpnAddress()));
  WantedForces wanted;
  RemoteForces forces{RemoteForceSettings()};
  std::int64_t now = 0;
  // In pieces that are as long as their first byte says, as sockets give them.
  while (!bytes.empty()) {
    const std::size_t piece =
        std::min<std::size_t>(1 + static_cast<unsigned char>(bytes.front()), bytes.size());
    const auto room = decoder.room();
    require(room.size() >= kLongestMessage, "there is always room");
    std::copy_n(bytes.begin(), piece, room.begin());
    decoder.received(piece);
    bytes.remove_prefix(piece);
    Message message;
    while (decoder.next(message) == Decoder::Step::Message) {
      require(message.payload.size() <= kLongestMessage, "messages are bounded");
      take_in(message, names, readings, wanted);
      devices::PointerState state;
      state.position.y() = -0.001;
      require(forces.force(wanted, state, now += 1'000'000).allFinite(), "a force is a number");
    }
  }
  require(names.senders().size() <= 512, "names are bounded");
}

std::vector<std::string> vrpn_seeds() {
  Outbox outbox;
  outbox.put_cookie();
  outbox.describe(kSenderDescription, 0, "Tracker0");
  outbox.describe_kinds();
  outbox.put(0, Kind::PosQuat, pack(PosQuat{}).bytes());
  outbox.put(0, Kind::Velocity, pack(Velocity{}).bytes());
  outbox.put(0, Kind::ButtonStates, pack_buttons(5, 8).bytes());
  outbox.put(0, Kind::ButtonChange, pack(Button{1, true}).bytes());
  outbox.put(0, Kind::AnalogChannel, Payload().put(2.0).put(0.5).put(0.25).bytes());
  Plane plane;
  plane.normal.y() = 1.0;
  plane.spring = 0.5;
  outbox.put(0, Kind::Plane, pack(plane).bytes());
  ForceField field;
  field.radius = 1.0;
  outbox.put(0, Kind::ForceField, pack(field).bytes());
  outbox.put(0, Kind::Ping, {});
  return {std::string(outbox.waiting())};
}

constexpr std::array<Harness, 1> kVrpn{{{"vrpn", run_vrpn, vrpn_seeds}}};

}  // namespace

std::span<const Harness> vrpn_harnesses() { return kVrpn; }

}  // namespace icome::fuzz
