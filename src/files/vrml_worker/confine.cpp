#include "files/vrml_worker/confine.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>

namespace icome::files {
namespace {

/// Coin reads nodes in nodes by recursion. Linux leaves at least 128 MiB of addresses below the stack.
constexpr rlim_t kStackBytes = 120ULL << 20U;
/// How far from the end of the stack a fault still means that the stack was used up.
constexpr std::size_t kStackMargin = 1U << 20U;
/// Where so much is not to be had, a fault is one of too little memory.
constexpr std::size_t kLittleMemory = 32U << 20U;

[[maybe_unused]] std::uintptr_t stack_end = 0;  // not by builds with a sanitizer
[[maybe_unused]] char signal_stack[1U << 16U];

void limit(__rlimit_resource resource, rlim_t most) {
  rlimit now{};
  ::getrlimit(resource, &now);
  const rlim_t value = std::min(most, now.rlim_max);
  now = {value, value};
  ::setrlimit(resource, &now);
}

[[noreturn]] void out_of_memory() { ::_exit(kVrmlOutOfMemory); }

#ifndef __SANITIZE_ADDRESS__
void on_fault(int number, siginfo_t* info, void*) {
  const auto address = reinterpret_cast<std::uintptr_t>(info->si_addr);
  if (number == SIGSEGV && address >= stack_end - kStackMargin && address < stack_end + kStackMargin)
    ::_exit(kVrmlTooDeep);
  // Parts of Coin do not ask whether they got the memory that they wanted.
  if (::mmap(nullptr, kLittleMemory, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED)
    out_of_memory();
  ::signal(number, SIG_DFL);
  ::raise(number);
}

void tell_faults_apart() {
  const stack_t other{signal_stack, 0, sizeof signal_stack};
  ::sigaltstack(&other, nullptr);
  struct sigaction action {};
  action.sa_sigaction = on_fault;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER;
  for (const int number : {SIGSEGV, SIGBUS, SIGABRT}) ::sigaction(number, &action, nullptr);
}
#endif

}  // namespace

void confine(const VrmlLimits& limits) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != static_cast<pid_t>(limits.parent)) ::_exit(kVrmlBadFrame);
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  std::set_new_handler(out_of_memory);
  limit(RLIMIT_STACK, kStackBytes);
#ifndef __SANITIZE_ADDRESS__
  // The address sanitizer takes terabytes of addresses, and tells of faults itself.
  limit(RLIMIT_AS, limits.memory);
  stack_end = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0)) - kStackBytes;
  tell_faults_apart();
#endif
  // The reader's own clock comes first, unless the reader hangs.
  limit(RLIMIT_CPU, static_cast<rlim_t>(std::clamp(std::ceil(limits.seconds), 0.0, 1e9)) + 1);
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_NOFILE, STDERR_FILENO + 1);
}

}  // namespace icome::files
