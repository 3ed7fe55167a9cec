// Compares a session with its targets: how soon an edit is felt and seen, how steady the servo stays beside a
// display and an import, how soon a design is on the screen. One run, one table.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "places.h"
#include "session_figures.h"

int main(int argc, char** argv) {
  using namespace icome::benchmarks;
  CLI::App app("Measures a session. Takes two minutes.");
  bool is_quick = false;
  SessionExtent extent;
  extent.demo = icome::places::project_folder() / "data" / "demo.wrl";
  app.add_flag("--quick", is_quick, "A little of everything: does it work at all?");
  app.add_option("--demo", extent.demo, "The design that start-up is measured with (default: the demo)");
  CLI11_PARSE(app, argc, argv);
  if (is_quick)
    extent = {.edits = 4, .grid = 30, .seconds = 0.5, .starts = 1, .most_objects = 100, .demo = extent.demo};
  std::vector<SessionSection> sections;
  for (const auto& figures : {scale_figures, felt_figures, seen_figures, servo_figures, start_figures})
    sections.push_back(figures(extent));
  print_sections(sections);
}
