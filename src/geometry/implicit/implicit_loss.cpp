#include "geometry/implicit/implicit_loss.h"

#include "base/random.h"
#include "geometry/tree/triangle_tree.h"

namespace icome::geometry {

std::optional<Vector3> place_that_mesh_lacks(const ImplicitSurface& surface, double time,
                                             const TriangleMesh& mesh, double reach) {
  constexpr int kPlaces = 10'000;
  const Bounds box = surface.bounds();
  const TriangleTree triangles(mesh);
  base::Random random(3);
  for (int i = 0; i < kPlaces; ++i) {
    const Vector3 share(random.uniform(0.0, 1.0), random.uniform(0.0, 1.0), random.uniform(0.0, 1.0));
    const Vector3 place = box.min() + share.cwiseProduct(box.sizes());
    if (!surface.inside(place, time)) continue;
    if (!triangles.nearest(place, reach) && !triangles.encloses(place)) return place;
  }
  return std::nullopt;
}

}  // namespace icome::geometry
