#pragma once
#include <span>
#include <string_view>

#include "interaction/operations/operation.h"
#include "world/edit/history.h"

namespace icome::interaction {

/// The outcome of a performed operation.
struct Performed {
  const Operation* operation;
  std::vector<world::ObjectId> objects;  // made or changed, and still there
  std::string note = {};                 // a remark for people
};

/// A world that operations are performed on, one action each: one's own, or one that is shared with others.
class OperationTarget {
 public:
  virtual ~OperationTarget() = default;
  virtual const world::World& world() const = 0;
  virtual world::IdSource& ids() = 0;
  /// Performs the edit of an action that people know by `title`.
  virtual base::Result<void> act(const world::Edit& edit, const std::string& title) = 0;
  virtual base::Result<void> undo() = 0;
  virtual base::Result<void> redo() = 0;
  /// Is there something to take back, or to do again? A target that cannot tell says so, and refuses then.
  virtual bool can_undo() const { return true; }
  virtual bool can_redo() const { return true; }
};

/// Performs {"op": NAME, parameters...}. A failed one changes nothing; the sentence begins with the
/// operation's name where there is one.
base::Result<Performed> perform_operation(OperationTarget& target, const Value& command,
                                          const PictureReader& pictures);

/// Performs operations on a world that it owns, as a person at the desktop would: `icome edit` and tests
/// drive it, and it undoes and redoes.
class OperationRunner final : public OperationTarget {
 public:
  explicit OperationRunner(world::World world, PictureReader pictures = {});

  const world::World& world() const override { return world_; }
  const world::History& history() const { return history_; }
  bool can_undo() const override { return history_.can_undo(); }
  bool can_redo() const override { return history_.can_redo(); }

  /// As perform_operation().
  base::Result<Performed> perform(const Value& command) {
    return perform_operation(*this, command, pictures_);
  }

 private:
  world::IdSource& ids() override { return ids_; }
  base::Result<void> act(const world::Edit& edit, const std::string& title) override {
    return history_.perform(world_, edit, title);
  }
  base::Result<void> undo() override;
  base::Result<void> redo() override;

  world::World world_;
  world::History history_;
  world::IdSource ids_;
  PictureReader pictures_;
};

/// The edit that an operation makes of a world with these arguments, to be performed elsewhere (a
/// session, a colleague's world). Fails for undo and redo, which are no edits.
base::Result<Plan> plan_operation(const Operation& operation, const Value::Fields& fields,
                                  const world::World& world, world::IdSource& ids,
                                  const PictureReader& pictures = {});

/// One edit that performs the operation on each of the objects, one after the other, as its first parameter.
/// Fails as soon as one of them is refused.
base::Result<Plan> plan_for_each(const Operation& operation, const Value::Fields& fields,
                                 std::span<const world::ObjectId> objects, world::World world,
                                 world::IdSource& ids, const PictureReader& pictures = {});

}  // namespace icome::interaction
