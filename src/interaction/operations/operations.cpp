#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "interaction/operations/near_names.h"
#include "interaction/operations/operation.h"

namespace icome::interaction {
namespace {

std::vector<Operation> history_operations() {
  return {{"undo", "Undo", "History", "Takes back what the last operation did.", {}},
          {"redo", "Redo", "History", "Does again what was taken back last.", {}}};
}

std::vector<Operation> all_operations() {
  std::vector<Operation> all;
  for (auto group : {shape_operations, vertex_operations, object_operations, solid_operations,
                     look_operations, texture_operations, effect_operations, history_operations})
    std::ranges::move(group(), std::back_inserter(all));
  return all;
}

void describe(const Parameter& parameter, const std::string& indent, std::string& text) {
  std::string notes;
  if (parameter.required) notes += "; required";
  if (!parameter.fallback.is_null()) notes += "; default " + json_from_value(parameter.fallback);
  if (!parameter.only_for.empty()) notes += fmt::format("; for {}", fmt::join(parameter.only_for, ", "));
  text += fmt::format("{}{}: {}\n{}    {}{}\n", indent, parameter.name, kind_of(parameter), indent,
                      parameter.meaning, notes);
  for (const Parameter& inner : parameter.fields) describe(inner, indent + "    ", text);
}

}  // namespace

const std::vector<Operation>& operations() {
  static const std::vector<Operation> kAll = all_operations();
  return kAll;
}

base::Result<const Operation*> find_operation(std::string_view name) {
  const auto found = std::ranges::find(operations(), name, &Operation::name);
  if (found != operations().end()) return &*found;
  std::vector<std::string> names;
  for (const Operation& operation : operations()) names.push_back(operation.name);
  return base::fail(fmt::format("there is no operation '{}'{}", name, suggestion(name, std::move(names))));
}

std::string kind_of(const Parameter& parameter) {
  switch (parameter.kind) {
    case ParameterKind::Flag:
      return "true or false";
    case ParameterKind::Number:
      return "number";
    case ParameterKind::Count:
      return "whole number";
    case ParameterKind::Text:
      return "text";
    case ParameterKind::Texts:
      return "text or [text, ...]";
    case ParameterKind::Picture:
      return "file";
    case ParameterKind::Choice:
      return fmt::format("{}", fmt::join(parameter.choices, " | "));
    case ParameterKind::Colour:
      return "[red, green, blue] or \"#rrggbb\" or name";
    case ParameterKind::Vector:
      return "[x, y, z]";
    case ParameterKind::Numbers:
      return "[number, ...]";
    case ParameterKind::Counts:
      return "[whole number, ...]";
    case ParameterKind::Points:
      return parameter.components == 2 ? "[[x, y], ...]" : "[[x, y, z], ...]";
    case ParameterKind::Object:
      return "object";
    case ParameterKind::Objects:
      return "object or [object, ...]";
    case ParameterKind::Records:
      return "[{...}, ...]";
  }
  return {};
}

std::string help_of(const Operation& operation) {
  std::string text = fmt::format("{}\n    {}\n", operation.name, operation.summary);
  for (const Parameter& parameter : operation.parameters) describe(parameter, "      ", text);
  return text;
}

}  // namespace icome::interaction
