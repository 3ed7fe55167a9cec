#include "sketch/tools/connect.h"

#include <cmath>

#include "sketch/tools/pick.h"

namespace icome::sketch {
namespace {

constexpr double kSeamTurn = 0.6;  // rad, up to which ends that meet are meant to go on into each other

/// Gives both ends of a closed curve one direction, where they nearly have it.
void smooth_seam(Curve& ring) {
  const Vector2 arrives = ring.segments.back().end_direction();
  const Vector2 leaves = ring.segments.front().start_direction();
  const double turn = std::atan2(arrives.x() * leaves.y() - arrives.y() * leaves.x(), arrives.dot(leaves));
  const Vector2 both = arrives + leaves;
  if (std::abs(turn) > kSeamTurn || both.isZero()) return;
  const Vector2 way = both.normalized();
  auto& first = ring.segments.front().points;
  auto& last = ring.segments.back().points;
  first[1] = first[0] + (first[1] - first[0]).norm() * way;
  last[2] = last[3] - (last[3] - last[2]).norm() * way;
}

}  // namespace

std::optional<StrokeEnd> nearest_end(const Drawing& drawing, const Vector2& point, double within,
                                     const std::optional<StrokeEnd>& except) {
  std::optional<StrokeEnd> nearest;
  double least = within;
  for (const Layer& layer : drawing.layers) {
    if (!can_change(layer)) continue;
    for (const StrokePointer& stroke : layer.strokes) {
      if (stroke->curve.closed) continue;
      for (const bool is_last : {false, true}) {
        if (except && except->stroke == stroke->id && except->is_last == is_last) continue;
        const auto& segments = stroke->curve.segments;
        const Vector2 place = is_last ? segments.back().points[3] : segments.front().points[0];
        const double distance = (place - point).norm();
        if (distance >= least) continue;
        least = distance;
        nearest = StrokeEnd{stroke->id, is_last, place};
      }
    }
  }
  return nearest;
}

Curve end_moved(const Curve& curve, bool last, const Vector2& to) {
  Curve moved = curve;
  auto& points = (last ? moved.segments.back() : moved.segments.front()).points;
  const Vector2 by = to - (last ? points[3] : points[0]);
  points[last ? 3 : 0] = to;
  points[last ? 2 : 1] += by;
  return moved;
}

Curve closed(const Curve& curve, double within) {
  const Vector2& start = curve.segments.front().points[0];
  const Vector2& end = curve.segments.back().points[3];
  if ((end - start).norm() >= within) {
    Curve ring = curve;
    ring.closed = true;
    ring.segments.push_back(CubicBezier::line(end, start));
    if (!ring.widths.empty())
      ring.widths.push_back(
          {curve.end(), ring.widths.back().to_width, ring.end(), ring.widths.front().from_width});
    return ring;
  }
  const Vector2 middle = 0.5 * (start + end);
  Curve ring = end_moved(end_moved(curve, false, middle), true, middle);
  ring.closed = true;
  smooth_seam(ring);
  return ring;
}

Curve chained(const Curve& first, const Curve& second) {
  const Vector2 middle = 0.5 * (first.segments.back().points[3] + second.segments.front().points[0]);
  Curve chain = end_moved(first, true, middle);
  const Curve rest = end_moved(second, false, middle);
  const double shift = chain.end();
  chain.segments.insert(chain.segments.end(), rest.segments.begin(), rest.segments.end());
  if (chain.widths.empty() && !rest.widths.empty()) chain.widths.push_back({0.0, 0.0, shift, 0.0});
  for (const WidthSegment& piece : rest.widths)
    chain.widths.push_back({piece.from + shift, piece.from_width, piece.to + shift, piece.to_width});
  if (rest.widths.empty() && !chain.widths.empty()) chain.widths.push_back({shift, 0.0, chain.end(), 0.0});
  return chain;
}

}  // namespace icome::sketch
