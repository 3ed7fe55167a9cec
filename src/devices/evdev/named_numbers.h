#pragma once
#include <span>
#include <string_view>

#include "base/result.h"

namespace icome::devices {

/// A setting that people give by its name, such as "depth=0.005".
struct NamedNumber {
  std::string_view name;
  double* value = nullptr;  // of the settings, never null
  double least = 0.0;
  double most = 0.0;
};

/// Sets the numbers that a text gives, "depth=0.005 hover=0.02", and leaves the others; sets none and fails
/// with a sentence, which names the `source` of the text, where one is unknown, no number or out of range.
base::Result<void> set_numbers(std::string_view source, std::string_view text,
                               std::span<const NamedNumber> numbers);

/// Sets the numbers that an environment variable gives; sets none where there is no such variable.
base::Result<void> set_numbers_from_environment(const char* variable, std::span<const NamedNumber> numbers);

}  // namespace icome::devices
