#include "devices/vrpn/vrpn_server.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/clock.h"
#include "base/parse_number.h"
#include "realtime/this_thread.h"

namespace icome::devices {
namespace {

using vrpn::kMostClients;
using vrpn::Place;
using vrpn::ServedClient;
using vrpn::Socket;

constexpr std::size_t kMostNames = 8;
constexpr std::size_t kMostCalls = 4;           // connections to clients that are under way at once
constexpr int kMostTaken = 16;                  // connections or requests taken in one turn
constexpr std::int64_t kPeriod = 1'000'000;     // ns between two states that a client gets
constexpr std::int64_t kBusyLook = 250'000;     // ns between two looks at the device, with clients
constexpr std::int64_t kIdleLook = 20'000'000;  // ns, without
// Rest of the thread after more bytes than it reads in a turn, and of its door while the system has no room
// for another connection, ns.
constexpr std::int64_t kFloodBreak = 1'000'000;
constexpr std::int64_t kFullBreak = 100'000'000;
constexpr int kTries = 20;  // for a port that is free for TCP and UDP

/// The port in a request to be called: "CLIENT_IP PORT", ended by a zero.
std::optional<std::uint16_t> asked_port(std::string_view text) {
  text = text.substr(0, text.find('\0'));
  const std::size_t space = text.rfind(' ');
  if (space == std::string_view::npos || space == 0) return std::nullopt;
  text.remove_prefix(space + 1);
  const auto port = base::parse_number<std::uint16_t>(text);
  return port && *port != 0 ? port : std::nullopt;
}

base::Result<void> check(const VrpnServerSettings& settings) {
  if (settings.names.empty() || settings.names.size() > kMostNames)
    return base::fail("a VRPN server shares 1 to 8 devices");
  for (auto name = settings.names.begin(); name != settings.names.end(); ++name) {
    if (name->empty() || name->size() > vrpn::kLongestName ||
        name->find_first_of("@\0", 0, 2) != std::string::npos)
      return base::fail("'" + *name +
                        "': the name of a VRPN device has 1 to 100 letters, and no @ among them");
    if (std::find(settings.names.begin(), name, *name) != name)
      return base::fail("'" + *name + "' is shared twice; give each device another name");
  }
  if (settings.port < 0 || settings.port > 65535)
    return base::fail(std::to_string(settings.port) +
                      " is no port; there are 1 to 65535, and 0 for a free one");
  return {};
}

}  // namespace

base::Result<std::unique_ptr<VrpnServer>> VrpnServer::create(const VrpnServerSettings& settings) {
  if (const auto checked = check(settings); !checked) return tl::unexpected(checked.error());
  std::unique_ptr<VrpnServer> server(new VrpnServer(settings));
  if (const auto listens = server->listen(settings); !listens) return tl::unexpected(listens.error());
  try {
    server->thread_ = std::thread([it = server.get()] { it->run(); });
  } catch (const std::system_error& error) {
    return base::fail(std::string("the system gives no thread for the VRPN server (") + error.what() +
                      "); close other programs and try again");
  }
  return server;
}

VrpnServer::VrpnServer(const VrpnServerSettings& settings) : names_(settings.names), clients_(kMostClients) {
  for (std::size_t i = 0; i < names_.size(); ++i) states_.push_back(std::make_unique<Device>());
}

base::Result<void> VrpnServer::listen(const VrpnServerSettings& settings) {
  const auto place = vrpn::find_host(settings.host, settings.port);
  if (!place) return tl::unexpected(place.error());
  const int tries = settings.port == 0 ? kTries : 1;
  for (int i = 1;; ++i) {
    place_ = *place;
    auto listener = vrpn::listen_at(place_);
    if (!listener) return tl::unexpected(listener.error());
    auto requests = vrpn::datagrams_at(place_);
    if (!requests && i == tries) return tl::unexpected(requests.error());
    if (!requests) continue;
    listener_ = std::move(*listener);
    requests_ = std::move(*requests);
    return {};
  }
}

void VrpnServer::feed(const PointerState& state, const Vector3& force, std::size_t device) {
  vrpn::SharedState& next = states_[device]->states.write_slot();
  next.state = state;
  next.force = force;
  states_[device]->states.publish();
}

Vector3 VrpnServer::wanted_force(const PointerState& state, std::int64_t now, std::size_t device) {
  Device& it = *states_[device];
  it.wanted.update();
  return it.forces.force(it.wanted.read(), state, now);
}

void VrpnServer::stop() {
  stop_.store(true, std::memory_order_relaxed);
  if (thread_.joinable()) thread_.join();
}

void VrpnServer::run() {
  while (!stop_.load(std::memory_order_relaxed)) {
    wait();
    const std::int64_t now = base::steady_nanoseconds();
    if (now >= full_until_) accept_clients(now);
    answer_requests(now);
    share(now);
    serve(now);
    publish_wishes();
  }
  for (auto& client : clients_) {
    if (client) client->say_farewell();
    client.reset();
  }
  listener_.close();
  requests_.close();
  wishes_changed_ = true;
  publish_wishes();
}

void VrpnServer::wait() {
  // A client that sends more than is read in a turn is read once a millisecond, so that the thread can rest
  // between.
  if (std::exchange(flooded_, false)) realtime::sleep_until(base::steady_nanoseconds() + kFloodBreak);
  std::array<pollfd, kMostClients + 2> waiting = {};
  std::size_t count = 0;
  // The system's number -1 stands for none.
  const bool full = base::steady_nanoseconds() < full_until_;
  waiting[count++] = {full ? -1 : listener_.number(), POLLIN, 0};
  waiting[count++] = {requests_.number(), POLLIN, 0};
  bool any = false;
  for (const auto& client : clients_) {
    if (!client) continue;
    any = true;
    const int events = client->has_waiting() ? POLLIN | POLLOUT : POLLIN;
    waiting[count++] = {client->socket(), static_cast<short>(events), 0};
  }
  const timespec time = {0, any ? kBusyLook : kIdleLook};
  static_cast<void>(ppoll(waiting.data(), count, &time, nullptr));
}

void VrpnServer::accept_clients(std::int64_t now) {
  for (int i = 0; i < kMostTaken; ++i) {
    Socket socket;
    const vrpn::Flow flow = vrpn::accept_from(listener_, socket);
    if (flow == vrpn::Flow::Ended) full_until_ = now + kFullBreak;
    if (flow != vrpn::Flow::Some) return;
    add(std::move(socket), {}, false, now);
  }
}

void VrpnServer::add(Socket socket, const Place& place, bool connecting, std::int64_t now) {
  const auto free = std::find(clients_.begin(), clients_.end(), nullptr);
  if (free == clients_.end()) return;  // the socket closes: no more are taken
  *free =
      std::make_unique<ServedClient>(std::move(socket), place, connecting, names_, ++clients_so_far_, now);
}

bool VrpnServer::may_call(const Place& place) const {
  std::size_t calls = 0;
  for (const auto& client : clients_) {
    if (!client) continue;
    if (client->place().host == place.host && client->place().port == place.port) return false;
    if (client->connecting()) ++calls;
  }
  return calls < kMostCalls;
}

void VrpnServer::answer_requests(std::int64_t now) {
  std::array<char, 128> text;
  for (int i = 0; i < kMostTaken; ++i) {
    std::size_t count = 0;
    Place sender;
    if (vrpn::receive_datagram(requests_, text, count, sender) != vrpn::Flow::Some) return;
    const auto port = asked_port({text.data(), count});
    if (!port) continue;
    // The sender's own address, whatever the text says: nobody sends us to a third computer.
    const Place place = {sender.host, *port};
    if (!may_call(place)) continue;
    if (Socket socket = vrpn::begin_connecting(place)) add(std::move(socket), place, true, now);
  }
}

void VrpnServer::share(std::int64_t now) {
  if (now < due_) return;
  std::array<bool, kMostNames> fresh = {};
  for (std::size_t device = 0; device < states_.size(); ++device)
    fresh[device] = states_[device]->states.update();
  for (const auto& client : clients_) {
    if (!client || !client->ready()) continue;
    for (std::size_t device = 0; device < states_.size(); ++device) {
      if (fresh[device]) client->share(device, states_[device]->states.read());
    }
  }
  // A turn that comes late takes nothing from the next one.
  if (std::find(fresh.begin(), fresh.end(), true) != fresh.end())
    due_ = std::max(due_ + kPeriod, now - kPeriod / 2);
}

void VrpnServer::serve(std::int64_t now) {
  for (auto& client : clients_) {
    if (!client) continue;
    const bool stays = client->serve(now);
    wishes_changed_ = client->wishes_changed() || !stays || wishes_changed_;
    flooded_ = flooded_ || client->floods();
    if (!stays) client.reset();
  }
}

void VrpnServer::publish_wishes() {
  if (!std::exchange(wishes_changed_, false)) return;
  for (std::size_t device = 0; device < states_.size(); ++device) {
    vrpn::WantedForces& wishes = states_[device]->wanted.write_slot();
    for (std::size_t i = 0; i < clients_.size(); ++i)
      wishes.clients[i] = clients_[i] ? clients_[i]->wanted(device) : vrpn::ClientForces();
    states_[device]->wanted.publish();
  }
}

}  // namespace icome::devices
