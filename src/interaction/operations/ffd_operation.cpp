#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/free_form_deformation.h"
#include "geometry/mesh_check.h"
#include "interaction/operations/shape_change.h"
#include "interaction/operations/vertex_operations.h"

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

/// The lattice with its points where they are said to go.
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

/// The vertices said, each once and in order; all where none are said.
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

Result<Plan> plan_ffd(const world::World& world, const Arguments& arguments, world::IdSource& ids) {
  auto change = shape_change(world, arguments);
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
  const geometry::FfdBinding binding((*mesh)->positions, *selection, *rest);
  const std::vector<Vector3> deformed = binding.deformed(*lattice);
  std::vector<std::uint32_t> vertices;
  std::vector<Vector3> positions;
  for (std::size_t i = 0; i < deformed.size(); ++i) {
    if (deformed[i] == (*mesh)->positions[binding.vertices()[i]]) continue;
    vertices.push_back(binding.vertices()[i]);
    positions.push_back(deformed[i]);
  }
  return plan_of_vertices(*change, std::move(vertices), std::move(positions), ids);
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
  return {object_parameter("what is deformed"),
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
