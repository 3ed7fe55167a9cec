#include "interaction/operations/operation_runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace icome::interaction {

OperationRunner::OperationRunner(world::World world, PictureReader pictures)
    : world_(std::move(world)), ids_(0, world_.next_number(0)), pictures_(std::move(pictures)) {}

base::Result<Performed> OperationRunner::perform(const Value& command) {
  const Value::Fields* fields = command.fields();
  const Value* name = fields ? field(*fields, "op") : nullptr;
  if (!name || !name->text())
    return base::fail(R"(this is no operation, such as {"op": "create", "shape": "box", "name": "seat"})");
  const auto operation = find_operation(*name->text());
  if (!operation) return tl::unexpected(operation.error());
  const auto named = [&](const base::Error& error) {
    return base::fail(fmt::format("{}: {}", (*operation)->name, error.message));
  };
  Value::Fields arguments = *fields;
  std::erase_if(arguments, [](const auto& it) { return it.first == "op"; });
  if (!(*operation)->plan) {
    if (!arguments.empty()) return base::fail(fmt::format("{} takes no parameters", (*operation)->name));
    return turn(**operation);
  }
  auto plan = plan_operation(**operation, arguments, world_, ids_, pictures_);
  if (!plan) return named(plan.error());
  if (const auto done = history_.perform(world_, plan->edit, (*operation)->title); !done)
    return named(done.error());
  std::erase_if(plan->objects, [&](world::ObjectId id) { return !world_.find(id); });
  return Performed{*operation, std::move(plan->objects), std::move(plan->note)};
}

base::Result<Performed> OperationRunner::turn(const Operation& operation) {
  const auto done = operation.name == "undo" ? history_.undo(world_) : history_.redo(world_);
  if (!done) return base::fail(fmt::format("{}: {}", operation.name, done.error().message));
  return Performed{&operation, {}};
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
