// Measures the cost of the desktop: frames of a moving view, beside Coin drawing them. One run, one table.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "desktop_figures.h"

namespace icome::benchmarks {
namespace {

void print_table(const std::vector<DesktopSection>& sections) {
  constexpr const char* kLine = "{:<58} {:>7} {:>17} {:>34}\n";
  fmt::print(fmt::runtime(kLine), "figure", "unit", "median", "ratio");
  for (const DesktopSection& section : sections) {
    fmt::print("-- {}\n", section.title);
    for (const DesktopRow& row : section.rows) {
      std::string ratio;
      if (row.times_of && *row.times_of > 0.0)
        ratio = fmt::format("{:.2f} of {}", row.value / *row.times_of, row.of);
      fmt::print(fmt::runtime(kLine), row.figure, row.unit, fmt::format("{:.1f}", row.value), ratio);
    }
  }
}

}  // namespace
}  // namespace icome::benchmarks

int main(int argc, char** argv) {
  CLI::App app("Measures what the desktop draws. Takes a minute.");
  bool is_quick = false;
  app.add_flag("--quick", is_quick, "A small scene: does it work at all?");
  CLI11_PARSE(app, argc, argv);
  using namespace icome::benchmarks;
  const DesktopExtent quick{.width = 320, .height = 200, .frames = 3, .objects = 50, .rows = 40};
  const DesktopExtent extent = is_quick ? quick : DesktopExtent{};
  std::vector<DesktopSection> sections;
  for (const auto& figures : {frame_figures}) {
    for (DesktopSection& section : figures(extent)) sections.push_back(std::move(section));
  }
  print_table(sections);
}
