#include "collab/client/connection.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/clock.h"

namespace icome::collab {
namespace {

constexpr std::chrono::milliseconds kClientTick{50};
constexpr int kMostSentAway = 5;  // times in a row, for the same reason
/// A server that stops, or has not taken a design over yet, says so: it is waited for at least so long.
constexpr std::chrono::milliseconds kTakeOver{12'000};

std::int64_t milliseconds_now() { return base::steady_nanoseconds() / 1'000'000; }

bool is_of_this_machine(const std::string& host) {
  return host == "localhost" || host == "::1" || host.starts_with("127.");
}

}  // namespace

base::Result<std::unique_ptr<Connection>> Connection::create(const DesignAddress& address,
                                                             ClientIdentity identity,
                                                             ContentCachePointer cache) {
  if (address.fingerprint == kNoTls && !is_of_this_machine(address.host))
    return base::fail(
        shown_address(address) +
        ": the address asks for a connection without encryption, which only goes to this machine.");
  std::unique_ptr<Connection> connection(new Connection(address, std::move(identity), std::move(cache)));
  auto network = NetworkThread::create(address);
  if (!network) return tl::unexpected(network.error());
  connection->network_ = std::move(*network);
  return connection;
}

void Connection::work() {
  for (NetworkThread::News& news : network_->take()) std::visit([this](auto& it) { take(it); }, news);
  send();
}

void Connection::take(NetworkThread::Opened&) {
  is_open_ = true;
  is_closing_ = false;
  talk_.opened(milliseconds_now());
}

void Connection::take(std::string& frame) {
  if (is_closing_) return;
  talk_.received(frame, milliseconds_now());
  if (talk_.state() == ConversationState::Live) network_->is_let_in();
}

void Connection::take(NetworkThread::Closed& closed) {
  is_distrusted_ = closed.is_distrusted;
  last_why_ = talk_.why_ended().empty() ? closed.why : talk_.why_ended();
  // A server that ends it again and again, with nothing more on its disk, would do so for ever.
  const bool is_the_same = !talk_.why_ended().empty() && talk_.replica().durable() == sent_away_at_;
  sent_away_ = is_the_same ? sent_away_ + 1 : 0;
  sent_away_at_ = talk_.replica().durable();
  if (closed.was_open) talk_.closed(closed.why, milliseconds_now());
  is_open_ = false;
}

void Connection::send() {
  if (talk_.state() == ConversationState::Ended) network_->give_up();
  while (is_open_ && !is_closing_ && network_->has_room()) {
    if (SharedBytes frame = talk_.next_frame(milliseconds_now())) {
      network_->send(std::move(frame));
    } else if (talk_.wants_to_close()) {
      is_closing_ = true;
      network_->close();
    } else {
      return;
    }
  }
}

base::Result<bool> Connection::work_until(const std::function<bool()>& done,
                                          const std::function<bool()>& stops,
                                          std::chrono::milliseconds patience) {
  const auto error = [this](const std::string& why) {
    return base::fail(fmt::format("{}: {}", shown_address(talk_.address()), why));
  };
  if (last_live_ == 0) last_live_ = milliseconds_now();
  for (;;) {
    work();
    const std::int64_t now = milliseconds_now();
    if (talk_.state() == ConversationState::Live) last_live_ = now;
    if (done()) return true;
    if (talk_.state() == ConversationState::Ended) return error(talk_.why_ended());
    if (stops()) return false;
    if (sent_away_ >= kMostSentAway && talk_.how_ended() == Parting::Other) return error(last_why_);
    const bool is_taken_over = talk_.how_ended() == Parting::ServerStops;
    const auto longest = is_taken_over ? std::max(patience, kTakeOver) : patience;
    if (talk_.state() == ConversationState::Away && now - last_live_ > longest.count())
      return error(last_why_.empty() ? "The server does not answer." : last_why_);
    network_->wait(kClientTick);
  }
}

}  // namespace icome::collab
