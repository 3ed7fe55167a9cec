#include "collab/server/log_thread.h"

#include <utility>

namespace icome::collab {

LogThread::LogThread(std::unique_ptr<OpLog> log, Done done)
    : log_(std::move(log)), done_(std::move(done)), thread_([this] { run(); }) {}

LogThread::~LogThread() {
  {
    const std::lock_guard lock(mutex_);
    stops_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void LogThread::start(StorageWork work) {
  {
    const std::lock_guard lock(mutex_);
    work_ = std::move(work);
  }
  wake_.notify_one();
}

void LogThread::run() {
  while (true) {
    StorageWork work;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return work_ || stops_; });
      if (!work_) return;
      work = std::exchange(work_, nullptr);
    }
    done_(work(*log_));
  }
}

}  // namespace icome::collab
