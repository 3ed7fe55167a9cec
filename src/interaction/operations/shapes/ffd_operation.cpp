#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "geometry/deform/free_form_deformation.h"
#include "geometry/mesh/mesh_check.h"
#include "interaction/operations/looks/material_edits.h"
#include "interaction/operations/object_frames.h"
#include "interaction/operations/shapes/shape_change.h"
#include "interaction/operations/shapes/vertex_operations.h"

namespace icome::interaction {
namespace {

using base::Bounds;
using base::fail;
using base::Result;
using geometry::FfdLattice;

constexpr double kFarthestPoint = 1e9;  // m

Result<Bounds> with_volume(const Bounds& box) {
  const auto thick = geometry::ffd_box(box);
  if (!thick) return fail("what is to be deformed has no size: say a box with 'from' and 'to'");
  return *thick;
}

Result<Bounds> box_of(const geometry::TriangleMesh& mesh, const Arguments& arguments,
                      const std::vector<std::uint32_t>& selection) {
  if (arguments.has("from") != arguments.has("to"))
    return fail("say both corners of the box, 'from' and 'to', or none");
  if (!arguments.has("from")) {
    if (!arguments.has("vertices")) return with_volume(geometry::bounds(mesh));
    Bounds around;
    for (const std::uint32_t vertex : selection) around.extend(mesh.positions[vertex]);
    return with_volume(around);
  }
  const Bounds box(arguments.vector("from"), arguments.vector("to"));
  if ((box.min().array() > box.max().array()).any())
    return fail("'from' must not be beyond 'to' along x, y or z");
  return with_volume(box);
}

Result<FfdLattice> lattice_in(const Bounds& box, const Arguments& arguments) {
  const auto cells = arguments.counts("cells");
  if (cells.size() != 3) return fail("'cells' must be three numbers: how many there are along x, y and z");
  base::Affine3 space_from_box(Eigen::Translation3d(box.min()));
  space_from_box.scale(box.sizes());
  return geometry::make_ffd_lattice(space_from_box, {int(cells[0]), int(cells[1]), int(cells[2])});
}

Result<void> move_points(FfdLattice& lattice, const std::vector<Arguments>& moves) {
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const auto at = moves[i].counts("point");
    bool good = at.size() == 3;
    for (std::size_t axis = 0; good && axis < 3; ++axis)
      good = at[axis] <= std::uint32_t(lattice.cells[axis]);
    if (!good)
      return fail(fmt::format("'moves', number {}: 'point' must be [i, j, k] from [0, 0, 0] to [{}, {}, {}]",
                              i + 1, lattice.cells[0], lattice.cells[1], lattice.cells[2]));
    lattice.points[lattice.index({int(at[0]), int(at[1]), int(at[2])})] += moves[i].vector("by");
  }
  return {};
}

/// The lattice with its points moved as the arguments say.
Result<FfdLattice> moved_lattice(FfdLattice lattice, const Arguments& arguments) {
  if (arguments.has("moves") == arguments.has("points"))
    return fail("say where control points go: either with 'moves' or with 'points' for all of them");
  if (arguments.has("points")) {
    lattice.points = arguments.points3("points");
  } else if (const auto moved = move_points(lattice, arguments.records("moves")); !moved) {
    return tl::unexpected(moved.error());
  }
  if (const auto good = geometry::check(lattice); !good) return tl::unexpected(good.error());
  return lattice;
}

/// The vertices given, each once and in order; all where none are given.
Result<std::vector<std::uint32_t>> selected(const geometry::TriangleMesh& mesh, const Arguments& arguments) {
  std::vector<std::uint32_t> selection;
  if (!arguments.has("vertices")) {
    selection.resize(mesh.positions.size());
    for (std::uint32_t v = 0; v < selection.size(); ++v) selection[v] = v;
    return selection;
  }
  selection = arguments.counts("vertices");
  if (selection.empty()) return fail("'vertices' is empty: name some, or leave it out for all");
  const auto good = geometry::check_chosen(selection, mesh.positions.size(), "vertex");
  if (!good) return tl::unexpected(good.error());
  std::ranges::sort(selection);
  selection.erase(std::unique(selection.begin(), selection.end()), selection.end());
  return selection;
}

/// The remark on a lattice that has nothing to move.
std::string remark_on_empty(const FfdLattice& rest) {
  const Vector3 &low = rest.points.front(), &high = rest.points.back();
  return fmt::format(
      "nothing is deformed, as no vertex lies in the box from [{:.4g}, {:.4g}, {:.4g}] to [{:.4g}, {:.4g}, "
      "{:.4g}]",
      low.x(), low.y(), low.z(), high.x(), high.y(), high.z());
}

/// Moves the vertices of a shape with the lattice; `positions` are their places in the lattice's frame.
Result<Plan> plan_deformed(const ShapeChange& change, const std::vector<Vector3>& positions,
                           const std::vector<std::uint32_t>& selection, const FfdLattice& rest,
                           const FfdLattice& lattice, const base::Affine3& object_from_lattice,
                           world::IdSource& ids) {
  const geometry::FfdBinding binding(positions, selection, rest);
  const std::vector<Vector3> deformed = binding.deformed(lattice);
  std::vector<std::uint32_t> vertices;
  std::vector<Vector3> moved;
  for (std::size_t i = 0; i < deformed.size(); ++i) {
    if (deformed[i] == positions[binding.vertices()[i]]) continue;
    vertices.push_back(binding.vertices()[i]);
    moved.emplace_back(object_from_lattice * deformed[i]);
  }
  auto plan = plan_of_vertices(change, std::move(vertices), std::move(moved), ids);
  if (plan && binding.vertices().empty()) plan->note = remark_on_empty(rest);
  return plan;
}

Result<Plan> plan_ffd_of_one(const world::World& world, world::ObjectId object, const Arguments& arguments,
                             world::IdSource& ids) {
  auto change = shape_change(world, object, arguments);
  if (!change) return tl::unexpected(change.error());
  const auto mesh = vertices_to_change(*change, arguments);
  if (!mesh) return tl::unexpected(mesh.error());
  const auto selection = selected(**mesh, arguments);
  if (!selection) return tl::unexpected(selection.error());
  const auto box = box_of(**mesh, arguments, *selection);
  if (!box) return tl::unexpected(box.error());
  const auto rest = lattice_in(*box, arguments);
  if (!rest) return tl::unexpected(rest.error());
  const auto lattice = moved_lattice(*rest, arguments);
  if (!lattice) return tl::unexpected(lattice.error());
  return plan_deformed(*change, (*mesh)->positions, *selection, *rest, *lattice, base::Affine3::Identity(),
                       ids);
}

/// The shape of one of several objects, in the world's frame like the lattice round all of them.
struct StandingShape {
  world::ObjectId object;
  geometry::TriangleMesh mesh;
};

Result<StandingShape> standing(const world::World& world, world::ObjectId object,
                               const Arguments& arguments) {
  auto change = shape_change(world, object, arguments);
  if (!change) return tl::unexpected(change.error());
  const auto mesh = vertices_to_change(*change, arguments);
  if (!mesh) return tl::unexpected(mesh.error());
  StandingShape shape{object, {{}, (*mesh)->triangles}};
  const base::Affine3 place = world::world_from_object(world, object);
  for (const Vector3& position : (*mesh)->positions) shape.mesh.positions.emplace_back(place * position);
  return shape;
}

/// Fails where two objects share a shape, which they would pull to two places.
Result<void> check_apart(const world::World& world, const std::vector<world::ObjectId>& objects) {
  std::map<world::GeometryId, world::ObjectId> users;
  for (const world::ObjectId id : objects) {
    const auto [first, fresh] = users.emplace(world.find(id)->geometry, id);
    if (!fresh)
      return fail(
          fmt::format("{} and {} share a shape: say \"alone\": true to give each one of its own first",
                      called(world, first->second), called(world, id)));
  }
  return {};
}

/// The plan that deforms several objects by one lattice along the world's axes, round all of them.
Result<Plan> plan_ffd_of_several(const world::World& world, const std::vector<world::ObjectId>& objects,
                                 const Arguments& arguments, world::IdSource& ids) {
  if (arguments.has("vertices"))
    return fail("'vertices' are those of one object: name one, or leave them out");
  if (!arguments.flag("alone"))
    if (const auto apart = check_apart(world, objects); !apart) return tl::unexpected(apart.error());
  std::vector<StandingShape> shapes;
  geometry::TriangleMesh all;
  for (const world::ObjectId id : objects) {
    auto shape = standing(world, id, arguments);
    if (!shape) return tl::unexpected(shape.error());
    all.positions.insert(all.positions.end(), shape->mesh.positions.begin(), shape->mesh.positions.end());
    shapes.push_back(std::move(*shape));
  }
  const auto box = box_of(all, arguments, {});
  if (!box) return tl::unexpected(box.error());
  const auto rest = lattice_in(*box, arguments);
  if (!rest) return tl::unexpected(rest.error());
  const auto lattice = moved_lattice(*rest, arguments);
  if (!lattice) return tl::unexpected(lattice.error());
  world::World then = world;  // a shape that the others have left is the last one's own
  Plan all_deformed{world::EditGroup(), objects, remark_on_empty(*rest)};
  auto& group = std::get<world::EditGroup>(all_deformed.edit.what);
  for (const StandingShape& shape : shapes) {
    auto change = shape_change(then, shape.object, arguments);
    if (!change) return tl::unexpected(change.error());
    if (const auto mesh = vertices_to_change(*change, arguments); !mesh) return tl::unexpected(mesh.error());
    std::vector<std::uint32_t> every(shape.mesh.positions.size());
    std::iota(every.begin(), every.end(), 0U);
    const base::Affine3 object_from_world = world::world_from_object(world, shape.object).inverse();
    auto plan = plan_deformed(*change, shape.mesh.positions, every, *rest, *lattice, object_from_world, ids);
    if (!plan) return plan;
    if (const auto done = world::apply(then, plan->edit); !done) return tl::unexpected(done.error());
    group.edits.push_back(std::move(plan->edit));
    if (plan->note.empty()) all_deformed.note.clear();
  }
  return all_deformed;
}

Result<Plan> plan_ffd(const world::World& world, const Arguments& arguments, world::IdSource& ids) {
  const auto objects = with_shapes(world, arguments.objects("object"));
  if (!objects) return tl::unexpected(objects.error());
  if (objects->size() == 1) return plan_ffd_of_one(world, objects->front(), arguments, ids);
  return plan_ffd_of_several(world, *objects, arguments, ids);
}

Parameter box_corner(std::string name, std::string meaning) {
  return {.name = std::move(name),
          .kind = ParameterKind::Vector,
          .meaning = std::move(meaning),
          .least = -kFarthestPoint,
          .most = kFarthestPoint};
}

std::vector<Parameter> ffd_parameters() {
  Parameter by = box_corner("by", "how far it goes, m");
  by.required = true;
  return {{.name = "object",
           .kind = ParameterKind::Objects,
           .meaning = "what is deformed; several, or all below a group, by one lattice along the axes of the "
                      "world, in whose "
                      "frame all that follows is then said",
           .required = true},
          {.name = "cells",
           .kind = ParameterKind::Counts,
           .meaning = "how many cells the lattice has along x, y and z",
           .fallback = Value::List{2, 2, 2},
           .least = 1,
           .most = double(geometry::kMostFfdPoints)},
          {.name = "moves",
           .kind = ParameterKind::Records,
           .meaning = "which control points go where; the others stay",
           .fields = {{.name = "point",
                       .kind = ParameterKind::Counts,
                       .meaning = "which one along x, y and z, from [0, 0, 0]",
                       .required = true,
                       .least = 0},
                      by}},
          {.name = "points",
           .kind = ParameterKind::Points,
           .meaning = "instead: where all go in the object's frame, m; z counts fastest, x slowest",
           .least = -kFarthestPoint,
           .most = kFarthestPoint},
          {.name = "vertices",
           .kind = ParameterKind::Counts,
           .meaning = "only these follow, by index; else all in the box",
           .least = 0},
          box_corner("from", "the box's lower corner in the object's frame, m; else round what follows"),
          box_corner("to", "its upper corner, m"),
          alone_parameter(),
          as_mesh_parameter()};
}

}  // namespace

Operation ffd_operation() {
  return {"ffd",
          "Deform",
          "Shape",
          "Deforms a mesh or a Loop surface by a lattice of control points round it (free-form deformation).",
          ffd_parameters(),
          plan_ffd};
}

}  // namespace icome::interaction
