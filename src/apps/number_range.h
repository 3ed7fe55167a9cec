#pragma once
#include <CLI/CLI.hpp>

namespace icome::apps {

/// Checks that an option's value is a number from `least` to `most`; unlike CLI::Range it refuses "nan".
CLI::Validator number_range(double least, double most);

}  // namespace icome::apps
