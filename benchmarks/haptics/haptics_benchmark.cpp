// The haptic core against the figures that are asked for and against packaged peers: one run, one table.
// Ends with 1 when any surface contact point was wrong: a quick answer that is wrong is no answer.
#include <CLI/CLI.hpp>
#include <cstdlib>

#include "figures.h"

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

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures the haptic core: ticks, pops, builds, beside packaged peers. Takes minutes.");
  bool is_quick = false;
  bool as_json = false;
  app.add_flag("--quick", is_quick, "Small meshes and short runs: does it work at all?");
  app.add_flag("--json", as_json, "Print JSON instead of a table");
  CLI11_PARSE(app, argc, argv);

  const Extent extent = is_quick ? quick() : full();
  std::vector<Section> sections = icome::benchmarks::mesh_figures(extent);
  sections.push_back(icome::benchmarks::primitive_figures(extent));
  sections.push_back(icome::benchmarks::wall_figures(extent));
  for (Section& section : icome::benchmarks::csg_figures(extent)) sections.push_back(std::move(section));
  sections.push_back(icome::benchmarks::loop_figures(extent));
  sections.push_back(icome::benchmarks::implicit_figures(extent));
  as_json ? icome::benchmarks::print_json(sections) : icome::benchmarks::print_table(sections);
  const Faults faults = icome::benchmarks::total_faults(sections);
  return faults.pops + faults.sticks == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
