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

/// Performs operations on a world that it owns, one action each, as a person at the desktop would: `icome
/// edit` and tests drive it, and it undoes and redoes.
class OperationRunner {
 public:
  explicit OperationRunner(world::World world, PictureReader pictures = {});

  const world::World& world() const { return world_; }
  const world::History& history() const { return history_; }

  /// Performs {"op": NAME, parameters...}. A failed one changes nothing; the sentence begins with the
  /// operation's name where there is one.
  base::Result<Performed> perform(const Value& command);

 private:
  base::Result<Performed> turn(const Operation& operation);

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
