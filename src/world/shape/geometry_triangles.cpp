// Triangulations of every built-in kind of shape.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/csg/meshing/csg_mesh.h"
#include "geometry/implicit/implicit_loss.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"
#include "world/shape/usual_tolerance.h"

namespace icome::world {
namespace {

using Triangles = std::shared_ptr<const MeshGeometry>;

// Sampling a solid takes time by its volume: tolerances finer than this are not kept.
constexpr double kMostCellsAcross = 256.0;

/// Dual contouring errs by far less than a cell, but by most of one where a ridge pokes through a side.
double cell_for(double tolerance, const Bounds& bounds) {
  return std::max(tolerance, bounds.sizes().maxCoeff() / kMostCellsAcross);
}

Triangles share(geometry::TriangleMesh mesh) { return std::make_shared<MeshGeometry>(std::move(mesh)); }

geometry::ContourOptions options_for(double tolerance, const Bounds& bounds) {
  return {.cell = cell_for(tolerance, bounds), .max_triangles = Geometry::kMostTriangles, .measures = false};
}

/// Each level halves the edges and brings the facets four times nearer.
int level_for(const geometry::TriangleMesh& control, double tolerance) {
  constexpr int kFinest = 6;
  double longest = 0.0;
  for (std::size_t t = 0; t < control.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i)
      longest = std::max(longest, (control.corner(t, (i + 1) % 3) - control.corner(t, i)).norm());
  }
  // The sagitta of an arc whose radius is about the edge it bridges is an eighth of that edge.
  const double off = longest / 8.0;
  const int level = off > tolerance ? int(std::ceil(0.5 * std::log2(off / tolerance))) : 1;
  return std::clamp(level, 1, kFinest);
}

/// The turn from the start of geometry's rings to that of pictures: a row of corners from pole to pole lies
/// on a picture's seam, so that no triangle lies across it, and a sphere's poles are those of its picture.
base::Matrix3 shape_from_rings(const PrimitiveGeometry& shape) {
  base::Matrix3 turn;
  if (std::holds_alternative<geometry::Sphere>(shape.primitive)) {
    turn << 0.0, -1.0, 0.0, 0.0, 0.0, 1.0, -1.0, 0.0, 0.0;  // x becomes -z, z becomes y
    return turn;
  }
  turn = shape.shape_from_primitive();
  const bool wrapped = std::holds_alternative<geometry::Cylinder>(shape.primitive) ||
                       std::holds_alternative<geometry::Cone>(shape.primitive);
  if (!wrapped) return turn;
  base::Matrix3 quarter;  // x becomes y
  quarter << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  return turn * quarter;
}

}  // namespace

double usual_tolerance(const Geometry& shape) {
  constexpr double kSmoothTolerance = 1e-3;   // of the size
  constexpr double kSampledTolerance = 1e-2;  // of the size, of solids that are sampled
  const Bounds box = shape.bounds();
  const double size = box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
  if (!(size > 0.0) || !std::isfinite(size)) return 1.0;
  const bool sampled = shape.kind() == "csg" || shape.kind() == "implicit";
  return (sampled ? kSampledTolerance : kSmoothTolerance) * size;
}

double usual_deviation(const Geometry& shape) {
  constexpr double kOfCell = 0.1;
  const bool sampled = shape.kind() == "csg" || shape.kind() == "implicit";
  return (sampled ? kOfCell : 1.0) * usual_tolerance(shape);
}

base::Result<Triangles> MeshGeometry::triangles(double) const {
  if (const auto self = weak_from_this().lock()) return self;
  return std::make_shared<const MeshGeometry>(*this);
}

base::Result<Triangles> LoopGeometry::triangles(double tolerance) const {
  const auto surface = geometry::LoopSurface::create(control);
  if (!surface) return tl::unexpected(surface.error());
  int level = level_for(control.mesh, tolerance);
  while (level > 0 && (control.mesh.triangles.size() << (2 * level)) > kMostTriangles) --level;
  auto mesh = (*surface)->tessellate(level);
  if (!mesh) return tl::unexpected(mesh.error());
  return share(std::move(*mesh));
}

base::Result<Triangles> PrimitiveGeometry::triangles(double tolerance) const {
  if (std::holds_alternative<geometry::Plane>(primitive))
    return base::fail("A plane has no end: it cannot be made triangles.");
  geometry::TriangleMesh mesh = geometry::tessellate(primitive, tolerance);
  const base::Matrix3 turn = shape_from_rings(*this);
  for (Vector3& position : mesh.positions) position = turn * position;
  return share(std::move(mesh));
}

base::Result<SolidTriangles> CsgGeometry::surface(double tolerance) const {
  const Bounds box = bounds();
  if (box.isEmpty()) return SolidTriangles{share({}), std::nullopt};
  auto contoured = geometry::contour(tree, options_for(tolerance, box));
  if (!contoured) return tl::unexpected(contoured.error());
  return SolidTriangles{share(std::move(contoured->mesh)), contoured->lost};
}

base::Result<Triangles> CsgGeometry::triangles(double tolerance) const {
  auto made = surface(tolerance);
  if (!made) return tl::unexpected(made.error());
  if (const auto& place = made->lost) {
    return base::fail(fmt::format(
        "Parts of the solid are too thin or too many to be made triangles, as at ({:.4g}, {:.4g}, "
        "{:.4g}) m of its own frame: make several solids of it, or keep it in a format that holds "
        "solids, such as .icome.",
        place->x(), place->y(), place->z()));
  }
  return std::move(made->mesh);
}

base::Result<SolidTriangles> ImplicitGeometry::triangles_so_far(double tolerance) const {
  for (double finer = tolerance;; finer *= 0.5) {
    auto made = triangles_at(0.0, finer);
    if (!made) return tl::unexpected(made.error());
    const double cell = cell_for(finer, bounds());
    const auto lost = geometry::place_that_mesh_lacks(*surface_, 0.0, (*made)->mesh, 2.0 * cell);
    if (!lost || cell > finer) return SolidTriangles{std::move(*made), lost};
  }
}

base::Result<Triangles> ImplicitGeometry::triangles(double tolerance) const {
  auto made = triangles_so_far(tolerance);
  if (!made) return tl::unexpected(made.error());
  if (const auto& lost = made->lost)
    return base::fail(
        fmt::format("Parts of the solid are too thin or too small to be made triangles, as at ({:.4g}, "
                    "{:.4g}, {:.4g}) m of "
                    "its own frame: make its box smaller or them larger, or keep it in a format that holds "
                    "formulas, such as "
                    ".icome.",
                    lost->x(), lost->y(), lost->z()));
  return std::move(made->mesh);
}

base::Result<Triangles> ImplicitGeometry::triangles_at(double time, double tolerance) const {
  auto contoured = geometry::contour(geometry::sampled(*surface_, time), options_for(tolerance, bounds()));
  if (!contoured) return tl::unexpected(contoured.error());
  return share(std::move(contoured->mesh));
}

}  // namespace icome::world
