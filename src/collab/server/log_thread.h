#pragma once
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "collab/server/hub.h"
#include "collab/storage/op_log.h"

namespace icome::collab {

/// The thread that works with a log, which may wait for a disk: one piece of work at a time. Owns both.
class LogThread {
 public:
  /// What work returned goes to `done`, on the log's thread.
  using Done = std::function<void(std::function<void()> then)>;

  LogThread(std::unique_ptr<OpLog> log, Done done);
  /// Waits for the work under way.
  ~LogThread();
  LogThread(const LogThread&) = delete;
  LogThread& operator=(const LogThread&) = delete;

  /// Precondition: the work before is done.
  void start(StorageWork work);

 private:
  void run();

  std::unique_ptr<OpLog> log_;
  Done done_;
  std::mutex mutex_;
  std::condition_variable wake_;
  StorageWork work_;
  bool stops_ = false;
  std::thread thread_;
};

}  // namespace icome::collab
