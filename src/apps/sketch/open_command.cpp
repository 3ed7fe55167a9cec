#include "apps/sketch/open_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "apps/help_text.h"
#include "apps/sketch/sketch_work.h"
#include "devices/catalogue.h"
#include "ui/sketch/run_sketch.h"

namespace icome::apps {
namespace {

constexpr const char* kOpenNotes =
    "Examples:\n"
    "  icome sketch open                            an empty page of A4\n"
    "  icome sketch open drawing.svg\n"
    "  icome sketch open signature.svc              its strokes as curves\n"
    "  icome sketch open --device haply             with a device that pushes back, on paper that is felt\n"
    "  icome sketch open --device Touch --paper canvas    the same, simulated: the mouse moves its pen\n"
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
  open.add_option("--device", options.device,
                  "Draw with a device that pushes back: an address (icome devices), or a profile, which is "
                  "simulated")
      ->type_name("NAME");
  open.add_option("--paper", options.paper,
                  "What is drawn on with it: paper, blackboard, canvas or glass (default paper)")
      ->type_name("NAME");
  open.callback([&options] { options.task = "open"; });
}

int run_sketch_open(const SketchOptions& options) {
  const auto paper = sketch::find_paper(options.paper);
  if (!paper) return sketch_failed(paper.error());
  ui::SketchWindowOptions window = {.file = options.in, .theme = options.theme};
  if (!options.device.empty()) {
    auto device = devices::open_device(options.device);
    if (!device) return sketch_failed(device.error());
    if (!((*device)->info().max_force > 0.0))
      return sketch_failed({fmt::format(
          "{}: this device gives no force; tablets and mice draw without --device", options.device)});
    window.pen = std::make_unique<sketch::FeltPen>(std::move(*device), *paper, drawing::Drawing().size);
    if (const auto started = window.pen->start(); !started) return sketch_failed(started.error());
  }
  char name[] = "icome";
  char* arguments[] = {name, nullptr};
  return ui::run_sketch_window(1, arguments, std::move(window));
}

}  // namespace icome::apps
