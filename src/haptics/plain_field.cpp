#include "haptics/plain_field.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>
#include <vector>

namespace icome::haptics {
namespace {

using base::Bounds;
using base::Vector3;

constexpr int kSamplesAcross = 4;
constexpr double kSampleStep = 1e-4;  // of the cube in which slopes are looked at
constexpr double kSafety = 1.4;       // times the steepest slope seen
constexpr std::size_t kMostCubes = 20'000;

/// A cube, and how far it is from the place that is asked about (m).
struct FieldCube {
  Vector3 centre;
  double half;
  double apart;
};

struct FartherCube {
  bool operator()(const FieldCube& one, const FieldCube& other) const { return one.apart > other.apart; }
};

/// The values of a formula at one time.
class PlainField {
 public:
  PlainField(const geometry::PlainFormula& value, const Bounds& box, double time)
      : value_(value), box_(box), time_(time) {}

  /// The nearest cubes first, halved until they are free or small.
  std::optional<Vector3> nearest(const Vector3& point, double limit, double fineness) const {
    const double steepest = kSafety * steepest_around(point, limit);
    std::priority_queue<FieldCube, std::vector<FieldCube>, FartherCube> open;
    open.push({point, limit, 0.0});
    std::optional<Vector3> found;
    double least = limit;
    for (std::size_t looks = 0; !open.empty() && open.top().apart < least - fineness && looks < kMostCubes;
         ++looks) {
      const FieldCube cube = open.top();
      open.pop();
      if (!meets_box(cube)) continue;
      // Of the part of the cube that lies in the box, which is all that the formula counts in.
      const Vector3 reach = Vector3::Constant(cube.half);
      const Vector3 low = (cube.centre - reach).cwiseMax(box_.min());
      const Vector3 high = (cube.centre + reach).cwiseMin(box_.max());
      const Vector3 middle = 0.5 * (low + high);
      const double here = value_(middle, time_);
      const double corner = 0.5 * (high - low).norm();
      if (here > steepest * corner) continue;
      if (const double distance = (middle - point).norm(); here < 0.0 && distance < least) {
        found = middle;
        least = distance;
      }
      if (corner <= fineness) continue;
      for (int i = 0; i < 8; ++i) {
        const double half = 0.5 * cube.half;
        const Vector3 centre = cube.centre + half * Vector3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
        const Vector3 over = ((centre - point).cwiseAbs() - Vector3::Constant(half)).cwiseMax(0.0);
        open.push({centre, half, over.norm()});
      }
    }
    return found;
  }

 private:
  bool meets_box(const FieldCube& cube) const {
    return ((cube.centre - box_.max()).array() <= cube.half).all() &&
           ((box_.min() - cube.centre).array() <= cube.half).all();
  }

  /// Of the values' slopes at some places of the cube, by differences.
  double steepest_around(const Vector3& point, double half) const {
    const double step = kSampleStep * half;
    double steepest = 0.0;
    for (int i = 0; i < kSamplesAcross * kSamplesAcross * kSamplesAcross; ++i) {
      const Vector3 which(i % kSamplesAcross, i / kSamplesAcross % kSamplesAcross,
                          i / (kSamplesAcross * kSamplesAcross));
      const Vector3 at = point + half * (2.0 / (kSamplesAcross - 1) * which - Vector3::Ones());
      const double here = value_(at, time_);
      Vector3 slope;
      for (int axis = 0; axis < 3; ++axis)
        slope[axis] = (value_(at + step * Vector3::Unit(axis), time_) - here) / step;
      if (slope.allFinite()) steepest = std::max(steepest, slope.norm());
    }
    return steepest;
  }

  const geometry::PlainFormula& value_;
  const Bounds& box_;
  const double time_;
};

}  // namespace

MembershipSolid plain_solid(const geometry::PlainFormula& value, const Bounds& box) {
  return {[value](const Vector3& point, double time) { return value(point, time) < 0.0; }, box,
          [value, box](const Vector3& point, double time, double limit, double fineness) {
            return PlainField(value, box, time).nearest(point, limit, fineness);
          }};
}

}  // namespace icome::haptics
