#include "devices/driver/environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "base/parse_number.h"

namespace icome::devices {

base::Result<void> environment_number(const char* variable, double least, double most, double& value) {
  const char* text = std::getenv(variable);
  if (text == nullptr || *text == '\0') return {};
  const auto number = base::parse_number<double>(text);
  // The range as a negated comparison, so that NaN fails too.
  if (!number || !(*number >= least && *number <= most))
    return base::fail(fmt::format("{} is \"{}\"; set it to a number from {} to {}, or unset it", variable,
                                  text, least, most));
  value = *number;
  return {};
}

base::Result<std::size_t> environment_choice(const char* variable, std::span<const std::string_view> words,
                                             std::size_t otherwise) {
  const char* text = std::getenv(variable);
  if (text == nullptr || *text == '\0') return otherwise;
  const auto word = std::find(words.begin(), words.end(), std::string_view(text));
  if (word != words.end()) return static_cast<std::size_t>(word - words.begin());
  std::string known;
  for (const std::string_view each : words) known += (known.empty() ? "" : " or ") + std::string(each);
  return base::fail(fmt::format("{} is \"{}\"; set it to {}, or unset it", variable, text, known));
}

}  // namespace icome::devices
