#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "sketch/feel/felt_pen.h"

namespace icome::ui {

struct SketchWindowOptions {
  std::filesystem::path file = {};                 // empty: an empty page
  std::string theme = {};                          // "dark", "light"; empty: as the main window has it
  std::unique_ptr<sketch::FeltPen> pen = nullptr;  // one that pushes back, started; null: none
};

/// Opens a window as a program of its own, and gives the exit code when it is closed. Where there is no
/// display, standard error tells what goes without one, and 1 is returned.
int run_sketch_window(int argc, char** argv, SketchWindowOptions options);

}  // namespace icome::ui
