#include "drawing/drawing.h"

#include "world/hasher.h"

namespace icome::drawing {
namespace {

void add_colour(world::Hasher& hasher, const Colour& colour) {
  for (const float part : colour) hasher.add(double(part));
}

void add_curve(world::Hasher& hasher, const Curve& curve) {
  hasher.add(curve.segments.size());
  for (const CubicBezier& segment : curve.segments)
    for (const Vector2& point : segment.points) hasher.add(point);
  hasher.add(curve.widths.size());
  for (const WidthSegment& piece : curve.widths) {
    for (const double number : {piece.from, piece.from_width, piece.to, piece.to_width}) hasher.add(number);
  }
  hasher.add(curve.closed);
}

void add_stroke(world::Hasher& hasher, const Stroke& stroke) {
  hasher.add(stroke.id.value);
  add_curve(hasher, stroke.curve);
  add_colour(hasher, stroke.colour);
  hasher.add(stroke.opacity);
  hasher.add(stroke.fill.has_value());
  if (stroke.fill) add_colour(hasher, *stroke.fill);
  hasher.add(stroke.ends);
}

}  // namespace

std::size_t Drawing::stroke_count() const {
  std::size_t count = 0;
  for (const Layer& layer : layers) count += layer.strokes.size();
  return count;
}

const Stroke* Drawing::find(StrokeId id) const {
  for (const Layer& layer : layers)
    for (const StrokePointer& stroke : layer.strokes)
      if (stroke->id == id) return stroke.get();
  return nullptr;
}

Bounds2 Drawing::bounds() const {
  Bounds2 box;
  for (const Layer& layer : layers) {
    for (const StrokePointer& stroke : layer.strokes) {
      if (stroke->curve.segments.empty()) continue;
      const Bounds2 line = stroke->curve.bounds();
      const Vector2 beside = Vector2::Constant(0.5 * stroke->curve.widest());
      box.extend(Bounds2(line.min() - beside, line.max() + beside));
    }
  }
  return box;
}

std::uint64_t hash_of(const Drawing& drawing) {
  world::Hasher hasher;
  hasher.add(drawing.size);
  hasher.add(drawing.layers.size());
  for (const Layer& layer : drawing.layers) {
    hasher.add(layer.id.value);
    hasher.add(layer.name);
    hasher.add(layer.visible);
    hasher.add(layer.locked);
    hasher.add(layer.strokes.size());
    for (const StrokePointer& stroke : layer.strokes) add_stroke(hasher, *stroke);
  }
  return hasher.value();
}

}  // namespace icome::drawing
