#include "coin_peer.h"
#include "files/design_files.h"
#include "sample_worlds.h"
#include "world/shape/mesh_geometry.h"
#include "world_figures.h"

namespace icome::benchmarks {

using namespace world;

namespace {

constexpr const char* kCoinParse = "Coin alone, parsed";

World one_mesh(std::size_t squares) {
  World world;
  must(apply(world, CreateGeometry{{1}, grid_mesh(squares, 0.1)}));
  must(apply(world, CreateObject{{2}, 0, {.name = "mesh", .geometry = {1}}}));
  return world;
}

std::string megabytes(const std::filesystem::path& path) {
  return std::to_string(std::filesystem::file_size(path) / 1'000'000) + " MB";
}

void add_format(const World& world, const std::filesystem::path& path, const WorldExtent& extent,
                double compared, WorldSection& section) {
  const double written =
      median_seconds(extent.repeats, [&] { (void)must(files::write_design(path, world)); });
  const double opened = median_seconds(extent.repeats, [&] { (void)must(files::read_design(path)); });
  const std::string name = path.extension().string() + " of " + megabytes(path);
  for (const auto& [what, seconds] : {std::pair(", saved", written), std::pair(", opened", opened)}) {
    section.rows.push_back({.figure = name + what,
                            .unit = "ms",
                            .value = seconds * 1e3,
                            .times_of = compared * 1e3,
                            .of = kCoinParse});
  }
}

/// Adds the figures of the peer for a file; returns the time of parsing alone, s.
double add_coin(const std::filesystem::path& path, const WorldExtent& extent, const WorkFolder& folder,
                WorldSection& section) {
  const double parsed = median_seconds(extent.repeats, [&] { parse_with_coin(path); });
  const double walked = median_seconds(extent.repeats, [&] { walk_with_coin(path); });
  const double written = write_with_coin(path, folder / "coin.wrl");
  for (const auto& [what, seconds] :
       {std::pair(std::string(kCoinParse), parsed),
        std::pair(std::string("Coin alone, parsed and every triangle called for"), walked),
        std::pair(std::string("Coin alone, written"), written)}) {
    section.rows.push_back({.figure = "peer: " + what,
                            .unit = "ms",
                            .value = seconds * 1e3,
                            .times_of = parsed * 1e3,
                            .of = kCoinParse});
  }
  return parsed;
}

WorldSection files_of(const std::string& title, const World& world, const WorldExtent& extent) {
  WorldSection section{title, {}};
  const WorkFolder folder;
  const std::filesystem::path path = folder / "design.wrl";
  (void)must(files::write_design(path, world));
  const double coin = add_coin(path, extent, folder, section);
  add_format(world, path, extent, coin, section);
  add_format(world, folder / "design.glb", extent, coin, section);
  add_format(world, folder / "design.icome", extent, coin, section);
  return section;
}

}  // namespace

std::vector<WorldSection> design_figures(const WorldExtent& extent) {
  const std::size_t triangles = 2 * extent.grid * extent.grid;
  return {files_of("a design of one mesh of " + std::to_string(triangles) + " triangles",
                   one_mesh(extent.grid), extent),
          files_of("a design of " + std::to_string(extent.objects) + " objects of 100 shapes",
                   grouped_world(extent.objects, false), extent)};
}

}  // namespace icome::benchmarks
