#include "sketch/tools/pick.h"

#include <cmath>

#include "sketch/tools/selection.h"

namespace icome::sketch {
namespace {

constexpr int kPiecesOfSegment = 16;

bool goes_around(const Curve& curve, const Vector2& point) {
  if (!curve.bounds().contains(point)) return false;
  std::vector<Vector2> line;
  for (const CubicBezier& segment : curve.segments)
    for (int i = 0; i < kPiecesOfSegment; ++i) line.push_back(segment.at(double(i) / kPiecesOfSegment));
  line.push_back(curve.segments.back().points[3]);
  return is_inside(point, line, InsideRule::NonZero);
}

}  // namespace

std::optional<StrokeId> enclosing(const Drawing& drawing, const Vector2& point) {
  for (auto layer = drawing.layers.rbegin(); layer != drawing.layers.rend(); ++layer) {
    if (!can_change(*layer)) continue;
    for (auto stroke = layer->strokes.rbegin(); stroke != layer->strokes.rend(); ++stroke)
      if (goes_around((*stroke)->curve, point)) return (*stroke)->id;
  }
  return std::nullopt;
}

StrokeIndex::StrokeIndex(const Drawing& drawing) {
  std::vector<CubicBezier> curves;
  for (const Layer& layer : drawing.layers) {
    if (!can_change(layer)) continue;
    for (const StrokePointer& stroke : layer.strokes) {
      for (std::size_t i = 0; i < stroke->curve.segments.size(); ++i) {
        segments_.push_back({stroke->id, i});
        curves.push_back(stroke->curve.segments[i]);
      }
    }
  }
  index_ = geometry::CurveIndex(curves);
}

std::optional<Pick> StrokeIndex::nearest(const Vector2& point, double within) const {
  geometry::CurveIndex::Nearest found;
  if (!index_.nearest(point, within, found)) return std::nullopt;
  const Segment& segment = segments_[found.curve];
  return Pick{segment.stroke, double(segment.number) + found.on_curve.t, found.on_curve.point,
              std::sqrt(found.on_curve.distance_squared)};
}

}  // namespace icome::sketch
