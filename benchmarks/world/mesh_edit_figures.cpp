#include "files/journal/journaled_world.h"
#include "sample_worlds.h"
#include "world/edit/history.h"
#include "world/shape/mesh_geometry.h"
#include "world_figures.h"

namespace icome::benchmarks {

using namespace world;
using files::JournaledWorld;

namespace {

constexpr GeometryId kMesh{1};
constexpr ObjectId kObject{2};

World mesh_world(std::size_t grid) {
  World world;
  must(apply(world, CreateGeometry{kMesh, grid_mesh(grid, 0.1)}));
  must(apply(world, CreateObject{kObject, 0, {.name = "mesh", .geometry = kMesh}}));
  return world;
}

/// Adds rows of an edit that is done, undone and done again, some times.
void add_rows(const std::string& name, const std::function<Edit(int)>& make, const EditSink& sink,
              const WorldExtent& extent, double copy_seconds, WorldSection& section) {
  History history;
  std::vector<double> there, back, again;
  for (int i = 0; i < extent.repeats; ++i) {
    const Edit edit = make(i);
    there.push_back(median_seconds(1, [&] { must(history.perform(sink, edit, "edit")); }));
    back.push_back(median_seconds(1, [&] { must(history.undo(sink)); }));
    again.push_back(median_seconds(1, [&] { must(history.redo(sink)); }));
  }
  for (const auto& [what, times] :
       {std::pair(", done", &there), std::pair(", undone", &back), std::pair(", done again", &again)}) {
    section.rows.push_back({.figure = name + what,
                            .unit = "ms",
                            .value = median(*times) * 1e3,
                            .times_of = copy_seconds * 1e3,
                            .of = "a copy of the mesh"});
  }
}

}  // namespace

WorldSection mesh_figures(const WorldExtent& extent) {
  const auto triangles = 2 * extent.grid * extent.grid;
  WorldSection section{"edits of a mesh of " + std::to_string(triangles) + " triangles", {}};
  const GeometryPointer shape = grid_mesh(extent.grid, 0.1);
  const auto& mesh = static_cast<const MeshGeometry&>(*shape);
  const double copy_seconds = median_seconds(extent.repeats, [&] { const MeshGeometry copy = mesh; });
  section.rows.push_back({.figure = "a copy of the mesh", .unit = "ms", .value = copy_seconds * 1e3});
  const auto move = [](int i) {
    MoveVertices edit{kMesh, {}, {}};
    for (std::uint32_t vertex = 0; vertex < 10; ++vertex) {
      edit.vertices.push_back(7 * vertex);
      edit.positions.emplace_back(vertex, i, 1.0);
    }
    return Edit(edit);
  };
  const auto replace = [&](int i) { return ReplaceGeometry{kMesh, grid_mesh(extent.grid, 0.2 + i)}; };
  World world = mesh_world(extent.grid);
  add_rows("10 vertices moved", move, world, extent, copy_seconds, section);
  add_rows("replaced whole", replace, world, extent, copy_seconds, section);
  const WorkFolder folder;
  must(files::write_journal(folder / "mesh.icome", world));
  JournaledWorld journal = must(JournaledWorld::open(folder / "mesh.icome", GeometryFactory()));
  add_rows("journalled: 10 vertices moved", move, journal.sink(), extent, copy_seconds, section);
  add_rows("journalled: replaced whole", replace, journal.sink(), extent, copy_seconds, section);
  return section;
}

}  // namespace icome::benchmarks
