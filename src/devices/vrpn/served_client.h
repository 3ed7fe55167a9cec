#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "devices/vrpn/protocol.h"
#include "devices/vrpn/remote_forces.h"
#include "devices/vrpn/vrpn_address.h"
#include "devices/vrpn/vrpn_socket.h"

namespace icome::devices::vrpn {

/// The state and the force of a device, as a server shares them.
struct SharedState {
  PointerState state;
  Vector3 force = Vector3::Zero();  // N
};

/// The devices of a server, the same for all its clients.
struct ServedDevices {
  std::vector<std::string> names;
  VrpnFrame frame;
  int buttons = 8;
  RemoteForceSettings forces;
};

/// One client of a server, from its first byte to its last. Nothing here waits, and its memory is bounded.
class ServedClient {
 public:
  /// `connecting`: we connect to it, as it asked for. The devices outlive it.
  ServedClient(Socket socket, const Place& place, bool connecting, const ServedDevices& devices,
               std::int64_t now);

  /// Receives and sends as much as goes at once. False once the client is to be dropped.
  bool serve(std::int64_t now);
  /// Has the client greeted, and taken all that was said before? States that would wait are left out: later
  /// ones are newer.
  bool ready() const { return talks() && !has_waiting(); }
  /// Says a device's state, to a client that is ready.
  void share(std::size_t device, const SharedState& shared);
  void say_farewell();

  int socket() const { return socket_.number(); }
  const Place& place() const { return place_; }
  bool connecting() const { return connecting_; }
  bool talks() const { return decoder_.greeted(); }
  bool has_waiting() const { return connecting_ || !outbox_.waiting().empty(); }
  /// Did the client send as much as is read in one turn? More may be waiting.
  bool floods() const { return floods_; }
  const ClientForces& wanted(std::size_t device) const { return wanted_[device]; }
  /// Have the client's wishes changed since this was asked last?
  bool wishes_changed() { return std::exchange(wishes_changed_, false); }

 private:
  bool receive_some();
  bool send_some(std::int64_t now);
  void take(const Message& message);
  void take_plane(std::size_t device, std::string_view payload);
  void take_field(std::size_t device, std::string_view payload);
  void share_buttons(std::size_t device, std::uint32_t buttons);

  Socket socket_;
  Place place_;
  bool connecting_;
  const ServedDevices& devices_;
  Decoder decoder_;
  Outbox outbox_;
  PeerNames names_;
  std::int64_t since_;            // ns
  std::int64_t stuck_since_ = 0;  // ns; 0: it takes our messages
  bool floods_ = false;
  bool left_ = false;
  bool wishes_changed_ = false;
  std::uint64_t revision_ = 0;
  std::vector<ClientForces> wanted_;    // by device
  std::vector<std::uint32_t> buttons_;  // as it knows them
  std::vector<bool> buttons_known_;
};

}  // namespace icome::devices::vrpn
