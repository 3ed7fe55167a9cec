#include "apps/exact_models.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "apps/interrupt.h"
#include "apps/stopwatch.h"
#include "files/csg_reader.h"
#include "geometry/csg_emptiness.h"
#include "geometry/csg_mesh.h"
#include "geometry/csg_offset.h"
#include "geometry/csg_solid.h"
#include "geometry/implicit_offset.h"
#include "geometry/implicit_surface.h"
#include "geometry/loop_levels.h"
#include "geometry/loop_offset.h"
#include "geometry/loop_surface.h"
#include "geometry/mesh_frame.h"
#include "geometry/mesh_topology.h"
#include "geometry/plain_formula.h"
#include "haptics/mesh_shape.h"
#include "haptics/plain_field.h"
#include "haptics/plain_loop.h"
#include "haptics/plain_solid.h"
#include "haptics/smooth_shape.h"
#include "haptics/thesis/thesis_shapes.h"

namespace icome::apps {
namespace {

constexpr double kCellsAcross = 160.0;  // of the meshes for pictures, of a simple solid
constexpr std::size_t kSimple = 40;     // primitives; each more makes every cell dearer
constexpr double kFewestAcross = 40.0;
constexpr std::size_t kPictureTriangles = 400'000;  // what a subdivided surface may have for pictures
constexpr int kFinestPicture = 5;                   // subdivisions

std::string in_millimetres(double metres) { return fmt::format("{:.2g} mm", 1e3 * metres); }

void take_mesh(TouchModel& model, geometry::TriangleMesh mesh) {
  model.body().eye =
      std::make_shared<TouchEye>(std::make_shared<const geometry::TriangleMesh>(std::move(mesh)));
}

geometry::ContourOptions contour_options(const base::Bounds& bounds, std::size_t primitives = 1) {
  geometry::ContourOptions options;
  const double crowd = double(std::max(primitives, kSimple)) / double(kSimple);
  options.cell = bounds.sizes().maxCoeff() / std::max(kFewestAcross, kCellsAcross / std::sqrt(crowd));
  options.progress = [](double) { return !interrupted(); };
  return options;
}

/// Makes the mesh what is felt. `detail`: how near the mesh is, or why there is one.
void touch_mesh(TouchModel& model, const TouchOptions& options, const std::string& detail) {
  haptics::MeshShapeSettings settings;
  settings.closed = model.body().closed;
  settings.tip_radius = options.radius;
  const auto shape = std::make_shared<const haptics::MeshShape>(model.body().eye->mesh(), settings);
  model.body().shape = shape;
  model.body().eye = std::make_shared<TouchEye>(shape);
  model.triangles = shape->mesh().triangles.size();
  model.body().solid.reset();
  model.body().membership.reset();
  model.body().judged = {};
  model.repairs.push_back(
      fmt::format("a tip with a radius feels it as a mesh of {} triangles{}", model.triangles, detail));
}

base::Result<void> no_sphere_tip(const TouchOptions& options) {
  if (options.radius <= 0.0) return {};
  return base::fail("--renderer thesis touches with a point: leave --radius out.");
}

base::Affine3 placement(const base::Bounds& bounds, const TouchOptions& options) {
  base::Affine3 world_from_file = base::Affine3::Identity();
  if (options.fit) world_from_file.scale(*options.fit / bounds.sizes().maxCoeff());
  // y up: a quarter turn about x.
  if (options.y_up) world_from_file.rotate(Eigen::AngleAxisd(0.5 * std::numbers::pi, base::Vector3::UnitX()));
  return world_from_file;
}

base::Result<geometry::ContourMesh> contoured(const geometry::CsgTree& tree, bool measures) {
  auto options = contour_options(geometry::bounds(tree), geometry::count(tree).primitives);
  options.measures = measures;
  return geometry::contour(tree, options);
}

/// The sphere tip's mesh of a CSG tree of which there is nothing better, for the reason given.
base::Result<void> touch_csg_mesh(TouchModel& model, const TouchOptions& options, const std::string& reason) {
  auto made = contoured(*model.body().csg, true);
  if (!made) return base::fail(model.name + ": " + made.error().message);
  if (made->mesh.triangles.empty())
    return base::fail(model.name +
                      ": the solid is empty, or so thin that its mesh is: touch it with a point.");
  if (made->lost)
    return base::fail(model.name +
                      ": parts of the solid are too thin for a mesh of it: touch it with a point.");
  const Stopwatch watch;
  take_mesh(model, std::move(made->mesh));
  touch_mesh(model, options, fmt::format(", within {}: {}", in_millimetres(made->error), reason));
  model.build_seconds = watch.seconds();
  return {};
}

base::Result<void> finish_csg(TouchModel& model, geometry::CsgTree made, const TouchOptions& options) {
  model.body().world_from_body.translation() = geometry::bring_near(made);
  const auto tree = std::make_shared<const geometry::CsgTree>(std::move(made));
  model.body().csg = tree;
  if (geometry::bounds(*tree).isEmpty())
    return base::fail(model.name + ": the solid is empty: its parts do not meet.");
  const Stopwatch watch;
  const auto solid = std::make_shared<const geometry::CsgSolid>(*tree);
  if (geometry::proved_empty(solid->program()))
    return base::fail(model.name + ": the solid is empty: its parts leave nothing.");
  const bool thesis = renderer_of(options) == haptics::Renderer::Thesis;
  if (thesis) {
    if (const auto point = no_sphere_tip(options); !point) return point;
  }
  model.body().solid = std::make_shared<const haptics::SmoothShape>(solid);
  model.body().shape = model.body().solid;
  if (options.radius > 0.0) {
    const auto centres = geometry::CsgOffset::create(*tree, options.radius);
    if (!centres) {
      return touch_csg_mesh(model, options, centres.error().message);
    }
    model.repairs.push_back(fmt::format("a tip with a radius feels it exactly: faces, and edges of {} arcs",
                                        (*centres)->edge_count()));
    model.body().shape = std::make_shared<const haptics::SmoothShape>(*centres, options.radius);
  }
  model.body().membership = haptics::plain_solid(*tree);
  if (thesis) {
    auto shape = haptics::ThesisCsgShape::create(*tree);
    if (!shape) return base::fail(model.name + ": " + shape.error().message);
    model.body().shape = *shape;
  }
  model.build_seconds = watch.seconds();
  return {};
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

/// What a sphere tip feels of a Loop surface: exactly, unless that takes too much.
void touch_offset(TouchModel& model, const std::shared_ptr<const geometry::LoopSurface>& surface,
                  const TouchOptions& options) {
  const auto centres = geometry::LoopOffset::create(surface, options.radius);
  if (!centres) {
    touch_mesh(model, options, ": " + centres.error().message);
    return;
  }
  model.repairs.push_back(
      fmt::format("a tip with a radius feels it exactly: {} tiles", (*centres)->tile_count()));
  model.body().shape = std::make_shared<const haptics::SmoothShape>(*centres, options.radius);
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

bool names_csg(const std::string& text) {
  const auto ends = [&](std::string_view ending) {
    return text.size() >= ending.size() &&
           text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
  };
  return ends(".csg") || ends(".csg.xz");
}

base::Result<TouchModel> load_csg(const std::string& text, const TouchOptions& options) {
  auto loaded = files::read_csg(text);
  if (!loaded) return tl::unexpected(loaded.error());
  TouchModel model;
  model.name = text;
  model.kind = "CSG tree";
  model.body().exact = true;
  model.repairs = loaded->notes;
  const geometry::CsgCount count = geometry::count(loaded->tree);
  model.repairs.push_back(
      fmt::format("{} primitives, {} nodes, {} deep", count.primitives, count.nodes, count.depth));
  model.read_seconds = loaded->read_seconds;
  const geometry::CsgTree::Index root = loaded->tree.root();
  const base::Affine3 placed = placement(geometry::bounds(loaded->tree), options);
  loaded->tree.set_transform(root, placed * loaded->tree.node(root).parent_from_node);
  if (const auto made = finish_csg(model, std::move(loaded->tree), options); !made)
    return tl::unexpected(made.error());
  return model;
}

base::Result<geometry::TriangleMesh> picture_mesh(const geometry::CsgTree& tree) {
  auto made = contoured(tree, false);
  if (!made) return tl::unexpected(made.error());
  return std::move(made->mesh);
}

base::Result<TouchModel> as_csg(TouchModel primitive, const TouchOptions& options) {
  if (const auto point = no_sphere_tip(options); !point) return tl::unexpected(point.error());
  geometry::CsgTree tree;
  tree.add_leaf(*primitive.body().primitive);
  auto shape = haptics::ThesisCsgShape::create(tree);
  if (!shape) return tl::unexpected(shape.error());
  primitive.body().shape = *shape;
  return primitive;
}

base::Result<TouchModel> as_loop_surface(TouchModel model, const TouchOptions& options) {
  const geometry::ControlMesh control = control_mesh(*model.body().eye->mesh(), options);
  const Stopwatch watch;
  auto surface = geometry::LoopSurface::create(control);
  if (!surface) return base::fail(model.name + ": " + surface.error().message);
  model.build_seconds = watch.seconds();
  model.kind = "Loop surface, control mesh " + model.kind;
  model.body().exact = true;
  model.repairs.push_back(
      fmt::format("control mesh of {} triangles, {} sharp edges", model.triangles, control.creases.size()));
  model.triangles = 0;
  model.body().closed = (*surface)->closed();
  model.body().eye =
      std::make_shared<TouchEye>([it = *surface, level = picture_level(control.mesh.triangles.size())] {
        return *it->tessellate(level);
      });
  model.body().solid = std::make_shared<const haptics::SmoothShape>(*surface);
  if (options.check) {
    auto judged = judged_limit(control);
    if (!judged)
      return base::fail(fmt::format("{}: --check cannot judge this surface, as {}: leave it out.", model.name,
                                    judged.error().message));
    model.body().judged = std::move(*judged);
    const JudgedMesh& mesh = model.body().judged;
    model.repairs.push_back(fmt::format(
        "judged by a mesh of the judge's own, of {} triangles, within {}: faults of less than {} pass",
        mesh.mesh->triangles.size(), in_millimetres(mesh.error),
        in_millimetres(std::max(haptics::JudgeSettings().pop_depth, 60.0 * mesh.error))));
  }
  if (options.subdivision->thesis) {
    if (const auto point = no_sphere_tip(options); !point) return tl::unexpected(point.error());
    auto levels = geometry::LoopLevels::create(control, {.finest = options.subdivision->level});
    if (!levels) return base::fail(model.name + ": " + levels.error().message);
    auto shape = haptics::ThesisLoopShape::create(*levels);
    if (!shape) return base::fail(model.name + ": " + shape.error().message);
    model.body().shape = *shape;
    model.build_seconds = watch.seconds();
  } else if (options.radius > 0.0) {
    touch_offset(model, *surface, options);
    model.build_seconds = watch.seconds();
  } else {
    model.body().shape = model.body().solid;
  }
  return model;
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
  std::optional<geometry::ContourMesh> mesh;  // made only where somebody needs it
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
  if (options.picture) take_mesh(model, mesh->mesh);
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
      take_mesh(model, std::move(mesh->mesh));
      touch_mesh(model, options, fmt::format(", within {}: {}", in_millimetres(mesh->error), reason));
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
