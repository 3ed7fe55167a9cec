#include "judge.h"

#include <algorithm>

namespace icome::benchmarks {
namespace {

/// Distance to the surface, m, negative inside.
double signed_distance(const EmbreeMesh& mesh, const Vector3& position) {
  const double distance = (mesh.nearest(position) - position).norm();
  const bool outside = mesh.first_hit(Vector3::Zero(), position).has_value();
  return outside ? distance : -distance;
}

}  // namespace

Faults judge(const EmbreeMesh& mesh, double tip_radius, const std::vector<Vector3>& tips,
             const std::vector<Vector3>& scps) {
  Faults faults;
  for (std::size_t i = 0; i < tips.size(); ++i) {
    if (signed_distance(mesh, scps[i]) < tip_radius - kPop) ++faults.pops;
    const double apart = (scps[i] - tips[i]).norm();
    if (apart <= kStick) continue;
    const double way_out = std::max(0.0, tip_radius - signed_distance(mesh, tips[i]));
    if (apart > way_out + kStick) ++faults.sticks;
  }
  return faults;
}

}  // namespace icome::benchmarks
