#include "files/vrml/read/vrml_confinement.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <functional>
#include <string>

#include "files/sample_files.h"

namespace icome::files {
namespace {

/// What a confined process comes to that tries something: 0: it could not.
int attempt(const std::function<bool()>& could) {
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) {
    confine({.memory = 64U << 20U, .seconds = 10.0, .parent = parent});
    ::_exit(could() ? 1 : 0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

#if defined(ICOME_THREAD_SANITIZER)
TEST(VrmlConfinement, DISABLED_ForksWithThreads) {}
#else

TEST(VrmlConfinement, StartsAndEndsNoProcesses) {
  EXPECT_EQ(attempt([] { return ::fork() >= 0; }), 0);
  EXPECT_EQ(attempt([] { return ::vfork() >= 0; }), 0);
  EXPECT_EQ(attempt([] {
              char name[] = "/bin/true";
              char* arguments[] = {name, nullptr};
              ::execv(name, arguments);  // would end as attempts that fail do
              return errno != EPERM;
            }),
            0);
  EXPECT_EQ(attempt([] { return ::kill(::getppid(), 0) == 0; }), 0);
  EXPECT_EQ(attempt([] { return ::kill(-1, SIGCONT) == 0; }), 0);
  EXPECT_EQ(attempt([] { return ::ptrace(PTRACE_ATTACH, ::getppid(), nullptr, nullptr) == 0; }), 0);
}

TEST(VrmlConfinement, ReachesNoFilesAndNoNetwork) {
  const ScratchFolder folder;
  const std::string file = folder.write("file", "text").string(), other = (folder.path() / "other").string();
  EXPECT_EQ(attempt([&] { return ::unlink(file.c_str()) == 0; }), 0);
  EXPECT_EQ(attempt([&] { return ::rename(file.c_str(), other.c_str()) == 0; }), 0);
  EXPECT_EQ(attempt([&] { return ::symlink(file.c_str(), other.c_str()) == 0; }), 0);
  EXPECT_EQ(attempt([&] { return ::mkdir(other.c_str(), 0700) == 0; }), 0);
  EXPECT_EQ(attempt([&] { return ::chmod(file.c_str(), 0) == 0; }), 0);
  EXPECT_EQ(attempt([&] { return ::truncate(file.c_str(), 0) == 0; }), 0);
  EXPECT_EQ(attempt([&] { return ::open(file.c_str(), O_RDONLY) >= 0; }), 0);
  EXPECT_EQ(attempt([&] {
              ::close(STDIN_FILENO);  // so that a number is free
              return ::open(file.c_str(), O_RDONLY) >= 0;
            }),
            0);
  EXPECT_EQ(attempt([&] { return ::chdir("/") == 0; }), 0);
  EXPECT_EQ(attempt([&] {
              ::close(STDIN_FILENO);
              return ::socket(AF_INET, SOCK_STREAM, 0) >= 0;
            }),
            0);
  EXPECT_TRUE(std::filesystem::exists(file));
}

TEST(VrmlConfinement, RaisesNoLimitAndMakesNoCode) {
  EXPECT_EQ(attempt([] {
              const rlimit all{RLIM_INFINITY, RLIM_INFINITY};
              return ::setrlimit(RLIMIT_AS, &all) == 0;
            }),
            0);
  EXPECT_EQ(attempt([] {
              return ::mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) !=
                     MAP_FAILED;
            }),
            0);
#ifndef ICOME_ADDRESS_SANITIZER
  EXPECT_EQ(attempt([] {
              return ::mmap(nullptr, 65U << 20U, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) != MAP_FAILED;
            }),
            0);
#endif
}

TEST(VrmlConfinement, LeavesWhatParsingNeeds) {
  EXPECT_EQ(WEXITSTATUS(attempt([] {
              std::string much(16U << 20U, 'x');
              much.resize(much.size() + 1);
              rlimit limit{};
              return ::getrlimit(RLIMIT_AS, &limit) == 0 && ::write(STDOUT_FILENO, "", 0) == 0;
            })),
            1);
#ifndef ICOME_ADDRESS_SANITIZER
  // The address sanitizer has a handler of its own for faults.
  const int crashed = attempt([] {
    ::raise(SIGFPE);
    return false;
  });
  EXPECT_TRUE(WIFSIGNALED(crashed) && WTERMSIG(crashed) == SIGFPE) << "a fault is told as what it is";
#endif
}
#endif

}  // namespace
}  // namespace icome::files
