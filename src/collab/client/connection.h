#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "base/result.h"
#include "collab/client/conversation.h"
#include "collab/client/network_thread.h"

namespace icome::collab {

/// A conversation over the network: connected with the server of an address, and again whenever the
/// connection is lost. Owns the thread that does so. The conversation itself goes on in work() and
/// work_until() alone, on the thread that calls them, which may be another one later.
class Connection {
 public:
  /// Fails for an address without TLS that is not of this machine. The cache is as in Conversation.
  static base::Result<std::unique_ptr<Connection>> create(const DesignAddress& address,
                                                          ClientIdentity identity,
                                                          ContentCachePointer cache = nullptr);

  Conversation& talk() { return talk_; }
  const Conversation& talk() const { return talk_; }

  /// Takes in what has come, and sends what is to be said. Never waits.
  void work();
  /// Works until `done` holds, which is asked after each thing that happens. False when `stops` held before,
  /// which is asked some times a second. Fails when the server does not let this client in (any more), or
  /// when it was not reached for as long as `patience`, or longer where another server is to take over.
  base::Result<bool> work_until(const std::function<bool()>& done, const std::function<bool()>& stops,
                                std::chrono::milliseconds patience);
  /// The server's certificate was not that of the link, the last time.
  bool is_distrusted() const { return is_distrusted_; }
  /// The reason why there was no connection, the last time.
  const std::string& last_why() const { return last_why_; }

 private:
  Connection(const DesignAddress& address, ClientIdentity identity, ContentCachePointer cache)
      : talk_(address, std::move(identity), drawing::every_kind_of_shape(), std::move(cache)) {}
  void take(NetworkThread::Opened& opened);
  void take(std::string& frame);
  void take(NetworkThread::Closed& closed);
  void send();

  Conversation talk_;
  bool is_open_ = false;
  bool is_closing_ = false;
  bool is_distrusted_ = false;
  std::int64_t last_live_ = 0;  // ms
  std::string last_why_;
  int sent_away_ = 0;  // times in a row that the server has ended it, and nothing came of it
  std::uint64_t sent_away_at_ = ~std::uint64_t{0};  // Replica::durable() then
  std::unique_ptr<NetworkThread> network_;
};

}  // namespace icome::collab
