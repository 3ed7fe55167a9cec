#include "collab/link/wire/listening_socket.h"

#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace icome::collab {
namespace {

bool is_on_loopback(const sockaddr* address) {
  if (address->sa_family == AF_INET) {
    const auto* const v4 = reinterpret_cast<const sockaddr_in*>(address);
    return ntohl(v4->sin_addr.s_addr) >> 24U == 127;
  }
  const auto* const v6 = reinterpret_cast<const sockaddr_in6*>(address);
  return address->sa_family == AF_INET6 && IN6_IS_ADDR_LOOPBACK(&v6->sin6_addr);
}

/// The descriptor, or below zero and errno.
int listen_on(const addrinfo& place) {
  const int socket = ::socket(place.ai_family, place.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket < 0) return socket;
  const int on = 1;  // at once after a server that has ended
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
  if (::bind(socket, place.ai_addr, place.ai_addrlen) == 0 && ::listen(socket, SOMAXCONN) == 0) return socket;
  const int error = errno;
  ::close(socket);
  errno = error;
  return -1;
}

Endpoint endpoint_of(int socket) {
  sockaddr_storage address = {};
  socklen_t size = sizeof(address);
  std::array<char, NI_MAXHOST> host = {};
  std::array<char, NI_MAXSERV> port = {};
  ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  ::getnameinfo(reinterpret_cast<sockaddr*>(&address), size, host.data(), host.size(), port.data(),
                port.size(), NI_NUMERICHOST | NI_NUMERICSERV);
  return {host.data(), std::uint16_t(std::atoi(port.data()))};
}

}  // namespace

std::string shown_endpoint(const Endpoint& endpoint) {
  const bool is_v6 = endpoint.host.find(':') != std::string::npos;
  return is_v6 ? fmt::format("[{}]:{}", endpoint.host, endpoint.port)
               : fmt::format("{}:{}", endpoint.host, endpoint.port);
}

base::Result<ListeningSocket> listen_at(const Endpoint& endpoint, Reach reach) {
  addrinfo wanted = {};
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int failed =
      ::getaddrinfo(endpoint.host.c_str(), std::to_string(endpoint.port).c_str(), &wanted, &found);
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> places(failed == 0 ? found : nullptr, ::freeaddrinfo);
  if (!places)
    return base::fail(fmt::format("{}: no address of this computer ({}); give one such as 127.0.0.1.",
                                  shown_endpoint(endpoint), ::gai_strerror(failed)));
  int error = EADDRNOTAVAIL;
  for (const addrinfo* place = places.get(); place != nullptr; place = place->ai_next) {
    if (reach == Reach::ThisComputerOnly && !is_on_loopback(place->ai_addr))
      return base::fail(fmt::format(
          "{}: without a certificate, only this computer may be served; give a certificate and its key, or "
          "listen on 127.0.0.1.",
          shown_endpoint(endpoint)));
    const int socket = listen_on(*place);
    if (socket >= 0) return ListeningSocket{socket, place->ai_family == AF_INET6, endpoint_of(socket)};
    error = errno;
  }
  return base::fail(fmt::format("{}: cannot be listened at ({}); choose another port or address.",
                                shown_endpoint(endpoint), std::strerror(error)));
}

}  // namespace icome::collab
