#include "collab/link/wire/http_listener.h"

#include <fmt/format.h>

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <string>
#include <utility>

namespace icome::collab {
namespace {

namespace asio = boost::asio;
using HttpSocket = asio::ip::tcp::socket;
using HttpError = boost::system::error_code;

constexpr int kMostVisits = 16;
constexpr std::size_t kMostOfRequest = 4096;  // bytes
constexpr std::chrono::seconds kVisitTime{5};
constexpr std::chrono::milliseconds kRestAfterFailure{100};

std::string_view reason_of(int status) {
  switch (status) {
    case 200:
      return "OK";
    case 400:
      return "Bad Request";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 431:
      return "Request Header Fields Too Large";
    case 503:
      return "Service Unavailable";
    default:
      return status < 400 ? "Other" : "Error";
  }
}

/// The answer to a request whose head is whole: METHOD PATH[?QUERY] HTTP/1.x, and lines that do not matter.
HttpAnswer answer_to(std::string_view request, const HttpListener::Answer& answer) {
  const std::string_view line = request.substr(0, request.find("\r\n"));
  const std::size_t method = line.find(' ');
  const std::size_t version = line.rfind(' ');
  if (method == line.npos || version <= method || !line.substr(version + 1).starts_with("HTTP/1."))
    return {400, "text/plain; charset=utf-8", "This is no HTTP request.\n"};
  std::string_view path = line.substr(method + 1, version - method - 1);
  path = path.substr(0, path.find('?'));
  if (!path.starts_with('/') || path.find(' ') != path.npos)
    return {400, "text/plain; charset=utf-8", "This is no path.\n"};
  if (line.substr(0, method) != "GET") return {405, "text/plain; charset=utf-8", "Only GET is answered.\n"};
  return answer(path);
}

std::string written(const HttpAnswer& answer) {
  return fmt::format(
      "HTTP/1.1 {} {}\r\nContent-Type: {}\r\nContent-Length: {}\r\n{}Cache-Control: no-store\r\n"
      "X-Content-Type-Options: nosniff\r\nConnection: close\r\n\r\n{}",
      answer.status, reason_of(answer.status), answer.type, answer.body.size(),
      answer.status == 405 ? "Allow: GET\r\n" : "", answer.body);
}

}  // namespace

/// Lets requests in, one after the other. Kept by its listener and by each visit.
class HttpListener::Counter : public std::enable_shared_from_this<Counter> {
 public:
  Counter(asio::io_context& context, const ListeningSocket& socket, Answer answer)
      : acceptor_(context, socket.is_v6 ? asio::ip::tcp::v6() : asio::ip::tcp::v4(), socket.descriptor),
        rest_(context),
        answer_(std::move(answer)) {}

  void accept_next() {
    if (is_accepting_ || visits_ >= kMostVisits || !acceptor_.is_open()) return;
    is_accepting_ = true;
    acceptor_.async_accept([self = shared_from_this()](HttpError error, HttpSocket socket) {
      self->is_accepting_ = false;
      if (error == asio::error::operation_aborted) return;
      if (error) return self->accept_after_rest();
      ++self->visits_;
      std::make_shared<Visit>(self, std::move(socket))->begin();
      self->accept_next();
    });
  }
  void end() {
    HttpError ignored;
    acceptor_.close(ignored);
    rest_.cancel();
  }

 private:
  /// One request and its answer.
  class Visit : public std::enable_shared_from_this<Visit> {
   public:
    Visit(std::shared_ptr<Counter> counter, HttpSocket socket)
        : counter_(std::move(counter)), socket_(std::move(socket)), deadline_(socket_.get_executor()) {}

    void begin() {
      deadline_.expires_after(kVisitTime);
      deadline_.async_wait([self = shared_from_this()](HttpError error) {
        if (!error) self->end();
      });
      asio::async_read_until(
          socket_, asio::dynamic_buffer(bytes_, kMostOfRequest), "\r\n\r\n",
          [self = shared_from_this()](HttpError error, std::size_t size) { self->on_request(error, size); });
    }

   private:
    void on_request(HttpError error, std::size_t size) {
      if (error && error != asio::error::not_found) return end();
      bytes_ = written(error ? HttpAnswer{431, "text/plain; charset=utf-8", "The request is too long.\n"}
                             : answer_to(std::string_view(bytes_).substr(0, size), counter_->answer_));
      asio::async_write(socket_, asio::buffer(bytes_),
                        [self = shared_from_this()](HttpError failed, std::size_t /*size*/) {
                          if (failed) return self->end();
                          HttpError ignored;
                          self->socket_.shutdown(HttpSocket::shutdown_send, ignored);
                          self->bytes_.resize(kMostOfRequest);
                          self->wait_for_end();
                        });
    }
    /// Closing while something unread is there would take the answer away from who asked.
    void wait_for_end() {
      socket_.async_read_some(asio::buffer(bytes_),
                              [self = shared_from_this()](HttpError error, std::size_t /*size*/) {
                                if (error) return self->end();
                                self->wait_for_end();
                              });
    }
    void end() {
      if (std::exchange(has_ended_, true)) return;
      HttpError ignored;
      socket_.close(ignored);
      deadline_.cancel();
      --counter_->visits_;
      counter_->accept_next();
    }

    std::shared_ptr<Counter> counter_;
    HttpSocket socket_;
    asio::steady_timer deadline_;
    std::string bytes_;  // of the request, then of the answer
    bool has_ended_ = false;
  };

  /// Accepting fails where there are no descriptors left, and would fail at once again.
  void accept_after_rest() {
    rest_.expires_after(kRestAfterFailure);
    rest_.async_wait([self = shared_from_this()](HttpError error) {
      if (!error) self->accept_next();
    });
  }

  asio::ip::tcp::acceptor acceptor_;
  asio::steady_timer rest_;
  Answer answer_;
  int visits_ = 0;
  bool is_accepting_ = false;
};

HttpListener::HttpListener(asio::io_context& context, const ListeningSocket& socket, Answer answer)
    : counter_(std::make_shared<Counter>(context, socket, std::move(answer))) {
  counter_->accept_next();
}

HttpListener::~HttpListener() { counter_->end(); }

}  // namespace icome::collab
