#pragma once
#include <cstddef>
#include <cstdint>

namespace icome::benchmarks {

/// Sightings by the following tracker of pairs that pass over or close beside one another.
struct CrossingFigures {
  std::size_t frames = 0;
  std::size_t swaps = 0;   ///< sightings of a triangle where its look-alike lies
  std::size_t ghosts = 0;  ///< sightings more than 4 mm or 0.1 rad from the truth, swaps among them
  double found_percent = 0;
};

/// Draws and follows at least so many frames. Each pair has nearly one shape (1 degree, 1 mm); one passes
/// over the other, or beside it, at several speeds and angles.
CrossingFigures follow_crossing_pairs(std::size_t frames, std::uint64_t seed);

}  // namespace icome::benchmarks
