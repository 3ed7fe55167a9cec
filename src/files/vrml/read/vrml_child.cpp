#include "files/vrml/read/vrml_child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

extern char** environ;

namespace icome::files {
namespace {

constexpr const char* kWorkerName = "icome-vrml-worker";
constexpr const char* kWorkerVariable = "ICOME_VRML_WORKER";
/// Large, so that megabytes need few turns.
constexpr int kSocketBuffer = 1 << 20;

#ifdef ICOME_ADDRESS_SANITIZER
constexpr bool kShowsErrors = true;  // the sanitizer writes its findings
#else
constexpr bool kShowsErrors = false;
#endif

std::filesystem::path worker_path() {
  if (const char* named = std::getenv(kWorkerVariable); named && *named) return named;
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / kWorkerName;
}

/// The environment without the user's settings, so that none changes how a file is parsed; only the
/// variables for finding libraries and for sanitizers are kept.
std::vector<std::string> worker_environment() {
  std::vector<std::string> kept = {"LC_ALL=C"};
  for (char** entry = environ; entry && *entry; ++entry) {
    const std::string_view text = *entry;
    const std::string_view name = text.substr(0, text.find('='));
    if (name == "LD_LIBRARY_PATH" || name.ends_with("SAN_OPTIONS")) kept.emplace_back(text);
  }
  return kept;
}

/// Settings for posix_spawn() that give the child nothing but its socket.
class SpawnPlan {
 public:
  explicit SpawnPlan(int socket) {
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, socket, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, socket, STDOUT_FILENO);
    if (!kShowsErrors) posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
    posix_spawnattr_init(&attributes);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes, &signals);
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes, &signals);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;
  ~SpawnPlan() {
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
  }

  posix_spawn_file_actions_t actions{};
  posix_spawnattr_t attributes{};
};

}  // namespace

base::Result<VrmlChild> VrmlChild::start() {
  const std::filesystem::path path = worker_path();
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    return base::fail(fmt::format("cannot talk to another process: {}", std::strerror(errno)));
  for (const int end : ends) ::setsockopt(end, SOL_SOCKET, SO_SNDBUF, &kSocketBuffer, sizeof kSocketBuffer);
  ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
  std::vector<std::string> environment = worker_environment();
  std::vector<char*> variables;
  for (std::string& entry : environment) variables.push_back(entry.data());
  variables.push_back(nullptr);
  std::string program = path.string();
  std::array<char*, 2> arguments = {program.data(), nullptr};
  const SpawnPlan plan(ends[1]);
  pid_t process = 0;
  const int error = ::posix_spawn(&process, program.c_str(), &plan.actions, &plan.attributes,
                                  arguments.data(), variables.data());
  ::close(ends[1]);
  if (error == 0) return VrmlChild(process, ends[0]);
  ::close(ends[0]);
  return base::fail(
      fmt::format("the program that reads VRML, {}, cannot be started: {}; it is built with icome, "
                  "and {} can say where it is",
                  program, std::strerror(error), kWorkerVariable));
}

VrmlChild::VrmlChild(VrmlChild&& other) noexcept
    : process_(std::exchange(other.process_, 0)), socket_(std::exchange(other.socket_, -1)) {}

VrmlChild::~VrmlChild() {
  if (socket_ >= 0) ::close(socket_);
  if (process_ != 0) end();
}

int VrmlChild::end() {
  int status = -1;
  // Does nothing to a process that has ended and was not waited for.
  ::kill(process_, SIGKILL);
  while (::waitpid(process_, &status, 0) < 0)
    if (errno != EINTR) {
      status = -1;
      break;
    }
  process_ = 0;
  return status;
}

}  // namespace icome::files
