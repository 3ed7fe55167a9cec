#include "world/mesh_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

#include "world/hasher.h"

namespace icome::world {
namespace {

void add_mesh(Hasher& hasher, const geometry::TriangleMesh& mesh) {
  hasher.add(mesh.positions.size());
  for (const Vector3& position : mesh.positions) hasher.add(position);
  hasher.add(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) hasher.add(vertex);
  }
}

std::size_t mesh_bytes(const geometry::TriangleMesh& mesh) {
  return mesh.positions.capacity() * sizeof(Vector3) +
         mesh.triangles.capacity() * sizeof(geometry::TriangleMesh::Triangle);
}

base::Result<void> check_moves(std::size_t count, std::span<const std::uint32_t> vertices,
                               std::span<const Vector3> positions) {
  if (vertices.size() != positions.size()) return base::fail("Every vertex to move needs one position.");
  std::unordered_set<std::uint32_t> seen;
  for (const std::uint32_t vertex : vertices) {
    if (vertex >= count)
      return base::fail(fmt::format("The shape has {} vertices, there is no vertex {}.", count, vertex));
    if (!seen.insert(vertex).second) return base::fail(fmt::format("Vertex {} is moved twice.", vertex));
  }
  if (!std::all_of(positions.begin(), positions.end(), [](const Vector3& it) { return it.allFinite(); }))
    return base::fail("Vertices must stay at finite places.");
  return {};
}

template <typename Shape>
base::Result<MovedVertices> moved(std::shared_ptr<Shape> copy, geometry::TriangleMesh& mesh,
                                  std::span<const std::uint32_t> vertices,
                                  std::span<const Vector3> positions) {
  if (const auto good = check_moves(mesh.positions.size(), vertices, positions); !good)
    return tl::unexpected(good.error());
  MovedVertices result;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    result.before.push_back(std::exchange(mesh.positions[vertices[i]], positions[i]));
  result.shape = std::move(copy);
  return result;
}

}  // namespace

std::uint64_t MeshGeometry::hash() const {
  Hasher hasher;
  hasher.add(kind());
  add_mesh(hasher, mesh);
  hasher.add(texture_coordinates.size());
  for (const auto& corners : texture_coordinates) {
    for (const Vector2& corner : corners) hasher.add(corner);
  }
  hasher.add(normals.size());
  for (const auto& corners : normals) {
    for (const Vector3& corner : corners) hasher.add(corner);
  }
  hasher.add(colours.size());
  for (const auto& corners : colours) {
    for (const Colour& corner : corners) {
      for (const float part : corner) hasher.add(double(part));
    }
  }
  return hasher.value();
}

std::size_t MeshGeometry::bytes() const {
  return sizeof(*this) + mesh_bytes(mesh) + texture_coordinates.capacity() * sizeof(texture_coordinates[0]) +
         normals.capacity() * sizeof(normals[0]) + colours.capacity() * sizeof(colours[0]);
}

std::uint64_t LoopGeometry::hash() const {
  Hasher hasher;
  hasher.add(kind());
  add_mesh(hasher, control.mesh);
  hasher.add(control.creases.size());
  for (const auto& [one, other] : control.creases) {
    hasher.add(one);
    hasher.add(other);
  }
  hasher.add(control.corners.size());
  for (const std::uint32_t corner : control.corners) hasher.add(corner);
  return hasher.value();
}

std::size_t LoopGeometry::bytes() const {
  return sizeof(*this) + mesh_bytes(control.mesh) + control.creases.capacity() * sizeof(control.creases[0]) +
         control.corners.capacity() * sizeof(control.corners[0]);
}

base::Result<MovedVertices> move_vertices(const Geometry& shape, std::span<const std::uint32_t> vertices,
                                          std::span<const Vector3> positions) {
  if (const auto* it = dynamic_cast<const MeshGeometry*>(&shape)) {
    auto copy = std::make_shared<MeshGeometry>(*it);
    return moved(copy, copy->mesh, vertices, positions);
  }
  if (const auto* it = dynamic_cast<const LoopGeometry*>(&shape)) {
    auto copy = std::make_shared<LoopGeometry>(*it);
    return moved(copy, copy->control.mesh, vertices, positions);
  }
  return base::fail(fmt::format("A shape of the kind \"{}\" has no vertices to move.", shape.kind()));
}

}  // namespace icome::world
