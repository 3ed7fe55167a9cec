#include "collab/bus/bus.h"

#include <nats/nats.h>

#include <vector>

namespace icome::collab {
namespace {

constexpr std::int64_t kConnecting = 3'000;    // ms
constexpr std::int64_t kReconnectPause = 250;  // ms
constexpr std::int64_t kPing = 2'000;          // ms between two looks whether the connection still stands
constexpr int kPingsUnanswered = 2;            // after which it does not
constexpr int kKeptBytes = 8 << 20;            // of what is published without a connection
constexpr int kMostWaiting = 65'536;           // messages that were not taken in yet
constexpr int kMostWaitingBytes = 64 << 20;

template <typename Handle, void (*Destroy)(Handle*)>
struct Destroyer {
  void operator()(Handle* it) const { Destroy(it); }
};
using BusOptions = std::unique_ptr<natsOptions, Destroyer<natsOptions, natsOptions_Destroy>>;
using BusConnection = std::unique_ptr<natsConnection, Destroyer<natsConnection, natsConnection_Destroy>>;
using BusSubscription =
    std::unique_ptr<natsSubscription, Destroyer<natsSubscription, natsSubscription_Destroy>>;

/// "nats://ann:secret@host:4222" without what stands before the '@'.
std::string without_password(const std::string& address) {
  const std::size_t begin = address.find("://"), at = address.rfind('@');
  if (begin == std::string::npos || at == std::string::npos || at < begin) return address;
  return address.substr(0, begin + 3) + address.substr(at + 1);
}

base::Result<void> done_or_why(natsStatus status, const std::string& place) {
  if (status == NATS_OK) return {};
  return base::fail(place + ": the bus (NATS) does not work: " + natsStatus_GetText(status) + ".");
}

}  // namespace

struct Bus::Parts {
  std::string place;
  std::function<void(std::string)> heard;
  BusConnection connection;
  std::vector<BusSubscription> subscriptions;

  static void take(natsConnection*, natsSubscription*, natsMsg* message, void* parts) {
    const std::string bytes(natsMsg_GetData(message), std::size_t(natsMsg_GetDataLength(message)));
    natsMsg_Destroy(message);
    static_cast<Parts*>(parts)->heard(bytes);
  }
};

Bus::Bus(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

Bus::~Bus() {
  // Its threads have ended with their last call when this returns.
  for (const BusSubscription& it : parts_->subscriptions) {
    (void)natsSubscription_Drain(it.get());
    (void)natsSubscription_WaitForDrainCompletion(it.get(), kConnecting);
  }
}

base::Result<std::unique_ptr<Bus>> Bus::connect(const std::string& address,
                                                std::function<void(std::string bytes)> heard) {
  const std::string place = without_password(address);
  if (!address.starts_with("nats://") && !address.starts_with("tls://"))
    return base::fail(place + ": is no address of a bus; it looks like nats://HOST:4222.");
  natsOptions* made = nullptr;
  if (const auto done = done_or_why(natsOptions_Create(&made), place); !done)
    return tl::unexpected(done.error());
  const BusOptions options(made);
  for (const natsStatus status :
       {natsOptions_SetURL(made, address.c_str()), natsOptions_SetTimeout(made, kConnecting),
        natsOptions_SetMaxReconnect(made, -1), natsOptions_SetReconnectWait(made, kReconnectPause),
        natsOptions_SetReconnectJitter(made, kReconnectPause, kReconnectPause),
        natsOptions_SetPingInterval(made, kPing), natsOptions_SetMaxPingsOut(made, kPingsUnanswered),
        natsOptions_SetReconnectBufSize(made, kKeptBytes), natsOptions_SetSendAsap(made, true),
        natsOptions_SetName(made, "icome")})
    if (const auto done = done_or_why(status, place); !done) return tl::unexpected(done.error());
  auto parts = std::make_unique<Parts>();
  parts->place = place;
  parts->heard = std::move(heard);
  natsConnection* connection = nullptr;
  if (const auto done = done_or_why(natsConnection_Connect(&connection, made), place); !done)
    return tl::unexpected(done.error());
  parts->connection.reset(connection);
  return std::unique_ptr<Bus>(new Bus(std::move(parts)));
}

base::Result<void> Bus::listen(const std::string& subject) {
  natsSubscription* made = nullptr;
  const natsStatus status =
      natsConnection_Subscribe(&made, parts_->connection.get(), subject.c_str(), Parts::take, parts_.get());
  if (const auto done = done_or_why(status, parts_->place); !done) return done;
  parts_->subscriptions.emplace_back(made);
  return done_or_why(natsSubscription_SetPendingLimits(made, kMostWaiting, kMostWaitingBytes), parts_->place);
}

/// Whoever waits for a message that could not be sent hears of it by the silence.
void Bus::publish(const std::string& subject, std::string_view bytes) {
  (void)natsConnection_Publish(parts_->connection.get(), subject.c_str(), bytes.data(), int(bytes.size()));
}

}  // namespace icome::collab
