#include "geometry/contour/dual_contouring.h"

#include <algorithm>
#include <cstdint>

#include "geometry/contour/contour_error.h"
#include "geometry/contour/contour_grid.h"
#include "geometry/contour/contour_quads.h"
#include "geometry/contour/contour_refine.h"
#include "geometry/contour/contour_vertices.h"

namespace icome::geometry {
namespace {

/// Numbers of vertices and edges are 32 bits wide.
constexpr std::size_t kMostContourTriangles = std::size_t{1} << 31;

/// Reports progress: each stage takes a part of the whole.
class StageProgress {
 public:
  explicit StageProgress(const ContourOptions& options) : tell_(&options.progress) {}

  /// Progress of the next stage, which takes this part of the whole.
  ContourProgress stage(double part) {
    const double begin = done_;
    done_ += part;
    return [this, begin, part](double of_stage) { return !*tell_ || (*tell_)(begin + part * of_stage); };
  }

 private:
  const std::function<bool(double)>* tell_;
  double done_ = 0.0;
};

}  // namespace

base::Result<ContourMesh> contour(const SampledSolid& solid, const ContourOptions& options) {
  const bool empty = solid.bounds.isEmpty();
  const auto grid =
      make_contour_grid(empty ? Bounds(Vector3::Zero(), Vector3::Zero()) : solid.bounds, options.cell);
  if (!grid) return base::fail(grid.error().message);
  if (empty) return ContourMesh{};

  StageProgress progress(options);
  const auto interrupted = [] { return base::fail("the meshing was interrupted"); };
  const auto max_edges =
      static_cast<std::uint32_t>(std::min(options.max_triangles, kMostContourTriangles) / 2);
  const auto cells = sample_contour_cells(solid, *grid, max_edges, progress.stage(0.5));
  if (!cells) return base::fail(cells.error().message);

  ContourMesh result;
  {
    const auto crossings = find_edge_crossings(solid, *grid, *cells, progress.stage(0.1));
    if (!crossings) return interrupted();
    auto vertices = place_vertices(solid, *grid, *cells, *crossings, progress.stage(0.1));
    if (!vertices) return interrupted();
    const auto quads = connect_quads(*grid, *cells, progress.stage(0.05));
    if (!quads) return interrupted();
    ContourDraft draft{&solid, &*grid, &*cells, &*crossings, &*quads, std::move(*vertices)};
    const auto splits = refine_and_split(draft, progress.stage(0.1));
    if (!splits) return interrupted();
    result.mesh.positions = std::move(draft.positions);
    result.mesh.triangles.reserve(splits->size() * 2);
    for (const QuadSplit& split : *splits) {
      result.mesh.triangles.insert(result.mesh.triangles.end(), split.triangles.begin(),
                                   split.triangles.end());
    }
  }
  if (!options.measures) return result;
  const auto error = measure_contour_error(solid, grid->cell, result.mesh, progress.stage(0.15));
  if (!error) return interrupted();
  result.error = *error;
  return result;
}

}  // namespace icome::geometry
