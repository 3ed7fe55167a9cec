#pragma once
#include <algorithm>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace icome::base {

/// Number of letters to insert, delete or change, or of neighbours to swap (Damerau 1964).
inline std::size_t edit_distance(std::string_view one, std::string_view other) {
  std::vector<std::size_t> before, last(other.size() + 1), row(other.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 0; i < one.size(); ++i) {
    row[0] = i + 1;
    for (std::size_t k = 0; k < other.size(); ++k) {
      row[k + 1] = std::min({last[k] + (one[i] == other[k] ? 0 : 1), row[k] + 1, last[k + 1] + 1});
      const bool swapped = i > 0 && k > 0 && one[i] == other[k - 1] && one[i - 1] == other[k];
      if (swapped) row[k + 1] = std::min(row[k + 1], before[k - 1] + 1);
    }
    before = std::exchange(last, row);
  }
  return last.back();
}

/// "; did you mean 'extrude'?" for the name that differs from `said` by the fewest letters, or ";
/// there are a, b, c" where none is near and they are few; else empty.
inline std::string suggestion(std::string_view said, std::vector<std::string> names) {
  constexpr std::size_t kMostListed = 24;
  // Longer ones are not compared: nobody mistypes them by a letter, and it takes the product of lengths.
  constexpr std::size_t kLongestCompared = 64;
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::erase(names, "");
  const std::string* nearest = nullptr;
  std::size_t least = 1 + (said.size() < 4 ? 1 : std::max<std::size_t>(2, said.size() / 3));
  for (const std::string& name : names) {
    if (said.size() > kLongestCompared || name.size() > kLongestCompared) continue;
    const std::size_t distance = edit_distance(said, name);
    const bool all_changed = distance == std::max(said.size(), name.size());
    if (distance >= least || all_changed) continue;
    least = distance;
    nearest = &name;
  }
  if (nearest != nullptr) return std::string("; did you mean '").append(*nearest).append("'?");
  if (names.empty() || names.size() > kMostListed) return {};
  std::string list;
  for (const std::string& name : names) list.append(list.empty() ? "; there are " : ", ").append(name);
  return list;
}

}  // namespace icome::base
