#pragma once
#include <time.h>

#include <QApplication>
#include <QEvent>
#include <QThread>
#include <string>
#include <vector>

namespace icome::ui {

/// An application that times what its thread, main's, does for each event: by the thread's own processor
/// time, so that neither waiting nor other work on the machine counts.
class TimedApplication final : public QApplication {
 public:
  using QApplication::QApplication;

  struct LongCall {
    double seconds;  // of the thread's processor time
    std::string what;
  };
  /// From now on calls that take longer than so many seconds are kept; the ones before are forgotten.
  void watch(double longer_than) {
    longer_than_ = longer_than;
    calls_ = 0;
    long_calls_.clear();
  }
  std::size_t calls() const { return calls_; }
  const std::vector<LongCall>& long_calls() const { return long_calls_; }

  /// Of the processor that the thread which asks has used.
  static double thread_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
  }

  bool notify(QObject* of, QEvent* event) override {
    // Objects of other threads hear of their events there.
    if (QThread::currentThread() != thread() || within_) return QApplication::notify(of, event);
    within_ = true;
    // Who it was for may be gone when it is over.
    const QEvent::Type type = event->type();
    const std::string name =
        of->objectName().isEmpty() ? of->metaObject()->className() : of->objectName().toStdString();
    const double before = thread_seconds();
    const bool result = QApplication::notify(of, event);
    const double took = thread_seconds() - before;
    within_ = false;
    ++calls_;
    if (took > longer_than_) long_calls_.push_back({took, "event " + std::to_string(type) + " of " + name});
    return result;
  }

 private:
  bool within_ = false;
  double longer_than_ = 1e9;
  std::size_t calls_ = 0;
  std::vector<LongCall> long_calls_;
};

}  // namespace icome::ui
