#pragma once
#include <optional>
#include <span>
#include <vector>

#include "geometry/contour/contour_samples.h"

namespace icome::geometry {

/// The place within `box` for a vertex that represents the sampled surface: on its edge or corner where it
/// has one there, else on the surface. May replace the samples by others nearer to the vertex.
Vector3 fit_vertex(const SampledSolid& solid, double cell, const Bounds& box,
                   std::span<SurfacePoint> samples);

/// Does the sheet go around a lone point (is_lone_point)?
bool is_lone_sheet(const ContourGrid& grid, const ContourCells& cells, const ContourCell& cell,
                   const SheetSamples& sheet);

/// The space of a cell for its vertices: all of it but a thin rim, so that the vertices of neighbours never
/// coincide.
Bounds vertex_space(const ContourGrid& grid, const ContourCell& cell);

/// The vertex of every sheet, by number, each in its cell. Nothing when `go_on` stopped it.
std::optional<std::vector<Vector3>> place_vertices(const SampledSolid& solid, const ContourGrid& grid,
                                                   const ContourCells& cells,
                                                   const std::vector<EdgeCrossing>& crossings,
                                                   const ContourProgress& go_on);

}  // namespace icome::geometry
