#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <utility>

#include "figures.h"
#include "files/mesh/mesh_reader.h"
#include "haptics/shapes/mesh_shape.h"
#include "tip_paths.h"
#include "touch_run.h"

namespace icome::benchmarks {
namespace {

constexpr double kMeshSize = 0.1;           // m: the longest side of every mesh
constexpr double kWalkDepth = 0.0015;       // m below the surface
constexpr double kSphereTip = 0.001;        // m
constexpr std::size_t kWalkTicks = 20'000;  // of each slide, unless the extent asks for fewer

Row slide_row(const RealMesh& mesh, double tip_radius, const std::vector<Vector3>& tips, int repeats) {
  const haptics::MeshShapeSettings settings{.closed = mesh.closed, .tip_radius = tip_radius};
  const auto shape = std::make_shared<const haptics::MeshShape>(mesh.mesh, settings);
  const TouchRun run = touch(scene_of(shape), tip_radius, tips, repeats);
  std::optional<Faults> faults;
  if (mesh.closed) faults = judge_closed(EmbreeMesh(*mesh.mesh), tip_radius, run.scps);
  return touch_row(fmt::format("{}, {} triangles, touching {:.0f} %", mesh.name, mesh.mesh->triangles.size(),
                               100.0 * run.touching),
                   run, faults);
}

}  // namespace

base::Result<RealMesh> read_real_mesh(const std::filesystem::path& file) {
  files::ReadOptions options;
  options.fit = kMeshSize;
  auto loaded = files::read_mesh(file, options);
  if (!loaded) return tl::unexpected(loaded.error());
  RealMesh result{file.filename().string(), nullptr, loaded->repair.surface.closed};
  result.mesh = std::make_shared<const TriangleMesh>(std::move(loaded->mesh));
  return result;
}

std::vector<Section> real_mesh_figures(const Extent& extent, const std::vector<RealMesh>& meshes) {
  Section point{"real meshes 0.1 m large, sliding 1.5 mm deep at 100 mm/s: point tip", {}};
  Section sphere{"the same: sphere tip of 1 mm radius", {}};
  for (const RealMesh& mesh : meshes) {
    std::fprintf(stderr, "%s\n", mesh.name.c_str());
    const auto tips = mesh_walk_path(*mesh.mesh, kSlow, kWalkDepth, std::min(kWalkTicks, extent.ticks));
    point.rows.push_back(slide_row(mesh, 0.0, tips, extent.repeats));
    sphere.rows.push_back(slide_row(mesh, kSphereTip, tips, extent.repeats));
  }
  return {point, sphere};
}

}  // namespace icome::benchmarks
