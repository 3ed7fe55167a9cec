// Compares the haptic core with its target figures and with packaged peers: one run, one table. Ends with 1
// when any surface contact point was wrong: a quick answer that is wrong is no answer.
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "figures.h"
#include "places.h"

namespace {

using icome::benchmarks::Extent;
using icome::benchmarks::Faults;
using icome::benchmarks::Section;

Extent full() {
  return {.frequencies = {17, 82, 230, 707},
          .reference = 230,
          .ticks = 100'000,
          .stabs = 2000,
          .presses = 1000,
          .object_counts = {10'000, 100'000},
          .csg_ticks = 50'000,
          .csg_trees = 5,
          .csg_presses = 10'000,
          .loop_level = 5,
          .repeats = 5,
          .builds = 5};
}

Extent quick() {
  return {.frequencies = {17, 82},
          .reference = 82,
          .ticks = 5000,
          .stabs = 100,
          .presses = 100,
          .object_counts = {10'000},
          .csg_ticks = 5000,
          .csg_trees = 1,
          .csg_presses = 300,
          .loop_level = 2,
          .repeats = 2,
          .builds = 1};
}

/// Files of scans and parts, small to large; missing ones are left out.
std::vector<std::filesystem::path> usual_meshes() {
  std::vector<std::filesystem::path> files{"/usr/share/glmark2/models/bunny.obj"};
  for (const char* name :
       {"cad/plate_holes.STL", "cad/featuretype.STL", "anatomy/bone.ply", "anatomy/tooth.obj",
        "cad/fandisk.obj", "anatomy/teeth-bottom.obj.xz", "scan/armadillo.obj.xz", "scan/horse.ply.xz",
        "scan/dragon.obj.xz", "anatomy/heart_ct_surface.ply.xz"}) {
    files.push_back(icome::places::shared_data() / "meshes" / name);
  }
  std::erase_if(files, [](const auto& file) { return !std::filesystem::exists(file); });
  return files;
}

std::vector<Section> sections_of_meshes(const Extent& extent,
                                        const std::vector<std::filesystem::path>& files) {
  std::vector<icome::benchmarks::RealMesh> meshes;
  for (const auto& file : files) {
    auto mesh = icome::benchmarks::read_real_mesh(file);
    if (mesh)
      meshes.push_back(std::move(*mesh));
    else
      std::cerr << mesh.error().message << '\n';
  }
  return icome::benchmarks::real_mesh_figures(extent, meshes);
}

std::vector<Section> all_sections(const Extent& extent) {
  std::vector<Section> sections = icome::benchmarks::mesh_figures(extent);
  const auto add = [&](std::vector<Section> more) {
    for (Section& section : more) sections.push_back(std::move(section));
  };
  add(sections_of_meshes(extent, usual_meshes()));
  add({icome::benchmarks::primitive_figures(extent), icome::benchmarks::wall_figures(extent)});
  add(icome::benchmarks::csg_figures(extent));
  add({icome::benchmarks::loop_figures(extent), icome::benchmarks::implicit_figures(extent),
       icome::benchmarks::panel_figures(extent)});
  return sections;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures the haptic core: ticks, pops, builds, beside packaged peers. Takes minutes.");
  bool is_quick = false;
  bool as_json = false;
  std::vector<std::filesystem::path> files;
  app.add_flag("--quick", is_quick, "Small meshes and short runs: does it work at all?");
  app.add_flag("--json", as_json, "Print JSON instead of a table");
  app.add_option("--mesh", files,
                 "Measure only slides over these meshes: .obj, .ply, .stl, .off, .glb, also .xz")
      ->check(CLI::ExistingFile);
  CLI11_PARSE(app, argc, argv);

  const Extent extent = is_quick ? quick() : full();
  const std::vector<Section> sections =
      files.empty() ? all_sections(extent) : sections_of_meshes(extent, files);
  as_json ? icome::benchmarks::print_json(sections) : icome::benchmarks::print_table(sections);
  const Faults faults = icome::benchmarks::total_faults(sections);
  return faults.pops + faults.sticks == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
