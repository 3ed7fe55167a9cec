#include "devices/spacemouse/spnav_link.h"

#include <fcntl.h>
#include <signal.h>
#include <spnav.h>
// The headers of X11, which it takes in, define words that others have as names.
#undef Bool
#undef None
#undef Status
#undef Success
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

namespace icome::devices {
namespace {

using EventNumbers = std::array<std::int32_t, 8>;
constexpr int kMostUnknown = 64;  // in one call

/// Is the number spacenavd's answer to the greeting? libspnav waits 0.3 s for it; an answer that comes later,
/// or after an event that libspnav took for it, stands among the events.
bool is_answer(std::int32_t number) { return (std::uint32_t(number) & 0xffffff00U) == 0x7faa5500U; }

std::atomic<bool> link_taken = false;

/// The value of "socket = ..." in spacenavd's settings; empty without one.
std::string configured_socket() {
  std::ifstream file("/etc/spnavrc");
  std::string line;
  while (std::getline(file, line)) {
    const std::size_t start = line.find_first_not_of(" \t");
    const std::size_t equals = line.find('=');
    if (start == std::string::npos || equals == std::string::npos || line.compare(start, 6, "socket") != 0)
      continue;
    const std::size_t first = line.find_first_not_of(" \t", equals + 1);
    if (first == std::string::npos) continue;
    return line.substr(first, line.find_last_not_of(" \t\r") + 1 - first);
  }
  return {};
}

/// The paths at which libspnav looks for spacenavd's socket.
std::vector<std::string> socket_paths() {
  std::vector<std::string> paths;
  if (const char* path = std::getenv("SPNAV_SOCKET")) paths.emplace_back(path);
  paths.push_back(configured_socket());
  paths.emplace_back("/var/run/spnav.sock");
  return paths;
}

bool listens(const std::string& path) {
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof(address.sun_path)) return false;
  std::memcpy(address.sun_path, path.c_str(), path.size());
  const int probe = socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (probe < 0) return false;
  // libspnav looks at its socket by select(), which takes no larger numbers.
  const bool usable = probe < FD_SETSIZE;
  const bool connected = connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  ::close(probe);
  return usable && connected;
}

std::optional<SpnavEvent> translated(const spnav_event& event) {
  SpnavEvent result;
  switch (event.type) {
    case SPNAV_EVENT_MOTION:
      result.axes = {event.motion.x,  event.motion.y,  event.motion.z,
                     event.motion.rx, event.motion.ry, event.motion.rz};
      return result;
    case SPNAV_EVENT_BUTTON:
      result.kind = SpnavEvent::Kind::Button;
      result.button = event.button.bnum;
      result.down = event.button.press != 0;
      return result;
    case SPNAV_EVENT_DEV:
      result.kind = event.dev.op == SPNAV_DEV_RM ? SpnavEvent::Kind::Unplugged : SpnavEvent::Kind::Plugged;
      return result;
    default:
      return std::nullopt;
  }
}

/// Discards available bytes of the connection.
void skip(std::size_t bytes) {
  EventNumbers away = {};
  static_cast<void>(recv(spnav_fd(), away.data(), bytes, MSG_DONTWAIT));
}

}  // namespace

std::unique_ptr<SpnavLink> SpnavLink::claim() {
  if (link_taken.exchange(true)) return nullptr;
  return std::unique_ptr<SpnavLink>(new SpnavLink());
}

SpnavLink::~SpnavLink() {
  if (opener_.joinable()) opener_.join();
  if (state_ == State::Open || succeeded_) close();
  link_taken = false;
}

// Checked first, since each failing spnav_open() loses memory and, with settings, an open file.
bool SpnavLink::somebody_listens() {
  for (const std::string& path : socket_paths()) {
    if (listens(path)) return true;
  }
  return false;
}

SpnavLink::State SpnavLink::state() {
  if (state_ == State::Opening && opened_) {
    opener_.join();
    state_ = succeeded_ ? State::Open : State::Closed;
  }
  return state_;
}

void SpnavLink::open() {
  if (state() != State::Closed) return;
  opened_ = succeeded_ = false;
  const auto connect = [this] {
    // Writing to a spacenavd that has just ended must not end us.
    sigset_t pipe;
    sigemptyset(&pipe);
    sigaddset(&pipe, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe, nullptr);
    succeeded_ = spnav_open() == 0;
    opened_ = true;
  };
  try {
    opener_ = std::thread(connect);
    state_ = State::Opening;
  } catch (const std::system_error&) {
    // The next attempt may get a thread.
  }
}

std::optional<SpnavEvent> SpnavLink::next() {
  // Skips a limited number of unknown events, as there may be no end of them.
  for (int i = 0; i < kMostUnknown && state() == State::Open; ++i) {
    // libspnav neither reports that spacenavd has ended, nor can it take half an event.
    EventNumbers ahead = {};
    const ssize_t there = recv(spnav_fd(), ahead.data(), sizeof(ahead), MSG_PEEK | MSG_DONTWAIT);
    if (there < 0 && errno == EINTR) continue;
    if (there == 0 || (there < 0 && errno != EAGAIN && errno != EWOULDBLOCK)) {
      close();
      break;
    }
    if (there >= ssize_t(sizeof(ahead[0])) && is_answer(ahead.front())) {
      skip(sizeof(ahead[0]));
      continue;
    }
    if (there < ssize_t(sizeof(ahead))) break;
    if (is_answer(ahead.back())) {
      skip(sizeof(ahead));
      continue;
    }
    spnav_event event = {};
    if (spnav_poll_event(&event) == 0) continue;  // of a kind that libspnav does not know
    if (const auto said = translated(event)) return said;
  }
  return std::nullopt;
}

void SpnavLink::close() {
  spnav_close();
  state_ = State::Closed;
  succeeded_ = false;
}

}  // namespace icome::devices
