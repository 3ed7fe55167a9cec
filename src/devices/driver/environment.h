#pragma once
#include <cstddef>
#include <span>
#include <string_view>

#include "base/result.h"

namespace icome::devices {

/// The text in an environment variable; empty where it is not set. Valid until it is set. Main's.
std::string_view environment_text(const char* variable);

/// Sets `value` to the number in an environment variable, if it is set; fails on what is no number from
/// `least` to `most`, with a sentence that names the variable. Main's.
base::Result<void> environment_number(const char* variable, double least, double most, double& value);

/// The index of the word in an environment variable among these, or `otherwise` where it is not set; fails on
/// another word, with a sentence that names the variable. Main's.
base::Result<std::size_t> environment_choice(const char* variable, std::span<const std::string_view> words,
                                             std::size_t otherwise);

}  // namespace icome::devices
