#pragma once
#include <vector>

#include "geometry/sweep/outline.h"

namespace icome::fonts {

using geometry::Vector2;

/// Closed lines of whole numbers: what is inside of one by the non-zero rule is covered.
using Rings = std::vector<std::vector<Vector2>>;

/// The area that rings cover together, as pieces that do not overlap. Corners are whole numbers of less than
/// 2^30 either way, and remain so.
std::vector<geometry::Outline> united(const Rings& rings);

/// The area that an odd number of rings cover, a ring that covers twice by itself counting twice; else as
/// united().
std::vector<geometry::Outline> covered_oddly(const Rings& rings);

/// Do the edges of rings cross more than `most` times? Both functions above take time by more than the square
/// of that: 12,000 crossings take half a second. What would take too long to find out counts as often.
bool cross_often(const Rings& rings, std::size_t most);
inline constexpr std::size_t kMostCrossings = 12'000;

}  // namespace icome::fonts
