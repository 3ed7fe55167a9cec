#pragma once
#include <filesystem>
#include <string>

namespace icome::ui {

struct SketchWindowOptions {
  std::filesystem::path file = {};  // empty: an empty page
  std::string theme = {};           // "dark", "light"; empty: as the main window has it
};

/// Opens a window as a program of its own, and gives the exit code when it is closed. Where there is no
/// display, standard error tells what goes without one, and 1 is returned.
int run_sketch_window(int argc, char** argv, const SketchWindowOptions& options);

}  // namespace icome::ui
