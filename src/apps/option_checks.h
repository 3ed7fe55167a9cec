#pragma once
#include <functional>
#include <string>

namespace icome::apps {

// Checks of CLI11 for the values of options: each gives what is wrong, or nothing.

/// A number from `least` to `most`; unlike CLI::Range it refuses "nan".
std::function<std::string(const std::string&)> number_range(double least, double most);

/// Some text: a shell gives none for a variable that is not set.
std::function<std::string(const std::string&)> not_empty();

}  // namespace icome::apps
