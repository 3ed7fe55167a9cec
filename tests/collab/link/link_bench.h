// What the tests of connections share: a loop with notes of what happened, sockets without manners, and a
// relay that can fail.
#pragma once
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "collab/link/certificate.h"
#include "collab/link/link_loop.h"
#include "files/sample_files.h"

namespace icome::collab {

/// Long enough for any machine: what is waited for comes much sooner.
constexpr std::chrono::seconds kLinkPatience{120};

/// A folder with a certificate that goes with it.
class CertificateFolder {
 public:
  CertificateFolder() : path(folder_.path()), certificate(path / "certificate.pem"), key(path / "key.pem") {
    if (make_certificate(certificate, key)) fingerprint = fingerprint_of(certificate).value_or("");
  }

 private:
  files::ScratchFolder folder_;

 public:
  std::filesystem::path path, certificate, key;
  std::string fingerprint;  // empty where there is none
};

/// A loop with notes of all that happens to its connections. Those that it accepts get back what they send.
class LinkBench : public LinkEvents {
 public:
  struct Notes {
    Peer peer = {};
    bool is_open = false;
    bool is_over = false;
    std::string why = {};
    std::size_t frames = 0;
    std::size_t bytes = 0;
    std::string last = {};
    std::deque<std::string> to_send = {};
    bool is_sending = false;
    int calls_after_end = 0;
  };

  LinkBench() : loop_(LinkLoop::create(*this).value()) {}

  LinkLoop& loop() { return *loop_; }
  void destroy_loop() { loop_.reset(); }
  Notes& of(LinkId link) { return notes_[link]; }
  const std::map<LinkId, Notes>& all() const { return notes_; }
  std::size_t open_count(bool ours) const {
    std::size_t count = 0;
    for (const auto& [link, notes] : notes_)
      count += notes.is_open && !notes.is_over && notes.peer.is_ours == ours ? 1 : 0;
    return count;
  }
  /// The connections that it accepted, in their order.
  std::vector<LinkId> accepted() const {
    std::vector<LinkId> result;
    for (const auto& [link, notes] : notes_)
      if (notes.is_open && !notes.peer.is_ours) result.push_back(link);
    return result;
  }

  void send(LinkId link, std::string frame) {
    of(link).to_send.push_back(std::move(frame));
    send_next(link);
  }

  /// Runs the loop until the condition, looked at every millisecond or so, holds; false after
  /// `kLinkPatience`.
  bool run_until(std::function<bool()> condition) {
    condition_ = std::move(condition);
    held_ = false;
    deadline_ = std::chrono::steady_clock::now() + kLinkPatience;
    look();
    loop_->run();
    return held_;
  }
  bool run_until_over(LinkId link) {
    return run_until([&, link] { return of(link).is_over; });
  }
  bool run_until_open(LinkId link) {
    return run_until([&, link] { return of(link).is_open || of(link).is_over; }) && !of(link).is_over;
  }
  /// What must come to pass in so short a time; that it does not is shown in part only.
  void run_for(std::chrono::milliseconds time) {
    const auto end = std::chrono::steady_clock::now() + time;
    run_until([end] { return std::chrono::steady_clock::now() >= end; });
  }
  /// Called with every look at a condition.
  std::function<void()> meanwhile = {};
  std::function<void(LinkId, std::string_view)> on_frame = {};  // of our connections
  std::function<void(LinkId)> on_opened = {};
  bool keeps_frames = true;
  bool echoes = true;

  void opened(LinkId link, const Peer& peer) override {
    Notes& notes = note(link);
    notes.peer = peer;
    notes.is_open = true;
    if (on_opened) on_opened(link);
  }
  void received(LinkId link, std::string_view frame) override {
    Notes& notes = note(link);
    ++notes.frames;
    notes.bytes += frame.size();
    if (keeps_frames) notes.last = frame;
    if (!notes.peer.is_ours && echoes) send(link, std::string(frame));
    if (notes.peer.is_ours && on_frame) on_frame(link, frame);
  }
  void sent(LinkId link) override {
    note(link).is_sending = false;
    send_next(link);
  }
  void closed(LinkId link, const std::string& why) override {
    Notes& notes = note(link);
    notes.is_over = true;
    notes.why = why;
  }

 private:
  Notes& note(LinkId link) {
    Notes& notes = of(link);
    if (notes.is_over) ++notes.calls_after_end;
    return notes;
  }
  void send_next(LinkId link) {
    Notes& notes = of(link);
    if (notes.is_sending || notes.is_over || notes.to_send.empty()) return;
    notes.is_sending = true;
    auto frame = std::make_shared<const std::string>(std::move(notes.to_send.front()));
    notes.to_send.pop_front();
    loop_->send(link, std::move(frame));
  }
  void look() {
    if (meanwhile) meanwhile();
    held_ = condition_();
    if (held_ || std::chrono::steady_clock::now() >= deadline_) return loop_->stop();
    loop_->after(std::chrono::milliseconds(1), [this] { look(); });
  }

  std::map<LinkId, Notes> notes_;
  std::function<bool()> condition_;
  std::chrono::steady_clock::time_point deadline_;
  bool held_ = false;
  std::unique_ptr<LinkLoop> loop_;
};

/// A socket that does as a test likes, and never waits.
class RawSocket {
 public:
  explicit RawSocket(std::uint16_t port)
      : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    sockaddr_in place = {};
    place.sin_family = AF_INET;
    place.sin_port = htons(port);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::connect(socket_, reinterpret_cast<const sockaddr*>(&place), sizeof(place));
  }
  RawSocket(RawSocket&& other) noexcept
      : socket_(std::exchange(other.socket_, -1)), came_(std::move(other.came_)), is_over_(other.is_over_) {}
  RawSocket& operator=(RawSocket&&) = delete;
  ~RawSocket() {
    if (socket_ >= 0) ::close(socket_);
  }

  int descriptor() const { return socket_; }
  /// Sends what the system takes now; gives how much that was.
  std::size_t send(std::string_view bytes) {
    const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    return sent > 0 ? std::size_t(sent) : 0;
  }
  /// All that came so far.
  const std::string& read() {
    std::array<char, 65536> bytes;
    while (!is_over_) {
      const ssize_t got = ::recv(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT);
      if (got > 0)
        came_.append(bytes.data(), std::size_t(got));
      else if (got < 0 && (errno == EAGAIN || errno == EINTR))
        break;
      else
        is_over_ = true;
    }
    return came_;
  }
  /// Has the other side ended it?
  bool is_over() {
    read();
    return is_over_;
  }
  /// Ends the connection as a system does whose program was killed.
  void reset() {
    const linger none = {1, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_LINGER, &none, sizeof(none));
    ::close(std::exchange(socket_, -1));
    is_over_ = true;
  }

 private:
  int socket_;
  std::string came_;
  bool is_over_ = false;
};

/// A place that passes one connection on to a server, until it is told to fail.
class Relay {
 public:
  explicit Relay(std::uint16_t target)
      : target_(target), listening_(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    sockaddr_in place = {};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(place);
    ::bind(listening_, reinterpret_cast<const sockaddr*>(&place), size);
    ::listen(listening_, 8);
    ::getsockname(listening_, reinterpret_cast<sockaddr*>(&place), &size);
    port = ntohs(place.sin_port);
  }
  ~Relay() {
    ::close(listening_);
    if (near_ >= 0) ::close(near_);
  }
  Relay(const Relay&) = delete;
  Relay& operator=(const Relay&) = delete;

  /// Moves what there is; the test calls it again and again.
  void pump() {
    if (near_ < 0 && !far_) {
      near_ = ::accept4(listening_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
      if (near_ >= 0) far_ = std::make_unique<RawSocket>(target_);
    }
    if (near_ < 0 || is_silent) return;
    move(near_, far_->descriptor(), up_);
    move(far_->descriptor(), near_, down_);
  }
  void reset() {
    const linger none = {1, 0};
    ::setsockopt(near_, SOL_SOCKET, SO_LINGER, &none, sizeof(none));
    ::close(std::exchange(near_, -1));
    far_->reset();
  }

  std::uint16_t port = 0;
  bool is_silent = false;  // takes everything and passes nothing on

 private:
  static void move(int from, int to, std::string& waiting) {
    std::array<char, 16384> bytes;
    if (waiting.size() < bytes.size()) {
      const ssize_t got = ::recv(from, bytes.data(), bytes.size(), MSG_DONTWAIT);
      if (got > 0) waiting.append(bytes.data(), std::size_t(got));
      if (got == 0) ::shutdown(to, SHUT_WR);
    }
    const ssize_t sent = ::send(to, waiting.data(), waiting.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent > 0) waiting.erase(0, std::size_t(sent));
  }

  std::uint16_t target_;
  int listening_;
  int near_ = -1;
  std::unique_ptr<RawSocket> far_;
  std::string up_, down_;
};

}  // namespace icome::collab
