#include "interaction/shaping/point_drag.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>

#include "geometry/mesh/mesh_check.h"
#include "interaction/operations/shapes/shape_change.h"
#include "world/shape/mesh_geometry.h"

namespace icome::interaction {
namespace {

using base::Affine3;
using base::fail;
using base::Result;
using geometry::SoftWeight;
using geometry::TriangleMesh;

/// Corner normals of meshes with more triangles are bent in the last step only.
constexpr std::size_t kMostBentLive = 10'000;

const world::MeshGeometry* with_normals(const world::Geometry& shape) {
  const auto* mesh = dynamic_cast<const world::MeshGeometry*>(&shape);
  return mesh && !mesh->normals.empty() ? mesh : nullptr;
}

bool bends_live(const world::Geometry& shape) {
  const world::MeshGeometry* mesh = with_normals(shape);
  return mesh && mesh->mesh.triangles.size() <= kMostBentLive;
}

std::vector<Vector3> moved_places(const PointDrag::Followers& it, const Vector3& offset) {
  const Vector3 way = it.shape_from_world * offset;
  std::vector<Vector3> places;
  places.reserve(it.starts.size());
  for (std::size_t i = 0; i < it.starts.size(); ++i) places.push_back(it.starts[i] + it.weights[i] * way);
  return places;
}

world::Edit moved_vertices(const PointDrag::Followers& it, const Vector3& offset) {
  return world::MoveVertices{it.geometry, it.vertices, moved_places(it, offset)};
}

/// Moves and bends a shape with normals. Places that are not finite bend nothing; the world refuses them.
world::Edit bent_shape(const PointDrag::Followers& it, const Vector3& offset) {
  const std::vector<Vector3> places = moved_places(it, offset);
  if (!std::ranges::all_of(places, [](const Vector3& place) { return place.allFinite(); }))
    return moved_vertices(it, offset);
  const auto& before = static_cast<const world::MeshGeometry&>(*it.before);
  std::vector<Vector3> all = before.mesh.positions;
  for (std::size_t i = 0; i < places.size(); ++i) all[it.vertices[i]] = places[i];
  return world::ReplaceGeometry{it.geometry, with_positions(before, std::move(all))};
}

world::Edit as_one_edit(std::vector<world::Edit> edits) {
  if (edits.size() == 1) return std::move(edits.front());
  return world::EditGroup{std::move(edits)};
}

/// The seeds and all other vertices that stand in the same places.
std::vector<std::uint32_t> with_doubles(const TriangleMesh& mesh, const std::vector<std::uint32_t>& seeds) {
  std::vector<std::uint32_t> all;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const auto here = [&](std::uint32_t seed) { return mesh.positions[seed] == mesh.positions[v]; };
    if (std::ranges::any_of(seeds, here)) all.push_back(v);
  }
  return all;
}

Result<std::vector<SoftWeight>> part_weights(const TriangleMesh& mesh,
                                             const std::vector<std::uint32_t>& seeds,
                                             const Affine3& world_from_shape,
                                             const geometry::SoftSelection& soft) {
  if (soft.radius == 0.0) return geometry::soft_weights(mesh, seeds, soft);
  TriangleMesh in_world = mesh;  // distances as they look, also where the object is stretched
  for (Vector3& position : in_world.positions) position = world_from_shape * position;
  return geometry::soft_weights(in_world, seeds, soft);
}

std::string drag_name(PartKind kind, const std::string& object) {
  const char* what = kind == PartKind::Vertex ? "vertex" : kind == PartKind::Edge ? "edge" : "face";
  return object.empty() ? fmt::format("Drag {}", what) : fmt::format("Drag {} of {}", what, object);
}

}  // namespace

world::Edit PointDrag::by(const Vector3& offset) const {
  std::vector<world::Edit> edits;
  for (const Followers& it : followers_)
    edits.push_back(bends_live(*it.before) ? bent_shape(it, offset) : moved_vertices(it, offset));
  return as_one_edit(std::move(edits));
}

std::optional<world::Edit> PointDrag::last(const Vector3& offset) const {
  std::vector<world::Edit> edits;
  for (const Followers& it : followers_) {
    if (with_normals(*it.before) && !bends_live(*it.before)) edits.push_back(bent_shape(it, offset));
  }
  if (edits.empty()) return std::nullopt;
  return as_one_edit(std::move(edits));
}

Result<PointDrag> drag_part(const world::World& world, world::ObjectId id, const MeshPart& part,
                            const geometry::SoftSelection& soft) {
  const auto shape = draggable_shape(world, id);
  if (!shape) return tl::unexpected(shape.error());
  const TriangleMesh& mesh = *draggable_mesh(**shape);
  if (part.vertices.empty()) return fail("Nothing is taken hold of: name a vertex, an edge or a face.");
  if (const auto good = geometry::check_chosen(part.vertices, mesh.positions.size(), "vertex"); !good)
    return tl::unexpected(good.error());
  const world::PhysicalObject& object = *world.find(id);
  const Affine3 world_from_shape = world_from_object(world, id);
  PointDrag::Followers it{.geometry = object.geometry, .before = *shape};
  it.shape_from_world = world_from_shape.linear().inverse();
  if (!it.shape_from_world.allFinite())
    return fail(fmt::format("'{}' is squashed flat: give it a size along all axes first.", object.name));
  const auto weights = part_weights(mesh, with_doubles(mesh, part.vertices), world_from_shape, soft);
  if (!weights) return tl::unexpected(weights.error());
  for (const SoftWeight& follows : *weights) {
    it.vertices.push_back(follows.vertex);
    it.starts.push_back(mesh.positions[follows.vertex]);
    it.weights.push_back(follows.weight);
  }
  return PointDrag({std::move(it)}, drag_name(part.kind, object.name));
}

}  // namespace icome::interaction
