#include "devices/haply/wire/web_socket.h"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <cerrno>
#include <cstring>
#include <functional>
#include <limits>
#include <new>
#include <stdexcept>
#include <utility>

#include "base/clock.h"

namespace icome::devices {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using SocketError = boost::system::error_code;

constexpr std::int64_t kStopStep = 10'000'000;  // ns, between two looks at `stop`
constexpr std::int64_t kCallStep = 2'000'000;   // ns, between two calls while a read waits
constexpr std::size_t kMostOfAnswer = 64 * 1024;

std::int64_t deadline_after(double patience) {
  return base::steady_nanoseconds() + std::int64_t(1e9 * patience);
}

/// A TCP connection whose reads and writes wait no longer than they should, as Boost.Beast wants them: its
/// own streams keep time only where they are asynchronous.
class TimedSocket {
 public:
  using executor_type = asio::io_context::executor_type;  // NOLINT(readability-identifier-naming): Asio's

  TimedSocket(asio::io_context& context, const std::atomic<bool>* stop) : context_(context), stop_(stop) {}
  ~TimedSocket() {
    if (socket_ >= 0) ::close(socket_);
  }
  TimedSocket(const TimedSocket&) = delete;
  TimedSocket& operator=(const TimedSocket&) = delete;

  executor_type get_executor() const noexcept { return context_.get_executor(); }
  void set_deadline(std::int64_t deadline) { deadline_ = deadline; }
  /// Reads no more than so many bytes from now on: an answer that never ends would never be late.
  void allow(std::size_t bytes) { allowed_ = bytes; }
  void allow_all() { allowed_ = kAll; }
  void stop_by(const std::atomic<bool>* stop) { stop_ = stop; }
  void while_waiting(std::function<void(bool)> call) { while_waiting_ = std::move(call); }
  bool readable() const {
    pollfd waiting = {socket_, POLLIN, 0};
    return ::poll(&waiting, 1, 0) > 0;
  }
  void shut() { ::shutdown(socket_, SHUT_RDWR); }

  /// Connects. Returns the reason why not, a part of a sentence; empty when it is connected.
  std::string connect(const ServiceAddress& address) {
    addrinfo wanted = {};
    wanted.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    const int failed =
        getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &wanted, &found);
    if (failed != 0) return std::string("its name is not known (") + gai_strerror(failed) + ")";
    int error = EHOSTUNREACH;
    for (const addrinfo* place = found; place && error != 0; place = place->ai_next)
      error = connect_to(*place);
    freeaddrinfo(found);
    return error == 0 ? std::string() : std::string("nothing answers there (") + std::strerror(error) + ")";
  }

  template <typename Buffers>
  std::size_t read_some(const Buffers& buffers, SocketError& error) {
    auto [parts, count] = parts_of(buffers);
    msghdr message = {};
    message.msg_iov = parts.data();
    message.msg_iovlen = count;
    if (count == 0) return error = {}, 0;
    const std::size_t got = transfer(POLLIN, error, [&] { return recvmsg(socket_, &message, MSG_DONTWAIT); });
    if (!error && got == 0) error = asio::error::eof;
    if (got > allowed_) return error = asio::error::message_size, 0;
    if (allowed_ != kAll) allowed_ -= got;
    return got;
  }
  template <typename Buffers>
  std::size_t write_some(const Buffers& buffers, SocketError& error) {
    auto [parts, count] = parts_of(buffers);
    msghdr message = {};
    message.msg_iov = parts.data();
    message.msg_iovlen = count;
    return transfer(POLLOUT, error, [&] { return sendmsg(socket_, &message, MSG_DONTWAIT | MSG_NOSIGNAL); });
  }
  template <typename Buffers>
  std::size_t read_some(const Buffers& buffers) {
    SocketError error;
    const std::size_t got = read_some(buffers, error);
    return error ? throw boost::system::system_error(error) : got;
  }
  template <typename Buffers>
  std::size_t write_some(const Buffers& buffers) {
    SocketError error;
    const std::size_t sent = write_some(buffers, error);
    return error ? throw boost::system::system_error(error) : sent;
  }

 private:
  static constexpr std::size_t kMostParts = 8;
  static constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

  template <typename Buffers>
  static std::pair<std::array<iovec, kMostParts>, std::size_t> parts_of(const Buffers& buffers) {
    std::array<iovec, kMostParts> parts = {};
    std::size_t count = 0;
    const auto end = asio::buffer_sequence_end(buffers);
    for (auto part = asio::buffer_sequence_begin(buffers); part != end && count < kMostParts; ++part) {
      const asio::const_buffer bytes(*part);
      if (bytes.size() == 0) continue;
      parts[count++] = {const_cast<void*>(bytes.data()), bytes.size()};
    }
    return {parts, count};
  }

  /// The error's number, or 0. Leaves a socket only where it is connected.
  int connect_to(const addrinfo& place) {
    socket_ = socket(place.ai_family, place.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, place.ai_protocol);
    if (socket_ < 0) return errno;
    int error = ::connect(socket_, place.ai_addr, place.ai_addrlen) == 0 ? 0 : errno;
    if (error == EINPROGRESS || error == EINTR) {
      error = ETIMEDOUT;
      socklen_t size = sizeof(error);
      if (wait_for(POLLOUT)) getsockopt(socket_, SOL_SOCKET, SO_ERROR, &error, &size);
    }
    if (error != 0) {
      ::close(std::exchange(socket_, -1));
      return error;
    }
    const int on = 1;  // a command waits for no other one
    setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
    return 0;
  }

  /// False once stopped or too late. Looks at the socket once more then, as this thread may have stood still.
  bool wait_for(short what) {
    const bool calls = what == POLLIN && while_waiting_;
    const std::int64_t deadline = deadline_;
    while (true) {
      const std::int64_t left = deadline - base::steady_nanoseconds();
      const std::int64_t step = std::clamp(left, std::int64_t{0}, calls ? kCallStep : kStopStep);
      const timespec time = {0, step};
      pollfd waiting = {socket_, what, 0};
      if (ppoll(&waiting, 1, &time, nullptr) > 0) return true;
      const bool is_last = left <= 0 || (stop_ && stop_->load(std::memory_order_relaxed));
      if (calls) {
        while_waiting_(is_last);
        deadline_ = deadline;  // what was sent meanwhile had another one
      }
      if (is_last) return false;
    }
  }

  template <typename Call>
  std::size_t transfer(short what, SocketError& error, Call&& call) {
    while (true) {
      const ssize_t bytes = call();
      error = {};
      if (bytes >= 0) return std::size_t(bytes);
      if (errno == EINTR) continue;
      if (errno != EAGAIN && errno != EWOULDBLOCK) {
        error = SocketError(errno, boost::system::system_category());
        return 0;
      }
      if (!wait_for(what)) {
        error = asio::error::timed_out;
        return 0;
      }
    }
  }

  asio::io_context& context_;
  const std::atomic<bool>* stop_;            // may be null
  std::function<void(bool)> while_waiting_;  // may be empty
  std::int64_t deadline_ = 0;                // ns
  std::size_t allowed_ = kAll;               // bytes
  int socket_ = -1;
};

/// Found by Boost.Beast, which ends a connection by it.
void teardown(beast::role_type /*role*/, TimedSocket& socket, SocketError& error) {
  socket.shut();
  error = {};
}

std::string trouble(const SocketError& error) {
  if (error == asio::error::timed_out) return "it does not answer in time";
  if (error == beast::websocket::error::closed || error == asio::error::eof ||
      error == boost::beast::http::error::end_of_stream || error == asio::error::connection_reset)
    return "it has closed the connection";
  return "it does not answer as it should (" + error.message() + ")";
}

}  // namespace

class WebSocket::Connection {
 public:
  explicit Connection(const std::atomic<bool>* stop)
      : stream_(context_, stop), buffer_(kMostBytes + kPadding) {
    stream_.read_message_max(kMostBytes);
    stream_.auto_fragment(false);
    stream_.text(true);
    buffer_.reserve(kMostBytes + kPadding);
  }

  std::string connect(const ServiceAddress& address, double patience) {
    socket().set_deadline(deadline_after(patience));
    std::string failed = socket().connect(address);
    if (!failed.empty()) return failed;
    SocketError error;
    socket().allow(kMostOfAnswer);
    try {
      stream_.handshake(shown_address(address), "/", error);
    } catch (const std::bad_alloc&) {
      return "it answers at too great a length";  // memory for it is taken as soon as it says how long it is
    } catch (const std::length_error&) {
      return "it answers at too great a length";
    }
    socket().allow_all();
    return error ? trouble(error) : std::string();
  }
  bool send(std::string_view text, std::int64_t deadline) {
    if (!why_.empty()) return false;
    SocketError error;
    socket().set_deadline(deadline);
    stream_.write(asio::buffer(text.data(), text.size()), error);
    return fine(error);
  }
  bool receive(std::int64_t deadline) {
    if (!why_.empty()) return false;
    SocketError error;
    socket().set_deadline(deadline);
    buffer_.consume(buffer_.size());
    stream_.read(buffer_, error);
    return fine(error);
  }
  void close(std::int64_t deadline) {
    if (!why_.empty()) return;
    SocketError error;
    socket().set_deadline(deadline);
    stream_.close(beast::websocket::close_code::normal, error);
    why_ = "it was closed here";
  }
  bool waiting() { return socket().readable(); }
  void stop_by(const std::atomic<bool>* stop) { socket().stop_by(stop); }
  void while_waiting(std::function<void(bool)> call) { socket().while_waiting(std::move(call)); }
  std::string_view text() const {
    return {static_cast<const char*>(buffer_.data().data()), buffer_.data().size()};
  }
  const std::string& why() const { return why_; }

 private:
  TimedSocket& socket() { return stream_.next_layer(); }
  bool fine(const SocketError& error) {
    if (error) why_ = trouble(error);
    return !error;
  }

  asio::io_context context_;
  beast::websocket::stream<TimedSocket, false> stream_;
  beast::flat_buffer buffer_;
  std::string why_;
};

WebSocket::WebSocket(std::unique_ptr<Connection> connection) : connection_(std::move(connection)) {}
WebSocket::~WebSocket() = default;

base::Result<std::unique_ptr<WebSocket>> WebSocket::connect(const ServiceAddress& address, double patience,
                                                            const std::atomic<bool>* stop) {
  auto connection = std::make_unique<Connection>(stop);
  std::string failed = connection->connect(address, patience);
  if (!failed.empty()) return base::fail(std::move(failed));
  return std::unique_ptr<WebSocket>(new WebSocket(std::move(connection)));
}

void WebSocket::stop_by(const std::atomic<bool>* stop) { connection_->stop_by(stop); }
void WebSocket::while_waiting(std::function<void(bool last)> call) {
  connection_->while_waiting(std::move(call));
}
bool WebSocket::send(std::string_view text, std::int64_t deadline) {
  return connection_->send(text, deadline);
}
bool WebSocket::receive(std::int64_t deadline) { return connection_->receive(deadline); }
bool WebSocket::waiting() const { return connection_->waiting(); }
std::string_view WebSocket::text() const { return connection_->text(); }
const std::string& WebSocket::why() const { return connection_->why(); }
void WebSocket::close(std::int64_t deadline) { connection_->close(deadline); }

base::Result<std::string> get_by_http(const ServiceAddress& address, const std::string& path, double patience,
                                      const std::atomic<bool>* stop) {
  namespace http = beast::http;
  asio::io_context context;
  TimedSocket socket(context, stop);
  socket.set_deadline(deadline_after(patience));
  std::string failed = socket.connect(address);
  if (!failed.empty()) return base::fail(std::move(failed));
  http::request<http::empty_body> request(http::verb::get, path, 11);
  request.set(http::field::host, shown_address(address));
  request.set(http::field::connection, "close");
  SocketError error;
  http::write(socket, request, error);
  if (error) return base::fail(trouble(error));
  socket.allow(kMostOfAnswer);
  beast::flat_buffer buffer;
  http::response_parser<http::empty_body> header;
  header.body_limit(kMostOfAnswer);
  http::read_header(socket, buffer, header, error);
  if (error) return base::fail(trouble(error));
  // A body's memory is taken as soon as its length is known.
  if (header.content_length_remaining().value_or(0) > kMostOfAnswer)
    return base::fail("it answers " + path + " at too great a length");
  http::response_parser<http::string_body> answer(std::move(header));
  http::read(socket, buffer, answer, error);
  if (error) return base::fail(trouble(error));
  if (answer.get().result() != http::status::ok)
    return base::fail("it answers " + path + " by status " + std::to_string(answer.get().result_int()));
  return std::move(answer.get().body());
}

}  // namespace icome::devices
