#pragma once
#include <atomic>
#include <memory>
#include <utility>

#include "files/design.h"
#include "io/open_file.h"
#include "session/storage/recovery.h"

namespace icome::session {

/// Recoverable work that one program has for itself until this goes, to read it, and then to keep it anew or
/// discard it. Until discarded it stays on disk as it is, against a second crash.
class ClaimedWork {
 public:
  /// Fails when another program has claimed it, or it is gone.
  static base::Result<std::shared_ptr<ClaimedWork>> claim(const RecoverableWork& work);

  const RecoverableWork& work() const { return work_; }
  /// The world that all whole edits make. Remarks tell of losses, if there are any. Takes its
  /// time; any one thread. Fails, leaving all as it is, for journals that cannot be read.
  base::Result<files::LoadedDesign> read(const files::DesignReadOptions& options);
  /// Deletes the work, which is safe elsewhere, or not wanted. A damaged journal (but not one whose last edit
  /// was cut off as the program stopped) stays, as "....damaged". Any one thread, after reading.
  void discard();

 private:
  ClaimedWork(RecoverableWork work, io::OpenFile file) : work_(std::move(work)), file_(std::move(file)) {}

  RecoverableWork work_;
  io::OpenFile file_;  // locked
  std::atomic<bool> has_more_ = false;
};

}  // namespace icome::session
