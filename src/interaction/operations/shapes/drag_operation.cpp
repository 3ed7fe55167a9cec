#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "geometry/deform/soft_selection.h"
#include "geometry/mesh/mesh_check.h"
#include "interaction/operations/shapes/shape_change.h"
#include "interaction/operations/shapes/vertex_operations.h"

namespace icome::interaction {
namespace {

using base::fail;
using base::Result;
using geometry::TriangleMesh;
using Seeds = std::vector<std::uint32_t>;
using DraggedEdge = std::array<std::uint32_t, 2>;  // the lower vertex first

constexpr double kFarthestDrag = 1e9;  // m

Result<std::vector<DraggedEdge>> edges_of(const std::vector<Vector2>& said, std::size_t vertices) {
  std::vector<DraggedEdge> edges;
  for (const Vector2& ends : said) {
    for (const double end : ends)
      if (end != std::floor(end) || !(end < double(vertices)))
        return fail(fmt::format("'edges' names vertex {}, but there are {}, counted from 0", end, vertices));
    const auto one = std::uint32_t(ends.x()), other = std::uint32_t(ends.y());
    edges.push_back({std::min(one, other), std::max(one, other)});
  }
  return edges;
}

Result<Seeds> ends_of_edges(const TriangleMesh& mesh, const std::vector<Vector2>& said) {
  const auto edges = edges_of(said, mesh.positions.size());
  if (!edges) return tl::unexpected(edges.error());
  std::set<DraggedEdge> missing(edges->begin(), edges->end());
  for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i)
      missing.erase(
          {std::min(triangle[i], triangle[(i + 1) % 3]), std::max(triangle[i], triangle[(i + 1) % 3])});
  }
  if (!missing.empty())
    return fail(fmt::format("'edges': no edge goes from vertex {} to vertex {}", (*missing.begin())[0],
                            (*missing.begin())[1]));
  Seeds seeds;
  for (const DraggedEdge& edge : *edges) seeds.insert(seeds.end(), edge.begin(), edge.end());
  return seeds;
}

Result<Seeds> corners_of_faces(const TriangleMesh& mesh, const std::vector<std::uint32_t>& faces) {
  const auto good = geometry::check_chosen(faces, mesh.triangles.size(), "triangle");
  if (!good) return tl::unexpected(good.error());
  Seeds seeds;
  for (const std::uint32_t face : faces)
    seeds.insert(seeds.end(), mesh.triangles[face].begin(), mesh.triangles[face].end());
  return seeds;
}

/// The nearest of the vertices that triangles use; the first of several at one distance.
Result<Seeds> nearest_vertex(const TriangleMesh& mesh, const Vector3& place) {
  double nearest = std::numeric_limits<double>::infinity();
  Seeds seeds;
  for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      const double distance = (mesh.positions[v] - place).squaredNorm();
      if (distance > nearest || (distance == nearest && !seeds.empty() && v >= seeds.front())) continue;
      nearest = distance;
      seeds = {v};
    }
  }
  if (seeds.empty()) return fail("there is no vertex near: the shape has no triangles");
  return seeds;
}

Result<Seeds> dragged(const TriangleMesh& mesh, const Arguments& arguments) {
  int ways = 0;
  for (const char* way : {"vertices", "edges", "faces", "near"}) ways += arguments.has(way) ? 1 : 0;
  if (ways != 1) return fail("say what is dragged: either 'vertices', 'edges', 'faces' or 'near'");
  if (arguments.has("edges")) return ends_of_edges(mesh, arguments.points2("edges"));
  if (arguments.has("faces")) return corners_of_faces(mesh, arguments.counts("faces"));
  if (arguments.has("near")) return nearest_vertex(mesh, arguments.vector("near"));
  return arguments.counts("vertices");
}

geometry::SoftSelection softness(const Arguments& arguments) {
  using geometry::Falloff;
  const std::string& falloff = arguments.text("falloff");
  geometry::SoftSelection soft;
  soft.radius = arguments.number("radius");
  soft.falloff = falloff == "linear"     ? Falloff::Linear
                 : falloff == "sharp"    ? Falloff::Sharp
                 : falloff == "constant" ? Falloff::Constant
                                         : Falloff::Smooth;
  if (arguments.text("distance") == "along-edges") soft.distance = geometry::SoftDistance::AlongEdges;
  return soft;
}

Result<Plan> plan_drag(const world::World& world, const Arguments& arguments, world::IdSource& ids) {
  auto change = shape_change(world, arguments);
  if (!change) return tl::unexpected(change.error());
  const auto mesh = vertices_to_change(*change, arguments);
  if (!mesh) return tl::unexpected(mesh.error());
  const auto seeds = dragged(**mesh, arguments);
  if (!seeds) return tl::unexpected(seeds.error());
  if (seeds->empty()) return fail("nothing is dragged: name at least one vertex, edge or face");
  const auto weights = geometry::soft_weights(**mesh, *seeds, softness(arguments));
  if (!weights) return tl::unexpected(weights.error());
  const Vector3 by = arguments.vector("by");
  std::vector<std::uint32_t> vertices;
  std::vector<Vector3> positions;
  for (const geometry::SoftWeight& follows : *weights) {
    const Vector3& before = (*mesh)->positions[follows.vertex];
    const Vector3 after = before + follows.weight * by;
    if (after == before) continue;
    vertices.push_back(follows.vertex);
    positions.push_back(after);
  }
  return plan_of_vertices(*change, std::move(vertices), std::move(positions), ids);
}

std::vector<Parameter> drag_parameters() {
  return {
      object_parameter("whose vertices move"),
      {.name = "vertices", .kind = ParameterKind::Counts, .meaning = "what is dragged, by index", .least = 0},
      {.name = "edges",
       .kind = ParameterKind::Points,
       .meaning = "or edges, each by its two vertices",
       .least = 0,
       .components = 2},
      {.name = "faces", .kind = ParameterKind::Counts, .meaning = "or triangles, by index", .least = 0},
      {.name = "near",
       .kind = ParameterKind::Vector,
       .meaning = "or the vertex nearest to this place in the object's frame, m",
       .least = -kFarthestDrag,
       .most = kFarthestDrag},
      {.name = "by",
       .kind = ParameterKind::Vector,
       .meaning = "how far it goes in the object's frame, m",
       .required = true,
       .least = -kFarthestDrag,
       .most = kFarthestDrag},
      {.name = "radius",
       .kind = ParameterKind::Number,
       .meaning = "how far round it others follow, m; 0: none does",
       .fallback = 0.0,
       .least = 0,
       .most = kFarthestDrag},
      {.name = "falloff",
       .kind = ParameterKind::Choice,
       .meaning = "how following dies away with the distance",
       .fallback = "smooth",
       .choices = {"smooth", "linear", "sharp", "constant"}},
      {.name = "distance",
       .kind = ParameterKind::Choice,
       .meaning = "how that is measured: through space, or over the surface's edges",
       .fallback = "straight",
       .choices = {"straight", "along-edges"}},
      alone_parameter(),
      as_mesh_parameter()};
}

}  // namespace

Operation drag_operation() {
  return {"drag",
          "Drag",
          "Shape",
          "Drags vertices, edges or faces of a mesh or of a Loop surface's control mesh; those round them "
          "follow.",
          drag_parameters(),
          plan_drag};
}

}  // namespace icome::interaction
