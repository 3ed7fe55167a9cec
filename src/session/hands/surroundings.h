#pragma once
#include <atomic>
#include <memory>
#include <unordered_set>

#include "interaction/snapping/snapped_move.h"
#include "session/background_task.h"
#include "world/edit/changes.h"

namespace icome::session {

/// What is around things that are moved: what they stop at, and what they snap to. Made when it is first
/// asked for, and brought up to date when it is asked for again, so that edits take no time for it while
/// nothing is moved. Main's, but for while it is lent to a thread. The world outlives it.
class Surroundings {
 public:
  explicit Surroundings(const world::World& world) : world_(world) {}
  /// Gives up what is being worked out, and waits for its thread.
  ~Surroundings();
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;

  /// The world has changed by these, or, when null, to another one.
  void follow(const world::Changes* changes);

  // As the world is now; both at the same edit. Not while they are lent.
  world::CollisionIndex& index();
  interaction::SnapFinder& finder();

  /// A way that is worked out on a thread of its own.
  class Work {
   public:
    bool is_done() const { return task_->is_done(); }
    /// Once, when it is done.
    base::Result<interaction::StoppedDrag::Found> take() { return task_->take(); }
    /// The world is not any more as it was when it was asked.
    bool is_stale() const { return is_stale_; }
    /// Nobody wants it any more.
    void give_up() { given_up_.store(true, std::memory_order_relaxed); }

   private:
    friend class Surroundings;
    std::atomic<bool> given_up_ = false;
    bool is_stale_ = false;  // main's
    std::unique_ptr<BackgroundTask<interaction::StoppedDrag::Found>> task_;
  };
  /// Does a thread have them? Then nothing can be asked.
  bool are_lent() const { return work_ && !work_->is_done(); }
  /// Lends them to a thread that works out how far a drag comes, with no more than so much effort.
  std::shared_ptr<Work> work_out(const interaction::StoppedDrag& drag, const base::Vector3& wanted,
                                 const interaction::DragRules& rules, std::uint64_t effort);

 private:
  struct Around {
    explicit Around(const world::World& world) : index(world) {}
    world::CollisionIndex index;
    interaction::SnapFinder finder = interaction::SnapFinder();
  };
  Around& around();

  const world::World& world_;
  std::shared_ptr<Around> around_;  // null: nobody has asked yet. Also a thread's that it is lent to
  // What has changed since.
  std::unordered_set<world::ObjectId> objects_;
  std::unordered_set<world::GeometryId> geometries_;
  std::shared_ptr<Work> work_;  // the last; may be null
};

}  // namespace icome::session
