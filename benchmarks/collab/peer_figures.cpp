#include "peer_figures.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <vector>

#include "server_process.h"

namespace icome::benchmarks {
namespace {

/// Runs a program in a folder to its end, `quietly` without what it prints. False: it is not there, or
/// failed.
bool run_there(const std::filesystem::path& folder, std::vector<std::string> arguments, bool quietly) {
  std::fflush(stdout);
  const pid_t process = ::fork();
  if (process == 0) {
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    const int nowhere = quietly ? ::open("/dev/null", O_WRONLY | O_CLOEXEC) : -1;
    if (nowhere >= 0) {
      ::dup2(nowhere, STDOUT_FILENO);
      ::dup2(nowhere, STDERR_FILENO);
    }
    if (::chdir(folder.c_str()) == 0) ::execvp(pointers.front(), pointers.data());
    ::_exit(127);
  }
  int status = 0;
  return ::waitpid(process, &status, 0) == process && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

void print_peers(const std::filesystem::path& source, const std::filesystem::path& folder,
                 const CrowdExtent& extent) {
  const BenchFolder place(folder);
  const std::filesystem::path copy = place.path() / "peers";
  std::filesystem::copy(source, copy, std::filesystem::copy_options::recursive);
  fmt::print("\nPeers, measured in the same way:\n\n");
  if (!run_there(copy, {"npm", "ci", "--no-audit", "--no-fund"}, true)) {
    fmt::print("They were not measured, as npm is not here or cannot fetch them.\n");
    return;
  }
  if (!run_there(
          copy,
          {"node", "peers.mjs", "--clients", fmt::format("{}", fmt::join(extent.clients, ",")), "--seconds",
           fmt::format("{:g}", extent.seconds), "--rate", fmt::format("{:g}", extent.updates_a_second)},
          false))
    fmt::print("Some of them failed.\n");
}

}  // namespace icome::benchmarks
