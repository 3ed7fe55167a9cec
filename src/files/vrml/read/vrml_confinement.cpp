#include "files/vrml/read/vrml_confinement.h"

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <new>
#include <vector>

namespace icome::files {
namespace {

/// Coin reads nested nodes by recursion. Linux leaves at least 128 MiB of addresses below the stack.
constexpr rlim_t kStackBytes = 120ULL << 20U;
/// Largest distance of a fault from the end of the stack that still means a used-up stack.
constexpr std::size_t kStackMargin = 1U << 20U;
/// If so much cannot be mapped, a fault is one of too little memory.
constexpr std::size_t kLittleMemory = 32U << 20U;

[[maybe_unused]] std::uintptr_t stack_end = 0;  // unused in builds with a sanitizer
[[maybe_unused]] char signal_stack[1U << 16U];

void limit(__rlimit_resource resource, rlim_t most) {
  rlimit now{};
  ::getrlimit(resource, &now);
  const rlim_t value = std::min(most, now.rlim_max);
  now = {value, value};
  ::setrlimit(resource, &now);
}

/// Address space of programs and libraries, which no file has asked for, bytes.
[[maybe_unused]] std::uint64_t mapped_bytes() {
  constexpr std::uint64_t kAboutAsMuch = 256ULL << 20U;
  unsigned long pages = 0;
  std::FILE* const file = std::fopen("/proc/self/statm", "r");
  const bool known = file != nullptr && std::fscanf(file, "%lu", &pages) == 1;
  if (file != nullptr) std::fclose(file);
  return known ? pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) : kAboutAsMuch;
}

/// The reader raises this limit when it sends further files; nobody here can.
[[maybe_unused]] void limit_memory(std::uint64_t bytes) {
  rlimit now{};
  ::getrlimit(RLIMIT_AS, &now);
  now.rlim_cur = std::min<rlim_t>(mapped_bytes() + bytes, now.rlim_max);
  ::setrlimit(RLIMIT_AS, &now);
}

[[noreturn]] void out_of_memory() { ::_exit(kVrmlOutOfMemory); }

#ifndef ICOME_ADDRESS_SANITIZER
void on_fault(int number, siginfo_t* info, void*) {
  const auto address = reinterpret_cast<std::uintptr_t>(info->si_addr);
  if (number == SIGSEGV && address >= stack_end - kStackMargin && address < stack_end + kStackMargin)
    ::_exit(kVrmlTooDeep);
  // Parts of Coin do not check whether they got the memory that they asked for.
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

#if defined(__x86_64__)
constexpr std::uint32_t kProcessor = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kProcessor = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kProcessor = 0;  // system calls have other numbers there
#endif

/// System calls that parsing needs, and harmless ones of its libraries.
constexpr long kHarmlessCalls[] = {
    SYS_read,          SYS_write,          SYS_close,        SYS_lseek,
    SYS_fstat,         SYS_munmap,         SYS_mremap,       SYS_madvise,
    SYS_brk,           SYS_futex,          SYS_exit,         SYS_exit_group,
    SYS_rt_sigaction,  SYS_rt_sigprocmask, SYS_rt_sigreturn, SYS_sigaltstack,
    SYS_getpid,        SYS_getppid,        SYS_gettid,       SYS_getuid,
    SYS_clock_gettime, SYS_gettimeofday,   SYS_nanosleep,    SYS_clock_nanosleep,
    SYS_sched_yield,   SYS_getrandom,      SYS_sysinfo,      SYS_uname};

/// The program of the kernel's filter: compares one call after the other.
class CallFilter {
 public:
  CallFilter() {
    load(offsetof(seccomp_data, arch));
    skip_unless_equal(kProcessor, 1);
    skip(1);
    refuse();
    load(offsetof(seccomp_data, nr));
    for (const long call : kHarmlessCalls) {
      skip_unless_equal(std::uint32_t(call), 1);
      allow();
    }
    // New code cannot be made.
    for (const long call : {SYS_mmap, SYS_mprotect}) allow_if(call, 2, BPF_JSET, PROT_EXEC, false);
    // A fault may end this process, and no other.
    allow_if(SYS_tgkill, 0, BPF_JEQ, std::uint32_t(::getpid()), true);
    // Limits may be read.
    allow_if(SYS_prlimit64, 2, BPF_JEQ, 0, true);
    refuse();
  }

  void install() {
    const sock_fprog program{static_cast<unsigned short>(code_.size()), code_.data()};
    ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
  }

 private:
  void load(std::size_t offset) {
    code_.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, std::uint32_t(offset)));
  }
  void skip_unless_equal(std::uint32_t value, std::uint8_t count) {
    code_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 0, count));
  }
  void skip(std::uint32_t count) { code_.push_back(BPF_STMT(BPF_JMP | BPF_JA, count)); }
  void allow() { code_.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)); }
  void refuse() { code_.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM)); }

  /// Allows a call by one of its arguments, of which only the low half is tested.
  void allow_if(long call, int argument, std::uint16_t test, std::uint32_t value, bool wanted) {
    skip_unless_equal(std::uint32_t(call), 4);
    load(offsetof(seccomp_data, args) + std::size_t(argument) * sizeof(std::uint64_t));
    code_.push_back(BPF_JUMP(std::uint16_t(BPF_JMP | BPF_K | test), value, std::uint8_t(wanted ? 0 : 1),
                             std::uint8_t(wanted ? 1 : 0)));
    allow();
    refuse();
  }

  std::vector<sock_filter> code_;
};

}  // namespace

void confine(const VrmlLimits& limits) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != static_cast<pid_t>(limits.parent)) ::_exit(kVrmlBadFrame);
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  std::set_new_handler(out_of_memory);
  limit(RLIMIT_STACK, kStackBytes);
#ifndef ICOME_ADDRESS_SANITIZER
  // The address sanitizer takes terabytes of addresses, and reports faults itself.
  limit_memory(limits.memory);
  stack_end = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0)) - kStackBytes;
  tell_faults_apart();
#endif
  // The reader's own clock comes first, unless the reader hangs.
  limit(RLIMIT_CPU, static_cast<rlim_t>(std::clamp(std::ceil(limits.seconds), 0.0, 1e9)) + 1);
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_NPROC, 0);
  limit(RLIMIT_NOFILE, STDERR_FILENO + 1);
  if (kProcessor != 0) CallFilter().install();
}

}  // namespace icome::files
