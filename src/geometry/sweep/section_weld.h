#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/sweep/sweep_advance.h"

namespace icome::geometry {

/// The shape to which the corners of a section are reduced.
enum class SectionShape {
  Whole,  ///< they keep apart
  Line,   ///< an outline flattened so that its edges meet in pairs, each way along one another
  Point,
  Ragged,  ///< an outline flattened to a line without such pairs
};

/// Gives the section's corners vertices: those of `before` where corners stay in place, one where they come
/// together, each to within `tolerance` (m), and new ones at the end of `positions` elsewhere.
SectionShape weld_section(SweepSection& section, const SweepSection& before, bool open, double tolerance,
                          std::vector<Vector3>& positions);

/// The corner of the first section that corner 0 of the last one meets, where every corner meets one within
/// `reach` (m), in order: 0 unless an outline has turned on itself. -1: they do not meet.
int meeting_corner(std::span<const Vector3> first, std::span<const Vector3> last, bool open, double reach);

}  // namespace icome::geometry
