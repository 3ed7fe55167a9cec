#pragma once
#include <optional>
#include <string>
#include <vector>

#include "interaction/operations/operation_runner.h"

namespace icome::speech {

/// The operations of one sentence, tried on a copy of the design: what a sentence does is one action, which
/// is undone as one, or nothing at all. Owns the copy, made when something is first tried; new ids come from
/// the design's source. The design must outlive it.
class Draft {
 public:
  Draft(const world::World& world, world::IdSource& ids) : design_(world), ids_(ids) {}

  /// Performs {"op": NAME, parameters...} on the copy; gives the objects made or changed. Fails with the
  /// operation's own sentence.
  base::Result<std::vector<world::ObjectId>> perform(interaction::Value::Fields command);
  /// Applies an edit that no operation makes.
  base::Result<void> apply(world::Edit edit);

  const world::World& world() const { return changed_ ? *changed_ : design_; }
  const std::vector<interaction::Value>& commands() const { return commands_; }
  /// What people see in the undo list: the title of the first operation.
  const std::string& title() const { return title_; }
  bool is_empty() const { return group_.edits.empty(); }
  /// The edit of all of them.
  world::Edit edit() const { return group_; }

 private:
  const world::World& design_;
  std::optional<world::World> changed_;
  world::IdSource& ids_;
  world::EditGroup group_;
  std::vector<interaction::Value> commands_;
  std::string title_;
};

/// The value of parameters that name objects: "#12" each.
interaction::Value objects_value(const std::vector<world::ObjectId>& objects);
/// A point or a displacement as a parameter.
interaction::Value vector_value(const base::Vector3& vector);

}  // namespace icome::speech
