#include "world/shape/primitive_normals.h"

#include <gtest/gtest.h>

#include <string_view>

#include "world/shape/mesh_geometry.h"

namespace icome::world {
namespace {

/// The judge: the nearest point of the surface to one a little off a corner, towards the triangle's middle
/// and outwards, lies against the normal there.
TEST(PrimitiveNormals, AreThoseOfTheSurface) {
  for (const char* text : {"box:0.1x0.2x0.3", "sphere:0.1", "cylinder:0.1x0.3", "cone:0.1x0.2",
                           "cone:0.1x0.05x0.2", "cone:0x0.1x0.2", "torus:0.2x0.05", "capsule:0.1x0.2"}) {
    for (const Axis axis : {Axis::Z, Axis::Y}) {
      const PrimitiveGeometry shape(*geometry::parse_primitive(text), axis);
      const auto surface = shape.triangles(1e-4);
      ASSERT_TRUE(surface);
      const geometry::TriangleMesh& mesh = (*surface)->mesh;
      const auto normals = primitive_normals(shape, mesh);
      ASSERT_EQ(normals.size(), mesh.triangles.size());
      const base::Matrix3 own_from_shape = shape.shape_from_primitive().transpose();
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vector3 middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
        for (int k = 0; k < 3; ++k) {
          const Vector3& normal = normals[t][std::size_t(k)];
          ASSERT_NEAR(normal.norm(), 1.0, 1e-12) << text;
          const Vector3 near = mesh.corner(t, k) + 1e-4 * (middle - mesh.corner(t, k));
          const auto at = geometry::scp_from_outside(shape.primitive, own_from_shape * near);
          const bool is_tip = std::string_view(text).starts_with("cone") &&
                              (own_from_shape * mesh.corner(t, k)).head<2>().norm() < 1e-9;
          // All round a tip normals differ, by half of a facet from that of its middle.
          ASSERT_GT(normal.dot(shape.shape_from_primitive() * at.normal), is_tip ? 0.98 : 1.0 - 1e-6)
              << text << " " << mesh.corner(t, k).transpose();
        }
      }
    }
  }
}

}  // namespace
}  // namespace icome::world
