#include "collab/client/network_thread.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace icome::collab {
namespace {

constexpr std::int64_t kShortestPause = 100;  // ms between two tries to connect; doubled each time
constexpr std::int64_t kLongestPause = 2'000;
constexpr std::chrono::milliseconds kSilence{10'000};  // a server answers every two seconds or so
constexpr std::size_t kMostFrames = 4;                 // that wait to be sent
constexpr std::size_t kMostBytes = 256U << 20U;        // of frames that wait for the owner

}  // namespace

base::Result<std::unique_ptr<NetworkThread>> NetworkThread::create(const DesignAddress& address) {
  std::unique_ptr<NetworkThread> network(new NetworkThread(address));
  auto loop = LinkLoop::create(*network);
  if (!loop) return tl::unexpected(loop.error());
  network->loop_ = std::move(*loop);
  network->loop_->post([it = network.get()] { it->connect(); });
  try {
    network->thread_ = std::thread([it = network.get()] { it->loop_->run(); });
  } catch (const std::system_error& error) {
    return base::fail(std::string("No thread could be started for the connection: ") + error.what() + ".");
  }
  return network;
}

NetworkThread::NetworkThread(const DesignAddress& address) {
  settings_.endpoint = {address.host, address.port};
  settings_.idle_time = kSilence;
  settings_.tls = address.fingerprint != kNoTls;
  if (settings_.tls) settings_.fingerprint = address.fingerprint;
}

NetworkThread::~NetworkThread() {
  if (!thread_.joinable()) return;
  loop_->stop();
  thread_.join();
}

// ---- the owner

std::vector<NetworkThread::News> NetworkThread::take() {
  const std::lock_guard lock(mutex_);
  std::vector<News> news(std::make_move_iterator(in_.begin()), std::make_move_iterator(in_.end()));
  in_.clear();
  in_bytes_ = 0;
  for (const News& it : news) told_connection_ += std::holds_alternative<Closed>(it) ? 1 : 0;
  return news;
}

void NetworkThread::wait(std::chrono::milliseconds longest) {
  std::unique_lock lock(mutex_);
  wake_.wait_for(lock, longest, [this] { return !in_.empty() || has_sent_; });
  has_sent_ = false;
}

bool NetworkThread::has_room() {
  const std::lock_guard lock(mutex_);
  return out_.size() < kMostFrames;
}

void NetworkThread::send(SharedBytes frame) {
  {
    const std::lock_guard lock(mutex_);
    if (connection_ != told_connection_) return;
    out_.push_back(std::move(frame));
  }
  loop_->post([this] { flush(); });
}

void NetworkThread::close() {
  {
    const std::lock_guard lock(mutex_);
    if (connection_ != told_connection_) return;
    wants_to_close_ = true;
  }
  loop_->post([this] { flush(); });
}

// ---- the thread

void NetworkThread::connect() {
  if (given_up_.load(std::memory_order_relaxed)) return;
  is_open_ = is_sending_ = is_closing_ = false;
  link_ = loop_->connect(settings_);
}

/// Gives the bytes of frames that wait for the owner.
std::size_t NetworkThread::tell(News news, std::size_t bytes) {
  std::size_t waiting = 0;
  {
    const std::lock_guard lock(mutex_);
    in_.push_back(std::move(news));
    waiting = in_bytes_ += bytes;
  }
  wake_.notify_one();
  return waiting;
}

void NetworkThread::opened(LinkId link, const Peer&) {
  if (link != link_) return;
  is_open_ = true;
  (void)tell(Opened{}, 0);
}

void NetworkThread::received(LinkId link, std::string_view frame) {
  if (link != link_) return;
  // The design comes anew when there is time for it.
  if (tell(std::string(frame), frame.size()) > kMostBytes)
    loop_->close(link, "The program is too busy to take in what comes.");
}

void NetworkThread::sent(LinkId link) {
  if (link != link_) return;
  is_sending_ = false;
  flush();
  {
    const std::lock_guard lock(mutex_);
    has_sent_ = true;
  }
  wake_.notify_one();
}

void NetworkThread::closed(LinkId link, const std::string& why) {
  if (link != link_) return;
  link_.reset();
  {
    const std::lock_guard lock(mutex_);
    in_.push_back(
        Closed{why, is_open_, loop_->distrusted() != std::exchange(distrusted_, loop_->distrusted())});
    out_.clear();
    wants_to_close_ = false;
    ++connection_;
  }
  wake_.notify_one();
  is_open_ = false;
  const std::int64_t pause = pause_.load(std::memory_order_relaxed);
  pause_.store(std::clamp(2 * pause, kShortestPause, kLongestPause), std::memory_order_relaxed);
  loop_->after(std::chrono::milliseconds(pause), [this] { connect(); });
}

void NetworkThread::flush() {
  if (!link_ || !is_open_ || is_sending_ || is_closing_) return;
  SharedBytes frame;
  {
    const std::lock_guard lock(mutex_);
    if (out_.empty()) {
      is_closing_ = wants_to_close_;
    } else {
      frame = std::move(out_.front());
      out_.pop_front();
    }
  }
  if (frame) {
    is_sending_ = true;
    loop_->send(*link_, std::move(frame));
  } else if (is_closing_) {
    loop_->close(*link_, "The client leaves.");
  }
}

}  // namespace icome::collab
