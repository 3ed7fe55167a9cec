#pragma once
#include <optional>
#include <vector>

#include "geometry/contour/contour_samples.h"
#include "geometry/contour/contour_split.h"

namespace icome::geometry {

/// The results of meshing so far. `positions` are those of the sheets' vertices, by number.
struct ContourDraft {
  const SampledSolid* solid;
  const ContourGrid* grid;
  const ContourCells* cells;
  const std::vector<EdgeCrossing>* crossings;
  const std::vector<ContourQuad>* quads;
  std::vector<Vector3> positions;
};

/// Divides the quads, and moves vertices where the triangles represent the surface badly: where an edge or
/// corner of it pokes into a cell whose own corners do not show it. There the surface is sampled again at
/// the triangles, and a vertex fitted to all samples; it may leave its cell by a part of one. Moves are kept
/// only where the triangles around the vertex become better. In the end no triangle is degenerate.
/// Nothing when `go_on` stopped it.
std::optional<std::vector<QuadSplit>> refine_and_split(ContourDraft& draft, const ContourProgress& go_on);

}  // namespace icome::geometry
