#include "interaction/operations/operation_runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace icome::interaction {

OperationRunner::OperationRunner(world::World world, PictureReader pictures)
    : world_(std::move(world)), ids_(0, world_.next_number(0)), pictures_(std::move(pictures)) {}

base::Result<void> OperationRunner::undo() {
  const auto done = history_.undo(world_);
  return done ? base::Result<void>() : tl::unexpected(done.error());
}

base::Result<void> OperationRunner::redo() {
  const auto done = history_.redo(world_);
  return done ? base::Result<void>() : tl::unexpected(done.error());
}

base::Result<Performed> perform_operation(OperationTarget& target, const Value& command,
                                          const PictureReader& pictures) {
  const Value::Fields* fields = command.fields();
  const Value* name = fields ? field(*fields, "op") : nullptr;
  if (!name || !name->text())
    return base::fail(R"(this is no operation, such as {"op": "create", "shape": "box", "name": "seat"})");
  const auto found = find_operation(*name->text());
  if (!found) return tl::unexpected(found.error());
  const Operation& operation = **found;
  const auto named = [&](const base::Error& error) {
    return base::fail(fmt::format("{}: {}", operation.name, error.message));
  };
  Value::Fields arguments = *fields;
  std::erase_if(arguments, [](const auto& it) { return it.first == "op"; });
  if (!operation.plan) {
    if (!arguments.empty()) return base::fail(fmt::format("{} takes no parameters", operation.name));
    const auto done = operation.name == "undo" ? target.undo() : target.redo();
    if (!done) return named(done.error());
    return Performed{&operation, {}};
  }
  auto plan = plan_operation(operation, arguments, target.world(), target.ids(), pictures);
  if (!plan) return named(plan.error());
  if (const auto done = target.act(plan->edit, operation.title); !done) return named(done.error());
  std::erase_if(plan->objects, [&](world::ObjectId id) { return !target.world().find(id); });
  return Performed{&operation, std::move(plan->objects), std::move(plan->note)};
}

base::Result<Plan> plan_operation(const Operation& operation, const Value::Fields& fields,
                                  const world::World& world, world::IdSource& ids,
                                  const PictureReader& pictures) {
  if (!operation.plan) return base::fail(fmt::format("{} is no edit of a world", operation.name));
  const auto arguments = Arguments::check(operation.parameters, fields, world, pictures);
  if (!arguments) return tl::unexpected(arguments.error());
  return operation.plan(world, *arguments, ids);
}

base::Result<Plan> plan_for_each(const Operation& operation, const Value::Fields& fields,
                                 std::span<const world::ObjectId> objects, world::World world,
                                 world::IdSource& ids, const PictureReader& pictures) {
  world::EditGroup group;
  Plan all{world::EditGroup()};
  for (const world::ObjectId id : objects) {
    Value::Fields own{{operation.parameters.front().name, fmt::format("#{}", id.value)}};
    own.insert(own.end(), fields.begin(), fields.end());
    auto plan = plan_operation(operation, own, world, ids, pictures);
    if (!plan) return plan;
    if (const auto done = world::apply(world, plan->edit); !done) return tl::unexpected(done.error());
    group.edits.push_back(std::move(plan->edit));
    all.objects.insert(all.objects.end(), plan->objects.begin(), plan->objects.end());
    if (!plan->note.empty()) all.note = std::move(plan->note);
  }
  all.edit = std::move(group);
  return all;
}

}  // namespace icome::interaction
