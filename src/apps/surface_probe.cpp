#include "apps/surface_probe.h"

#include <limits>
#include <optional>

namespace icome::apps {
namespace {

using base::Vector3;
using geometry::MeshHit;

// How much of a surface must face one way for it to count as a sheet: 1 is flat, a half sphere has 0.5.
constexpr double kSheet = 0.7;

// Twice the triangle's area as a vector along its normal.
Vector3 area_vector(const geometry::TriangleMesh& mesh, std::size_t triangle) {
  const Vector3& first = mesh.corner(triangle, 0);
  return (mesh.corner(triangle, 1) - first).cross(mesh.corner(triangle, 2) - first);
}

ProbedPoint probed(const TouchModel& model, const MeshHit& hit, const Vector3& from) {
  Vector3 normal = area_vector(*model.mesh, hit.triangle).normalized();
  if (!model.closed && normal.dot(from - hit.point) < 0.0) normal = -normal;
  return {hit.point, normal};
}

}  // namespace

SurfaceProbe::SurfaceProbe(const std::vector<TouchModel>& models) : models_(models) {
  for (const TouchModel& model : models_) bounds_.extend(model.tree->bounds());
  find_front();
}

void SurfaceProbe::find_front() {
  Vector3 sum = Vector3::Zero();
  double area = 0.0;
  for (const TouchModel& model : models_) {
    if (is_half_space(model)) {
      front_ = Vector3::UnitZ();
      return;
    }
    for (std::size_t i = 0; i < model.mesh->triangles.size(); ++i) {
      const Vector3 part = area_vector(*model.mesh, i);
      sum += part;
      area += part.norm();
    }
  }
  if (sum.norm() > kSheet * area) front_ = sum.normalized();
}

ProbedPoint SurfaceProbe::look(const Vector3& from, const Vector3& to, const Vector3& near) const {
  std::optional<ProbedPoint> best;
  double first = std::numeric_limits<double>::infinity();
  for (const TouchModel& model : models_) {
    const std::optional<MeshHit> hit = model.tree->first_hit(from, to);
    if (!hit || hit->parameter >= first) continue;
    first = hit->parameter;
    best = probed(model, *hit, from);
  }
  return best ? *best : nearest(near, from);
}

ProbedPoint SurfaceProbe::nearest(const Vector3& point, const Vector3& from) const {
  ProbedPoint best{point, Vector3::UnitZ()};
  double limit = std::numeric_limits<double>::infinity();
  for (const TouchModel& model : models_) {
    const std::optional<MeshHit> hit = model.tree->nearest(point, limit);
    if (!hit || hit->parameter >= limit) continue;
    limit = hit->parameter;
    best = probed(model, *hit, from);
  }
  return best;
}

}  // namespace icome::apps
