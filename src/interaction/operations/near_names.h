#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace icome::interaction {

/// "; did you mean 'extrude'?" for the name that differs from what was said by the fewest letters, or ";
/// there are a, b, c" where none comes near and they are few. Empty where neither helps.
std::string suggestion(std::string_view said, std::vector<std::string> names);

}  // namespace icome::interaction
