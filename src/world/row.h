#pragma once
#include <algorithm>
#include <cassert>
#include <vector>

#include "world/id.h"

namespace icome::world {

// Objects side by side: the children of one, or the roots of the world or of a scene.

/// Where the id is; the row's size where it is not in it.
inline std::size_t place_of(const std::vector<ObjectId>& row, ObjectId id) {
  return std::size_t(std::find(row.begin(), row.end(), id) - row.begin());
}

/// Where an id that is in the row is, sooner than place_of in a row of very many: most work goes on at the
/// ends, else it is likely to be near the place where it was put.
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
