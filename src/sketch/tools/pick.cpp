#include "sketch/tools/pick.h"

#include <cmath>

namespace icome::sketch {

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
