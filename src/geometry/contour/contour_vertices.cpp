#include "geometry/contour/contour_vertices.h"

#include <algorithm>

#include "geometry/algebra/quadric.h"
#include "geometry/contour/contour_search.h"
#include "geometry/contour/contour_sheets.h"

namespace icome::geometry {
namespace {

constexpr double kCellRim = 1e-6;  // of a cell
/// A vertex this part of a cell off the planes that it was made from lies on all of them.
constexpr double kOnPlanes = 1e-9;
/// Normals within this cosine of their mean are the same.
constexpr double kSame = 1 - 1e-12;
/// Normals within this cosine of their mean (some 6 degrees) make a smooth sheet.
constexpr double kSmooth = 0.995;
/// The largest distance beside its cell at which a vertex may be put on a smooth surface, in cells.
constexpr double kBesideCell = 0.25;
/// Rounds of fitting a vertex to a curved edge, each on samples four times as near.
constexpr int kFits = 3;

/// The point moved along the normal onto the surface, if that is near the box and the same sheet; else, and
/// when it already lies there, the point itself.
Vector3 snapped(const SampledSolid& solid, double cell, const Bounds& box, const Vector3& point,
                const Vector3& normal) {
  const auto found = search_along(solid, point, normal, cell / 2);
  const bool fits = found && found->normal.dot(normal) > 0 &&
                    box.exteriorDistance(found->point) <= kBesideCell * cell &&
                    (found->point - point).norm() > kOnPlanes * cell;
  return fits ? found->point : point;
}

/// On a curved surface the planes at the samples miss its edge. Nearer to the edge they miss it by less: by a
/// sixteenth at a quarter of the distance.
Vector3 fitted_to_edge(const SampledSolid& solid, double cell, const Bounds& box, Vector3 point,
                       std::span<SurfacePoint> samples) {
  double reach = cell / 8;
  for (int fit = 0; fit < kFits; ++fit, reach /= 4) {
    for (SurfacePoint& sample : samples) {
      const Vector3 near = point + (sample.point - point) / 4;
      const Vector3 inner = near - sample.normal * reach, outer = near + sample.normal * reach;
      if (solid.inside(inner) && !solid.inside(outer)) sample = find_crossing(solid, inner, outer);
    }
    point = nearest_to_planes(samples, box);
  }
  return point;
}

Vector3 mean_normal(std::span<const SurfacePoint> samples) {
  Vector3 sum = Vector3::Zero();
  for (const SurfacePoint& sample : samples) sum += sample.normal;
  return sum.normalized();
}

/// The place of one of the eight vertices around a lone point. These could turn a part of the solid that is
/// thinner than a cell inside out, unless they are corners of it or keep to the samples' means.
Vector3 fit_lone_vertex(const SampledSolid& solid, double cell, const Bounds& box,
                        std::span<const SurfacePoint> samples) {
  const Vector3 corner = nearest_to_planes(samples, box);
  const bool on_planes = farthest_plane(samples, corner) <= kOnPlanes * cell;
  if (on_planes && snapped(solid, cell, box, corner, mean_normal(samples)) == corner) return corner;
  Vector3 sum = Vector3::Zero();
  for (const SurfacePoint& sample : samples) sum += sample.point;
  return sum / static_cast<double>(samples.size());
}

}  // namespace

Vector3 fit_vertex(const SampledSolid& solid, double cell, const Bounds& box,
                   std::span<SurfacePoint> samples) {
  const Vector3 first = nearest_to_planes(samples, box);
  const Vector3 mean = mean_normal(samples);
  double least = 1.0;
  for (const SurfacePoint& sample : samples) least = std::min(least, sample.normal.dot(mean));
  const bool on_planes = farthest_plane(samples, first) <= kOnPlanes * cell;
  if (on_planes && least >= kSame) return first;
  const Vector3 near = snapped(solid, cell, box, first, mean);
  // Three planes always meet; the surface has its corner there only if it passes through that point.
  if (least >= kSmooth || (on_planes && near == first)) return near;
  return snapped(solid, cell, box, fitted_to_edge(solid, cell, box, first, samples), mean);
}

bool is_lone_sheet(const ContourGrid& grid, const ContourCells& cells, const ContourCell& cell,
                   const SheetSamples& sheet) {
  return sheet.corner >= 0 && is_lone_point(grid, cells.cells, cell, sheet.corner);
}

Bounds vertex_space(const ContourGrid& grid, const ContourCell& cell) {
  const Vector3 low = grid.point(cell.key);
  const Vector3 rim = Vector3::Constant(kCellRim * grid.cell);
  return {low + rim, low + Vector3::Constant(grid.cell) - rim};
}

std::optional<std::vector<Vector3>> place_vertices(const SampledSolid& solid, const ContourGrid& grid,
                                                   const ContourCells& cells,
                                                   const std::vector<EdgeCrossing>& crossings,
                                                   const ContourProgress& go_on) {
  std::vector<Vector3> vertices(cells.vertices);
  const bool done = contour_in_batches(cells.cells.size(), go_on, [&](std::size_t begin, std::size_t end) {
    SheetSampler sampler(grid, cells, crossings, cells.cells[begin].key);
    for (std::size_t i = begin; i < end; ++i) {
      const ContourCell& cell = cells.cells[i];
      std::array<SheetSamples, 4> samples = sampler.samples(cell);
      const Bounds space = vertex_space(grid, cell);
      for (int sheet = 0; sheet < cell_sheets(cell.signs, cell.joins).count; ++sheet) {
        SheetSamples& own = samples[sheet];
        vertices[cell.first_vertex + sheet] = is_lone_sheet(grid, cells, cell, own)
                                                  ? fit_lone_vertex(solid, grid.cell, space, own.all())
                                                  : fit_vertex(solid, grid.cell, space, own.all());
      }
    }
  });
  if (!done) return std::nullopt;
  return vertices;
}

}  // namespace icome::geometry
