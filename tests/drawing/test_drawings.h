// Curves and drawings at random, which tests work on.
#pragma once
#include <numbers>
#include <random>
#include <vector>

#include "drawing/drawing_edit.h"

namespace icome::drawing::judges {

/// A smooth curve of so many segments through random points; closed where asked for.
inline Curve random_curve(unsigned seed, std::size_t segments, bool closed = false) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-0.1, 0.1);
  const auto point = [&] { return Vector2(number(random), number(random)); };
  Curve curve;
  curve.closed = closed;
  const Vector2 first = point();
  const Vector2 first_handle = 0.3 * point();
  Vector2 at = first;
  Vector2 handle = first_handle;
  for (std::size_t i = 0; i < segments; ++i) {
    const bool back = closed && i + 1 == segments;
    const Vector2 next = back ? first : point();
    const Vector2 next_handle = back ? first_handle : Vector2(0.3 * point());
    curve.segments.push_back({{at, at + handle, next - next_handle, next}});
    at = next;
    handle = next_handle;
  }
  const double end = curve.end();
  curve.widths = {{0.0, 0.001, 0.35 * end, 0.003},
                  {0.35 * end, 0.003, 0.8 * end, 0.0005},
                  {0.8 * end, 0.0005, end, 0.001}};
  return curve;
}

inline StrokePointer stroke_of(std::uint64_t id, Curve curve) {
  auto stroke = std::make_shared<Stroke>();
  stroke->id = StrokeId{id};
  stroke->curve = std::move(curve);
  stroke->colour = {0.25F, 0.5F, 0.75F};
  stroke->fill = Colour{1.0F, 0.0F, 0.0F};
  return stroke;
}

/// A drawing of one layer, number 1, with these curves as strokes 2, 3, ...
inline Drawing drawing_with(const std::vector<Curve>& curves) {
  Drawing drawing;
  drawing.layers.push_back({.id = drawing.next_layer_id(), .name = "Layer 1", .strokes = {}});
  for (const Curve& curve : curves) drawing.layers[0].strokes.push_back(stroke_of(drawing.next_id++, curve));
  return drawing;
}

}  // namespace icome::drawing::judges
