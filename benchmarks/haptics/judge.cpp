#include "judge.h"

#include <algorithm>

namespace icome::benchmarks {
namespace {

/// Signed distance to the surface, m, negative inside.
double signed_distance(const EmbreeMesh& mesh, const Vector3& position) {
  const double distance = (mesh.nearest(position) - position).norm();
  const bool outside = mesh.first_hit(Vector3::Zero(), position).has_value();
  return outside ? distance : -distance;
}

/// Does a ray from there to far away cross the mesh an odd number of times?
bool crosses_oddly(const EmbreeMesh& mesh, const Vector3& from, const Vector3& direction) {
  constexpr double kFar = 10.0;   // m, beyond every mesh that is measured
  constexpr double kPast = 1e-7;  // m, beyond a crossing: the resolution of single precision here
  const Vector3 end = from + kFar * direction;
  Vector3 at = from;
  bool odd = false;
  while (const auto share = mesh.first_hit(at, end)) {
    odd = !odd;
    at += *share * (end - at) + kPast * direction;
  }
  return odd;
}

bool is_inside(const EmbreeMesh& mesh, const Vector3& position) {
  const Vector3 directions[] = {Vector3(0.36, 0.48, 0.8), Vector3(-0.6, 0.64, 0.48),
                                Vector3(0.48, -0.6, -0.64)};
  int votes = 0;
  for (const Vector3& direction : directions) votes += crosses_oddly(mesh, position, direction);
  return votes >= 2;
}

}  // namespace

Faults judge_closed(const EmbreeMesh& mesh, double tip_radius, const std::vector<Vector3>& scps) {
  Faults faults;
  for (const Vector3& scp : scps) {
    const double distance = (mesh.nearest(scp) - scp).norm();
    if (distance < tip_radius - kPop || (distance > kPop && is_inside(mesh, scp))) ++faults.pops;
  }
  return faults;
}

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
