// Measures how many edits a second the store of designs makes durable, and how long each waits. One run, one
// table.
#include <CLI/CLI.hpp>

#include "store_figures.h"

int main(int argc, char** argv) {
  CLI::App app("Measures the stores of designs. Takes a minute.");
  bool is_quick = false;
  std::string folder = std::filesystem::temp_directory_path().string();
  app.add_flag("--quick", is_quick, "A short run: does it work at all?");
  app.add_option("--folder", folder, "On which disk; by default that of temporary files")
      ->check(CLI::ExistingDirectory);
  CLI11_PARSE(app, argc, argv);
  using namespace icome::benchmarks;
  StoreExtent extent;
  if (is_quick) extent.seconds = 0.1;
  print_table(store_figures(folder, extent), extent, folder);
}
