#include "devices/vrpn/client_link.h"

#include <algorithm>
#include <utility>

#include "base/clock.h"

namespace icome::devices::vrpn {
namespace {

constexpr std::int64_t kPingAfter = 1'000'000'000;   // ns without a byte
constexpr std::int64_t kGoneAfter = 3'000'000'000;   // ns without a byte
constexpr std::int64_t kStuckAfter = 1'000'000'000;  // ns in which the server takes nothing
constexpr int kMostReceived = 16;                    // pieces in one call, so that a flood cannot hold it up
constexpr std::int32_t kOurDevice = 0;               // the number of its name, as we tell it

}  // namespace

base::Result<std::unique_ptr<ClientLink>> ClientLink::connect(const VrpnAddress& address, double patience) {
  const std::string server = address.host + ":" + std::to_string(address.port);
  const auto place = find_host(address.host, address.port);
  if (!place) return tl::unexpected(place.error());
  Socket socket = begin_connecting(*place);
  const std::int64_t deadline = base::steady_nanoseconds() + static_cast<std::int64_t>(1e9 * patience);
  if (socket) wait_for(socket, true, deadline - base::steady_nanoseconds());
  if (!socket || !connected(socket))
    return base::fail("no VRPN server answers at " + server +
                      "; start it there, or check the address and that no firewall is between");
  prepare(socket, 1e-9 * kGoneAfter);
  std::unique_ptr<ClientLink> link(new ClientLink(address, std::move(socket)));
  while (!link->decoder_.greeted()) {
    const std::int64_t left =
        deadline + static_cast<std::int64_t>(1e9 * patience) - base::steady_nanoseconds();
    if (left <= 0) return base::fail("what listens at " + server + " does not speak VRPN; check the port");
    if (!link->receive(left, [](const Message&, Kind, bool) {})) return base::fail(link->why());
  }
  return link;
}

ClientLink::ClientLink(const VrpnAddress& address, Socket socket)
    : server_(address.host + ":" + std::to_string(address.port)),
      name_(address.name),
      socket_(std::move(socket)),
      heard_(base::steady_nanoseconds()) {
  outbox_.put_cookie();
}

void ClientLink::introduce(std::initializer_list<Kind> kinds) {
  introduced_ = true;
  outbox_.describe(kSenderDescription, kOurDevice, name_);
  outbox_.describe(Kind::Ping);
  outbox_.describe(Kind::Pong);
  for (const Kind kind : kinds) outbox_.describe(kind);
}

bool ClientLink::has_device() const {
  const auto& all = names_.senders();
  return std::find(all.begin(), all.end(), name_) != all.end();
}

bool ClientLink::end(const std::string& how) {
  if (why_.empty()) why_ = "the VRPN server at " + server_ + " " + how;
  return false;
}

bool ClientLink::flush() {
  while (!outbox_.waiting().empty()) {
    std::size_t count = 0;
    const Flow flow = send(socket_, outbox_.waiting(), count);
    outbox_.sent(count);
    if (flow == Flow::Ended) return end("ended the connection; it comes back by itself once it runs again");
    if (flow == Flow::Later) {
      const std::int64_t now = base::steady_nanoseconds();
      if (stuck_since_ == 0) stuck_since_ = now;
      if (now - stuck_since_ > kStuckAfter)
        return end("takes no more messages; look whether it stands still");
      return true;
    }
    stuck_since_ = 0;
  }
  stuck_since_ = 0;
  return true;
}

bool ClientLink::keep_alive(std::int64_t now) {
  if (now - heard_ > kGoneAfter)
    return end("has said nothing for 3 s; look whether it runs, and whether its computer is on");
  if (introduced_ && now - heard_ > kPingAfter && now - asked_ > kPingAfter) {
    asked_ = now;
    outbox_.put(kOurDevice, Kind::Ping, {});
  }
  return true;
}

bool ClientLink::receive(std::int64_t nanoseconds, Handler handler) {
  if (!why_.empty() || !flush()) return false;
  wait_for(socket_, !outbox_.waiting().empty(), nanoseconds);
  const std::int64_t now = base::steady_nanoseconds();
  for (int i = 0; i < kMostReceived; ++i) {
    std::size_t count = 0;
    const Flow flow = vrpn::receive(socket_, decoder_.room(), count);
    if (flow == Flow::Ended) return end("ended the connection; it comes back by itself once it runs again");
    if (flow == Flow::Later) break;
    heard_ = now;
    decoder_.received(count);
    Message message;
    Decoder::Step step = decoder_.next(message);
    for (; step == Decoder::Step::Message; step = decoder_.next(message)) {
      if (!take(message, handler)) return false;
    }
    if (step == Decoder::Step::Broken) return end("does not speak VRPN 7 as we know it; check the port");
  }
  return keep_alive(now) && flush();
}

bool ClientLink::take(const Message& message, Handler handler) {
  if (message.type == kDisconnect)
    return end("ended the connection; it comes back by itself once it runs again");
  if (message.type < 0) {
    names_.learn(message);
    return true;
  }
  const Kind kind = names_.kind(message.type);
  // A pong that finds no room is left out: the messages that wait show as well that we are there.
  if (kind == Kind::Ping && introduced_) outbox_.put(kOurDevice, Kind::Pong, {});
  handler(message, kind, names_.sender(message.sender) == name_);
  return true;
}

bool ClientLink::say(Kind kind, const Payload& payload) {
  if (!outbox_.waiting().empty()) return false;
  return outbox_.put(kOurDevice, kind, payload.bytes());
}

void ClientLink::leave_with(Kind kind, const Payload& payload) {
  outbox_.put(kOurDevice, kind, payload.bytes());
  leave();
}

void ClientLink::leave() {
  outbox_.put(kOurDevice, kDisconnect, {});
  const std::int64_t deadline = base::steady_nanoseconds() + 100'000'000;
  while (why_.empty() && flush() && !outbox_.waiting().empty() && base::steady_nanoseconds() < deadline)
    wait_for(socket_, true, 10'000'000);
  end("is no longer asked");
}

}  // namespace icome::devices::vrpn
