#include "devices/driver/environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "base/parse_number.h"

namespace icome::devices {

std::string_view environment_text(const char* variable) {
  const char* text = std::getenv(variable);
  return text != nullptr ? std::string_view(text) : std::string_view();
}

base::Result<void> environment_number(const char* variable, double least, double most, double& value) {
  const std::string_view text = environment_text(variable);
  if (text.empty()) return {};
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
  const std::string_view text = environment_text(variable);
  if (text.empty()) return otherwise;
  const auto word = std::find(words.begin(), words.end(), text);
  if (word != words.end()) return static_cast<std::size_t>(word - words.begin());
  std::string known;
  for (const std::string_view each : words) known += (known.empty() ? "" : " or ") + std::string(each);
  return base::fail(fmt::format("{} is \"{}\"; set it to {}, or unset it", variable, text, known));
}

}  // namespace icome::devices
