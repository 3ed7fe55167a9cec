// After Moeller (1997): compares the ranges that the triangles cut out of the line that their planes share.
#include "world/collision/triangle_meeting.h"

#include <algorithm>
#include <array>
#include <limits>

namespace icome::world {
namespace {

using base::Vector3;
using geometry::Corners;

Vector3 unit_normal(const Corners& corners) {
  return (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
}

/// The heights of a triangle's corners over a plane; heights within the rounding are zero.
struct Heights {
  std::array<double, 3> of;
  bool above = false, below = false;

  Heights(const Corners& corners, const Vector3& foot, const Vector3& normal, double rounding) {
    for (int i = 0; i < 3; ++i) {
      const double height = normal.dot(corners[i] - foot);
      of[i] = std::abs(height) <= rounding ? 0.0 : height;
      above = above || of[i] > 0.0;
      below = below || of[i] < 0.0;
    }
  }

  bool on_one_side() const { return above != below && of[0] != 0.0 && of[1] != 0.0 && of[2] != 0.0; }
  bool flat() const { return !above && !below; }
  bool on_both_sides() const { return above && below; }
};

/// The segment in which a triangle cuts the plane; one point twice where it only touches.
std::array<Vector3, 2> cut(const Corners& corners, const Heights& heights) {
  std::array<Vector3, 6> points;
  std::size_t count = 0;
  for (int i = 0; i < 3; ++i) {
    const int next = (i + 1) % 3;
    const double a = heights.of[i], b = heights.of[next];
    if (a == 0.0) points[count++] = corners[i];
    if ((a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0))
      points[count++] = corners[i] + a / (a - b) * (corners[next] - corners[i]);
  }
  return {points[0], points[count - 1]};
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void extend(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// Length by which two ranges overlap; negative when they are apart.
double overlap(const Range& a, const Range& b) { return std::min(a.high, b.high) - std::max(a.low, b.low); }

Range range_of(const Corners& corners, const Vector3& axis, const Vector3& origin) {
  Range range;
  for (const Vector3& corner : corners) range.extend(axis.dot(corner - origin));
  return range;
}

/// Triangles in one plane: the overlap along the directions across their edges.
TriangleMeeting meeting_flat(const Corners& one, const Corners& other, const Vector3& normal,
                             const Vector3& other_normal, double rounding) {
  double least = std::numeric_limits<double>::infinity();
  for (const Corners* corners : {&one, &other}) {
    for (int i = 0; i < 3; ++i) {
      const Vector3 axis = normal.cross((*corners)[(i + 1) % 3] - (*corners)[i]).normalized();
      least = std::min(least, overlap(range_of(one, axis, one[0]), range_of(other, axis, one[0])));
    }
  }
  if (least < -rounding) return TriangleMeeting::Apart;
  if (least <= rounding) return TriangleMeeting::Touching;
  return normal.dot(other_normal) > 0.0 ? TriangleMeeting::Flush : TriangleMeeting::Touching;
}

}  // namespace

TriangleMeeting meeting(const Corners& one, const Corners& other, double rounding) {
  const Vector3 other_normal = unit_normal(other);
  const Heights heights(one, other[0], other_normal, rounding);
  if (heights.on_one_side()) return TriangleMeeting::Apart;
  const Vector3 normal = unit_normal(one);
  const Heights other_heights(other, one[0], normal, rounding);
  if (other_heights.on_one_side()) return TriangleMeeting::Apart;
  if (heights.flat() || other_heights.flat()) return meeting_flat(one, other, normal, other_normal, rounding);

  const std::array<Vector3, 2> a = cut(one, heights), b = cut(other, other_heights);
  const Vector3 along_a = a[1] - a[0], along_b = b[1] - b[0];
  const Vector3 along = along_a.squaredNorm() > along_b.squaredNorm() ? along_a : along_b;
  if (along.norm() <= rounding) {
    return (a[0] - b[0]).norm() <= 2.0 * rounding ? TriangleMeeting::Touching : TriangleMeeting::Apart;
  }
  const Vector3 axis = along.normalized();
  Range range_a, range_b;
  for (int i = 0; i < 2; ++i) {
    range_a.extend(axis.dot(a[i] - a[0]));
    range_b.extend(axis.dot(b[i] - a[0]));
  }
  const double common = overlap(range_a, range_b);
  if (common < -rounding) return TriangleMeeting::Apart;
  const bool through = heights.on_both_sides() && other_heights.on_both_sides();
  return through && common > rounding ? TriangleMeeting::Crossing : TriangleMeeting::Touching;
}

}  // namespace icome::world
