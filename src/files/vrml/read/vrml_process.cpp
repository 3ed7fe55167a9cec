#include "files/vrml/read/vrml_process.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <deque>
#include <string>
#include <utility>

#include "base/clock.h"
#include "files/vrml/read/vrml_broker.h"
#include "files/vrml/read/vrml_child.h"
#include "files/vrml/read/vrml_frames.h"
#include "io/memory_budget.h"

namespace icome::files {
namespace {

/// FlatBuffers cannot count more bytes.
constexpr std::uint64_t kAnswerLimit = (1ULL << 31U) - 1;
constexpr std::uint64_t kUrlsLimit = 1U << 20U;
constexpr std::size_t kPartSize = 1U << 20U;
/// Longest time between two calls for progress, s.
constexpr double kProgressPeriod = 0.05;
/// Approximate speed of a worker's parser, bytes/s; for the progress that people see.
constexpr double kExpectedSpeed = 30e6;

double seconds_since(std::int64_t start) {
  return static_cast<double>(base::steady_nanoseconds() - start) * 1e-9;
}

template <typename Plain>
std::string bytes_of(const Plain& plain) {
  return {reinterpret_cast<const char*>(&plain), sizeof plain};
}

/// Frames on their way to the worker.
class Outbox {
 public:
  /// `bytes` must stay in place until they are sent.
  void put(VrmlFrame kind, int file, std::string_view bytes) {
    parts_.push_back({bytes_of(VrmlFrameHead{kind, file, bytes.size()}), {}});
    parts_.push_back({{}, bytes});
    left_ += parts_[parts_.size() - 2].kept.size() + bytes.size();
  }
  void put_copy(VrmlFrame kind, int file, std::string bytes) {
    parts_.push_back({bytes_of(VrmlFrameHead{kind, file, bytes.size()}) + std::move(bytes), {}});
    left_ += parts_.back().kept.size();
  }
  bool empty() const { return parts_.empty(); }
  std::size_t left() const { return left_; }

  /// Sends as much as the socket takes now. A worker that takes no more is detected when reading.
  void send_to(int socket) {
    while (!parts_.empty()) {
      const Part& part = parts_.front();
      const std::string_view all = part.kept.empty() ? part.seen : std::string_view(part.kept);
      const std::string_view rest = all.substr(sent_);
      const ssize_t count = ::send(socket, rest.data(), std::min(rest.size(), kPartSize), MSG_NOSIGNAL);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return;
      if (count < 0) return parts_.clear();
      sent_ += static_cast<std::size_t>(count);
      left_ -= static_cast<std::size_t>(count);
      if (sent_ < all.size()) continue;
      parts_.pop_front();
      sent_ = 0;
    }
  }

 private:
  struct Part {
    std::string kept;
    std::string_view seen;
  };
  std::deque<Part> parts_ = {};
  std::size_t sent_ = 0;  // of the first part
  std::size_t left_ = 0;  // of all
};

/// A frame on its way from the worker.
class Inbox {
 public:
  enum class State { Waiting, Whole, Ended, Nonsense };

  State receive_from(int socket) {
    while (true) {
      const bool in_head = head_filled_ < sizeof head_;
      if (!in_head && filled_ == head_.size) return State::Whole;
      if (!in_head && filled_ == body_.size())
        body_.resize(std::min<std::uint64_t>(head_.size, filled_ + std::max(filled_, kPartSize)));
      char* const to = in_head ? reinterpret_cast<char*>(&head_) + head_filled_ : body_.data() + filled_;
      const std::size_t room = in_head ? sizeof head_ - head_filled_ : body_.size() - filled_;
      const ssize_t count = ::recv(socket, to, room, 0);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return State::Waiting;
      if (count <= 0) return State::Ended;
      (in_head ? head_filled_ : filled_) += static_cast<std::size_t>(count);
      if (in_head && head_filled_ == sizeof head_ && !is_sensible()) return State::Nonsense;
    }
  }
  /// Limits the bytes of an answer.
  void limit(std::uint64_t bytes) { limit_ = std::min(bytes, kAnswerLimit); }
  const VrmlFrameHead& head() const { return head_; }
  /// Takes the whole frame's content and begins the next.
  std::string take() {
    head_filled_ = 0;
    filled_ = 0;
    return std::exchange(body_, {});
  }

 private:
  bool is_sensible() const {
    return (head_.kind == VrmlFrame::Answer && head_.size <= limit_) ||
           (head_.kind == VrmlFrame::Fetch && head_.size <= kUrlsLimit);
  }

  std::uint64_t limit_ = kAnswerLimit;
  VrmlFrameHead head_ = {};
  std::size_t head_filled_ = 0;
  std::string body_ = {};
  std::size_t filled_ = 0;
};

/// The dialogue with the worker for one file.
class Talk {
 public:
  Talk(VrmlChild child, const std::filesystem::path& path, const DesignReadOptions& options)
      : child_(std::move(child)),
        options_(options),
        broker_(path, options.size_limit, options.follows_urls_above),
        memory_(options.memory_limit) {}

  base::Result<VrmlAnswer> run(std::string_view bytes) {
    memory_.add_file(bytes.size());
    inbox_.limit(memory_.allowed());
    const VrmlLimits limits{memory_.allowed(), options_.seconds_limit, ::getpid()};
    outbox_.put_copy(VrmlFrame::Limits, 0, bytes_of(limits));
    outbox_.put_copy(VrmlFrame::Name, 0, broker_.files().front().string());
    outbox_.put(VrmlFrame::File, 0, bytes);
    size_ = bytes.size();
    while (true) {
      if (options_.progress && !options_.progress(part_done())) return base::fail("reading was stopped");
      const double left = options_.seconds_limit - seconds_since(start_);
      if (!(left > 0.0)) return base::fail(too_long());
      wait_for_socket(left);
      outbox_.send_to(child_.socket());
      switch (inbox_.receive_from(child_.socket())) {
        case Inbox::State::Waiting:
          break;
        case Inbox::State::Whole:
          if (inbox_.head().kind == VrmlFrame::Answer)
            return VrmlAnswer{inbox_.take(), broker_.files(), inlined_bytes_};
          answer_fetch();
          break;
        case Inbox::State::Ended:
          return base::fail(why_ended(child_.end()));
        case Inbox::State::Nonsense:
          return base::fail("the VRML reader answered with something else than a scene");
      }
    }
  }

 private:
  void wait_for_socket(double left) const {
    const double seconds = options_.progress ? std::min(left, kProgressPeriod) : std::min(left, 3600.0);
    const short events = outbox_.empty() ? POLLIN : POLLIN | POLLOUT;
    pollfd wanted{child_.socket(), events, 0};
    ::poll(&wanted, 1, static_cast<int>(std::ceil(seconds * 1e3)));
  }

  void answer_fetch() {
    const int from = inbox_.head().file;
    VrmlBroker::Reply reply = broker_.fetch(from, inbox_.take());
    if (reply.kind == VrmlFrame::File) {
      allow_for_file(reply.bytes.size());
      outbox_.put_copy(VrmlFrame::Name, reply.file,
                       broker_.files()[static_cast<std::size_t>(reply.file)].string());
    }
    outbox_.put_copy(reply.kind, reply.file, std::move(reply.bytes));
  }

  /// Raises the worker's limit, which it cannot do itself: a file may control it.
  void allow_for_file(std::uint64_t bytes) {
    const std::uint64_t before = memory_.allowed();
    inlined_bytes_ += bytes;
    memory_.add_file(bytes);
    inbox_.limit(memory_.allowed());
    rlimit limit{};
    if (::prlimit(child_.process(), RLIMIT_AS, nullptr, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
      return;
    limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur + (memory_.allowed() - before), limit.rlim_max);
    ::prlimit(child_.process(), RLIMIT_AS, &limit, nullptr);
  }

  /// A guess that never decreases and reaches 1 only with the answer.
  double part_done() const {
    const double sent =
        1.0 - static_cast<double>(outbox_.left()) / static_cast<double>(size_ + outbox_.left() + 1);
    const double expected = 0.01 + static_cast<double>(size_) / kExpectedSpeed;
    return 0.1 * sent + 0.85 * (1.0 - std::exp(-seconds_since(start_) / expected));
  }

  std::string too_long() const {
    return fmt::format("reading this file took longer than {:g} s", options_.seconds_limit);
  }

  std::string why_ended(int status) const {
    if (WIFEXITED(status) && WEXITSTATUS(status) == kVrmlOutOfMemory) return memory_.problem().message;
    if (WIFEXITED(status) && WEXITSTATUS(status) == kVrmlTooDeep) return "its nodes nest too deep to be read";
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) return too_long();
    if (WIFSIGNALED(status))
      return fmt::format("the VRML reader crashed (signal {}) on this file", WTERMSIG(status));
    return fmt::format("the VRML reader ended without an answer (code {})",
                       WIFEXITED(status) ? WEXITSTATUS(status) : -1);
  }

  VrmlChild child_;
  const DesignReadOptions& options_;
  VrmlBroker broker_;
  io::MemoryBudget memory_;          // of the worker
  std::uint64_t inlined_bytes_ = 0;  // of the files beside the design
  Outbox outbox_ = {};
  Inbox inbox_ = {};
  std::size_t size_ = 0;  // of the design, in bytes
  std::int64_t start_ = base::steady_nanoseconds();
};

}  // namespace

base::Result<VrmlAnswer> ask_vrml_worker(std::string_view bytes, const std::filesystem::path& path,
                                         const DesignReadOptions& options) {
  auto child = VrmlChild::start();
  if (!child) return base::fail(path.string() + ": " + child.error().message);
  auto answer = Talk(std::move(*child), path, options).run(bytes);
  if (!answer) return base::fail(path.string() + ": " + answer.error().message);
  return answer;
}

}  // namespace icome::files
