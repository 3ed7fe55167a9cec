#include "geometry/csg/meshing/csg_mesh.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/contour/contour_error.h"
#include "geometry/csg/csg_leaf_surfaces.h"
#include "geometry/csg/csg_solid.h"
#include "geometry/csg/meshing/csg_cut.h"
#include "geometry/csg/meshing/csg_mesh_check.h"

namespace icome::geometry {
namespace {

/// Walls below this many cells may slip between the points of a grid.
constexpr double kThinCells = 2.0;
constexpr double kMakingPart = 0.8;  // of the whole work, without measuring
constexpr double kShiftCells = 0.1;  // what is cut out is off by less
constexpr int kMostTries = 3;        // with cells that get smaller
constexpr double kFiner = 2.0;
/// Distances from a primitive are trusted to this part of the coordinates.
constexpr double kDistanceRounding = 1e-9;

/// May one of the surfaces pass the box?
bool may_cross(const CsgLeafSurfaces& surfaces, const Bounds& box) {
  const Vector3 centre = box.center();
  const double size = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  const double radius = box.diagonal().norm() / 2 + kDistanceRounding * size;
  bool crossed = false;
  surfaces.near(centre, radius, [&](const CsgLeafSurfaces::Leaf& it) {
    crossed = !it.even || distance_to_surface(it.leaf, centre) <= radius;
    return !crossed;
  });
  return crossed;
}

/// Meshes one tree by cutting out, by sampling, or by one after the other.
class CsgMesher {
 public:
  CsgMesher(const CsgTree& tree, const ContourOptions& options)
      : tree_(tree), options_(options), compiled_(tree), surfaces_(tree, bounds(tree)) {
    solid_.bounds = bounds(tree);
    solid_.inside = [this](const Vector3& point) { return compiled_.inside(point); };
    solid_.crossing = [this](const Vector3& a, const Vector3& b) {
      const double nowhere = std::numeric_limits<double>::quiet_NaN();  // then it is found by halving
      return compiled_.crossing(a, b).value_or(SurfacePoint{Vector3::Constant(nowhere), b - a});
    };
    solid_.may_cross = [this](const Bounds& box) { return geometry::may_cross(surfaces_, box); };
  }
  CsgMesher(const CsgMesher&) = delete;
  CsgMesher& operator=(const CsgMesher&) = delete;

  base::Result<ContourMesh> mesh() {
    const bool limited = !solid_.bounds.isEmpty() && solid_.bounds.sizes().allFinite();
    if (!limited || !(options_.cell > 0.0)) return by_cells(options_.cell);
    bool can_cut = csg_can_cut(program());
    const bool cuts_first =
        can_cut && (has_flat_faces(program()) || is_thin(program(), kThinCells * options_.cell));
    std::optional<ContourMesh> best;
    double cell = options_.cell;
    for (int i = 0; i < kMostTries; ++i, cell /= kFiner) {
      for (const bool cuts : {cuts_first, !cuts_first}) {
        if (cuts && !can_cut) continue;
        auto made = cuts ? cut_out(cell) : by_cells(cell);
        if (stopped_ || (!made && is_limited_in_triangles() && !best)) return made;
        can_cut = can_cut && (made || !cuts);  // too much work gets more with smaller cells
        if (!made) continue;
        made->lost = place_that_mesh_lacks(program(), made->mesh, cell, cuts ? kShiftCells * cell : 0.0);
        best = std::move(*made);
        if (!best->lost) return measured(std::move(*best), cell);
      }
    }
    return best ? measured(std::move(*best), options_.cell) : by_cells(options_.cell);
  }

 private:
  const CsgProgram& program() const { return compiled_.program(); }
  /// Has the caller limited the number of triangles? Then an error tells that they do not suffice.
  bool is_limited_in_triangles() const { return options_.max_triangles < ContourOptions().max_triangles; }

  bool go_on(double part) {
    stopped_ = stopped_ || (options_.progress && !options_.progress(part));
    return !stopped_;
  }

  base::Result<ContourMesh> by_cells(double cell) {
    ContourOptions options = options_;
    options.cell = cell;
    options.measures = false;
    options.progress = [this](double part) { return go_on(kMakingPart * part); };
    return contour(solid_, options);
  }

  base::Result<ContourMesh> cut_out(double cell) {
    const ContourProgress progress = [this](double part) { return go_on(kMakingPart * part); };
    auto mesh = cut_csg(tree_, cell, options_.max_triangles, progress);
    if (!mesh) return tl::unexpected(mesh.error());
    return ContourMesh{std::move(*mesh)};
  }

  base::Result<ContourMesh> measured(ContourMesh made, double cell) {
    if (!options_.measures) return made;
    const ContourProgress progress = [this](double part) {
      return go_on(kMakingPart + (1.0 - kMakingPart) * part);
    };
    const auto error = measure_contour_error(solid_, cell, made.mesh, progress);
    if (!error) return base::fail("the meshing was interrupted");
    made.error = *error;
    return made;
  }

  const CsgTree& tree_;
  const ContourOptions& options_;
  CsgSolid compiled_;
  CsgLeafSurfaces surfaces_;
  SampledSolid solid_;
  bool stopped_ = false;
};

}  // namespace

base::Result<ContourMesh> contour(const CsgTree& tree, const ContourOptions& options) {
  if (tree.empty()) return contour(SampledSolid{}, options);
  return CsgMesher(tree, options).mesh();
}

}  // namespace icome::geometry
