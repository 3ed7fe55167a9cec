#pragma once
#include <cstddef>
#include <vector>

#include "world/motion.h"

namespace icome::files {

/// Into so many straight pieces what is bent between two key frames is cut, for formats that know no others.
inline constexpr std::size_t kPiecesOfBend = 16;

/// The moments that cut each piece between two of these in so many; jumps stay where they are.
std::vector<double> cut_finer(const std::vector<double>& times, std::size_t pieces);

/// The same motion with key frames that lie on straight ways: steps as two at one moment, splines cut.
world::Motion straightened(const world::Motion& motion);

/// Does it have splines?
bool is_bent(const world::Motion& motion);

}  // namespace icome::files
