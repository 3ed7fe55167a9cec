#include "apps/option_checks.h"

#include <fmt/format.h>

#include "base/parse_number.h"

namespace icome::apps {

std::function<std::string(const std::string&)> number_range(double least, double most) {
  return [least, most](const std::string& text) {
    const auto number = base::parse_finite(text);
    if (number && *number >= least && *number <= most) return std::string();
    return fmt::format("{} is not a number from {:g} to {:g}", text, least, most);
  };
}

std::function<std::string(const std::string&)> not_empty() {
  return [](const std::string& value) { return std::string(value.empty() ? "is empty" : ""); };
}

}  // namespace icome::apps
