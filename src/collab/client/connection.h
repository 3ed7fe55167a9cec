#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/result.h"
#include "collab/client/conversation.h"
#include "collab/link/link_loop.h"

namespace icome::collab {

/// A key that no other client has, for ClientIdentity: 128 random bits.
base::Result<std::string> make_client_key();

/// A conversation over the network: connects to the server of an address, and again whenever the connection
/// is lost. Owns its sockets; everything happens in work_until(), on the thread that calls it.
class Connection final : private LinkEvents {
 public:
  /// Fails for an address without TLS that is not of this machine.
  static base::Result<std::unique_ptr<Connection>> create(const DesignAddress& address,
                                                          ClientIdentity identity,
                                                          const world::GeometryFactory& factory = {});
  ~Connection() override = default;

  Conversation& talk() { return talk_; }
  const Conversation& talk() const { return talk_; }

  /// Listens and speaks until `done` holds, which is asked after each thing that happens. False when `stops`
  /// held before, which is asked some times a second. Fails when the server does not let this client in (any
  /// more), or when it was never reached for as long as `patience`.
  base::Result<bool> work_until(const std::function<bool()>& done, const std::function<bool()>& stops,
                                std::chrono::milliseconds patience);

 private:
  Connection(const DesignAddress& address, ClientIdentity identity, const world::GeometryFactory& factory)
      : talk_(address, std::move(identity), factory) {}
  void opened(LinkId link, const Peer& peer) override;
  void received(LinkId link, std::string_view frame) override;
  void sent(LinkId link) override;
  void closed(LinkId link, const std::string& why) override;
  void connect();
  void flush();
  void tick();
  void look();

  std::unique_ptr<LinkLoop> loop_;
  Conversation talk_;
  std::optional<LinkId> link_;
  bool is_open_ = false;
  bool is_sending_ = false;
  bool is_closing_ = false;
  std::int64_t next_try_ = 0;   // ms
  std::int64_t pause_ = 0;      // ms before the try after the next
  std::int64_t last_live_ = 0;  // ms
  std::string last_why_;
  const std::function<bool()>* done_ = nullptr;
  bool ticks_ = false;
};

}  // namespace icome::collab
