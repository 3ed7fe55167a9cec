#pragma once
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "devices/vrpn/protocol.h"

namespace icome::devices::fakes {

inline sockaddr_in loopback(int port) {
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  return address;
}

/// A client on a plain socket, which waits.
class PlainClient {
 public:
  explicit PlainClient(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    const sockaddr_in address = loopback(port);
    EXPECT_EQ(connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
    be_patient();
  }
  static PlainClient called_at(int listener) { return PlainClient(accept(listener, nullptr, nullptr), true); }
  PlainClient(PlainClient&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}
  ~PlainClient() {
    if (socket_ >= 0) close(socket_);
  }

  void say(std::string_view bytes) const {
    static_cast<void>(send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL));
  }
  /// Greets, and describes itself as a client of the device.
  void greet(const std::string& name = "Pointer0") {
    vrpn::Outbox outbox;
    outbox.put_cookie();
    outbox.describe(vrpn::kSenderDescription, 7, name);
    outbox.describe_kinds();
    say(outbox.waiting());
  }
  void say(vrpn::Kind kind, const vrpn::Payload& payload) {
    vrpn::Outbox outbox;
    outbox.put(7, kind, payload.bytes());
    say(outbox.waiting());
  }
  /// Receives until a message of this kind, about the device that it names, has come.
  bool hears(vrpn::Kind kind, const std::function<bool(std::string_view)>& condition,
             const std::string& device = "Pointer0") {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (std::chrono::steady_clock::now() < end) {
      vrpn::Message message;
      while (decoder_.next(message) == vrpn::Decoder::Step::Message) {
        names_.learn(message);
        if (message.type >= 0 && names_.kind(message.type) == kind &&
            names_.sender(message.sender) == device && condition(message.payload))
          return true;
      }
      const std::span<char> room = decoder_.room();
      const ssize_t count = recv(socket_, room.data(), room.size(), 0);
      if (count <= 0) return false;
      decoder_.received(static_cast<std::size_t>(count));
    }
    return false;
  }
  bool hears(vrpn::Kind kind) {
    return hears(kind, [](std::string_view) { return true; });
  }
  /// Receives until the server closes.
  bool is_closed() const {
    std::array<char, 65536> away;
    ssize_t count = 1;
    while (count > 0) count = recv(socket_, away.data(), away.size(), 0);
    return count == 0 || errno == ECONNRESET;
  }
  int socket() const { return socket_; }

 private:
  PlainClient(int socket, bool) : socket_(socket) { be_patient(); }
  void be_patient() const {
    const timeval patience = {30, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  }

  int socket_;
  vrpn::Decoder decoder_;
  vrpn::PeerNames names_;
};

}  // namespace icome::devices::fakes
