#include "apps/touch/exact_models.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "apps/interrupt.h"
#include "apps/stopwatch.h"
#include "geometry/csg/meshing/csg_mesh.h"
#include "geometry/implicit/implicit_offset.h"
#include "geometry/implicit/implicit_surface.h"
#include "geometry/implicit/plain_formula.h"
#include "geometry/loop/loop_levels.h"
#include "geometry/loop/loop_offset.h"
#include "geometry/loop/loop_surface.h"
#include "geometry/mesh/mesh_topology.h"
#include "haptics/judge/plain_field.h"
#include "haptics/judge/plain_loop.h"
#include "haptics/judge/plain_solid.h"
#include "haptics/shapes/mesh_shape.h"
#include "haptics/shapes/smooth_shape.h"
#include "haptics/thesis/thesis_shapes.h"

namespace icome::apps {
namespace {

constexpr double kCellsAcross = 160.0;  // of the meshes for pictures, of a simple solid
constexpr std::size_t kSimple = 40;     // primitives; each more makes every cell dearer
constexpr double kFewestAcross = 40.0;
constexpr std::size_t kPictureTriangles = 400'000;  // the most of a subdivided surface for pictures
constexpr int kFinestPicture = 5;                   // subdivisions

std::string in_millimetres(double metres) { return fmt::format("{:.2g} mm", 1e3 * metres); }

void take_mesh(TouchBody& body, geometry::TriangleMesh mesh) {
  body.eye = std::make_shared<TouchEye>(std::make_shared<const geometry::TriangleMesh>(std::move(mesh)));
}

geometry::ContourOptions contour_options(const base::Bounds& bounds, std::size_t primitives = 1) {
  geometry::ContourOptions options;
  const double crowd = double(std::max(primitives, kSimple)) / double(kSimple);
  options.cell = bounds.sizes().maxCoeff() / std::max(kFewestAcross, kCellsAcross / std::sqrt(crowd));
  options.progress = [](double) { return !interrupted(); };
  return options;
}

/// Has the body felt as its mesh. `detail`: the accuracy of the mesh, or the reason for it.
void touch_mesh(TouchModel& model, TouchBody& body, const TouchOptions& options, const std::string& detail) {
  haptics::MeshShapeSettings settings;
  settings.closed = body.closed;
  settings.tip_radius = options.radius;
  const auto shape = std::make_shared<const haptics::MeshShape>(body.eye->mesh(), settings);
  body.shape = shape;
  body.eye = std::make_shared<TouchEye>(shape);
  body.exact = false;
  body.solid.reset();
  body.membership.reset();
  body.judged = {};
  model.repairs.push_back(fmt::format("a tip with a radius feels it as a mesh of {} triangles{}",
                                      shape->mesh().triangles.size(), detail));
}

base::Result<void> no_sphere_tip(const TouchOptions& options) {
  if (options.radius <= 0.0) return {};
  return base::fail("--renderer thesis touches with a point: leave --radius out.");
}

base::Result<geometry::ContourMesh> contoured(const geometry::CsgTree& tree, bool measures) {
  auto options = contour_options(geometry::bounds(tree), geometry::count(tree).primitives);
  options.measures = measures;
  return geometry::contour(tree, options);
}

/// The edges at which faces meet at more than `angle` rad.
std::vector<std::array<std::uint32_t, 2>> sharp_edges(const geometry::TriangleMesh& mesh, double angle) {
  const geometry::EdgeNeighbours neighbours = geometry::edge_neighbours(mesh);
  const auto normal = [&](std::size_t t) {
    return (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0)).normalized();
  };
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t other = neighbours[t][i];
      if (other == geometry::kNoTriangle || other < t) continue;
      if (normal(t).dot(normal(other)) < std::cos(angle))
        edges.push_back({mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]});
    }
  }
  return edges;
}

geometry::ControlMesh control_mesh(const geometry::TriangleMesh& mesh, const TouchOptions& options) {
  geometry::ControlMesh control{mesh, {}, {}};
  if (options.crease_degrees)
    control.creases = sharp_edges(mesh, *options.crease_degrees * std::numbers::pi / 180.0);
  return control;
}

/// Has a sphere tip feel a Loop surface: exactly, unless that takes too much; then as a mesh.
void touch_offset(TouchModel& model, TouchBody& body,
                  const std::shared_ptr<const geometry::LoopSurface>& surface, const TouchOptions& options) {
  const auto centres = geometry::LoopOffset::create(surface, options.radius);
  if (!centres) {
    touch_mesh(model, body, options, ": " + centres.error().message);
    return;
  }
  model.repairs.push_back(
      fmt::format("a tip with a radius feels it exactly: {} tiles", (*centres)->tile_count()));
  body.shape = std::make_shared<const haptics::SmoothShape>(*centres, options.radius);
}

int picture_level(std::size_t control_triangles) {
  int level = 1;
  while (level < kFinestPicture && (control_triangles << (2 * (level + 1))) <= kPictureTriangles) ++level;
  return level;
}

}  // namespace

base::Result<haptics::MembershipSolid> negative_inside(const std::string& formula,
                                                       const geometry::ImplicitSurface& surface) {
  const auto value = geometry::plain_formula(formula);
  if (!value) return tl::unexpected(value.error());
  return haptics::plain_solid(*value, surface.box(), surface.changes());
}

base::Result<JudgedMesh> judged_limit(const geometry::ControlMesh& control) {
  auto plain = haptics::plain_loop(control);
  if (!plain) return tl::unexpected(plain.error());
  return JudgedMesh{std::make_shared<const geometry::TriangleMesh>(std::move(plain->mesh)), plain->error};
}

base::Result<geometry::TriangleMesh> picture_mesh(const geometry::CsgTree& tree) {
  auto made = contoured(tree, false);
  if (!made) return tl::unexpected(made.error());
  return std::move(made->mesh);
}

base::Result<void> render_as_thesis(const TouchModel& model, TouchBody& body, const TouchOptions& options) {
  if (!body.primitive && !body.csg)
    return base::fail(model.name +
                      ": --renderer thesis touches CSG trees, and meshes with --subdivide thesis:LEVEL.");
  if (const auto point = no_sphere_tip(options); !point) return point;
  geometry::CsgTree leaf;
  if (!body.csg) leaf.add_leaf(*body.primitive);
  auto shape = haptics::ThesisCsgShape::create(body.csg ? *body.csg : leaf);
  if (!shape) return base::fail(model.name + ": " + shape.error().message);
  body.shape = *shape;
  return {};
}

base::Result<void> subdivide(TouchModel& model, TouchBody& body, const TouchOptions& options) {
  if (!body.is_mesh)
    return base::fail(model.name +
                      ": --subdivide is for meshes; a design says itself which surfaces are smooth.");
  const geometry::ControlMesh control = control_mesh(*body.eye->mesh(), options);
  auto surface = geometry::LoopSurface::create(control);
  if (!surface) return base::fail(model.name + ": " + surface.error().message);
  body.exact = true;
  model.repairs.push_back(fmt::format("a Loop surface, control mesh of {} triangles, {} sharp edges",
                                      control.mesh.triangles.size(), control.creases.size()));
  body.closed = (*surface)->closed();
  body.eye =
      std::make_shared<TouchEye>([it = *surface, level = picture_level(control.mesh.triangles.size())] {
        return *it->tessellate(level);
      });
  body.solid = std::make_shared<const haptics::SmoothShape>(*surface);
  if (options.check) {
    auto judged = judged_limit(control);
    if (!judged)
      return base::fail(fmt::format("{}: --check cannot judge this surface, as {}: leave it out.", model.name,
                                    judged.error().message));
    body.judged = std::move(*judged);
    model.repairs.push_back(fmt::format(
        "judged by a mesh of the judge's own, of {} triangles, within {}: faults of less than {} pass",
        body.judged.mesh->triangles.size(), in_millimetres(body.judged.error),
        in_millimetres(std::max(haptics::JudgeSettings().pop_depth, 60.0 * body.judged.error))));
  }
  if (options.subdivision->thesis) {
    if (const auto point = no_sphere_tip(options); !point) return point;
    auto levels = geometry::LoopLevels::create(control, {.finest = options.subdivision->level});
    if (!levels) return base::fail(model.name + ": " + levels.error().message);
    auto shape = haptics::ThesisLoopShape::create(*levels);
    if (!shape) return base::fail(model.name + ": " + shape.error().message);
    body.shape = *shape;
  } else if (options.radius > 0.0) {
    touch_offset(model, body, *surface, options);
  } else {
    body.shape = body.solid;
  }
  return {};
}

base::Result<TouchModel> load_implicit(const TouchOptions& options) {
  if (renderer_of(options) == haptics::Renderer::Thesis)
    return base::fail("--implicit knows no renderer \"thesis\": leave --renderer out.");
  if (!options.bounds) return base::fail("--implicit needs --bounds: the box in which the formula counts.");
  const Stopwatch watch;
  auto surface = geometry::ImplicitSurface::create(*options.implicit, *options.bounds);
  if (!surface) return base::fail("--implicit: " + surface.error().message);
  TouchModel model;
  model.name = *options.implicit;
  model.kind = (*surface)->changes() ? "implicit surface that changes with time" : "implicit surface";
  model.body().exact = true;
  model.build_seconds = watch.seconds();
  std::optional<geometry::ContourMesh> mesh;  // made only where it is needed
  const auto make_mesh = [&]() -> base::Result<void> {
    if (mesh) return {};
    auto made = geometry::contour(geometry::sampled(**surface, 0.0), contour_options((*surface)->bounds()));
    if (!made) return base::fail("--implicit: " + made.error().message);
    if (made->mesh.triangles.empty())
      return base::fail("--implicit: there is no solid in the box; it is where the formula is negative.");
    mesh = std::move(*made);
    return {};
  };
  if (options.picture || !geometry::shows_solid(**surface, 0.0)) {
    if (const auto made = make_mesh(); !made) return tl::unexpected(made.error());
  }
  if (options.picture) take_mesh(model.body(), mesh->mesh);
  model.body().solid = std::make_shared<const haptics::SmoothShape>(*surface);
  model.body().shape = model.body().solid;
  if (options.radius > 0.0) {
    const auto centres = geometry::ImplicitOffset::create(*options.implicit, *options.bounds, options.radius);
    if (!centres) {
      const std::string& reason = centres.error().message;
      if ((*surface)->changes())
        return base::fail(
            "--radius: this surface changes with time and can only be touched with a point, as " + reason +
            ": leave it out.");
      if (const auto made = make_mesh(); !made) return tl::unexpected(made.error());
      take_mesh(model.body(), std::move(mesh->mesh));
      touch_mesh(model, model.body(), options,
                 fmt::format(", within {}: {}", in_millimetres(mesh->error), reason));
      model.triangles = model.body().eye->mesh()->triangles.size();
      return model;
    }
    model.repairs.push_back(
        fmt::format("a tip with a radius feels it exactly: {} parts", (*centres)->part_count()));
    model.body().shape = std::make_shared<haptics::SmoothShape>(*centres, options.radius);
  }
  auto solid = negative_inside(*options.implicit, **surface);
  if (!solid) return base::fail("--implicit: " + solid.error().message);
  model.body().membership = std::move(*solid);
  return model;
}

}  // namespace icome::apps
