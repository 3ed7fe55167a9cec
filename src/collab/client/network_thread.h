#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "base/result.h"
#include "collab/link/link_loop.h"
#include "collab/protocol/address.h"

namespace icome::collab {

/// The thread that keeps a client connected with the server of an address, and connects again whenever the
/// connection is lost: frames come and go by boxes, so that its owner, one other thread, never waits. Owns
/// the thread and its sockets.
class NetworkThread final : private LinkEvents {
 public:
  struct Opened {};
  struct Closed {
    std::string why = {};
    bool was_open = false;
    bool is_distrusted = false;  // for the server's certificate
  };
  /// A thing that happened; a string is a frame that came.
  using News = std::variant<Opened, std::string, Closed>;

  /// Begins to connect at once.
  static base::Result<std::unique_ptr<NetworkThread>> create(const DesignAddress& address);
  ~NetworkThread() override;

  /// All that has happened since the last call, in order. Never waits.
  std::vector<News> take();
  /// Waits for news, or until a frame was sent, for so long at most.
  void wait(std::chrono::milliseconds longest);

  /// Frames that were given and are not sent yet are few enough for another one.
  bool has_room();
  /// Sends a frame by the connection that take() told of last; it is dropped if that is gone.
  void send(SharedBytes frame);
  /// Ends this connection once all was sent; another one follows.
  void close();
  /// The server has let the client in: if the connection is lost, the next try follows at once.
  void is_let_in() { pause_.store(0, std::memory_order_relaxed); }
  /// No connection follows any more.
  void give_up() { given_up_.store(true, std::memory_order_relaxed); }

 private:
  explicit NetworkThread(const DesignAddress& address);
  void opened(LinkId link, const Peer& peer) override;
  void received(LinkId link, std::string_view frame) override;
  void sent(LinkId link) override;
  void closed(LinkId link, const std::string& why) override;
  void connect();
  void flush();
  std::size_t tell(News news, std::size_t bytes);

  std::unique_ptr<LinkLoop> loop_;
  ConnectSettings settings_;

  // The thread's own.
  std::optional<LinkId> link_;
  bool is_open_ = false;
  bool is_sending_ = false;
  bool is_closing_ = false;
  std::uint64_t distrusted_ = 0;  // LinkLoop::distrusted(), at the last end

  // Shared by both threads.
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<News> in_;
  std::size_t in_bytes_ = 0;
  std::deque<SharedBytes> out_;
  std::uint64_t connection_ = 0;  // counts those that were lost
  bool wants_to_close_ = false;
  bool has_sent_ = false;
  std::atomic<std::int64_t> pause_ = 0;  // ms before the try after the next
  std::atomic<bool> given_up_ = false;

  std::uint64_t told_connection_ = 0;  // the owner's
  std::thread thread_;                 // last: it uses what is above
};

}  // namespace icome::collab
