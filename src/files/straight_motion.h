#pragma once
#include <cstddef>
#include <vector>

#include "world/motion.h"

namespace icome::files {

/// Number of straight pieces into which each piece of a spline is cut, for formats without splines.
inline constexpr std::size_t kPiecesOfBend = 16;

/// The moments with each interval between two of these cut into so many pieces; jumps stay.
std::vector<double> cut_finer(const std::vector<double>& times, std::size_t pieces);

/// An equal motion with linear key frames only: steps as two at one moment, splines cut.
world::Motion straightened(const world::Motion& motion);

/// Does it have splines?
bool is_bent(const world::Motion& motion);

}  // namespace icome::files
