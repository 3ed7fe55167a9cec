#pragma once
#include <atomic>
#include <memory>
#include <utility>
#include <vector>

#include "interaction/techniques/world_targets.h"
#include "session/background_task.h"

namespace icome::session {

/// Makes shapes into targets for techniques, on a thread of its own. Main's.
class TargetMaker {
 public:
  using Made = std::pair<world::GeometryPointer, std::shared_ptr<const interaction::TargetShape>>;

  TargetMaker() = default;
  /// Waits for the shape under way.
  ~TargetMaker() { given_up_.store(true, std::memory_order_relaxed); }
  TargetMaker(const TargetMaker&) = delete;
  TargetMaker& operator=(const TargetMaker&) = delete;

  bool is_at_work() const { return task_ && !task_->is_done(); }
  /// Begins to make these; not while it is at work.
  void make(std::vector<world::GeometryPointer> shapes);
  /// Gives all that was made since the last call; a shape that could not be made is null there. Not while
  /// it is at work.
  std::vector<Made> take();

 private:
  std::atomic<bool> given_up_ = false;
  std::vector<world::GeometryPointer> asked_;
  std::unique_ptr<BackgroundTask<std::vector<Made>>> task_;  // ends before the others
};

}  // namespace icome::session
