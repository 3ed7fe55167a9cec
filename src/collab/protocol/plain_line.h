#pragma once
#include <string>
#include <string_view>

namespace icome::collab {

/// The text of a stranger as one line that can be shown and logged anywhere: whole characters of UTF-8, at
/// most so many bytes, a blank for each control character and a question mark for each byte that is none.
std::string plain_line(std::string_view text, std::size_t most_bytes);

}  // namespace icome::collab
