#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "figures.h"
#include "geometry/implicit/implicit_surface.h"
#include "geometry/loop/loop_surface.h"
#include "geometry/mesh/geodesic_sphere.h"
#include "haptics/shapes/mesh_shape.h"
#include "haptics/shapes/smooth_shape.h"
#include "tip_paths.h"
#include "touch_run.h"

namespace icome::benchmarks {
namespace {

using geometry::TriangleMesh;
using haptics::Shape;

constexpr double kStroke = 0.002;      // m/s: the slowest stroke of a hand
constexpr double kStiffness = 1000;    // N/m
constexpr int kControlFrequency = 22;  // 9,680 faces

Row tick_row(const std::string& name, const TouchRun& run, const Faults& faults) {
  Row row{.figure = fmt::format("{}, touching {:.0f} %", name, 100.0 * run.touching)};
  row.median = run.tick.us.median;
  row.p999 = run.tick.us.p999;
  row.solver = run.solver_us;
  row.load = run.load_us;
  row.noise = run.tick.noise;
  row.faults = faults;
  return row;
}

/// The largest change of the force from one tick to the next in a slow slide, N, once it touches.
double largest_force_step(const std::shared_ptr<const Shape>& shape, std::size_t ticks) {
  const std::vector<Vector3> tips = slide_path(kBumpySphere, kStroke, kSlideDepth, ticks);
  const TouchRun run = touch(scene_of(shape), 0.0, tips, 1);
  double largest = 0.0;
  std::optional<Vector3> last;
  for (std::size_t i = 0; i < tips.size(); ++i) {
    const Vector3 force = kStiffness * (run.scps[i] - tips[i]);
    if (last) largest = std::max(largest, (force - *last).norm());
    last = force.isZero(0.0) ? std::nullopt : std::optional(force);
  }
  return largest;
}

std::size_t bytes_of(const TriangleMesh& mesh) {
  return mesh.positions.size() * sizeof(Vector3) + mesh.triangles.size() * sizeof(TriangleMesh::Triangle);
}

Row share_row(const std::string& what, double limit, double mesh, double scale, const std::string& unit,
              double to_reach) {
  Row row{.figure = fmt::format("limit against mesh: {} {:.3g} of {:.3g} {}", what, scale * limit,
                                scale * mesh, unit)};
  row.unit = "share";
  row.median = limit / mesh;
  row.to_reach = to_reach;
  return row;
}

}  // namespace

Section loop_figures(const Extent& extent) {
  std::fprintf(stderr, "Loop surface\n");
  geometry::ControlMesh control;
  control.mesh = geometry::bumpy_geodesic_sphere(kControlFrequency, kBumpySphere.radius,
                                                 kBumpySphere.bump_height, kBumpySphere.bumps);
  const auto surface = *geometry::LoopSurface::create(control);
  const auto mesh = std::make_shared<const TriangleMesh>(*surface->tessellate(extent.loop_level));
  const auto limit = std::make_shared<const haptics::SmoothShape>(surface);
  const auto fine =
      std::make_shared<const haptics::MeshShape>(mesh, haptics::MeshShapeSettings{.closed = true});
  const EmbreeMesh judging(*mesh);
  const std::vector<Vector3> tips = slide_path(kBumpySphere, kSlow, kSlideDepth, extent.ticks);
  const TouchRun on_limit = touch(scene_of(limit), 0.0, tips, extent.repeats);
  const TouchRun on_mesh = touch(scene_of(fine), 0.0, tips, extent.repeats);
  Section section{"tick on a Loop surface of 9,680 control faces, sliding 2 mm deep at 100 mm/s", {}};
  section.rows.push_back(tick_row("its limit", on_limit, judge(judging, 0.0, tips, on_limit.scps)));
  section.rows.back().to_reach = 5.0;
  section.rows.back().p999_to_reach = 20.0;
  const std::string name = fmt::format("mesh of level {}", extent.loop_level);
  section.rows.push_back(tick_row(name, on_mesh, judge(judging, 0.0, tips, on_mesh.scps)));
  section.rows.push_back(share_row("time", on_limit.tick.us.median, on_mesh.tick.us.median, 1.0, "us", 1.0));
  section.rows.push_back(share_row("memory", double(limit->bytes()), double(fine->bytes() + bytes_of(*mesh)),
                                   1e-6, "MB", 1.0 / 50.0));
  section.rows.push_back(share_row("force step", largest_force_step(limit, extent.ticks),
                                   largest_force_step(fine, extent.ticks), 1000.0, "mN", 0.1));
  return section;
}

Section implicit_figures(const Extent& extent) {
  std::fprintf(stderr, "implicit surface\n");
  const base::Bounds box(Vector3(-0.1, -0.1, -0.05), Vector3(0.1, 0.1, 0.02));
  const auto surface =
      *geometry::ImplicitSurface::create("z - 0.004*sin(60*x + 6*t) - 0.003*sin(50*y - 4*t + 20*x)", box);
  std::vector<Vector3> tips;
  for (std::size_t i = 0; i < extent.ticks; ++i) {
    const double way = kSlow * kTick * double(i);
    tips.emplace_back(0.06 * std::sin(way / 0.06), 0.06 * std::sin(0.77 * way / 0.06),
                      i < 200 ? 0.015 - 1e-4 * double(i) : -0.005);
  }
  const TouchRun run =
      touch(scene_of(std::make_shared<const haptics::SmoothShape>(surface)), 0.0, tips, extent.repeats);
  Faults faults;
  for (std::size_t i = 0; i < tips.size(); ++i) {
    const auto f = surface->value(run.scps[i], kTick * double(i));
    faults.pops += box.contains(run.scps[i]) && -f.value > kPop * std::max(1.0, f.gradient.norm());
  }
  return {"tick on waves (implicit surface, moving), the tip 5 mm under at 100 mm/s",
          {tick_row("two trains of waves", run, faults)}};
}

}  // namespace icome::benchmarks
