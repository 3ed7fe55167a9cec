#pragma once
#include <optional>

#include "geometry/contour/contour_progress.h"
#include "geometry/contour/dual_contouring.h"

namespace icome::geometry {

/// ContourMesh::error of a mesh made with this cell. Nothing when `go_on` stopped it.
std::optional<double> measure_contour_error(const SampledSolid& solid, double cell, const TriangleMesh& mesh,
                                            const ContourProgress& go_on);

}  // namespace icome::geometry
