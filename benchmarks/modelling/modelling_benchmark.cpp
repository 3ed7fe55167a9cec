// Measures the cost of tools that shape meshes, each beside the plain way to the same result in the same run.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "geometry/deform/free_form_deformation.h"
#include "geometry/deform/triangle_subdivision.h"
#include "geometry/sweep/extrusion.h"
#include "geometry/tree/triangle_tree.h"
#include "measure.h"
#include "world/edit/history.h"
#include "world/shape/mesh_geometry.h"

namespace icome::benchmarks {
namespace {

using base::Vector3;

struct ModellingExtent {
  int grid = 1000;    // squares along each side of the large mesh
  int steps = 10000;  // of the extrusion
  int levels = 5;     // of the subdivision: 4^levels pieces of each triangle
  int repeats = 5;
};

struct ModellingRow {
  std::string figure;
  double seconds;
  std::optional<double> plain = {};  // s, the plain way
  std::string of = {};               // name of the plain way
};

/// The value of a result that cannot fail, unless the benchmark is wrong.
template <typename Value>
Value must(base::Result<Value> result) {
  if (!result) std::abort();
  if constexpr (!std::is_void_v<Value>) return std::move(*result);
}

void print(const std::string& title, const std::vector<ModellingRow>& rows) {
  fmt::print("-- {}\n", title);
  for (const ModellingRow& row : rows) {
    const std::string ratio = row.plain ? fmt::format("{:.3f} of {} ({:.1f} ms)", row.seconds / *row.plain,
                                                      row.of, *row.plain * 1e3)
                                        : "";
    fmt::print("{:<58} {:>10.2f} ms  {}\n", row.figure, row.seconds * 1e3, ratio);
  }
}

/// A sheet of 0.4 m with small waves.
geometry::TriangleMesh sheet(int squares) {
  geometry::TriangleMesh mesh;
  const double step = 0.4 / squares;
  for (int z = 0; z <= squares; ++z)
    for (int x = 0; x <= squares; ++x)
      mesh.positions.emplace_back(x * step - 0.2, 0.002 * std::sin(0.07 * x) * std::cos(0.09 * z),
                                  z * step - 0.2);
  const auto at = [&](int x, int z) { return std::uint32_t(z * (squares + 1) + x); };
  for (int z = 0; z < squares; ++z) {
    for (int x = 0; x < squares; ++x) {
      mesh.triangles.push_back({at(x, z), at(x, z + 1), at(x + 1, z)});
      mesh.triangles.push_back({at(x + 1, z), at(x, z + 1), at(x + 1, z + 1)});
    }
  }
  return mesh;
}

/// Measures a drag of one control point of 125: the motion of the vertices, and the work for hand and world.
void print_deformation(const ModellingExtent& extent) {
  geometry::TriangleMesh mesh = sheet(extent.grid);
  base::Affine3 box = base::Affine3::Identity();
  box.translation() = Vector3(-0.2, -0.01, -0.2);
  box.linear() = Vector3(0.4, 0.02, 0.4).asDiagonal();
  const auto rest = must(geometry::make_ffd_lattice(box, {4, 4, 4}));
  auto dragged = rest;
  const std::array<int, 3> point = {2, 4, 2};
  dragged.points[dragged.index(point)] += Vector3(0.0, 0.03, 0.0);

  const double bound =
      median_seconds(extent.repeats, [&] { geometry::FfdBinding binding(mesh.positions, rest); });
  const geometry::FfdBinding binding(mesh.positions, rest);
  std::vector<Vector3> moved;
  const double evaluated = median_seconds(extent.repeats, [&] { moved = binding.deformed(dragged); });
  const double again = bound + evaluated;

  const std::vector<double> shares = binding.shares(point);
  const Vector3 way = dragged.points[dragged.index(point)] - rest.points[rest.index(point)];
  const double followed = median_seconds(extent.repeats, [&] {
    for (std::size_t i = 0; i < shares.size(); ++i)
      moved[i] = mesh.positions[binding.vertices()[i]] + shares[i] * way;
  });

  geometry::TriangleTree tree(mesh);
  const double built = median_seconds(extent.repeats, [&] { geometry::TriangleTree fresh(mesh); });
  for (std::size_t i = 0; i < moved.size(); ++i) mesh.positions[binding.vertices()[i]] = moved[i];
  const double refitted = median_seconds(extent.repeats, [&] { tree.refit(mesh); });
  print(
      fmt::format("free-form deformation of {} vertices, lattice of 5 x 5 x 5 points", mesh.positions.size()),
      {{"found once: which vertices are in the box, and where", bound},
       {"every point moved: all vertices evaluated", evaluated, again, "finding and evaluating"},
       {"one point dragged: vertices follow by their shares", followed, again, "finding and evaluating"},
       {"what is felt: the tree of triangles refitted", refitted, built, "building it"},
       {"a step of the drag, with the refit", followed + refitted, again + built, "recomputing all"}});
}

void print_extrusion(const ModellingExtent& extent) {
  const auto circle = must(geometry::regular_polygon(24, 0.01, {0.1, 0.0}));
  // A spring: turns about y and rises.
  geometry::SweepStep step;
  step.axis = Vector3::UnitY();
  step.angle = 2.0 * std::numbers::pi / 200.0;
  step.translation = Vector3(0.0, 0.03 / 200.0, 0.0);
  step.repeat = extent.steps;
  geometry::TriangleMesh mesh;
  const double seconds =
      median_seconds(extent.repeats, [&] { mesh = must(geometry::extrude(circle, std::vector{step})); });
  // A lower bound: every corner has to be moved, and every triangle to be written.
  const double plain = median_seconds(extent.repeats, [&] {
    geometry::TriangleMesh copy;
    const base::Affine3 motion = geometry::motion(step);
    for (const Vector3& place : mesh.positions) copy.positions.push_back(motion * place);
    copy.triangles = mesh.triangles;
  });
  print("extrusion", {{fmt::format("a circle of 24 corners through {} steps: {} triangles", extent.steps,
                                   mesh.triangles.size()),
                       seconds, plain, "moving and copying its result"}});
}

void print_subdivision(const ModellingExtent& extent) {
  const geometry::TriangleMesh coarse = sheet(23);
  std::vector<std::uint32_t> all(coarse.triangles.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  std::size_t triangles = 0;
  const double seconds = median_seconds(extent.repeats, [&] {
    triangles = must(geometry::subdivide_triangles(coarse, all, extent.levels)).mesh.triangles.size();
  });
  print("subdivision", {{fmt::format("{} triangles to {}", coarse.triangles.size(), triangles), seconds}});
}

/// Measures an edit of every vertex of the large mesh, done, undone and done again.
void print_undo(const ModellingExtent& extent) {
  const geometry::TriangleMesh mesh = sheet(extent.grid);
  constexpr world::GeometryId kMesh{1};
  world::World world;
  must(apply(world, world::CreateGeometry{kMesh, std::make_shared<world::MeshGeometry>(mesh)}));
  must(apply(world, world::CreateObject{{2}, 0, {.name = "mesh", .geometry = kMesh}}));
  world::MoveVertices edit{kMesh, {}, {}};
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) {
    edit.vertices.push_back(i);
    edit.positions.push_back(1.5 * mesh.positions[i]);
  }
  world::History history;
  std::vector<double> there, back, again;
  for (int i = 0; i < extent.repeats; ++i) {
    there.push_back(median_seconds(1, [&] { must(history.perform(world, edit, "Deform")); }));
    back.push_back(median_seconds(1, [&] { must(history.undo(world)); }));
    again.push_back(median_seconds(1, [&] { must(history.redo(world)); }));
    must(history.undo(world));
  }
  const double copied = median_seconds(extent.repeats, [&] { const geometry::TriangleMesh copy = mesh; });
  print(
      fmt::format("an edit of all {} vertices of {} triangles", mesh.positions.size(), mesh.triangles.size()),
      {{"done", median(there), copied, "a copy of the mesh"},
       {"undone", median(back), copied, "a copy of the mesh"},
       {"done again", median(again), copied, "a copy of the mesh"}});
}

}  // namespace
}  // namespace icome::benchmarks

int main(int argc, char** argv) {
  using namespace icome::benchmarks;
  ModellingExtent extent;
  CLI::App app("Measures what tools that shape meshes cost");
  bool quick = false;
  app.add_flag("--quick", quick, "Small meshes, to see that it runs");
  CLI11_PARSE(app, argc, argv);
  if (quick) extent = {.grid = 50, .steps = 200, .levels = 2, .repeats = 2};
  print_deformation(extent);
  print_extrusion(extent);
  print_subdivision(extent);
  print_undo(extent);
  return 0;
}
