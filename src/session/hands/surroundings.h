#pragma once
#include <atomic>
#include <memory>
#include <unordered_set>

#include "interaction/snapping/snapped_move.h"
#include "session/background_task.h"
#include "world/edit/changes.h"

namespace icome::session {

/// The surroundings of moved things: the index of shapes that stop them, and the finder of places that they
/// snap to. Made when first asked for, and brought up to date when asked for again, so that edits take no
/// time for it while nothing is moved. Main's, but for while it is lent to a thread. The world outlives it.
class Surroundings {
 public:
  explicit Surroundings(const world::World& world) : world_(world) {}
  /// Gives up the work under way, and waits for its thread.
  ~Surroundings();
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;

  /// Takes in changes of the world; null: it is another one.
  void follow(const world::Changes* changes);

  // Index and finder for the world as it is now; both at the same edit. Not while they are lent.
  world::CollisionIndex& index();
  interaction::SnapFinder& finder();

  /// A way that is worked out on a thread of its own.
  class Work {
   public:
    bool is_done() const { return task_->is_done(); }
    /// Takes the result, once, when it is done.
    base::Result<interaction::StoppedDrag::Found> take() { return task_->take(); }
    /// Has the world changed since the work was asked for?
    bool is_stale() const { return is_stale_; }
    /// Gives the work up, as it is not wanted any more.
    void give_up() { given_up_.store(true, std::memory_order_relaxed); }

   private:
    friend class Surroundings;
    std::atomic<bool> given_up_ = false;
    bool is_stale_ = false;  // main's
    std::unique_ptr<BackgroundTask<interaction::StoppedDrag::Found>> task_;
  };
  /// Does a thread have index and finder? Then nothing can be asked of them.
  bool are_lent() const { return work_ && !work_->is_done(); }
  /// Lends them to a thread that works out how far a drag comes, with no more than that effort.
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
  std::shared_ptr<Around> around_;  // null: not asked for yet. Also a thread's that it is lent to
  // The changes since.
  std::unordered_set<world::ObjectId> objects_;
  std::unordered_set<world::GeometryId> geometries_;
  std::shared_ptr<Work> work_;  // the last; may be null
};

}  // namespace icome::session
