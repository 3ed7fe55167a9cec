#pragma once
#include <algorithm>
#include <string>
#include <string_view>

#include "base/utf8.h"

namespace icome::base {

/// Text that a person wrote, as errors repeat it: its first 60 characters, and "..." where it has more.
inline std::string shown_text(std::string_view text) {
  constexpr std::size_t kMostCharacters = 60;
  std::size_t bytes = 0;
  for (std::size_t count = 0; count < kMostCharacters && bytes < text.size(); ++count)
    bytes += std::max<std::size_t>(1, utf8_length(text.substr(bytes)));
  return std::string(text.substr(0, bytes)) + (bytes < text.size() ? "..." : "");
}

}  // namespace icome::base
