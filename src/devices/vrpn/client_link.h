#pragma once
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>

#include "base/function_ref.h"
#include "base/result.h"
#include "devices/vrpn/protocol.h"
#include "devices/vrpn/vrpn_address.h"
#include "devices/vrpn/vrpn_socket.h"

namespace icome::devices::vrpn {

/// A client's connection to a VRPN server by TCP, for one device of it. One thread uses it.
class ClientLink {
 public:
  /// Connects and greets, which may take `patience` s for each; the error says what is missing.
  static base::Result<std::unique_ptr<ClientLink>> connect(const VrpnAddress& address, double patience = 2.0);

  /// Called with a message of the server, its kind, and whether it is about our device.
  using Handler = base::FunctionRef<void(const Message&, Kind, bool)>;
  /// Waits for bytes, `nanoseconds` at most, and hands out the messages that have come whole. Answers pings,
  /// and pings after a long silence. False once the connection has ended: why() says how. Real-time safe but
  /// for descriptions, which come at the beginning.
  bool receive(std::int64_t nanoseconds, Handler handler);
  /// Tells our device's name and the kinds of messages that we send. Not before the names of the server were
  /// looked at: a stock one takes over every name that it is told, and tells it as its own.
  void introduce(std::initializer_list<Kind> kinds);
  /// Sends as soon as there is room; false, and nothing of it, while earlier messages still wait.
  bool say(Kind kind, const Payload& payload);
  /// Says the last message, even behind others that wait, and farewell; waits 0.1 s at most.
  void leave();
  void leave_with(Kind kind, const Payload& payload);

  const PeerNames& names() const { return names_; }
  /// Does the server have a device of our name?
  bool has_device() const;
  const std::string& why() const { return why_; }

 private:
  ClientLink(const VrpnAddress& address, Socket socket);
  bool take(const Message& message, Handler handler);
  bool flush();
  bool keep_alive(std::int64_t now);
  bool end(const std::string& how);

  std::string server_;  // for people
  std::string name_;
  Socket socket_;
  Decoder decoder_;
  Outbox outbox_;
  PeerNames names_;
  bool introduced_ = false;
  std::int64_t heard_ = 0;        // ns, of the last bytes
  std::int64_t asked_ = 0;        // ns, of the last ping
  std::int64_t stuck_since_ = 0;  // ns, when the server began to take nothing; 0: it takes our messages
  std::string why_;
};

}  // namespace icome::devices::vrpn
