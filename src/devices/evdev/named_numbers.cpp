#include "devices/evdev/named_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/near_names.h"
#include "base/parse_number.h"
#include "base/shown_text.h"
#include "base/utf8.h"

namespace icome::devices {
namespace {

/// The number of that name; null where there is none.
const NamedNumber* named_number(std::span<const NamedNumber> numbers, std::string_view name) {
  for (const NamedNumber& number : numbers) {
    if (number.name == name) return &number;
  }
  return nullptr;
}

std::string nearest_name(std::span<const NamedNumber> numbers, std::string_view name) {
  std::vector<std::string> names;
  for (const NamedNumber& number : numbers) names.emplace_back(number.name);
  return base::suggestion(name, std::move(names));
}

/// Words for who separates settings by something else than blanks; empty for others.
std::string separators_advice(std::string_view word, std::span<const NamedNumber> numbers) {
  if (word.find_first_of(",;&") == std::string_view::npos) return {};
  std::string text;
  for (const NamedNumber& number : numbers.first(std::min<std::size_t>(2, numbers.size())))
    text += fmt::format("{}{}={:g}", text.empty() ? "" : " ", number.name, *number.value);
  return "; blanks separate settings, as in \"" + text + "\"";
}

}  // namespace

base::Result<void> set_numbers(std::string_view source, std::string_view text,
                               std::span<const NamedNumber> numbers) {
  std::vector<std::pair<const NamedNumber*, double>> given;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(word.size() + (word.size() < text.size() ? 1 : 0));
    if (word.empty()) continue;
    const std::size_t equals = word.find('=');
    const std::string_view name = word.substr(0, equals);
    const NamedNumber* number = named_number(numbers, name);
    const std::string shown = base::shown_text(base::as_utf8(word));
    if (number == nullptr)
      return base::fail(fmt::format("{}: \"{}\" is no setting{}{}", source, shown,
                                    nearest_name(numbers, name), separators_advice(word, numbers)));
    const auto value =
        equals == std::string_view::npos ? std::nullopt : base::parse_finite(word.substr(equals + 1));
    if (!value || !(*value >= number->least && *value <= number->most))
      return base::fail(fmt::format("{}: \"{}\" should read {}=NUMBER, with a number from {:g} to {:g}{}",
                                    source, shown, name, number->least, number->most,
                                    separators_advice(word, numbers)));
    given.emplace_back(number, *value);
  }
  for (const auto& [number, value] : given) *number->value = value;
  return {};
}

base::Result<void> set_numbers_from_environment(const char* variable, std::span<const NamedNumber> numbers) {
  const char* text = std::getenv(variable);
  return set_numbers(variable, text == nullptr ? "" : text, numbers);
}

}  // namespace icome::devices
