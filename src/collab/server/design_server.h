#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>

#include "base/result.h"
#include "collab/bus/bus.h"
#include "collab/link/link_loop.h"
#include "collab/server/hub.h"
#include "collab/server/log_thread.h"
#include "collab/server/relays.h"
#include "collab/storage/store.h"
#include "drawing/shape/every_kind.h"
#include "io/open_file.h"

namespace icome::collab {

/// How a server serves.
struct ServeSettings {
  std::string store = {};  // as Store::make() reads it
  /// The folder for a database server's own files, such as certificate and audit log; empty: the usual one.
  /// The files of a store in a folder are there.
  std::filesystem::path files = {};
  std::string bus =
      {};  // "nats://HOST:PORT", by which servers before one database pass clients on; empty: none
  Endpoint listen = {};
  std::filesystem::path certificate =
      {};  // PEM, with `key`; empty: the store's own, made where there is none
  std::filesystem::path key = {};
  bool insecure = false;                  // without TLS, on the loopback only
  std::optional<Endpoint> health = {};    // where /health and /metrics are answered; nothing: nowhere
  std::vector<std::string> origins = {};  // of browsers
  std::size_t most_links_an_address = 200;
  HubSettings hub = {};
};

/// A server of the designs in a store: sockets, threads and clocks around a Hub. It has a folder for itself;
/// a database it shares with other servers, each design being one's at a time, and passes clients on to the
/// one that has their design. Owns everything. run() is the only thread that works with it, but for the log's
/// own.
class DesignServer final : private LinkEvents, private RelayEvents {
 public:
  /// Listens when it returns. Fails with a sentence that names the folder, the file or the address.
  static base::Result<std::unique_ptr<DesignServer>> create(const ServeSettings& settings);
  ~DesignServer() override;

  /// Where it listens.
  const Endpoint& endpoint() const { return endpoint_; }
  std::optional<Endpoint> health_endpoint() const { return health_; }
  /// Of its certificate; empty without TLS.
  const std::string& fingerprint() const { return fingerprint_; }
  /// For people.
  const std::string& store() const { return shown_store_; }

  /// Serves until `ends` (asked some times a second) says so; then tells the clients, and saves what they
  /// have sent. Fails where the folder of the store is taken away meanwhile, as nothing would be kept any
  /// more.
  base::Result<void> run(const std::function<bool()>& ends);

 private:
  DesignServer(const StoreFolder& files, io::OpenFile lock, const TokenSigner& signer, HubSettings settings,
               std::string shown_store);
  base::Result<void> start(const ServeSettings& settings, std::unique_ptr<OpLog> log);
  void opened(LinkId link, const Peer& peer) override;
  void received(LinkId link, std::string_view frame) override;
  void sent(LinkId link) override;
  void closed(LinkId link, const std::string& why) override;

  // Clients of other servers, whose designs are here, and the other way round.
  void publish(const std::string& server, std::string bytes) override;
  void guest_opened(LinkId guest, const std::string& address) override;
  void guest_received(LinkId guest, std::string_view frame) override;
  void guest_sent(LinkId guest) override;
  void guest_closed(LinkId guest) override;
  void client_frame(LinkId client, SharedBytes frame) override;
  void client_ends(LinkId client, const std::string& why) override;

  base::Result<void> join_bus(const std::string& address);
  bool pass_on(LinkId link, const std::string& server, std::string_view hello);
  void send(LinkId link, SharedBytes frame);
  void close(LinkId link, const std::string& why);
  void forget(LinkId link);
  void stir();
  void look_soon();
  void look();
  void flush(LinkId link);
  void go_on(LinkId link);
  void work_on_log();
  void choose_pace(std::int64_t now);
  void tick();
  HttpAnswer answer(std::string_view path) const;

  std::filesystem::path folder_;  // of its files
  std::string shown_store_;
  io::OpenFile lock_;
  world::GeometryFactory factory_ = drawing::every_kind_of_shape();
  std::unique_ptr<LinkLoop> loop_;
  Hub hub_;
  Relays relays_;
  std::unique_ptr<LogThread> log_;
  AuditLog audit_;
  Endpoint endpoint_;
  std::optional<Endpoint> health_;
  std::string fingerprint_;
  std::function<bool()> ends_;
  bool log_works_ = false;
  bool is_stirred_ = false, is_log_stirred_ = false;
  bool stops_ = false;
  bool is_homeless_ = false;     // the store is not at its place any more
  std::int64_t stop_until_ = 0;  // ms
  std::int64_t started_ = 0;     // ms
  /// The state of what is sent to a connection.
  struct Sending {
    bool is_under_way = false;  // its last frame
    bool goes_on = false;       // more waits for it than one frame holds, or came while that was under way
  };
  std::unordered_map<LinkId, Sending> links_;
  std::uint64_t deliveries_ = 0;  // HubCounters::deliveries at the last tick
  static constexpr std::size_t kTurns = 4;
  std::array<std::set<LinkId>, kTurns> turns_;  // connections that may have something to hear
  std::size_t turn_ = 0;                        // the group that was looked at last
  std::int64_t gather_ = 0;                     // ms in which what is to be said is gathered into one frame
  std::int64_t ticked_ = 0;                     // ms
  std::int64_t next_commit_ = 0;                // ns
  bool waits_to_commit_ = false;
  std::unique_ptr<Bus> bus_;  // null: no others are known; last, as its thread posts to the loop
};

}  // namespace icome::collab
