#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "geometry/mesh/triangle_mesh.h"
#include "table.h"

namespace icome::benchmarks {

/// The sizes of the measurements.
struct Extent {
  std::vector<int> frequencies;  // of the bumpy spheres, coarse to fine; 20 f^2 triangles each
  int reference;                 // the frequency at which peers and builds are compared
  std::size_t ticks;             // of each slide
  int stabs;
  int presses;                             // into each wall
  std::vector<std::size_t> object_counts;  // of the scenes of primitives
  std::size_t csg_ticks;                   // of each slide on a CSG solid
  std::size_t csg_trees;                   // random ones of each size
  std::size_t csg_presses;                 // and slides on each solid
  int loop_level;                          // of the mesh that a Loop surface is compared with
  int repeats;                             // of each timed run
  int builds;                              // of each tree
};

/// Slides and stabs on meshes with a point and a sphere tip, building trees, and the packaged peers.
std::vector<Section> mesh_figures(const Extent& extent);

/// A mesh from a file, such as a scan or a part.
struct RealMesh {
  std::string name;
  std::shared_ptr<const geometry::TriangleMesh> mesh;
  bool closed;
};

/// Reads a mesh file and makes its longest side 0.1 m. Fails as files::read_mesh does.
base::Result<RealMesh> read_real_mesh(const std::filesystem::path& file);

/// Slides over real meshes with a point and a sphere tip. Closed ones are judged.
std::vector<Section> real_mesh_figures(const Extent& extent, const std::vector<RealMesh>& meshes);

/// Large scenes of primitives, one of which is touched.
Section primitive_figures(const Extent& extent);

/// Walls of 1 mm that are pressed 5 mm deep.
Section wall_figures(const Extent& extent);

/// CSG solids: accuracy against brute force, ticks, and presses; the renderers `exact` and `thesis`.
std::vector<Section> csg_figures(const Extent& extent);

/// The limit of a Loop surface, beside the haptic mesh of the same surface.
Section loop_figures(const Extent& extent);

/// Waves that move under the tip.
Section implicit_figures(const Extent& extent);

/// Menus of many items that are open at once.
Section panel_figures(const Extent& extent);

}  // namespace icome::benchmarks
