#include "realtime/guard/guard.h"

#include <cassert>

// The sanitizers replace the same functions; two replacements in one program do not get along.
#if defined(ICOME_ADDRESS_SANITIZER) || defined(ICOME_THREAD_SANITIZER)
#define ICOME_GUARD_AVAILABLE 0
#endif
#ifndef ICOME_GUARD_AVAILABLE
#define ICOME_GUARD_AVAILABLE 1
#endif

namespace icome::realtime {
namespace {

// Counted all the time: an increment costs less than asking whether a guard is alive. Plain data with
// constant initial values, so that reaching it never allocates, however early the first malloc comes.
constinit thread_local std::uint64_t allocations_of_thread = 0;
constinit thread_local std::uint64_t frees_of_thread = 0;
constinit thread_local std::uint64_t locks_of_thread = 0;

}  // namespace

bool RealtimeGuard::available() { return ICOME_GUARD_AVAILABLE != 0; }

RealtimeGuard::RealtimeGuard() : thread_(std::this_thread::get_id()), before_(counts_of_thread()) {}

void RealtimeGuard::stop() {
  stopped_ = counts();
  running_ = false;
}

RealtimeGuard::Counts RealtimeGuard::counts_of_thread() {
  return {allocations_of_thread, frees_of_thread, locks_of_thread};
}

RealtimeGuard::Counts RealtimeGuard::counts() const {
  if (!running_) return stopped_;
  assert(thread_ == std::this_thread::get_id());
  const Counts now = counts_of_thread();
  return {now.allocations - before_.allocations, now.frees - before_.frees, now.locks - before_.locks};
}

}  // namespace icome::realtime

#if ICOME_GUARD_AVAILABLE

#include <dlfcn.h>
#include <malloc.h>
#include <pthread.h>
#include <semaphore.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>

// glibc's own entry points, for programs that replace malloc.
// NOLINTBEGIN(readability-identifier-naming)
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* memory);
}
// NOLINTEND(readability-identifier-naming)

namespace {

using icome::realtime::allocations_of_thread;
using icome::realtime::frees_of_thread;
using icome::realtime::locks_of_thread;

// Counts a call of the lock function `kHiding` of this file, then calls the function of that name that it
// hides. That function is looked up at the first call, which may come from a static initialiser of another
// file; several threads may do so at once and find the same.
template <auto* kHiding, typename... Arguments>
int counted(const char* name, Arguments... arguments) {
  using Function = int(Arguments...);
  static constinit std::atomic<Function*> hidden = nullptr;
  ++locks_of_thread;
  Function* function = hidden.load(std::memory_order_relaxed);
  if (function == nullptr) {
    // Looking up may allocate, which is not the caller's doing.
    const std::uint64_t allocations = allocations_of_thread;
    const std::uint64_t frees = frees_of_thread;
    function = reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
    allocations_of_thread = allocations;
    frees_of_thread = frees;
    hidden.store(function, std::memory_order_relaxed);
  }
  return function(arguments...);
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) noexcept {
  ++allocations_of_thread;
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) noexcept {
  ++allocations_of_thread;
  return __libc_calloc(count, size);
}

void* realloc(void* memory, std::size_t size) noexcept {
  ++allocations_of_thread;
  if (memory != nullptr) ++frees_of_thread;
  return __libc_realloc(memory, size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  ++allocations_of_thread;
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  ++allocations_of_thread;
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  ++allocations_of_thread;
  *memory = __libc_memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}

void free(void* memory) noexcept {
  if (memory != nullptr) ++frees_of_thread;
  __libc_free(memory);
}

int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  return counted<pthread_mutex_lock>("pthread_mutex_lock", mutex);
}
int pthread_mutex_trylock(pthread_mutex_t* mutex) noexcept {
  return counted<pthread_mutex_trylock>("pthread_mutex_trylock", mutex);
}
int pthread_mutex_timedlock(pthread_mutex_t* mutex, const timespec* until) noexcept {
  return counted<pthread_mutex_timedlock>("pthread_mutex_timedlock", mutex, until);
}
int pthread_mutex_clocklock(pthread_mutex_t* mutex, clockid_t clock, const timespec* until) noexcept {
  return counted<pthread_mutex_clocklock>("pthread_mutex_clocklock", mutex, clock, until);
}

int pthread_rwlock_rdlock(pthread_rwlock_t* lock) noexcept {
  return counted<pthread_rwlock_rdlock>("pthread_rwlock_rdlock", lock);
}
int pthread_rwlock_tryrdlock(pthread_rwlock_t* lock) noexcept {
  return counted<pthread_rwlock_tryrdlock>("pthread_rwlock_tryrdlock", lock);
}
int pthread_rwlock_timedrdlock(pthread_rwlock_t* lock, const timespec* until) noexcept {
  return counted<pthread_rwlock_timedrdlock>("pthread_rwlock_timedrdlock", lock, until);
}
int pthread_rwlock_clockrdlock(pthread_rwlock_t* lock, clockid_t clock, const timespec* until) noexcept {
  return counted<pthread_rwlock_clockrdlock>("pthread_rwlock_clockrdlock", lock, clock, until);
}
int pthread_rwlock_wrlock(pthread_rwlock_t* lock) noexcept {
  return counted<pthread_rwlock_wrlock>("pthread_rwlock_wrlock", lock);
}
int pthread_rwlock_trywrlock(pthread_rwlock_t* lock) noexcept {
  return counted<pthread_rwlock_trywrlock>("pthread_rwlock_trywrlock", lock);
}
int pthread_rwlock_timedwrlock(pthread_rwlock_t* lock, const timespec* until) noexcept {
  return counted<pthread_rwlock_timedwrlock>("pthread_rwlock_timedwrlock", lock, until);
}
int pthread_rwlock_clockwrlock(pthread_rwlock_t* lock, clockid_t clock, const timespec* until) noexcept {
  return counted<pthread_rwlock_clockwrlock>("pthread_rwlock_clockwrlock", lock, clock, until);
}

int pthread_spin_lock(pthread_spinlock_t* lock) noexcept {
  return counted<pthread_spin_lock>("pthread_spin_lock", lock);
}
int pthread_spin_trylock(pthread_spinlock_t* lock) noexcept {
  return counted<pthread_spin_trylock>("pthread_spin_trylock", lock);
}

// Waiting ends a cancelled thread by unwinding, so functions that wait must not be noexcept.
int pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex) {
  return counted<pthread_cond_wait>("pthread_cond_wait", condition, mutex);
}
int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex, const timespec* until) {
  return counted<pthread_cond_timedwait>("pthread_cond_timedwait", condition, mutex, until);
}
int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock,
                           const timespec* until) {
  return counted<pthread_cond_clockwait>("pthread_cond_clockwait", condition, mutex, clock, until);
}
int sem_wait(sem_t* semaphore) { return counted<sem_wait>("sem_wait", semaphore); }
int sem_timedwait(sem_t* semaphore, const timespec* until) {
  return counted<sem_timedwait>("sem_timedwait", semaphore, until);
}
int sem_clockwait(sem_t* semaphore, clockid_t clock, const timespec* until) {
  return counted<sem_clockwait>("sem_clockwait", semaphore, clock, until);
}
int sem_trywait(sem_t* semaphore) noexcept { return counted<sem_trywait>("sem_trywait", semaphore); }

}  // extern "C"

#endif
