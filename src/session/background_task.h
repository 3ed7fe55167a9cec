#pragma once
#include <atomic>
#include <exception>
#include <functional>
#include <new>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "base/result.h"

namespace icome::session {

/// One piece of work on a thread of its own, which is asked now and then whether it is done. Owns the
/// thread.
template <typename T>
class BackgroundTask {
 public:
  explicit BackgroundTask(std::function<base::Result<T>()> work) : work_(std::move(work)) {
    try {
      thread_ = std::thread([this] { run(); });
    } catch (const std::system_error& error) {
      end(base::fail(std::string("No thread could be started for it: ") + error.what() + "."));
    }
  }
  /// Waits for the work.
  ~BackgroundTask() {
    if (thread_.joinable()) thread_.join();
  }
  BackgroundTask(const BackgroundTask&) = delete;
  BackgroundTask& operator=(const BackgroundTask&) = delete;

  /// Is the work done? take() does not wait then.
  bool is_done() const { return done_.load(std::memory_order_acquire); }
  void wait() const { done_.wait(false, std::memory_order_acquire); }
  /// Waits for the work and gives its result. Once.
  base::Result<T> take() {
    if (thread_.joinable()) thread_.join();
    return std::move(*result_);
  }

 private:
  void run() {
    try {
      end(work_());
    } catch (const std::bad_alloc&) {
      end(base::fail("There is not enough memory for it: close other programs and try again."));
    } catch (const std::exception& error) {
      end(base::fail(std::string("It failed: ") + error.what() + "."));
    }
  }
  void end(base::Result<T> result) {
    result_ = std::move(result);
    done_.store(true, std::memory_order_release);
    done_.notify_all();
  }

  std::function<base::Result<T>()> work_;
  std::optional<base::Result<T>> result_;  // the thread's until it is done
  std::atomic<bool> done_ = false;
  std::thread thread_;
};

}  // namespace icome::session
