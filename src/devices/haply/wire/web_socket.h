#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "base/result.h"
#include "devices/haply/wire/service_address.h"

namespace icome::devices {

/// The client's end of a WebSocket on which texts go both ways. Everything that waits does so until a time on
/// the steady clock (base::steady_nanoseconds) at most. One thread uses it. Owns its connection.
class WebSocket {
 public:
  /// The longest message that is taken, bytes; a longer one ends the connection.
  static constexpr std::size_t kMostBytes = 256 * 1024;
  /// Bytes after a message that may be read, whatever they hold.
  static constexpr std::size_t kPadding = 64;

  /// Connects and greets, which takes `patience` (s) at most, beside what the system needs to look up the
  /// host's name; `stop` is as in stop_by(). The error is a part of a sentence: "nothing answers there
  /// (Connection refused)".
  static base::Result<std::unique_ptr<WebSocket>> connect(const ServiceAddress& address, double patience,
                                                          const std::atomic<bool>* stop = nullptr);
  /// A flag that ends every wait within 10 ms once it is set, and with it the connection; null: none. It must
  /// live as long as it is used.
  void stop_by(const std::atomic<bool>* stop);
  /// Has this called every 2 ms while receive() waits, and once more, with `last`, before it gives up, as
  /// after that nothing can be sent. It may send.
  void while_waiting(std::function<void(bool last)> call);
  /// Leaves without a word unless close() was called.
  ~WebSocket();

  /// Sends a text; false, and why() tells it, once the connection is of no more use. Takes no memory after
  /// the first.
  bool send(std::string_view text, std::int64_t deadline);
  /// Waits for the next message, which text() is then; false, and why() tells it, once the connection is of
  /// no more use, which it also is when nothing came in time. Takes no memory.
  bool receive(std::int64_t deadline);
  /// Is there something that receive() would read at once? It may be less than a message. Real-time safe.
  bool waiting() const;
  /// The message that receive() took, until the next call.
  std::string_view text() const;
  const std::string& why() const;
  /// Says goodbye and waits for the answer until the deadline.
  void close(std::int64_t deadline);

 private:
  class Connection;
  explicit WebSocket(std::unique_ptr<Connection> connection);
  std::unique_ptr<Connection> connection_;
};

/// A service's answer to GET, at most 64 KB of it, within `patience`, s. Errors and `stop` as those of
/// connect().
base::Result<std::string> get_by_http(const ServiceAddress& address, const std::string& path, double patience,
                                      const std::atomic<bool>* stop = nullptr);

}  // namespace icome::devices
