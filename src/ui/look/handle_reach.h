#pragma once
// How near the pointer must be to a handle that is drawn over a picture to take hold of it.
#include <QPointF>
#include <cmath>

namespace icome::ui {

/// Pixels around a handle that count as it.
inline constexpr double kHandleReach = 9.0;

/// In pixels.
inline double distance(QPointF one, QPointF other) {
  return std::hypot(one.x() - other.x(), one.y() - other.y());
}

}  // namespace icome::ui
