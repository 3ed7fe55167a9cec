#include "devices/vrpn/vrpn_socket.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

namespace icome::devices::vrpn {
namespace {

constexpr int kBacklog = 1 << 15;  // bytes

sockaddr_in system_address(const Place& place) {
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = place.host;
  address.sin_port = htons(place.port);
  return address;
}

void set_option(int socket, int level, int option, int value) {
  static_cast<void>(setsockopt(socket, level, option, &value, sizeof(value)));
}

/// What keeps a server from a place, for people, by the system's number of the error.
tl::unexpected<base::Error> no_place(const Place& place, int error) {
  const std::string at = "cannot listen at " + shown(place) + ": ";
  if (error == EADDRINUSE)
    return base::fail(at + "another program does; end it, or choose another port (0 takes a free one)");
  if (error == EADDRNOTAVAIL)
    return base::fail(at +
                      "this computer has no such address; 127.0.0.1 is for programs on it, 0.0.0.0 for "
                      "all networks that it is in");
  if (error == EACCES)
    return base::fail(at + "ports below 1024 are the system's; choose a higher one, such as 3883");
  return base::fail(at + std::strerror(error));
}

base::Result<Socket> bound(const Place& place, int type) {
  Socket socket(::socket(AF_INET, type | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!socket) return no_place(place, errno);
  // A server that comes back at once finds its port in use by connections that are ending.
  if (type == SOCK_STREAM) set_option(socket.number(), SOL_SOCKET, SO_REUSEADDR, 1);
  const sockaddr_in address = system_address(place);
  if (bind(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
    return no_place(place, errno);
  return socket;
}

Flow flow_of(ssize_t moved, std::size_t& count) {
  count = static_cast<std::size_t>(std::max<ssize_t>(0, moved));
  if (moved > 0) return Flow::Some;
  if (moved < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) return Flow::Later;
  return Flow::Ended;
}

}  // namespace

Socket& Socket::operator=(Socket&& other) noexcept {
  if (this != &other) {
    close();
    number_ = std::exchange(other.number_, -1);
  }
  return *this;
}

void Socket::close() {
  if (number_ >= 0) ::close(number_);
  number_ = -1;
}

std::string shown(const Place& place) {
  std::array<char, INET_ADDRSTRLEN> text = {};
  const in_addr address = {place.host};
  inet_ntop(AF_INET, &address, text.data(), text.size());
  return std::string(text.data()) + ":" + std::to_string(place.port);
}

base::Result<Place> find_host(const std::string& host, int port) {
  if (host.find(':') != std::string::npos)
    return base::fail("'" + host +
                      "' is an address of IPv6, which VRPN does not speak; give a name or an address such as "
                      "127.0.0.1");
  addrinfo hints = {};
  hints.ai_family = AF_INET;
  addrinfo* found = nullptr;
  if (getaddrinfo(host.c_str(), nullptr, &hints, &found) != 0 || found == nullptr)
    return base::fail("no computer is known by the name '" + host + "'; check it, or give its IP address");
  sockaddr_in address = {};
  std::memcpy(&address, found->ai_addr, sizeof(address));
  freeaddrinfo(found);
  return Place{address.sin_addr.s_addr, static_cast<std::uint16_t>(port)};
}

Socket begin_connecting(const Place& place) {
  Socket socket(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!socket) return {};
  const sockaddr_in address = system_address(place);
  if (connect(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0 &&
      errno != EINPROGRESS)
    return {};
  return socket;
}

bool connected(const Socket& socket) {
  sockaddr_in peer = {};
  socklen_t size = sizeof(peer);
  return getpeername(socket.number(), reinterpret_cast<sockaddr*>(&peer), &size) == 0;
}

bool refused(const Socket& socket) {
  int error = 0;
  socklen_t size = sizeof(error);
  return getsockopt(socket.number(), SOL_SOCKET, SO_ERROR, &error, &size) != 0 || error != 0;
}

void prepare(const Socket& socket, double patience) {
  set_option(socket.number(), IPPROTO_TCP, TCP_NODELAY, 1);
  set_option(socket.number(), SOL_SOCKET, SO_SNDBUF, kBacklog);
  set_option(socket.number(), IPPROTO_TCP, TCP_USER_TIMEOUT, static_cast<int>(1000.0 * patience));
}

base::Result<Socket> listen_at(Place& place) {
  auto socket = bound(place, SOCK_STREAM);
  if (!socket) return socket;
  sockaddr_in address = {};
  socklen_t size = sizeof(address);
  if (listen(socket->number(), 16) != 0 ||
      getsockname(socket->number(), reinterpret_cast<sockaddr*>(&address), &size) != 0)
    return no_place(place, errno);
  place.port = ntohs(address.sin_port);
  return socket;
}

base::Result<Socket> datagrams_at(const Place& place) { return bound(place, SOCK_DGRAM); }

Flow accept_from(const Socket& listener, Socket& taken) {
  taken = Socket(accept4(listener.number(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (taken) return Flow::Some;
  const bool full = errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM;
  return full ? Flow::Ended : Flow::Later;
}

Flow receive(const Socket& socket, std::span<char> bytes, std::size_t& count) {
  return flow_of(recv(socket.number(), bytes.data(), bytes.size(), MSG_DONTWAIT), count);
}

Flow send(const Socket& socket, std::string_view bytes, std::size_t& count) {
  return flow_of(::send(socket.number(), bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL), count);
}

Flow receive_datagram(const Socket& socket, std::span<char> bytes, std::size_t& count, Place& sender) {
  sockaddr_in address = {};
  socklen_t size = sizeof(address);
  const ssize_t moved = recvfrom(socket.number(), bytes.data(), bytes.size(), MSG_DONTWAIT,
                                 reinterpret_cast<sockaddr*>(&address), &size);
  sender = {address.sin_addr.s_addr, ntohs(address.sin_port)};
  if (moved == 0) {
    count = 0;
    return Flow::Some;
  }
  return flow_of(moved, count);
}

void wait_for(const Socket& socket, bool to_send, std::int64_t nanoseconds) {
  pollfd waiting = {socket.number(), static_cast<short>(to_send ? POLLIN | POLLOUT : POLLIN), 0};
  const timespec time = {static_cast<time_t>(nanoseconds / 1'000'000'000),
                         static_cast<long>(nanoseconds % 1'000'000'000)};
  static_cast<void>(ppoll(&waiting, 1, &time, nullptr));
}

}  // namespace icome::devices::vrpn
