#pragma once
#include <optional>

#include "sketch/drawn.h"

namespace icome::sketch {

/// An end of a stroke that is not closed.
struct StrokeEnd {
  StrokeId stroke;
  bool is_last;   ///< its end, else its start
  Vector2 place;  ///< m
};

/// The nearest end of a stroke, less than `within` (m) away, that tools may change; `except` one end, if
/// given.
std::optional<StrokeEnd> nearest_end(const Drawing& drawing, const Vector2& point, double within,
                                     const std::optional<StrokeEnd>& except = {});

/// The curve with its start or end brought to a place, and the control point beside it moved along.
Curve end_moved(const Curve& curve, bool last, const Vector2& to);

/// The closed curve of an open one (thesis 4.5.5, connect curves): ends that are less than `within` (m) apart
/// are brought together halfway between them, and turn into each other where they nearly do; others are
/// joined by a straight segment.
Curve closed(const Curve& curve, double within);

/// One curve of two: the end of the first and the start of the second are brought together halfway between
/// them. Precondition: both are open.
Curve chained(const Curve& first, const Curve& second);

}  // namespace icome::sketch
