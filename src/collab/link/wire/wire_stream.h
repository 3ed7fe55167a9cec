#pragma once
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/async_base.hpp>
#include <boost/beast/core/role.hpp>
#include <chrono>
#include <memory>
#include <utility>

#include "collab/link/wire/byte_channel.h"

namespace icome::collab {

using LinkError = boost::system::error_code;
using LinkClock = std::chrono::steady_clock;
using Executor = boost::asio::io_context::executor_type;
using Socket = boost::asio::basic_stream_socket<boost::asio::ip::tcp, Executor>;
using Timer = boost::asio::basic_waitable_timer<LinkClock, boost::asio::wait_traits<LinkClock>, Executor>;

constexpr std::size_t kRecordBytes = 16'384;  // the longest that TLS encrypts at once
constexpr int kUnsentBytes = 128 * 1024;      // in the system: more waits in send(), for newer news
constexpr std::chrono::milliseconds kMostClosing{1000};

/// Room for a record that is put together, which the wires of a thread share.
using Scratch = std::array<char, kRecordBytes>;

/// A socket with or without TLS for Boost.Beast's algorithms; owns it. It waits until the socket is ready and
/// then moves bytes by a ByteChannel, so that unlike boost::asio::ssl::stream it needs no buffers while it
/// waits.
class Wire {
 public:
  using executor_type = Executor;  // NOLINT(readability-identifier-naming): Asio's

  Wire(const Executor& executor, Scratch& scratch)
      : socket_(executor), linger_(executor), scratch_(scratch), last_sign_(LinkClock::now()) {}

  Executor get_executor() noexcept { return socket_.get_executor(); }
  Socket& socket() { return socket_; }
  ByteChannel& channel() { return channel_; }
  /// Sets the owner that keeps this wire alive. To be called before anything else.
  void belong_to(std::weak_ptr<void> owner) { owner_ = std::move(owner); }
  void start(std::chrono::milliseconds patience);
  void close() {
    LinkError ignored;
    socket_.close(ignored);
    linger_.cancel();
  }

  /// When the other side was last seen alive: something came, or what had to wait could be sent.
  LinkClock::time_point last_sign() const { return last_sign_; }
  void woke() {
    channel_.may_read();
    last_sign_ = LinkClock::now();
  }
  /// Ends the wait for the other side's end in a second.
  void limit_linger();

  template <typename Buffers, typename Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler);
  template <typename Buffers, typename Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler);
  template <typename Handler>
  void async_shake_hands(Handler&& handler);

 private:
  template <typename Buffers>
  Transfer write(const Buffers& buffers);

  Socket socket_;
  Timer linger_;
  ByteChannel channel_;
  Scratch& scratch_;
  LinkClock::time_point last_sign_;
  std::weak_ptr<void> owner_;
};

inline void Wire::start(std::chrono::milliseconds patience) {
  const int socket = socket_.native_handle();
  const int on = 1;  // a frame waits for no other one
  ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  ::setsockopt(socket, IPPROTO_TCP, TCP_NOTSENT_LOWAT, &kUnsentBytes, sizeof(kUnsentBytes));
  const auto time = unsigned(std::max<std::int64_t>(1, patience.count()));
  ::setsockopt(socket, IPPROTO_TCP, TCP_USER_TIMEOUT, &time, sizeof(time));
  channel_.use(socket);
}

inline void Wire::limit_linger() {
  linger_.expires_after(kMostClosing);
  linger_.async_wait([this, owner = owner_](LinkError error) {
    if (error) return;
    const std::shared_ptr<void> alive = owner.lock();
    LinkError ignored;
    if (alive) socket_.cancel(ignored);
  });
}

/// Repeats an attempt, which gives a Transfer, whenever the socket is ready for it.
template <typename Attempt, typename Handler>
class TransferOperation : public boost::beast::async_base<Handler, Executor> {
 public:
  template <typename GivenHandler>
  TransferOperation(Wire& wire, Attempt attempt, GivenHandler&& handler)
      : boost::beast::async_base<Handler, Executor>(std::forward<GivenHandler>(handler), wire.get_executor()),
        wire_(wire),
        attempt_(std::move(attempt)) {
    go_on(false);
  }

  void operator()(LinkError error) {
    if (error) return this->complete(true, error, std::size_t{0});
    wire_.woke();
    go_on(true);
  }

 private:
  void go_on(bool has_waited) {
    const Transfer transfer = attempt_();
    Socket& socket = wire_.socket();
    switch (transfer.outcome) {
      case Transfer::Outcome::WaitToRead:
        return socket.async_wait(Socket::wait_read, std::move(*this));
      case Transfer::Outcome::WaitToWrite:
        return socket.async_wait(Socket::wait_write, std::move(*this));
      case Transfer::Outcome::Done:
        return this->complete(has_waited, LinkError(), transfer.bytes);
      case Transfer::Outcome::Ended:
        return this->complete(has_waited, LinkError(boost::asio::error::eof), std::size_t{0});
      case Transfer::Outcome::Broken:
        break;
    }
    const LinkError error = transfer.error == 0 ? make_error_code(boost::system::errc::protocol_error)
                                                : LinkError(transfer.error, boost::system::system_category());
    this->complete(has_waited, error, std::size_t{0});
  }

  Wire& wire_;
  Attempt attempt_;
};

template <typename Attempt, typename Handler>
void begin_transfer(Wire& wire, Attempt attempt, Handler&& handler) {
  TransferOperation<Attempt, std::decay_t<Handler>>(wire, std::move(attempt), std::forward<Handler>(handler));
}

template <typename Buffers, typename Handler>
void Wire::async_read_some(const Buffers& buffers, Handler&& handler) {
  boost::asio::mutable_buffer to;
  for (auto at = boost::asio::buffer_sequence_begin(buffers); at != boost::asio::buffer_sequence_end(buffers);
       ++at)
    if (to.size() == 0) to = boost::asio::mutable_buffer(*at);
  begin_transfer(
      *this, [this, to] { return channel_.read(static_cast<char*>(to.data()), to.size()); },
      std::forward<Handler>(handler));
}

/// As much as goes into one record of TLS, however many buffers it lies in.
template <typename Buffers>
Transfer Wire::write(const Buffers& buffers) {
  for (auto at = boost::asio::buffer_sequence_begin(buffers); at != boost::asio::buffer_sequence_end(buffers);
       ++at) {
    const boost::asio::const_buffer first(*at);
    if (first.size() >= kRecordBytes)
      return channel_.write(static_cast<const char*>(first.data()), first.size());
    if (first.size() > 0) break;
  }
  const std::size_t size = boost::asio::buffer_copy(boost::asio::buffer(scratch_), buffers);
  return channel_.write(scratch_.data(), size);
}

template <typename Buffers, typename Handler>
void Wire::async_write_some(const Buffers& buffers, Handler&& handler) {
  begin_transfer(
      *this, [this, buffers] { return write(buffers); }, std::forward<Handler>(handler));
}

template <typename Handler>
void Wire::async_shake_hands(Handler&& handler) {
  begin_transfer(
      *this, [this] { return channel_.shake_hands(); }, std::forward<Handler>(handler));
}

/// Ends a wire in good order: says so, and reads on for a second until the other side has ended it too. What
/// comes unread to a closed socket would have the system take our last words back.
template <typename Handler>
class EndOperation : public boost::beast::async_base<Handler, Executor> {
 public:
  template <typename GivenHandler>
  EndOperation(Wire& wire, GivenHandler&& handler)
      : boost::beast::async_base<Handler, Executor>(std::forward<GivenHandler>(handler), wire.get_executor()),
        wire_(wire) {
    wire_.channel().end_writing();
    wire_.limit_linger();
    go_on(false);
  }

  void operator()(LinkError error) {
    if (error) return this->complete(true, LinkError());
    wire_.woke();
    go_on(true);
  }

 private:
  void go_on(bool has_waited) {
    if (wire_.channel().drain().outcome != Transfer::Outcome::WaitToRead)
      return this->complete(has_waited, LinkError());
    wire_.socket().async_wait(Socket::wait_read, std::move(*this));
  }

  Wire& wire_;
};

/// Found by Boost.Beast, which ends a connection by it.
template <typename Handler>
void async_teardown(boost::beast::role_type /*role*/, Wire& wire, Handler&& handler) {
  EndOperation<std::decay_t<Handler>>(wire, std::forward<Handler>(handler));
}
/// Found by Boost.Beast, which calls it where its own times are over; we use none of them.
inline void beast_close_socket(Wire& wire) { wire.close(); }

}  // namespace icome::collab
