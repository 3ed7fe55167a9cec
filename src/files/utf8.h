#pragma once
#include <string>
#include <string_view>

namespace icome::files {

/// The text with a question mark for every byte that is no UTF-8, as JSON must be.
std::string as_utf8(std::string_view text);

}  // namespace icome::files
