#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "cutout/tracker/thesis/hough_lines.h"
#include "cutout/tracker/tracker.h"

namespace icome::cutout {

/// Three lines that make a triangle of the known list.
struct KnownTriple {
  std::size_t triangle;  ///< index in the known list
  TrianglePose pose;
  double mismatch;  ///< of angle and height as shares of what is allowed, 0 to 2
  int votes;        ///< the least of the three lines'
  std::array<std::size_t, 3> lines;
};

/// The third stage of thesis 3.4.6 and 3.4.7: triples of lines that are isosceles triangles, whose base angle
/// and then whose height are a known one's. `pixel` is the size of a pixel on the table, mm.
std::vector<KnownTriple> isosceles_triples(std::span<const HoughLine> lines, const KnownTriangles& known,
                                           double pixel);

}  // namespace icome::cutout
