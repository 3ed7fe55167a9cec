#include "ui/forms/operation_arguments.h"

#include <fmt/format.h>

#include <algorithm>

#include "interaction/operations/operation_runner.h"
#include "session/storage/picture_file.h"

namespace icome::ui {

using interaction::Operation;
using interaction::Parameter;
using interaction::ParameterKind;
using interaction::Value;
using world::ObjectId;

namespace {

bool takes_objects(const Parameter& parameter) {
  return parameter.kind == ParameterKind::Object || parameter.kind == ParameterKind::Objects;
}

/// The parameters that must be given, too.
std::vector<Parameter> missing_of(const Operation& operation, const Value::Fields& given) {
  std::string choice;
  if (!operation.parameters.empty())
    if (const Value* const first = interaction::field(given, operation.parameters.front().name))
      if (const std::string* const text = first->text()) choice = *text;
  std::vector<Parameter> missing;
  for (const Parameter& it : operation.parameters)
    if (it.required && is_asked(it, choice) && interaction::field(given, it.name) == nullptr)
      missing.push_back(it);
  return missing;
}

}  // namespace

bool asks_only_for_objects(const Operation& operation) {
  return std::ranges::all_of(operation.parameters,
                             [](const Parameter& it) { return it.required && takes_objects(it); });
}

std::vector<std::vector<ObjectId>> shares_of(const std::vector<Parameter>& parameters,
                                             const std::vector<ObjectId>& selection) {
  std::vector<std::vector<ObjectId>> shares(parameters.size());
  auto next = selection.begin();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!parameters[i].required || !takes_objects(parameters[i]) || next == selection.end()) continue;
    const auto end = parameters[i].kind == ParameterKind::Object ? next + 1 : selection.end();
    shares[i].assign(next, end);
    next = end;
  }
  return shares;
}

Value value_of(const Parameter& parameter, const std::vector<ObjectId>& objects) {
  if (objects.empty()) return {};
  Value::List names;
  for (const ObjectId id : objects) names.emplace_back(fmt::format("#{}", id.value));
  return parameter.kind == ParameterKind::Object ? names.front() : Value(std::move(names));
}

bool asks_for_values(const Operation& operation, const Value::Fields& given) {
  return !std::ranges::all_of(missing_of(operation, given), takes_objects);
}

std::optional<Value::Fields> completed_fields(const Operation& operation, const Value::Fields& given,
                                              const std::vector<ObjectId>& selection) {
  const std::vector<Parameter> missing = missing_of(operation, given);
  const auto shares = shares_of(missing, selection);
  Value::Fields fields = given;
  std::size_t used = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (shares[i].empty()) return std::nullopt;
    used += shares[i].size();
    fields.emplace_back(missing[i].name, value_of(missing[i], shares[i]));
  }
  const bool all = shares.empty() || used == selection.size();
  return all ? std::optional(std::move(fields)) : std::nullopt;
}

bool is_asked(const Parameter& parameter, const std::string& choice) {
  return parameter.only_for.empty() || std::ranges::count(parameter.only_for, choice) > 0;
}

base::Result<void> check_value(const Parameter& parameter, const Value& value, const world::World& world) {
  Parameter alone = parameter;
  alone.only_for.clear();
  const std::vector<Parameter> parameters{std::move(alone)};
  const Value::Fields fields{{parameter.name, value}};
  const auto checked = interaction::Arguments::check(parameters, fields, world);
  return checked ? base::Result<void>() : tl::unexpected(checked.error());
}

interaction::PictureReader picture_reader(const session::Session& session) {
  return [folder = session.files().path().parent_path()](const std::string& file) {
    return session::read_picture(folder / file);
  };
}

base::Result<std::string> perform_operation(session::Session& session, const Operation& operation,
                                            const Value::Fields& fields) {
  auto plan =
      interaction::plan_operation(operation, fields, session.world(), session.ids(), picture_reader(session));
  if (!plan) return tl::unexpected(plan.error());
  if (const auto done = session.history().perform(plan->edit, operation.title); !done)
    return tl::unexpected(done.error());
  session.select(std::move(plan->objects));
  return std::move(plan->note);
}

}  // namespace icome::ui
