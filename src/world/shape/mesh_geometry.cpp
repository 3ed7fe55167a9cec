#include "world/shape/mesh_geometry.h"

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

tl::unexpected<base::Error> no_vertices(const Geometry& shape) {
  return base::fail(fmt::format("A shape of the kind \"{}\" has no vertices to move.", shape.kind()));
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
  // Shapes made by hand keep the hash that they had before there were recipes.
  if (!recipe.empty()) hasher.add(std::string_view(recipe));
  return hasher.value();
}

std::size_t MeshGeometry::bytes() const {
  return sizeof(*this) + mesh_bytes(mesh) + texture_coordinates.capacity() * sizeof(texture_coordinates[0]) +
         normals.capacity() * sizeof(normals[0]) + colours.capacity() * sizeof(colours[0]) + recipe.size();
}

std::string_view recipe_of(const Geometry& shape) {
  const auto* const mesh = dynamic_cast<const MeshGeometry*>(&shape);
  return mesh ? std::string_view(mesh->recipe) : std::string_view();
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

base::Result<std::vector<Vector3>> move_vertices_of(Geometry& shape, std::span<const std::uint32_t> vertices,
                                                    std::span<const Vector3> positions) {
  auto* const loop = dynamic_cast<LoopGeometry*>(&shape);
  auto* const mesh = dynamic_cast<MeshGeometry*>(&shape);
  if (!loop && !mesh) return no_vertices(shape);
  std::vector<Vector3>& all = loop ? loop->control.mesh.positions : mesh->mesh.positions;
  if (const auto good = check_moves(all.size(), vertices, positions); !good)
    return tl::unexpected(good.error());
  std::vector<Vector3> before;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    before.push_back(std::exchange(all[vertices[i]], positions[i]));
  loop ? loop->forget_bounds() : mesh->forget_bounds();
  if (mesh) mesh->recipe.clear();
  return before;
}

base::Result<MovedVertices> move_vertices(const Geometry& shape, std::span<const std::uint32_t> vertices,
                                          std::span<const Vector3> positions) {
  std::shared_ptr<Geometry> copy;
  if (const auto* it = dynamic_cast<const MeshGeometry*>(&shape)) copy = std::make_shared<MeshGeometry>(*it);
  if (const auto* it = dynamic_cast<const LoopGeometry*>(&shape)) copy = std::make_shared<LoopGeometry>(*it);
  if (!copy) return no_vertices(shape);
  auto before = move_vertices_of(*copy, vertices, positions);
  if (!before) return tl::unexpected(before.error());
  return MovedVertices{std::move(copy), std::move(*before)};
}

}  // namespace icome::world
