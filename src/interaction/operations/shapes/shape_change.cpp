#include "interaction/operations/shapes/shape_change.h"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/mesh/bent_normals.h"
#include "world/shape/geometry_check.h"
#include "world/shape/usual_tolerance.h"
#include "world/shape/visit_geometry.h"

namespace icome::interaction {
namespace {

using base::fail;
using base::Result;
using geometry::TriangleMesh;
using world::LoopGeometry;
using world::MeshGeometry;

Result<void> check_shape(const world::Geometry& shape) {
  std::string wrong = world::visit_geometry(
      shape, [](const MeshGeometry& it) { return world::complaint(it); },
      [](const LoopGeometry& it) { return world::complaint(it); },
      [](const world::Geometry&) { return std::string(); });
  if (!wrong.empty()) return fail(std::move(wrong));
  return {};
}

Result<void> make_triangles(ShapeChange& change, const Arguments& arguments, std::string_view wanted) {
  const std::string& name = change.world->find(change.object)->name;
  if (!arguments.flag("as_mesh"))
    return fail(
        fmt::format("'{}' is {} and {}: perform 'mesh' first, which makes triangles of it, or say "
                    "\"as_mesh\": true to do so in the same step",
                    name, kind_in_words(*change.shape), wanted));
  auto triangles = triangles_of(change, world::usual_tolerance(*change.shape));
  if (!triangles) return tl::unexpected(triangles.error());
  change.shape = std::move(*triangles);
  change.made_triangles = true;
  return {};
}

/// The shape to be edited; with `alone` a copy for the object, which the group then begins by making.
world::GeometryId own_copy(const ShapeChange& change, world::EditGroup& group, world::IdSource& ids) {
  if (!change.alone) return change.shared;
  const auto own = ids.next<world::GeometryId>();
  group.edits.push_back(world::CopyGeometry{own, change.shared});
  group.edits.push_back(world::ChooseGeometry{change.object, own});
  return own;
}

}  // namespace

Result<world::GeometryPointer> triangles_of(const ShapeChange& change, double tolerance) {
  const auto made = change.shape->triangles(tolerance);
  if (!made) return tl::unexpected(made.error());
  if ((*made)->mesh.triangles.empty())
    return fail(
        fmt::format("no triangles can be made of '{}': it is empty, or nothing of it is large enough to be "
                    "found; leave it as it is, or make a smaller solid of the part that matters",
                    change.world->find(change.object)->name));
  return world::GeometryPointer(*made);
}

Parameter object_parameter(std::string meaning) {
  return {.name = "object", .kind = ParameterKind::Object, .meaning = std::move(meaning), .required = true};
}

Parameter alone_parameter() {
  return {.name = "alone",
          .kind = ParameterKind::Flag,
          .meaning = "gives the object a shape of its own first; else its clones change with it",
          .fallback = false};
}

Parameter as_mesh_parameter() {
  return {.name = "as_mesh",
          .kind = ParameterKind::Flag,
          .meaning = "makes triangles of a shape that is none first, as 'mesh' does",
          .fallback = false};
}

Result<ShapeChange> shape_change(const world::World& world, const Arguments& arguments) {
  const world::ObjectId id = arguments.object("object");
  if (!world.find(id)->geometry)
    return fail(fmt::format("'{}' has no shape, it only holds others together: name one that has",
                            arguments.text("object")));
  return shape_change(world, id, arguments);
}

Result<ShapeChange> shape_change(const world::World& world, world::ObjectId id, const Arguments& arguments) {
  const world::PhysicalObject& object = *world.find(id);
  const world::GeometryObject* shared = world.find(object.geometry);
  if (!shared) return fail(fmt::format("'{}' has no shape of its own", object.name));
  const bool alone = shared->users > 1 && arguments.flag("alone");
  return ShapeChange{&world, id, object.geometry, shared->shape, false, alone};
}

Result<std::shared_ptr<const MeshGeometry>> mesh_to_change(ShapeChange& change, const Arguments& arguments) {
  if (!dynamic_cast<const MeshGeometry*>(change.shape.get())) {
    const auto made = make_triangles(change, arguments, "no mesh of triangles");
    if (!made) return tl::unexpected(made.error());
  }
  if (const auto good = check_shape(*change.shape); !good) return tl::unexpected(good.error());
  return std::static_pointer_cast<const MeshGeometry>(change.shape);
}

Result<const TriangleMesh*> vertices_to_change(ShapeChange& change, const Arguments& arguments) {
  const auto* loop = dynamic_cast<const LoopGeometry*>(change.shape.get());
  if (!loop && !dynamic_cast<const MeshGeometry*>(change.shape.get())) {
    const auto made = make_triangles(change, arguments, "has no vertices to move");
    if (!made) return tl::unexpected(made.error());
  }
  if (const auto good = check_shape(*change.shape); !good) return tl::unexpected(good.error());
  return loop ? &loop->control.mesh : &static_cast<const MeshGeometry&>(*change.shape).mesh;
}

std::string kind_in_words(const world::Geometry& shape) {
  const std::string_view kind = shape.kind();
  if (kind == "mesh") return "a mesh";
  if (kind == "loop") return "a Loop surface";
  if (kind == "primitive") return "an exact shape";
  if (kind == "csg") return "a solid combined of others";
  if (kind == "implicit") return "a solid by formula";
  return fmt::format("a shape of the kind \"{}\"", kind);
}

world::GeometryPointer with_positions(const MeshGeometry& shape, std::vector<Vector3> positions) {
  auto moved = std::make_shared<MeshGeometry>(TriangleMesh{{}, shape.mesh.triangles});
  moved->texture_coordinates = shape.texture_coordinates;
  moved->colours = shape.colours;
  if (!shape.normals.empty()) moved->normals = geometry::bent_normals(shape.mesh, positions, shape.normals);
  moved->mesh.positions = std::move(positions);
  return moved;
}

Result<Plan> plan_of_shape(const ShapeChange& change, const world::GeometryPointer& shape,
                           world::IdSource& ids) {
  if (const auto good = check_shape(*shape); !good) return tl::unexpected(good.error());
  if (!change.alone) return Plan{world::ReplaceGeometry{change.shared, shape}, {change.object}};
  world::EditGroup group;
  const auto own = ids.next<world::GeometryId>();
  group.edits.push_back(world::CreateGeometry{own, shape});
  group.edits.push_back(world::ChooseGeometry{change.object, own});
  return Plan{std::move(group), {change.object}};
}

Result<Plan> plan_of_vertices(const ShapeChange& change, std::vector<std::uint32_t> vertices,
                              std::vector<Vector3> positions, world::IdSource& ids) {
  if (!std::ranges::all_of(positions, [](const Vector3& it) { return it.allFinite(); }))
    return fail("vertices would go to places that are not finite: move them less far");
  const auto* mesh = dynamic_cast<const MeshGeometry*>(change.shape.get());
  if (mesh && (change.made_triangles || !mesh->normals.empty())) {
    std::vector<Vector3> all = mesh->mesh.positions;
    for (std::size_t i = 0; i < vertices.size(); ++i) all[vertices[i]] = positions[i];
    return plan_of_shape(change, with_positions(*mesh, std::move(all)), ids);
  }
  world::EditGroup group;
  const world::GeometryId own = own_copy(change, group, ids);
  if (!vertices.empty())
    group.edits.push_back(world::MoveVertices{own, std::move(vertices), std::move(positions)});
  return Plan{std::move(group), {change.object}};
}

}  // namespace icome::interaction
