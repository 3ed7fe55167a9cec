#pragma once
#include <optional>
#include <vector>

#include "geometry/curve/curve_index.h"
#include "sketch/drawn.h"

namespace icome::sketch {

/// A place of a stroke.
struct Pick {
  StrokeId stroke;
  double place;     ///< along its curve, counted in segments
  Vector2 point;    ///< m
  double distance;  ///< m, from what was asked about
};

/// Finds the stroke that is nearest to a pen (thesis 4.5.3) among those that tools may change: of layers that
/// are visible and not locked. Made of a drawing as it is at that time.
class StrokeIndex {
 public:
  explicit StrokeIndex(const Drawing& drawing);

  /// The nearest place less than `within` (m) away from the middle of a line. Real-time safe.
  std::optional<Pick> nearest(const Vector2& point, double within) const;

 private:
  struct Segment {
    StrokeId stroke;
    std::size_t number;
  };

  std::vector<Segment> segments_;
  geometry::CurveIndex index_;
};

/// The topmost stroke that goes around a point (non-zero rule), among those that tools may change.
std::optional<StrokeId> enclosing(const Drawing& drawing, const Vector2& point);

/// May tools change the strokes of this layer?
inline bool can_change(const Layer& layer) { return layer.visible && !layer.locked; }

}  // namespace icome::sketch
