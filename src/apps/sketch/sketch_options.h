#pragma once
#include <filesystem>
#include <string>

#include "sketch/fit/stroke_fit.h"

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
}

namespace icome::apps {

/// Options by which strokes become curves.
struct SketchFitOptions {
  double error_mm = 0.1;
  unsigned shared = 3;
  std::string method = "exact";
  bool no_refit = false;
  double thinnest_mm = 0.2;
  double widest_mm = 1.0;

  sketch::FitSettings settings() const;
};

/// The options of icome sketch.
struct SketchOptions {
  std::string task;  // "fit", "render", "edit", "list", "feel" or "open"; empty: none was named
  std::filesystem::path in;
  std::filesystem::path out;
  std::filesystem::path apply;  // edit: tools, one a line; "-": standard input
  std::string object;           // the drawing in a design; empty: the only one
  SketchFitOptions fit;
  std::string paper = "paper";       // feel, model: what is drawn on
  bool eraser = false;               // feel: an eraser in place of a pen
  std::string device;                // feel: a device's profile; empty: the simulated one
  double rate_hz = 1000.0;           // feel: of the servo
  std::filesystem::path trace;       // feel: what every tick did
  double height_mm = 0.5;            // model: of every line
  bool as_drawing = false;           // model: one object that can be drawn on
  double height_by_width = 0.0;      // model: for its greatest width, beside it
  double sheet_mm = 1.0;             // model: thickness of the paper, 0 for none
  std::string page = "auto";         // render: auto, paper or drawing
  int size = 1200;                   // render: pixels along the longer side
  std::string background = "white";  // render: a colour or "none"
  bool centre_lines = false;         // lines of SVG files as lines, not as outlines
  bool keep_going = false;
  bool help_tools = false;
  std::string tool;   // with help_tools: only this one
  std::string theme;  // open: "dark" or "light"; empty: as the main window has it
  bool json = false;
};

void add_sketch(CLI::App& app, SketchOptions& options);

}  // namespace icome::apps
