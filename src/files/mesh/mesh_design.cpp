#include "files/mesh/mesh_design.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "files/csg/csg_reader.h"
#include "files/design_builder.h"
#include "files/exact_looks.h"
#include "files/mesh/mesh_cleaning.h"
#include "files/mesh/mesh_formats.h"
#include "geometry/mesh/weld.h"
#include "io/byte_watch.h"
#include "io/file_ending.h"
#include "world/shape/solid_geometry.h"

namespace icome::files {

base::Result<MeshShape> read_mesh_shape(const std::filesystem::path& path, double unit,
                                        std::uint64_t size_limit, io::TimeBudget& time_budget,
                                        io::MemoryBudget& memory) {
  auto parsed = parse_mesh_file(path, size_limit, time_budget, memory);
  if (!parsed) return tl::unexpected(parsed.error());
  const std::uint64_t colours = parsed->colours.empty() ? 0 : sizeof(std::array<world::Colour, 3>);
  if (!memory.has_room(parsed->mesh.positions.size() * sizeof(base::Vector3) +
                       parsed->mesh.triangles.size() * (sizeof(parsed->mesh.triangles[0]) + colours)))
    return base::fail(fmt::format("{}: {}", path.string(), memory.problem().message));
  MeshShape result{nullptr, std::move(parsed->format), {}};
  for (const std::string& note : parsed->notes) result.remarks.push_back(as_sentence(note));
  if (parsed->mesh.triangles.empty())
    result.remarks.push_back(fmt::format(
        "It has {}no triangles: nothing of it can be seen.",
        parsed->mesh.positions.empty() ? "" : fmt::format("{} points and ", parsed->mesh.positions.size())));
  time_budget.step(kParsedPart, 1.0);
  world::MeshGeometry shape(std::move(parsed->mesh));
  if (!parsed->colours.empty()) {
    for (const auto& [a, b, c] : shape.mesh.triangles)
      shape.colours.push_back({parsed->colours[a], parsed->colours[b], parsed->colours[c]});
  }
  if (const auto scaled = scale(shape.mesh.positions, unit, path.string()); !scaled)
    return tl::unexpected(scaled.error());
  if (!time_budget.lasts(0.1)) return tl::unexpected(io::interruption());
  if (std::string lost = drop_not_finite(shape); !lost.empty()) result.remarks.push_back(std::move(lost));
  // STL repeats every corner; equal corners become one vertex.
  if (!time_budget.lasts(0.3)) return tl::unexpected(io::interruption());
  if (io::ending_of(path).type == ".stl") {
    geometry::weld_equal(shape.mesh, [&] { return time_budget.lasts_now(); });
    if (!time_budget.lasts(0.6)) return tl::unexpected(io::interruption());
    drop_unused(shape.mesh);
  }
  if (!time_budget.lasts(0.8)) return tl::unexpected(io::interruption());
  result.shape = std::make_shared<const world::MeshGeometry>(std::move(shape));
  return result;
}

base::Result<LoadedDesign> read_mesh_design(const std::filesystem::path& path,
                                            const DesignReadOptions& options, io::MemoryBudget& memory) {
  io::TimeBudget time_budget(options.progress);
  auto read = read_mesh_shape(path, options.unit, options.size_limit, time_budget, memory);
  if (!read) return tl::unexpected(read.error());
  DesignBuilder builder(memory);
  for (const std::string& remark : read->remarks) builder.remark(remark);
  builder.add(
      world::PhysicalObject{.name = io::bare_name(path), .geometry = builder.add(std::move(read->shape))});
  return builder.take(read->format, path.string());
}

base::Result<LoadedDesign> read_csg_design(const std::filesystem::path& path,
                                           const DesignReadOptions& options, io::MemoryBudget& memory) {
  CsgReadOptions limits;
  limits.progress = options.progress;
  limits.size_limit = std::min(limits.size_limit, options.size_limit);
  limits.memory = &memory;
  auto loaded = read_csg(path, limits);
  if (!loaded) return tl::unexpected(loaded.error());
  DesignBuilder builder(memory);
  for (const std::string& note : loaded->notes) builder.remark(as_sentence(note));
  const auto shape = std::make_shared<const world::CsgGeometry>(std::move(loaded->tree));
  if (has_clear_parts(*shape)) builder.remark("Colours of parts are kept, but shown without their opacity.");
  builder.add(world::PhysicalObject{.name = io::bare_name(path), .geometry = builder.add(shape)});
  return builder.take(io::ending_of(path).packed ? "OpenSCAD CSG, xz" : "OpenSCAD CSG", path.string());
}

}  // namespace icome::files
