#pragma once
#include <cstddef>
#include <vector>

#include "world_table.h"

namespace icome::benchmarks {

/// The sizes of the measurements.
struct WorldExtent {
  std::size_t objects = 100'000;
  std::size_t edits = 20'000;  // of each kind that does not wait for the disk
  std::size_t synced = 300;    // edits that wait for the disk
  std::size_t group = 100;     // edits for one wait
  std::size_t grid = 708;      // squares along each side of the large mesh: two triangles each
  int repeats = 5;
};

WorldSection edit_figures(const WorldExtent& extent);
WorldSection journal_figures(const WorldExtent& extent);
WorldSection file_figures(const WorldExtent& extent);
WorldSection mesh_figures(const WorldExtent& extent);
std::vector<WorldSection> design_figures(const WorldExtent& extent);

}  // namespace icome::benchmarks
