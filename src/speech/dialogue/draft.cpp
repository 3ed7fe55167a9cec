#include "speech/dialogue/draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace icome::speech {

using base::Result;
using interaction::Value;

Result<std::vector<world::ObjectId>> Draft::perform(Value::Fields command) {
  const Value* const name = interaction::field(command, "op");
  const auto operation = interaction::find_operation(*name->text());
  if (!operation) return tl::unexpected(operation.error());
  Value::Fields arguments = command;
  std::erase_if(arguments, [](const auto& it) { return it.first == "op"; });
  auto plan = interaction::plan_operation(**operation, arguments, world(), ids_);
  if (!plan) return tl::unexpected(plan.error());
  if (const auto done = apply(std::move(plan->edit)); !done) return tl::unexpected(done.error());
  if (title_.empty()) title_ = (*operation)->title;
  commands_.emplace_back(std::move(command));
  std::erase_if(plan->objects, [&](world::ObjectId id) { return !world().find(id); });
  return std::move(plan->objects);
}

Result<void> Draft::apply(world::Edit edit) {
  if (!changed_) changed_ = design_;
  if (const auto done = world::apply(*changed_, edit); !done) return tl::unexpected(done.error());
  group_.edits.push_back(std::move(edit));
  return {};
}

Value objects_value(const std::vector<world::ObjectId>& objects) {
  Value::List list;
  for (const world::ObjectId id : objects) list.emplace_back(fmt::format("#{}", id.value));
  return list;
}

Value vector_value(const base::Vector3& vector) { return Value::List{vector.x(), vector.y(), vector.z()}; }

}  // namespace icome::speech
