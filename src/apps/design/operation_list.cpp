#include "apps/design/operation_list.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/near_names.h"

namespace icome::apps {
namespace {

using interaction::Operation;
using interaction::Parameter;
using Json = nlohmann::ordered_json;

Json json_of_parameter(const Parameter& parameter) {
  Json json;
  json["name"] = parameter.name;
  json["kind"] = interaction::kind_of(parameter);
  json["meaning"] = parameter.meaning;
  json["required"] = parameter.required;
  json["default"] = Json::parse(json_from_value(parameter.fallback));
  if (std::isfinite(parameter.least)) json["least"] = parameter.least;
  if (std::isfinite(parameter.most)) json["most"] = parameter.most;
  if (!parameter.choices.empty()) json["choices"] = parameter.choices;
  if (!parameter.only_for.empty()) json["only_for"] = parameter.only_for;
  for (const Parameter& inner : parameter.fields) json["fields"].push_back(json_of_parameter(inner));
  return json;
}

Json json_of_operation(const Operation& operation) {
  Json json;
  json["name"] = operation.name;
  json["title"] = operation.title;
  json["group"] = operation.group;
  json["summary"] = operation.summary;
  json["parameters"] = Json::array();
  for (const Parameter& parameter : operation.parameters)
    json["parameters"].push_back(json_of_parameter(parameter));
  return json;
}

/// Operations one after the other, below the name of their group.
std::string text_of(const std::vector<const Operation*>& operations) {
  std::string text;
  std::string group;
  for (const Operation* operation : operations) {
    if (operation->group != group) text += fmt::format("{}{}\n", text.empty() ? "" : "\n", operation->group);
    group = operation->group;
    text += fmt::format("\n{}", help_of(*operation));
  }
  return text;
}

}  // namespace

base::Result<std::string> operation_list(std::span<const Operation* const> operations,
                                         const std::string& what, const std::string& only, bool json) {
  std::vector<const Operation*> chosen;
  std::vector<std::string> names;
  for (const Operation* operation : operations) {
    names.push_back(operation->name);
    if (only.empty() || operation->name == only) chosen.push_back(operation);
  }
  if (chosen.empty())
    return base::fail(
        fmt::format("there is no {} '{}'{}", what, only, base::suggestion(only, std::move(names))));
  if (!json) return text_of(chosen);
  Json document;
  document[what + "s"] = Json::array();
  for (const Operation* operation : chosen) document[what + "s"].push_back(json_of_operation(*operation));
  return document.dump(2) + "\n";
}

}  // namespace icome::apps
