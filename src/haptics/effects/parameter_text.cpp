#include "haptics/effects/parameter_text.h"

#include <fmt/format.h>

#include <utility>

#include "base/near_names.h"
#include "base/parse_number.h"
#include "base/shown_text.h"

namespace icome::haptics {
namespace {

constexpr Parameter kAnything{};  // default limits, which ranges_of() does not show

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::string with_unit(std::string text, const Parameter& parameter) {
  return parameter.unit.empty() ? text : fmt::format("{} {}", text, parameter.unit);
}

std::string range_text(const Parameter& parameter) {
  return with_unit(fmt::format("{:g} to {:g}", parameter.least, parameter.most), parameter);
}

base::Result<double> read_parameter(std::string_view text, std::size_t place, const Parameter& parameter) {
  const std::string_view said = without_blanks(text);
  const auto value = base::parse_finite(said);
  if (!value) {
    return base::fail(fmt::format("number {} ({}) is \"{}\", which is no number.", place,
                                  with_unit(std::string(parameter.name), parameter), base::shown_text(said)));
  }
  if (*value >= parameter.least && *value <= parameter.most) return *value;
  return base::fail(fmt::format("number {} ({}) is {}: choose one from {}.", place, parameter.name,
                                base::shown_text(said), range_text(parameter)));
}

}  // namespace

std::string usage_of(std::span<const Parameter> parameters) {
  std::string usage, ends;
  for (const Parameter& parameter : parameters) {
    if (parameter.usual) {
      usage += '[';
      ends += ']';
    }
    if (&parameter != &parameters.front()) usage += ',';
    usage += parameter.name;
  }
  return usage + ends;
}

std::string ranges_of(std::span<const Parameter> parameters) {
  std::string text;
  for (const Parameter& parameter : parameters) {
    const bool anything = parameter.least == kAnything.least && parameter.most == kAnything.most;
    text += text.empty() ? "" : ", ";
    text += anything ? with_unit(std::string(parameter.name), parameter)
                     : fmt::format("{} {}", parameter.name, range_text(parameter));
    if (parameter.usual) text += fmt::format(" ({:g})", *parameter.usual);
  }
  return text;
}

base::Result<std::vector<double>> read_parameters(std::string_view text,
                                                  std::span<const Parameter> parameters) {
  std::vector<std::string_view> parts;
  if (!without_blanks(text).empty()) parts = split_outside_parentheses(text, ',');
  if (parts.size() > parameters.size()) {
    return base::fail(fmt::format("it takes {}: {} numbers at most, not {}.", usage_of(parameters),
                                  parameters.size(), parts.size()));
  }
  std::vector<double> numbers;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (i >= parts.size()) {
      if (!parameters[i].usual) {
        return base::fail(fmt::format("number {} ({}) is missing: it takes {}.", i + 1, parameters[i].name,
                                      usage_of(parameters)));
      }
      numbers.push_back(*parameters[i].usual);
      continue;
    }
    const auto number = read_parameter(parts[i], i + 1, parameters[i]);
    if (!number) return tl::unexpected(number.error());
    numbers.push_back(*number);
  }
  return numbers;
}

std::string unknown_name(std::string_view kind, std::string_view said, std::vector<std::string> names) {
  const std::string near = base::suggestion(said, std::move(names));
  return fmt::format("there is no {} \"{}\"{}{}", kind, base::shown_text(said), near,
                     near.ends_with('?') ? "" : ".");
}

std::vector<std::string_view> split_outside_parentheses(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  std::size_t start = 0;
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    if (text[i] != separator || depth > 0) continue;
    parts.push_back(text.substr(start, i - start));
    start = i + 1;
  }
  parts.push_back(text.substr(start));
  return parts;
}

}  // namespace icome::haptics
