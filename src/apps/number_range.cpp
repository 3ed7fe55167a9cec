#include "apps/number_range.h"

#include <fmt/format.h>

#include <string>

#include "base/parse_number.h"

namespace icome::apps {

CLI::Validator number_range(double least, double most) {
  const auto check = [least, most](const std::string& text) {
    const auto number = base::parse_finite(text);
    if (number && *number >= least && *number <= most) return std::string();
    return fmt::format("{} is not a number from {:g} to {:g}", text, least, most);
  };
  return CLI::Validator(check, fmt::format("FLOAT in [{:g} - {:g}]", least, most));
}

}  // namespace icome::apps
