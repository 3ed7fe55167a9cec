#include "files/csg/csg_arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "io/text_scanner.h"

namespace icome::files {

using Kind = CsgDocument::Kind;
using Index = CsgDocument::Index;

CsgArguments::CsgArguments(const CsgDocument& document, Index statement,
                           std::initializer_list<std::string_view> names)
    : document_(document), statement_name_(document.name(document.statements()[statement])) {
  const auto* positional = names.begin();
  const Index end = document.arguments_end(statement);
  for (Index i = document.statements()[statement].first_argument; i < end && !failed(); ++i) {
    const CsgDocument::Argument& argument = document.arguments()[i];
    const std::string_view name = document.name(argument);
    if (name == "$fn" || std::find(names.begin(), names.end(), name) != names.end())
      bind(argument, name);
    else if (name.starts_with('$'))
      continue;  // a special variable without meaning for the shape
    else if (!name.empty())
      error_ = document.error_at(argument.name, taken(names) + ", not " + io::quoted(name));
    else if (positional == names.end())
      fail(argument.value, taken(names) + " and nothing more");
    else
      bind(argument, *positional++);
  }
}

std::string CsgArguments::taken(std::initializer_list<std::string_view> names) const {
  return fmt::format("{} takes {}", statement_name_, fmt::join(names, ", "));
}

void CsgArguments::bind(const CsgDocument::Argument& argument, std::string_view name) {
  for (const auto& [other, value] : values_) {
    if (other == name)
      return fail(argument.value, fmt::format("{} of {} is given twice", name, statement_name_));
  }
  values_.emplace_back(name, argument.value);
}

std::optional<Index> CsgArguments::find(std::string_view name) const {
  if (failed()) return std::nullopt;
  for (const auto& [known, value] : values_) {
    if (known == name && document_.value(value).kind != Kind::Undefined) return value;
  }
  return std::nullopt;
}

std::optional<double> CsgArguments::number(std::string_view name) {
  const std::optional<Index> found = find(name);
  if (!found) return std::nullopt;
  if (document_.value(*found).kind == Kind::Number) return document_.value(*found).number;
  fail_kind(*found, fmt::format("a number is expected for {} of {}", name, statement_name_));
  return std::nullopt;
}

bool CsgArguments::flag(std::string_view name) {
  const std::optional<Index> found = find(name);
  if (!found) return false;
  if (document_.value(*found).kind == Kind::Boolean) return document_.value(*found).number != 0.0;
  fail_kind(*found, fmt::format("true or false is expected for {} of {}", name, statement_name_));
  return false;
}

std::size_t CsgArguments::length(Index vector) const {
  std::size_t elements = 0;
  const Index end = document_.value_end(vector);
  for (Index i = vector + 1; i < end; i = document_.value_end(i)) ++elements;
  return elements;
}

void CsgArguments::read_numbers(Index vector, double* numbers, std::size_t count, const char* what) {
  if (failed()) return;
  const auto expected = [&] { return fmt::format("{} is expected, a vector of {} numbers", what, count); };
  if (document_.value(vector).kind != Kind::Vector) return fail_kind(vector, expected());
  Index next = vector + 1;
  const Index end = document_.value_end(vector);
  for (std::size_t i = 0; i < count && next < end; ++i, ++next) {
    if (document_.value(next).kind != Kind::Number) return fail_kind(next, expected());
    numbers[i] = document_.value(next).number;
  }
  if (const std::size_t elements = next - vector - 1; next != end || elements != count)
    fail(vector, fmt::format("{}, but this one has {}", expected(), length(vector)));
}

void CsgArguments::fail(Index value, const std::string& message) {
  if (!failed()) error_ = document_.error_at(document_.value(value).offset, message);
}

void CsgArguments::fail_kind(Index value, const std::string& expected) {
  fail(value, fmt::format("{}, but there is {}", expected, kind_name(document_.value(value).kind)));
}

}  // namespace icome::files
