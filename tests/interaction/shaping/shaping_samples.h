#pragma once
#include <gtest/gtest.h>

#include "interaction/shaping/shaping.h"
#include "world/edit/edit.h"
#include "world/sample_world.h"

namespace icome::interaction {

/// A square sheet of side 1 in the plane z = 0 from the origin on, of cells^2 squares; the vertex at (i, j)
/// is number j (cells + 1) + i.
inline geometry::TriangleMesh sheet_of(std::uint32_t cells) {
  geometry::TriangleMesh mesh;
  for (std::uint32_t j = 0; j <= cells; ++j) {
    for (std::uint32_t i = 0; i <= cells; ++i)
      mesh.positions.emplace_back(i / double(cells), j / double(cells), 0);
  }
  for (std::uint32_t j = 0; j < cells; ++j) {
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t at = j * (cells + 1) + i, above = at + cells + 1;
      mesh.triangles.push_back({at, at + 1, above + 1});
      mesh.triangles.push_back({at, above + 1, above});
    }
  }
  return mesh;
}

/// Turned, stretched unevenly and mirrored.
inline base::Affine3 askew(double number) {
  return base::Affine3(Eigen::Translation3d(number, 2.0, -number)) *
         Eigen::AngleAxisd(number, base::Vector3(1.0, number, 2.0).normalized()) *
         Eigen::Scaling(0.5, number, -2.0);
}

/// A world in which one object, askew and below another, is made of a mesh.
struct ShapedWorld {
  explicit ShapedWorld(const world::GeometryPointer& shape) {
    const auto above = world::add_object(world, ids, "above", nullptr, {}, askew(1.5));
    thing = world::add_object(world, ids, "thing", shape, above, askew(0.7));
  }
  explicit ShapedWorld(const geometry::TriangleMesh& mesh)
      : ShapedWorld(std::make_shared<world::MeshGeometry>(mesh)) {}

  const world::Geometry& shape() const { return *world.find(world.find(thing)->geometry)->shape; }
  const geometry::TriangleMesh& mesh() const { return *draggable_mesh(shape()); }
  base::Affine3 place() const { return world_from_object(world, thing); }
  /// World frame, m.
  base::Vector3 vertex(std::uint32_t v) const { return place() * mesh().positions[v]; }
  std::vector<base::Vector3> vertices() const {
    std::vector<base::Vector3> all;
    for (std::uint32_t v = 0; v < mesh().positions.size(); ++v) all.push_back(vertex(v));
    return all;
  }
  PointDrag drag(std::vector<std::uint32_t> vertices, const geometry::SoftSelection& soft = {}) const {
    auto made = drag_part(world, thing, {.kind = PartKind::Vertex, .vertices = std::move(vertices)}, soft);
    EXPECT_TRUE(made) << (made ? "" : made.error().message);
    return std::move(*made);
  }

  world::World world;
  world::IdSource ids;
  world::ObjectId thing;
};

}  // namespace icome::interaction
