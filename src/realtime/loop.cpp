#include "realtime/loop.h"

#include <pthread.h>
#include <sys/prctl.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <system_error>
#include <utility>

#include "base/clock.h"
#include "realtime/locked_memory.h"
#include "realtime/this_thread.h"

namespace icome::realtime {
namespace {

constexpr double kLowestRate = 500.0;     // Hz
constexpr double kHighestRate = 10000.0;  // Hz
constexpr std::size_t kLongestThreadName = 15;

std::string notice_for(const LoopSettings& settings, const LoopReport& report) {
  std::string notice;
  if (settings.realtime_priority && !report.realtime_priority) {
    notice =
        "Real-time priority was not permitted, so other programs may delay a tick: give your user \"rtprio " +
        std::to_string(settings.priority) + "\" in /etc/security/limits.conf and log in again.";
  }
  if (settings.lock_memory && !report.memory_locked) {
    if (!notice.empty()) notice += ' ';
    notice +=
        "Memory could not be locked, so paging may delay a tick: give your user \"memlock unlimited\" "
        "in /etc/security/limits.conf and log in again.";
  }
  return notice;
}

base::Result<void> check(const LoopSettings& settings) {
  // Written so that a rate that is not a number fails too.
  if (!(settings.rate_hz >= kLowestRate && settings.rate_hz <= kHighestRate)) {
    return base::fail("A loop cannot run at " + std::to_string(settings.rate_hz) +
                      " Hz: choose a rate from 500 to 10000 Hz.");
  }
  if (settings.priority < 1 || settings.priority > 99) {
    return base::fail("There is no real-time priority " + std::to_string(settings.priority) +
                      ": choose one from 1 to 99.");
  }
  return {};
}

}  // namespace

Timetable::Timetable(std::int64_t origin, double rate_hz) : origin_(origin), period_(1e9 / rate_hz) {
  assert(rate_hz > 0.0);
}

std::int64_t Timetable::deadline(std::uint64_t index) const {
  // Multiplied, not summed: rounding to whole nanoseconds never adds up.
  return origin_ + std::llround(static_cast<double>(index) * period_);
}

std::uint64_t Timetable::next(std::uint64_t index, std::int64_t now) const {
  if (deadline(index + 1) > now) return index + 1;
  const double periods = static_cast<double>(now - origin_) / period_;
  std::uint64_t candidate = std::max(index + 1, static_cast<std::uint64_t>(periods));
  while (deadline(candidate) <= now) ++candidate;  // twice at most
  return candidate;
}

LoopRunner::LoopRunner(const LoopSettings& settings, Tick tick)
    : settings_(settings), tick_(std::move(tick)), recorder_(1.0 / settings.rate_hz) {}

base::Result<std::unique_ptr<LoopRunner>> LoopRunner::create(const LoopSettings& settings, Tick tick) {
  assert(tick);
  if (auto checked = check(settings); !checked) return tl::unexpected(checked.error());
  std::unique_ptr<LoopRunner> runner(new LoopRunner(settings, std::move(tick)));
  if (auto started = runner->start(); !started) return tl::unexpected(started.error());
  return runner;
}

LoopRunner::~LoopRunner() { stop(); }

void LoopRunner::stop() {
  stop_asked_.store(true, std::memory_order_relaxed);
  wait();
}

void LoopRunner::wait() {
  assert(thread_.get_id() != std::this_thread::get_id());
  if (thread_.joinable()) thread_.join();
}

base::Result<void> LoopRunner::start() {
  try {
    thread_ = std::thread([this] { run(); });
  } catch (const std::system_error& error) {
    return base::fail(std::string("The system gave no thread for the loop (") + error.what() +
                      "): close other programs and try again.");
  }
  prepared_.wait(false, std::memory_order_acquire);
  return {};
}

void LoopRunner::prepare_thread() {
  pthread_setname_np(pthread_self(), settings_.name.substr(0, kLongestThreadName).c_str());
  // Without SCHED_FIFO the kernel may wake a sleeper 50 us late to save power; ask for 1 ns.
  prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  if (settings_.realtime_priority) report_.realtime_priority = ask_for_realtime_priority(settings_.priority);
  if (settings_.lock_memory) report_.memory_locked = lock_memory();
  report_.notice = notice_for(settings_, report_);
}

void LoopRunner::run() {
  prepare_thread();
  prepared_.store(true, std::memory_order_release);
  prepared_.notify_one();
  run_ticks();
  running_.store(false, std::memory_order_release);
}

void LoopRunner::run_ticks() {
  const double period = 1.0 / settings_.rate_hz;
  const Timetable timetable(base::steady_nanoseconds() + std::llround(period * 1e9), settings_.rate_hz);
  std::uint64_t index = 0;
  std::uint64_t skipped = 0;
  for (;;) {
    TickTimes times{.scheduled = timetable.deadline(index), .skipped = skipped};
    sleep_until(times.scheduled);
    if (stop_asked_.load(std::memory_order_relaxed)) return;
    times.started = base::steady_nanoseconds();
    const bool more = tick_({index, times.scheduled, static_cast<double>(skipped + 1) * period});
    times.finished = base::steady_nanoseconds();
    recorder_.record(times);
    if (!more) return;
    const std::uint64_t next = timetable.next(index, times.finished);
    skipped = next - index - 1;
    index = next;
  }
}

}  // namespace icome::realtime
