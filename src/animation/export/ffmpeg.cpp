#include "animation/export/ffmpeg.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

#include "animation/export/frame_maker.h"

extern char** environ;

namespace icome::animation {
namespace {

using base::fail;
using base::Result;

constexpr int kWait = 100;                  // ms, between questions
constexpr int kFeedBuffer = 1 << 20;        // bytes
constexpr std::size_t kMostSaid = 8 << 10;  // bytes
constexpr int kHandedAbove = 20;            // descriptors here, so that none is in the way of those there

/// Both ends of a way to or from the program.
struct Ends {
  int ours = -1, theirs = -1;

  Ends() = default;
  Ends(const Ends&) = delete;
  Ends& operator=(const Ends&) = delete;
  ~Ends() {
    if (ours >= 0) ::close(ours);
    if (theirs >= 0) ::close(theirs);
  }
  int take_ours() { return std::exchange(ours, -1); }
};

/// Settings for posix_spawn() that give the program its three files and those that are handed to it.
class FfmpegPlan {
 public:
  FfmpegPlan(int input, int complaints, const std::vector<Ffmpeg::HandedFile>& files) {
    posix_spawn_file_actions_init(&actions);
    int last = STDERR_FILENO;
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, complaints, STDERR_FILENO);
    for (const Ffmpeg::HandedFile& file : files) {
      posix_spawn_file_actions_adddup2(&actions, file.ours, file.theirs);
      last = std::max(last, file.theirs);
    }
    posix_spawn_file_actions_addclosefrom_np(&actions, last + 1);
    posix_spawnattr_init(&attributes);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes, &signals);
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes, &signals);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  FfmpegPlan(const FfmpegPlan&) = delete;
  FfmpegPlan& operator=(const FfmpegPlan&) = delete;
  ~FfmpegPlan() {
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
  }

  posix_spawn_file_actions_t actions{};
  posix_spawnattr_t attributes{};
};

/// Copies of descriptors whose numbers no handed file has, closed at the end: dup2 to one number must not
/// close another that is still to be handed on.
class HighCopies {
 public:
  ~HighCopies() {
    for (const int each : copies_) ::close(each);
  }
  int of(int descriptor) {
    const int copy = ::fcntl(descriptor, F_DUPFD_CLOEXEC, kHandedAbove);
    if (copy >= 0) copies_.push_back(copy);
    return copy;
  }

 private:
  std::vector<int> copies_;
};

bool make_ends(Ends& input, Ends& complaints) {
  std::array<int, 2> pair{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair.data()) != 0) return false;
  input.ours = pair[0];
  input.theirs = pair[1];
  for (const int end : pair) ::setsockopt(end, SOL_SOCKET, SO_SNDBUF, &kFeedBuffer, sizeof kFeedBuffer);
  if (::pipe2(pair.data(), O_CLOEXEC) != 0) return false;
  complaints.ours = pair[0];
  complaints.theirs = pair[1];
  return ::fcntl(input.ours, F_SETFL, O_NONBLOCK) == 0 && ::fcntl(complaints.ours, F_SETFL, O_NONBLOCK) == 0;
}

}  // namespace

Result<Ffmpeg> Ffmpeg::start(const std::vector<std::string>& arguments,
                             const std::vector<HandedFile>& files) {
  Ends input, complaints;
  if (!make_ends(input, complaints))
    return fail(fmt::format("cannot talk to another process: {}", std::strerror(errno)));
  HighCopies copies;
  std::vector<HandedFile> handed;
  for (const HandedFile& file : files) handed.push_back({copies.of(file.ours), file.theirs});
  const FfmpegPlan plan(copies.of(input.theirs), copies.of(complaints.theirs), handed);

  std::vector<std::string> words = {"ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error", "-y"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  pid_t process = 0;
  const int error =
      ::posix_spawnp(&process, "ffmpeg", &plan.actions, &plan.attributes, pointers.data(), environ);
  if (error == 0) return Ffmpeg(process, input.take_ours(), complaints.take_ours());
  if (error == ENOENT)
    return fail(
        "films are written by the program ffmpeg, which is not there; install it (apt install ffmpeg), or "
        "write "
        "pictures: --out frames/");
  return fail(fmt::format("the program ffmpeg cannot be started: {}", std::strerror(error)));
}

Ffmpeg::Ffmpeg(Ffmpeg&& other) noexcept
    : process_(std::exchange(other.process_, 0)),
      input_(std::exchange(other.input_, -1)),
      complaints_(std::exchange(other.complaints_, -1)),
      said_(std::move(other.said_)) {}

Ffmpeg::~Ffmpeg() {
  if (input_ >= 0) ::close(input_);
  if (complaints_ >= 0) ::close(complaints_);
  if (process_ == 0) return;
  ::kill(process_, SIGKILL);
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void Ffmpeg::hear() {
  std::array<char, 4096> block{};
  while (complaints_ >= 0) {
    const ssize_t count = ::read(complaints_, block.data(), block.size());
    if (count > 0) {
      said_.append(block.data(), std::min(std::size_t(count), kMostSaid - std::min(kMostSaid, said_.size())));
      continue;
    }
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EAGAIN) return;
    ::close(complaints_);
    complaints_ = -1;
  }
}

tl::unexpected<base::Error> Ffmpeg::failed() {
  hear();
  std::string text;
  for (const char c : said_) text += c == '\n' || c == '\r' ? ' ' : c;
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return fail(fmt::format("ffmpeg has failed: {}", text.empty() ? "it does not say why" : text));
}

Result<void> Ffmpeg::feed(std::string_view bytes, const GoesOn& goes_on) {
  auto asked = std::chrono::steady_clock::now();
  while (!bytes.empty()) {
    const ssize_t count = ::send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count > 0) {
      bytes.remove_prefix(std::size_t(count));
      continue;
    }
    if (count < 0 && errno == EINTR) continue;
    if (count == 0 || errno != EAGAIN) {
      // It has closed its input: its complaint may still be on the way.
      const auto ended = finish(goes_on);
      if (!ended) return ended;
      return fail("ffmpeg has failed: it ended before the last frame");
    }
    std::array<pollfd, 2> ways = {pollfd{input_, POLLOUT, 0}, pollfd{complaints_, POLLIN, 0}};
    ::poll(ways.data(), ways.size(), kWait);
    hear();
    const auto now = std::chrono::steady_clock::now();
    if (now - asked < std::chrono::milliseconds(kWait)) continue;
    asked = now;
    if (goes_on && !goes_on()) return stopped_export();
  }
  return {};
}

Result<void> Ffmpeg::finish(const GoesOn& goes_on) {
  if (input_ >= 0) ::close(std::exchange(input_, -1));
  auto asked = std::chrono::steady_clock::now();
  int status = 0;
  while (true) {
    const pid_t ended = ::waitpid(process_, &status, WNOHANG);
    if (ended == process_) break;
    if (ended < 0 && errno != EINTR) {
      process_ = 0;
      return fail(fmt::format("ffmpeg cannot be waited for: {}", std::strerror(errno)));
    }
    // Its complaints end with it, so that their end wakes this up.
    pollfd way{complaints_, POLLIN, 0};
    if (complaints_ >= 0) {
      ::poll(&way, 1, kWait);
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    hear();
    const auto now = std::chrono::steady_clock::now();
    if (now - asked < std::chrono::milliseconds(kWait)) continue;
    asked = now;
    if (goes_on && !goes_on()) return stopped_export();
  }
  process_ = 0;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  if (WIFSIGNALED(status) && said_.empty())
    return fail(fmt::format("ffmpeg was ended by signal {}", WTERMSIG(status)));
  return failed();
}

}  // namespace icome::animation
