#include "bench_session.h"

#include <cmath>

#include "world/edit/edit.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::benchmarks {

Added add_shape(session::Session& session, world::GeometryPointer shape, const base::Affine3& place) {
  const Added added{session.ids().next<world::ObjectId>(), session.ids().next<world::GeometryId>(),
                    session.ids().next<world::MaterialId>()};
  world::PhysicalObject object;
  object.name = "plate";
  object.geometry = added.geometry;
  object.material = added.material;
  object.parent_from_object = place;
  must(session.history().perform(world::EditGroup{{world::CreateMaterial{added.material, {}},
                                                   world::CreateGeometry{added.geometry, std::move(shape)},
                                                   world::CreateObject{added.object, 0, object}}},
                                 "Add"));
  session.settle();
  return added;
}

world::GeometryPointer thick_plate() {
  return std::make_shared<world::PrimitiveGeometry>(geometry::Box{base::Vector3(0.2, 0.01, 0.2)});
}

world::GeometryPointer large_plate(int squares) {
  geometry::TriangleMesh mesh;
  const double step = 0.4 / squares;
  for (int z = 0; z <= squares; ++z) {
    for (int x = 0; x <= squares; ++x)
      mesh.positions.emplace_back(x * step - 0.2, 0.0005 * std::sin(0.7 * x) * std::cos(0.9 * z),
                                  z * step - 0.2);
  }
  const auto at = [&](int x, int z) { return std::uint32_t(z * (squares + 1) + x); };
  for (int z = 0; z < squares; ++z) {
    for (int x = 0; x < squares; ++x) {
      mesh.triangles.push_back({at(x, z), at(x, z + 1), at(x + 1, z)});
      mesh.triangles.push_back({at(x + 1, z), at(x, z + 1), at(x + 1, z + 1)});
    }
  }
  return std::make_shared<world::MeshGeometry>(std::move(mesh));
}

base::Affine3 lowered(double metres) { return base::Affine3(Eigen::Translation3d(0.0, -metres, 0.0)); }

}  // namespace icome::benchmarks
