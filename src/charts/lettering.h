#pragma once
#include <string>
#include <string_view>

namespace icome::charts {

// Lines of text are set in DejaVu Sans and, where that lacks a letter, in any other font of the desktop
// that has it; scripts that join or run from right to left as their readers expect. The text is UTF-8; bytes
// that are not count as replacement marks. Every thread may call these.

/// Height of a capital letter, of the size of its text.
inline constexpr double kCapitalHeight = 0.729;

/// The width of one line, in heights of a capital letter.
double line_width(std::string_view text);

/// Those of its letters that no font of this desktop has, each once, as they come.
std::string letters_without_font(std::string_view text);

/// The text with each byte that is not part of valid UTF-8 replaced by U+FFFD, and control characters
/// by spaces.
std::string printable(std::string_view text);

}  // namespace icome::charts
