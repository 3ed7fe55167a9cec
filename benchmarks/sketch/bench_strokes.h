#pragma once
#include <string>
#include <vector>

#include "geometry/curve/cubic_bezier.h"
#include "sketch/fit/stroke_fit.h"

namespace icome::benchmarks {

using base::Vector2;
using geometry::CubicBezier;
using sketch::PenStroke;

/// A stroke of a real pen and the recording it comes from.
struct BenchStroke {
  std::string file;
  PenStroke stroke;
};

/// All strokes of the shared recordings in which the pen moves; none where they are not beside the project.
std::vector<BenchStroke> shared_strokes();

/// Their samples as lines in units of `unit` (m), each from its first sample, without repeats.
std::vector<Vector2> line_of(const PenStroke& stroke, double unit);
/// Control points (m) in the units and from the origin of line_of().
std::vector<CubicBezier> beside_line(const std::vector<CubicBezier>& curve, const PenStroke& stroke,
                                     double unit);

/// The program's curve of a stroke within `error` (m).
sketch::FittedStroke fit_within(const PenStroke& stroke, double error, bool refit = true);

/// The longer side of the stroke's box, m.
double extent_of(const PenStroke& stroke);

/// The strokes end to end, as a pen that reports 1000 times a second and places between as straight, repeated
/// until there are `samples`. The pen moves as fast as it did.
PenStroke long_stroke(const std::vector<BenchStroke>& strokes, std::size_t samples);

}  // namespace icome::benchmarks
