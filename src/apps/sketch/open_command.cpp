#include "apps/sketch/open_command.h"

#include <CLI/CLI.hpp>

#include "apps/help_text.h"
#include "ui/sketch/run_sketch.h"

namespace icome::apps {
namespace {

constexpr const char* kOpenNotes =
    "Examples:\n"
    "  icome sketch open                            an empty page of A4\n"
    "  icome sketch open drawing.svg\n"
    "  icome sketch open signature.svc              its strokes as curves\n"
    "\n"
    "FILE: an SVG file, or strokes as for icome sketch fit. F1 lists the keys in the window. What it saves "
    "is "
    "SVG,\n"
    "which keeps all; pictures (.png, .pdf) are exported.";

}  // namespace

void add_sketch_open(CLI::App& sketch, SketchOptions& options) {
  CLI::App& open = *sketch.add_subcommand("open", "Draw in a window, with a pen or the mouse");
  open.footer(kOpenNotes);
  open.add_option("FILE", options.in, "An SVG file, or a recording of a pen (default: an empty page)")
      ->type_name("");
  open.add_option("--theme", options.theme, kThemeHelp)
      ->type_name("dark|light")
      ->check(CLI::IsMember({"dark", "light"}));
  open.callback([&options] { options.task = "open"; });
}

int run_sketch_open(const SketchOptions& options) {
  char name[] = "icome";
  char* arguments[] = {name, nullptr};
  return ui::run_sketch_window(1, arguments, {.file = options.in, .theme = options.theme});
}

}  // namespace icome::apps
