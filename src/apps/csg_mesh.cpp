#include "apps/csg_mesh.h"

#include "geometry/csg_solid.h"

namespace icome::apps {
namespace {

using base::Vector3;
using geometry::CsgSolid;
using geometry::SurfacePoint;

/// Where the surface lies between a point inside and one outside, by halving: for crossings that rounding
/// hides from the exact search, as where faces of two operands touch.
SurfacePoint halved_crossing(const CsgSolid& solid, Vector3 inside, Vector3 outside) {
  const Vector3 normal = (outside - inside).normalized();
  constexpr int kHalvings = 50;  // from there on doubles tell nothing apart
  for (int i = 0; i < kHalvings; ++i) {
    const Vector3 middle = (inside + outside) / 2;
    (solid.inside(middle) ? inside : outside) = middle;
  }
  return {(inside + outside) / 2, normal};
}

bool has_faces_near(const CsgSolid& solid, const geometry::Bounds& box) {
  bool found = false;
  const Vector3 centre = box.center();
  solid.near(centre, centre, box.sizes().norm() / 2, 0.0, [&](std::uint32_t, const geometry::Bounds&) {
    found = true;
    return false;
  });
  return found;
}

}  // namespace

base::Result<geometry::ContourMesh> mesh_of(const geometry::CsgTree& tree,
                                            const geometry::ContourOptions& options) {
  const CsgSolid solid(tree);
  geometry::SampledSolid sampled;
  sampled.bounds = solid.bounds();
  sampled.inside = [&](const Vector3& point) { return solid.inside(point); };
  sampled.crossing = [&](const Vector3& a, const Vector3& b) {
    const auto found = solid.crossing(a, b);
    return found ? *found : halved_crossing(solid, a, b);
  };
  sampled.may_cross = [&](const geometry::Bounds& box) { return has_faces_near(solid, box); };
  return geometry::contour(sampled, options);
}

}  // namespace icome::apps
