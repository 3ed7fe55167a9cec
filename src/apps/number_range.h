#pragma once
#include <functional>
#include <string>

namespace icome::apps {

/// A check of CLI11 that an option's value is a number from `least` to `most`; unlike CLI::Range it refuses
/// "nan". It gives what is wrong, or nothing.
std::function<std::string(const std::string&)> number_range(double least, double most);

}  // namespace icome::apps
