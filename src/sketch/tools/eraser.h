#pragma once
#include <span>

#include "sketch/drawn.h"

namespace icome::sketch {

/// Parts of a curve from one place to another.
struct CurvePart {
  double from;
  double to;
};

/// The parts of a curve that are no nearer to a line of straight pieces than `distance` (m), in order, found
/// to a thousandth of it. Of a closed curve the part over its start is the last, and its `to` beyond end().
std::vector<CurvePart> parts_beside(const Curve& curve, std::span<const Vector2> line, double distance);

/// The edit that an eraser of this radius (m) makes on its way: curve and width segments are cut where it
/// passes over the middle of the line, and the rest stays as it is, as strokes of their own; or the whole
/// strokes that it touches. Layers that are hidden or locked keep all. Parts get ids from `next_id` on.
DrawingEdit erased(const Drawing& drawing, std::span<const Vector2> way, double radius, bool whole_strokes,
                   std::uint64_t& next_id);

/// The open curve that a closed one is when it is cut at `place` and begins there.
Curve opened_at(const Curve& closed, double place);

}  // namespace icome::sketch
