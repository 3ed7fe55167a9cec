#pragma once
#include "geometry/mesh/bent_normals.h"
#include "interaction/command_samples.h"
#include "interaction/operations/value.h"
#include "world/sample_world.h"

namespace icome::interaction {

inline geometry::TriangleMesh square_mesh(double side = 1.0) {
  geometry::TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {side, 0, 0}, {side, 0, -side}, {0, 0, -side}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// A closed cube of side 2 about the origin; vertex 4 x + 2 y + z for the upper ends of the axes.
inline geometry::TriangleMesh cube_mesh() {
  geometry::TriangleMesh mesh;
  for (int v = 0; v < 8; ++v)
    mesh.positions.emplace_back((v & 4) != 0 ? 1 : -1, (v & 2) != 0 ? 1 : -1, (v & 1) != 0 ? 1 : -1);
  mesh.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                    {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  return mesh;
}

/// The normal of each triangle at all of its corners.
inline geometry::CornerNormals flat_normals(const geometry::TriangleMesh& mesh) {
  geometry::CornerNormals normals;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3 one = mesh.corner(t, 1) - mesh.corner(t, 0), other = mesh.corner(t, 2) - mesh.corner(t, 0);
    const Vector3 normal = one.cross(other).normalized();
    normals.push_back({normal, normal, normal});
  }
  return normals;
}

/// A world of one object with that shape.
inline world::World world_of(const world::GeometryPointer& shape, const std::string& name = "thing") {
  world::World world;
  world::IdSource ids;
  world::add_object(world, ids, name, shape);
  return world;
}
inline world::World world_of(const geometry::TriangleMesh& mesh) {
  return world_of(std::make_shared<world::MeshGeometry>(mesh));
}
inline world::World world_of_loop(const geometry::ControlMesh& control) {
  return world_of(std::make_shared<world::LoopGeometry>(control));
}

inline const world::Geometry& shape_of(const OperationRunner& runner, std::string_view name = "thing") {
  const world::World& world = runner.world();
  return *world.find(world.find(named_object(world, name).value())->geometry)->shape;
}
inline const world::MeshGeometry& mesh_of(const OperationRunner& runner, std::string_view name = "thing") {
  return dynamic_cast<const world::MeshGeometry&>(shape_of(runner, name));
}
inline const geometry::ControlMesh& control_of(const OperationRunner& runner,
                                               std::string_view name = "thing") {
  return dynamic_cast<const world::LoopGeometry&>(shape_of(runner, name)).control;
}

/// Performs a command that must succeed; holds undo and redo to the world before and after it.
inline void performed_both_ways(OperationRunner& runner, std::string_view command) {
  const std::uint64_t before = hash(runner.world());
  performed(runner, command);
  const std::uint64_t after = hash(runner.world());
  performed(runner, R"({"op": "undo"})");
  EXPECT_EQ(hash(runner.world()), before) << command;
  performed(runner, R"({"op": "redo"})");
  EXPECT_EQ(hash(runner.world()), after) << command;
}

}  // namespace icome::interaction
