#pragma once
#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

namespace icome::drawing {

/// Finds the lines of places in a text, however many are asked for.
class TextLines {
 public:
  explicit TextLines(std::string_view text) {
    for (std::size_t at = text.find('\n'); at < text.size(); at = text.find('\n', at + 1))
      ends_.push_back(at);
  }

  /// The line of a byte, from 1. The last one for places behind the text, the first for negative ones.
  std::size_t line_of(std::ptrdiff_t offset) const {
    if (offset < 0) return 1;
    return 1 + std::size_t(std::ranges::lower_bound(ends_, std::size_t(offset)) - ends_.begin());
  }

 private:
  std::vector<std::size_t> ends_;
};

}  // namespace icome::drawing
