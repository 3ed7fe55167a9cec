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
#include "devices/vrpn/vrpn_socket.h"

namespace icome::devices::vrpn {

/// The state and the force of a device, as a server shares them.
struct SharedState {
  PointerState state;
  Vector3 force = Vector3::Zero();  // N
};

/// One client of a server, from its first byte to its last. Nothing here waits, and its memory is bounded.
///
/// A client that hangs with its connection open would leave its forces behind. So one with forces is pinged
/// every second; one that has answered before and leaves a ping without a word for 3 s loses its forces, and
/// after 10 s its connection. Stock clients answer no pings and may rightly be silent: theirs end once they
/// take nothing for 2 s.
class ServedClient {
 public:
  /// `connecting`: we connect to it, as it asked for. `number`: no other client has or had it. The names of
  /// the devices outlive it.
  ServedClient(Socket socket, const Place& place, bool connecting, const std::vector<std::string>& devices,
               std::uint64_t number, std::int64_t now);

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
  bool is_alive(std::int64_t now);
  bool send_some(std::int64_t now);
  void take(const Message& message);
  void take_plane(std::size_t device, std::string_view payload);
  void take_field(std::size_t device, std::string_view payload);
  void note_wish(std::size_t device);
  void drop_wishes();
  void share_buttons(std::size_t device, std::uint32_t buttons);

  Socket socket_;
  Place place_;
  bool connecting_;
  const std::vector<std::string>& devices_;
  std::uint64_t number_;
  Decoder decoder_;
  Outbox outbox_;
  PeerNames names_;
  std::int64_t since_;            // ns
  std::int64_t pinged_ = 0;       // ns, the last time
  std::int64_t quiet_since_ = 0;  // ns, of the first ping after its last bytes; 0: none
  bool answers_ = false;          // has it answered a ping?
  bool has_forces_ = false;       // or had them when it fell silent
  std::size_t forced_ = 0;        // the device that it gave a force last
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
