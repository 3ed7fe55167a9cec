#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/result.h"

namespace icome::devices::vrpn {

/// Owns a socket (or none: -1). No call waits, unless it says so.
class Socket {
 public:
  Socket() = default;
  explicit Socket(int number) : number_(number) {}
  ~Socket() { close(); }
  Socket(Socket&& other) noexcept : number_(other.number_) { other.number_ = -1; }
  Socket& operator=(Socket&& other) noexcept;

  int number() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }
  void close();

 private:
  int number_ = -1;
};

/// The outcome of a call that moves bytes.
enum class Flow : std::uint8_t {
  Some,   // some bytes went
  Later,  // no byte could go now
  Ended,  // the other side is gone
};

/// An IPv4 address in the order of the network, and a port in ours.
struct Place {
  std::uint32_t host = 0;
  std::uint16_t port = 0;
};
/// The place as people write it: "127.0.0.1:3883".
std::string shown(const Place& place);
/// Looks a name up, which may take seconds; the error says that it is unknown, or that it is of IPv6.
base::Result<Place> find_host(const std::string& host, int port);

/// A TCP socket that connects or is connected; writes on it tell when poll() says that it can be written.
Socket begin_connecting(const Place& place);
/// Is the socket connected by now?
bool connected(const Socket& socket);
/// Has the attempt to connect failed?
bool refused(const Socket& socket);
/// Small messages go at once, few wait in the system, so that a slow reader gets no old ones, and a peer that
/// is gone without a word is given up after `patience` s.
void prepare(const Socket& socket, double patience);
/// A listening TCP socket at a place, which fills in the port that it got, or a UDP one; the error says what
/// is in the way and what to do.
base::Result<Socket> listen_at(Place& place);
base::Result<Socket> datagrams_at(const Place& place);
/// Takes a connection that waits. Later: none does; Ended: one does, but the system has no room for it.
Flow accept_from(const Socket& listener, Socket& taken);

Flow receive(const Socket& socket, std::span<char> bytes, std::size_t& count);
Flow send(const Socket& socket, std::string_view bytes, std::size_t& count);
/// One datagram, cut off at the end of `bytes`, and who sent it.
Flow receive_datagram(const Socket& socket, std::span<char> bytes, std::size_t& count, Place& sender);
/// Waits for something to receive (and, if asked, for room to send), `nanoseconds` at most.
void wait_for(const Socket& socket, bool to_send, std::int64_t nanoseconds);

}  // namespace icome::devices::vrpn
