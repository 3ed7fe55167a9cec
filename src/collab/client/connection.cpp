#include "collab/client/connection.h"

#include <fmt/format.h>
#include <openssl/rand.h>

#include <algorithm>
#include <array>

#include "base/clock.h"

namespace icome::collab {
namespace {

constexpr std::int64_t kShortestPause = 100;  // ms between two tries to connect; doubled each time
constexpr std::int64_t kLongestPause = 2'000;
constexpr std::int64_t kClientTick = 50;  // ms

std::int64_t milliseconds_now() { return base::steady_nanoseconds() / 1'000'000; }

bool is_of_this_machine(const std::string& host) {
  return host == "localhost" || host == "::1" || host.starts_with("127.");
}

}  // namespace

base::Result<std::string> make_client_key() {
  std::array<unsigned char, 16> bytes{};
  if (RAND_bytes(bytes.data(), int(bytes.size())) != 1)
    return base::fail("The system gives no random numbers for a key of this client.");
  std::string text;
  for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

base::Result<std::unique_ptr<Connection>> Connection::create(const DesignAddress& address,
                                                             ClientIdentity identity,
                                                             const world::GeometryFactory& factory) {
  if (address.fingerprint == kNoTls && !is_of_this_machine(address.host))
    return base::fail(
        shown_address(address) +
        ": the address asks for a connection without encryption, which only goes to this machine.");
  std::unique_ptr<Connection> connection(new Connection(address, std::move(identity), factory));
  auto loop = LinkLoop::create(*connection);
  if (!loop) return tl::unexpected(loop.error());
  connection->loop_ = std::move(*loop);
  return connection;
}

base::Result<bool> Connection::work_until(const std::function<bool()>& done,
                                          const std::function<bool()>& stops,
                                          std::chrono::milliseconds patience) {
  bool was_stopped = false, ran_out = false;
  const auto is_over = [&] {
    const bool is_away = talk_.state() != ConversationState::Live;
    if (!is_away) last_live_ = milliseconds_now();
    was_stopped = stops();
    ran_out = talk_.state() == ConversationState::Away && milliseconds_now() - last_live_ > patience.count();
    return done() || talk_.state() == ConversationState::Ended || was_stopped || ran_out;
  };
  const std::function<bool()> over = is_over;
  if (last_live_ == 0) last_live_ = milliseconds_now();
  done_ = &over;
  loop_->post([this] {
    connect();
    flush();
    look();
  });
  if (!ticks_) {
    ticks_ = true;
    loop_->after(std::chrono::milliseconds(kClientTick), [this] { tick(); });
  }
  loop_->run();
  done_ = nullptr;
  if (done()) return true;
  if (was_stopped) return false;
  const std::string why = talk_.state() == ConversationState::Ended ? talk_.why_ended() : last_why_;
  return base::fail(fmt::format("{}: {}", shown_address(talk_.address()), why));
}

void Connection::connect() {
  const std::int64_t now = milliseconds_now();
  if (link_ || talk_.state() == ConversationState::Ended || now < next_try_) return;
  const DesignAddress& address = talk_.address();
  ConnectSettings settings;
  settings.endpoint = {address.host, address.port};
  settings.tls = address.fingerprint != kNoTls;
  if (settings.tls) settings.fingerprint = address.fingerprint;
  is_open_ = is_sending_ = is_closing_ = false;
  link_ = loop_->connect(settings);
}

void Connection::opened(LinkId link, const Peer&) {
  if (link != link_) return;
  is_open_ = true;
  talk_.opened(milliseconds_now());
  flush();
}

void Connection::received(LinkId link, std::string_view frame) {
  if (link != link_) return;
  talk_.received(frame, milliseconds_now());
  if (talk_.state() == ConversationState::Live) pause_ = 0;
  flush();
  look();
}

void Connection::sent(LinkId link) {
  if (link != link_) return;
  is_sending_ = false;
  flush();
  look();
}

void Connection::closed(LinkId link, const std::string& why) {
  if (link != link_) return;
  link_.reset();
  last_why_ = talk_.why_ended().empty() ? why : talk_.why_ended();
  const std::int64_t now = milliseconds_now();
  next_try_ = now + pause_;
  pause_ = std::clamp(2 * pause_, kShortestPause, kLongestPause);
  if (is_open_) talk_.closed(why, now);
  is_open_ = false;
  look();
}

void Connection::flush() {
  if (!link_ || !is_open_ || is_sending_ || is_closing_) return;
  if (SharedBytes frame = talk_.next_frame(milliseconds_now())) {
    is_sending_ = true;
    loop_->send(*link_, std::move(frame));
  } else if (talk_.wants_to_close()) {
    is_closing_ = true;
    loop_->close(*link_, "The client leaves.");
  }
}

void Connection::tick() {
  connect();
  flush();
  look();
  loop_->after(std::chrono::milliseconds(kClientTick), [this] { tick(); });
}

/// Ends work_until() when there is a reason to.
void Connection::look() {
  if (done_ != nullptr && (*done_)()) loop_->stop();
}

}  // namespace icome::collab
