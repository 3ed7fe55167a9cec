#pragma once
#include <filesystem>
#include <string>

class QWidget;

namespace icome::ui {

struct CutoutWindowOptions {
  std::filesystem::path file = {};  // empty: an empty stage
  std::string theme = {};           // "dark", "light"; empty: as the main window has it
};

/// Opens a window as a program of its own, and gives the exit code when it is closed. Where there is no
/// display, standard error tells what goes without one, and 1 is returned.
int run_cutout_window(int argc, char** argv, const CutoutWindowOptions& options);

/// Opens a window of its own for an animation, which is gone when it is closed; an empty stage without a
/// file.
void open_cutout_window(const std::filesystem::path& file);
/// Is it an animation's file, by its name?
bool is_cutout_file(const std::filesystem::path& file);
/// Asks which animation, and opens it likewise.
void choose_cutout(QWidget& parent);

}  // namespace icome::ui
