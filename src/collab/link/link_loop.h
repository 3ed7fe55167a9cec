#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace icome::collab {

/// A connection of a LinkLoop; numbers are never given twice.
using LinkId = std::uint64_t;

/// Bytes that many connections may send without copies of their own.
using SharedBytes = std::shared_ptr<const std::string>;

/// The place where a server listens or a client connects to.
struct Endpoint {
  std::string host = "127.0.0.1";  // a name or a number; IPv6 without brackets
  std::uint16_t port = 0;          // 0, listening only: any that is free
};

/// Who a connection is with.
struct Peer {
  std::string address = {};  // "192.0.2.7:51234"
  bool is_ours = false;      // made by connect(), not accepted
};

/// What happens to the connections of a LinkLoop; all calls come from the thread that runs it, never from
/// within connect(), send() or close(), which they may call. Who was accepted and did not shake hands as it
/// should is not heard of.
class LinkEvents {
 public:
  virtual ~LinkEvents() = default;
  /// Both sides have shaken hands: frames may be sent.
  virtual void opened(LinkId link, const Peer& peer) = 0;
  /// A whole frame came; the bytes are valid during the call. None comes after close().
  virtual void received(LinkId link, std::string_view frame) = 0;
  /// What send() was given has been handed to the system, which keeps little that it has not sent yet: the
  /// next frame may be sent.
  virtual void sent(LinkId link) = 0;
  /// The connection is over, or (never opened) did not come about; `why` is a sentence. The last call for it.
  virtual void closed(LinkId link, const std::string& why) = 0;
};

/// How a server listens.
struct ListenSettings {
  Endpoint endpoint = {};
  std::filesystem::path certificate = {};  // PEM, chain; empty: without TLS, on the loopback only
  std::filesystem::path key = {};          // PEM
  std::vector<std::string> origins =
      {};  // that browsers may come from, such as "https://example.org"; none else
  std::size_t most_frame_bytes = 1U << 20U;          // a longer one ends its connection
  std::size_t most_links = 10'000;                   // those that still shake hands count
  std::size_t most_links_an_address = 200;           // from one address, or one IPv6 network (/64)
  std::chrono::milliseconds handshake_time{10'000};  // for TLS and WebSocket together
  std::chrono::milliseconds idle_time{30'000};       // nothing came, not even the answer to a ping: over
};

/// How a client connects.
struct ConnectSettings {
  Endpoint endpoint = {};
  bool tls = true;               // false: to the loopback only
  std::string fingerprint = {};  // "sha256:" and 64 hexadecimal digits: this certificate, or one that the
                                 // system's authorities vouch for
  std::size_t most_frame_bytes = 64U << 20U;
  std::chrono::milliseconds handshake_time{10'000};
  std::chrono::milliseconds idle_time{30'000};
};

/// What an HTTP request (GET, without TLS) is answered with.
struct HttpAnswer {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body = {};
};

/// Connections that carry frames of bytes: WebSocket over TLS 1.2 or newer at the path /icome, of both sides,
/// all run by one thread. Owns its sockets; `events` outlives it. Other threads may call post() and stop()
/// only. Destroying it, not while it runs, ends all connections without a call; a name that is being looked
/// up is waited for.
class LinkLoop {
 public:
  static base::Result<std::unique_ptr<LinkLoop>> create(LinkEvents& events);
  ~LinkLoop();
  LinkLoop(const LinkLoop&) = delete;
  LinkLoop& operator=(const LinkLoop&) = delete;

  /// Accepts connections from now on, and gives the address as a number with its port. Fails with a sentence
  /// that names the endpoint or the file.
  base::Result<Endpoint> listen(const ListenSettings& settings);
  /// Answers GET requests at an endpoint of its own; `answer` gets the path. Little is served at a time, and
  /// what is slow or long is cut off.
  base::Result<Endpoint> listen_http(const Endpoint& endpoint,
                                     std::function<HttpAnswer(std::string_view path)> answer);
  /// Connections of ours so far that ended because of the other side's certificate.
  std::uint64_t distrusted() const;
  /// Begins to connect: opened() or closed() follows, never within this call.
  LinkId connect(const ConnectSettings& settings);

  /// Sends one frame. Precondition: opened, and sent() came for the frame before. Nothing happens on a
  /// connection that is over.
  void send(LinkId link, SharedBytes frame);
  /// Ends a connection in good order after what is being sent, within a second or so; the other side hears
  /// the beginning of `why` (123 bytes), and closed() follows as the only call.
  void close(LinkId link, const std::string& why);

  /// Runs `work` on the loop's thread, in the order of the calls. Any thread.
  void post(std::function<void()> work);
  /// Runs `work` on the loop's thread once, so much later. The loop's thread, or before run().
  void after(std::chrono::nanoseconds delay, std::function<void()> work);

  /// Runs until stop(): the calling thread is the loop's thread meanwhile. May be run again after it was
  /// stopped, and goes on where it was.
  void run();
  /// Ends run(), or the next run() where none is running. Any thread, but no signal handler.
  void stop();

 private:
  class Parts;  // sockets and timers, behind the one source that knows Beast
  explicit LinkLoop(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::collab
