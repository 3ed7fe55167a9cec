// Compares the world with its target figures: edits, their journal beside SQLite and beside saving the whole
// design, opening, memory, edits of a large mesh, and files beside Coin. One run, one table.
#include <CLI/CLI.hpp>

#include "world_figures.h"

int main(int argc, char** argv) {
  CLI::App app("Measures the world and its journal. Takes a minute.");
  bool is_quick = false;
  app.add_flag("--quick", is_quick, "A small world: does it work at all?");
  CLI11_PARSE(app, argc, argv);
  using namespace icome::benchmarks;
  const WorldExtent quick{.objects = 2000, .edits = 500, .synced = 20, .group = 10, .grid = 30, .repeats = 2};
  const WorldExtent extent = is_quick ? quick : WorldExtent{};
  std::vector<WorldSection> sections{edit_figures(extent), journal_figures(extent), file_figures(extent),
                                     mesh_figures(extent)};
  for (WorldSection& section : design_figures(extent)) sections.push_back(std::move(section));
  print_table(sections);
}
