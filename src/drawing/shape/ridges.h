#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "drawing/drawing.h"
#include "geometry/mesh/triangle_mesh.h"
#include "geometry/sweep/outline.h"

namespace icome::drawing {

/// Heights of what the lines of a drawing become, so that they can be touched.
struct RidgeHeights {
  double height = 0.0005;        ///< m, of every line; 0.00005 to 0.1
  double height_by_width = 0.0;  ///< m for a metre of the line's greatest width, beside it; 0 to 10

  bool operator==(const RidgeHeights&) const = default;
};

/// The share of its height by which each line is higher than the one before it.
inline constexpr double kRiseOfStroke = 0.002;

/// Says what is wrong with the heights; empty where nothing is.
std::string complaint(const RidgeHeights& heights);

/// The areas that a stroke covers as solids that stand on the paper, closed and facing out: the paper lies in
/// the plane z = 0 with its middle at the origin and y up.
struct StrokeRidge {
  geometry::TriangleMesh line;  ///< m, from z = 0 to 1; empty for a line without width
  geometry::TriangleMesh fill;  ///< likewise; empty where nothing is filled
};
using StrokeRidgePointer = std::shared_ptr<const StrokeRidge>;

/// Ridges by their strokes. They are for paper of one size.
using StrokeRidges = std::map<StrokePointer, StrokeRidgePointer>;

/// A ridge on its paper.
struct Ridge {
  StrokePointer stroke;
  StrokeRidgePointer areas;
  double height;       ///< m, of the line
  double fill_height;  ///< m; flatter than the line's
};

/// The ridges of all strokes that can be seen, the lowest first. Later ones are a little higher, so that no
/// two tops lie in one plane. `known` has ridges that were made before for paper of the same size; they are
/// taken from there, and the new ones are put there. Rims are off by 0.02 mm at most. Fails, naming the
/// stroke, for areas that cannot be cut into triangles.
base::Result<std::vector<Ridge>> ridges_of(const Drawing& drawing, const RidgeHeights& heights,
                                           StrokeRidges& known);

/// The areas that the closed curves of all strokes that can be seen enclose together, in the frame of ridges
/// (m), off by `tolerance` (m, > 0) at most. Fails for curves that cross without an end.
base::Result<std::vector<geometry::Outline>> enclosed_areas(const Drawing& drawing, double tolerance);
/// The open curves that can be seen, as points on them, in the same frame.
std::vector<std::vector<Vector2>> open_lines(const Drawing& drawing, double tolerance);

}  // namespace icome::drawing
