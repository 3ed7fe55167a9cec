#pragma once
#include <functional>
#include <memory>
#include <string_view>

#include "collab/link/link_loop.h"
#include "collab/link/wire/listening_socket.h"

namespace boost::asio {
class io_context;
}

namespace icome::collab {

/// Answers GET requests on a socket that it owns, some 16 at a time, each within five seconds. Used by the
/// thread that runs `context`, which outlives it.
class HttpListener {
 public:
  using Answer = std::function<HttpAnswer(std::string_view path)>;
  HttpListener(boost::asio::io_context& context, const ListeningSocket& socket, Answer answer);
  ~HttpListener();
  HttpListener(const HttpListener&) = delete;
  HttpListener& operator=(const HttpListener&) = delete;

 private:
  class Counter;
  std::shared_ptr<Counter> counter_;
};

}  // namespace icome::collab
