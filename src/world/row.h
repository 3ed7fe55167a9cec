#pragma once
#include <algorithm>
#include <cassert>
#include <vector>

#include "world/id.h"

namespace icome::world {

// Rows of objects side by side: the children of one, or the roots of the world or of a scene.

/// Index of the id in the row; the row's size where it is not in it.
inline std::size_t place_of(const std::vector<ObjectId>& row, ObjectId id) {
  return std::size_t(std::find(row.begin(), row.end(), id) - row.begin());
}

/// Index of an id that is in the row, found sooner than by place_of in a very long row: most work happens
/// at the ends, else it is likely to be near the place where it was put.
inline std::size_t place_near(const std::vector<ObjectId>& row, ObjectId id, std::size_t hint) {
  constexpr std::size_t kEnd = 16;
  const std::size_t last = row.size() - 1;
  for (std::size_t i = 0; i <= std::min(kEnd, last); ++i) {
    if (row[last - i] == id) return last - i;
    if (row[i] == id) return i;
  }
  hint = std::min(hint, last);
  for (std::size_t away = 0;; ++away) {
    if (hint + away <= last && row[hint + away] == id) return hint + away;
    if (away <= hint && row[hint - away] == id) return hint - away;
    assert(away <= last);
  }
}

inline void insert(std::vector<ObjectId>& row, std::size_t place, ObjectId id) {
  row.insert(row.begin() + std::ptrdiff_t(place), id);
}

}  // namespace icome::world
