#include "apps/sketch/sketch_options.h"

#include <CLI/CLI.hpp>

#include "apps/option_checks.h"
#include "apps/sketch/open_command.h"

namespace icome::apps {
namespace {

constexpr const char* kSketchNotes =
    "Examples:\n"
    "  icome sketch open drawing.svg                draw in a window\n"
    "  icome sketch fit strokes.csv --json          curves of a pen's strokes\n"
    "  icome sketch render strokes.scap page.png    how they look\n"
    "  icome sketch edit drawing.svg --apply edits.jsonl --out new.svg\n"
    "\n"
    "All lengths are mm; x is to the right and y down (docs/sketch.md).";

constexpr const char* kFitNotes =
    "Examples:\n"
    "  icome sketch fit strokes.csv                 a table: samples, segments, errors\n"
    "  icome sketch fit signature.svc --error 0.05 --json\n"
    "  icome sketch fit strokes.inkml --out drawing.svg\n"
    "  icome sketch fit strokes.csv --method thesis --shared 5\n"
    "\n"
    "STROKES: CSV with the header t,x,y,pressure (s, mm, mm, 0 to 1; a row with pressure 0 ends a stroke),\n"
    "InkML, .svc (SVC 2004), .scap (StrokeStrip), .dat (MyPaint) or .events (evemu).\n"
    "\n"
    "The exact method keeps the whole line from sample to sample and the curve within --error of each "
    "other,\n"
    "both ways, with few segments that turn into each other smoothly but at corners. The method of the "
    "thesis\n"
    "(4.2 to 4.7) keeps the root of the mean square within it, with samples that neighbours share; its\n"
    "greatest error is told, and may be larger.\n"
    "\n"
    "JSON: {file, method, error_mm, notes, strokes: [{samples, segments: [[[x,y],[x,y],[x,y],[x,y]], ...],\n"
    "widths: [[t0,w0,t1,w1], ...] (t counts segments: 2.5 is the middle of the third; w in mm), "
    "max_error_mm\n"
    "(the greatest distance of curve and line, certainly not more), corners (joints that break)}]}.";

constexpr const char* kRenderNotes =
    "Examples:\n"
    "  icome sketch render drawing.svg page.png --size 2400\n"
    "  icome sketch render strokes.csv page.pdf     as large as it is\n"
    "  icome sketch render strokes.scap lines.svg --centre-lines\n"
    "\n"
    "IN: an SVG file, or strokes as for icome sketch fit, which become curves first. An SVG file of this\n"
    "program keeps all that was drawn; of others the paths and shapes are taken, and what is skipped is "
    "told.\n"
    "\n"
    "JSON: {in, out, layers, strokes, segments, width_mm, height_mm, notes}.";

constexpr const char* kEditNotes =
    "Examples:\n"
    "  icome sketch edit new --apply edits.jsonl --out drawing.svg\n"
    "  icome sketch edit strokes.csv --apply edits.jsonl --out page.png --json\n"
    "  icome sketch edit --help-tools               all tools with their parameters\n"
    "  icome sketch edit --help-tools erase         one of them\n"
    "\n"
    "edits.jsonl may be:\n"
    "  {\"op\": \"draw\", \"way\": [[20, 20], [60, 50], [100, 20]], \"closed\": true, \"fill\": \"orange\"}\n"
    "  {\"op\": \"pull\", \"at\": [60, 50], \"to\": [60, 70]}\n"
    "  {\"op\": \"lasso\", \"way\": [[0, 0], [50, 0], [50, 90], [0, 90]]}\n"
    "  {\"op\": \"rotate\", \"degrees\": 10}\n"
    "  {\"op\": \"erase\", \"way\": [[90, 0], [90, 60]], \"radius\": 3}\n"
    "\n"
    "IN: new for an empty page of A4, an SVG file, or strokes as for icome sketch fit. OUT: .svg keeps all,\n"
    ".png and .pdf are pictures. Empty lines and lines that begin with # are skipped. undo and redo are\n"
    "tools, too. A line that is wrong ends the run with its number, and nothing is written.\n"
    "\n"
    "JSON: {in, out (null when nothing was written), operations (how many were done), errors: [{line, op,\n"
    "message}], notes: [{line, op, text}], layers, strokes, segments, hash (equal for\n"
    "drawings that are equal, numbers of strokes and layers too, which saving may change)}.";

constexpr const char* kModelNotes =
    "Examples:\n"
    "  icome sketch model drawing.svg drawing.wrl\n"
    "  icome touch drawing.wrl --check              feel it\n"
    "  icome sketch model strokes.csv strokes.stl --height 0.3 --height-by-width 0.5 --sheet 2\n"
    "  icome sketch model drawing.svg drawing.icome --drawing\n"
    "  icome sketch edit drawing.icome --apply edits.jsonl --out drawing.icome\n"
    "\n"
    "Each line becomes a ridge in its colour, each fill a flatter one, on a sheet that feels as --paper "
    "says;\n"
    "layers are groups. The sheet lies in the plane z = 0 about the origin, y up. OUT: a design (icome "
    "convert\n"
    "--help tells its types).\n"
    "\n"
    "JSON: {in, out, objects, triangles, notes}.";

constexpr const char* kListNotes =
    "JSON: {in, width_mm, height_mm, notes, layers: [{number, name, visible, locked, strokes: [{number,\n"
    "segments, length_mm, widest_mm, colour, opacity, fill (or null), closed, bounds: [x0,y0,x1,y1]}]}]}.";

constexpr const char* kFeelNotes =
    "Examples:\n"
    "  icome sketch feel strokes.csv --paper canvas\n"
    "  icome sketch feel signature.svc --device Touch --trace ticks.csv --out drawn.svg\n"
    "\n"
    "A simulated hand draws the strokes with a simulated device, as fast as they were made, on a plane that "
    "the\n"
    "servo renders as it would for a person: a spring and a damper, friction and a grain. The hand presses "
    "so\n"
    "that it is pushed with 2 N at full pressure, as far as the device can. What is drawn is where the pen "
    "was.\n"
    "\n"
    "Papers: paper, blackboard, canvas and glass. An eraser rubs 1.8 times as hard.\n"
    "\n"
    "Trace: stroke,t,x,y,z,force_x,force_y,force_z,pressure; s, m and N, z up from the paper, the stroke's "
    "middle\n"
    "at the origin and y up.\n"
    "\n"
    "JSON: {file, paper, eraser, device, rate_hz, notes, strokes: [{samples (of the recording), ticks, "
    "drawn\n"
    "(ticks on the paper), max_force_n, max_step_n (from one tick to the next), rubbing_n (mean force along "
    "the\n"
    "paper), work_j (of the device on the pen; never above 0 where it gives no energy), segments, "
    "max_error_mm\n"
    "(of the curve of what was drawn)}]}.";

void add_fit_options(CLI::App& command, SketchFitOptions& fit) {
  command.add_option("--error", fit.error_mm, "How far a curve may be from the strokes (default 0.1)")
      ->type_name("MM")
      ->check(number_range(0.0001, 1000.0));
  command.add_option("--method", fit.method, "How curves are fitted (default exact)")
      ->type_name("exact|thesis")
      ->check(CLI::IsMember({"exact", "thesis"}));
  command
      .add_option("--shared", fit.shared,
                  "Samples that neighbours share, for the thesis's method (default 3)")
      ->type_name("S")
      ->check(number_range(0.0, 50.0));
  command.add_flag("--no-refit", fit.no_refit, "Leave the segments as they were made while the pen moved");
  command.add_option("--thinnest", fit.thinnest_mm, "Width of the line without pressure (default 0.2)")
      ->type_name("MM")
      ->check(number_range(0.0, 1000.0));
  command.add_option("--widest", fit.widest_mm, "Width of the line at full pressure (default 1)")
      ->type_name("MM")
      ->check(number_range(0.0, 1000.0));
}

void add_object_option(CLI::App& command, SketchOptions& options) {
  command.add_option("--object", options.object, "The drawing in a design (default: the only one)")
      ->type_name("NAME");
}

void add_lines_option(CLI::App& command, SketchOptions& options) {
  command.add_flag("--centre-lines", options.centre_lines,
                   "In SVG files, write lines with a width instead of their outlines");
}

CLI::App& add_task(CLI::App& sketch, const char* name, const char* summary, const char* notes,
                   SketchOptions& options) {
  CLI::App& task = *sketch.add_subcommand(name, summary);
  task.footer(notes);
  task.add_flag("--json", options.json, "Print a JSON document (fields below)");
  task.callback([&options, name] { options.task = name; });
  return task;
}

}  // namespace

sketch::FitSettings SketchFitOptions::settings() const {
  constexpr double kMetresOfMm = 0.001;
  sketch::FitSettings settings;
  settings.method = method == "thesis" ? sketch::FitMethod::Thesis : sketch::FitMethod::Exact;
  settings.error = error_mm * kMetresOfMm;
  settings.shared = shared;
  settings.refit = !no_refit;
  settings.tip = {thinnest_mm * kMetresOfMm, widest_mm * kMetresOfMm};
  return settings;
}

void add_sketch(CLI::App& app, SketchOptions& options) {
  CLI::App& sketch =
      *app.add_subcommand("sketch", "Draw with a pen: curves of strokes, pictures, edits (thesis 4.5)");
  sketch.footer(kSketchNotes);
  sketch.require_subcommand(1);
  add_sketch_open(sketch, options);
  CLI::App& fit = add_task(sketch, "fit", "Fit curves to the strokes of a pen", kFitNotes, options);
  fit.add_option("STROKES", options.in, "A recording of a pen")->type_name("")->required();
  add_fit_options(fit, options.fit);
  fit.add_option("--out", options.out, "Write the drawing")->type_name("OUT.svg|png|pdf");
  add_lines_option(fit, options);
  CLI::App& render =
      add_task(sketch, "render", "Make a picture of a drawing or of strokes", kRenderNotes, options);
  render.add_option("IN", options.in, "An SVG file, a design with a drawing, or a recording of a pen")
      ->type_name("")
      ->required();
  render.add_option("OUT", options.out, "The picture: .png, .svg or .pdf")->type_name("")->required();
  render.add_option("--size", options.size, "Pixels along the longer side of a PNG file (default 1200)")
      ->type_name("PIXELS")
      ->check(number_range(1.0, 16384.0));
  render
      .add_option("--page", options.page,
                  "What is shown: the paper, the drawing, or the paper where it is enough (default auto)")
      ->type_name("auto|paper|drawing")
      ->check(CLI::IsMember({"auto", "paper", "drawing"}));
  render.add_option("--background", options.background, "white or none (default white)")
      ->type_name("white|none")
      ->check(CLI::IsMember({"white", "none"}));
  add_object_option(render, options);
  add_fit_options(render, options.fit);
  add_lines_option(render, options);
  CLI::App& edit =
      add_task(sketch, "edit", "Change a drawing by a script: each line is a tool with its parameters",
               kEditNotes, options);
  edit.add_option("IN", options.in, "new, an SVG file, a design with a drawing, or a recording of a pen")
      ->type_name("REQUIRED");
  auto* const apply = edit.add_option("--apply", options.apply, "Tools, one a line; - for standard input");
  apply->type_name("EDITS.jsonl REQUIRED");
  auto* const out = edit.add_option("--out", options.out, "Write the drawing")->type_name("OUT REQUIRED");
  edit.add_flag("--keep-going", options.keep_going, "Go on after lines that are wrong");
  add_object_option(edit, options);
  add_fit_options(edit, options.fit);
  add_lines_option(edit, options);
  auto* const help_tools =
      edit.add_option("--help-tools", options.tool, "List all tools and their parameters, or one, and end")
          ->type_name("[TOOL]")
          ->expected(0, 1);
  edit.callback([&options, apply, out, help_tools] {
    options.task = "edit";
    options.help_tools = help_tools->count() > 0;
    if (options.help_tools) return;
    if (options.in.empty()) throw CLI::RequiredError("IN");
    if (apply->count() == 0) throw CLI::RequiredError("--apply");
    if (out->count() == 0) throw CLI::RequiredError("--out");
  });
  CLI::App& feel =
      add_task(sketch, "feel", "Draw strokes with a simulated pen that feels the paper", kFeelNotes, options);
  feel.add_option("STROKES", options.in, "A recording of a pen")->type_name("")->required();
  feel.add_option("--paper", options.paper, "What is drawn on (default paper)")->type_name("NAME");
  feel.add_flag("--eraser", options.eraser, "An eraser in place of a pen");
  feel.add_option("--device", options.device, "The profile of a device, such as Touch (icome devices)")
      ->type_name("NAME");
  feel.add_option("--rate", options.rate_hz, "Of the servo (default 1000)")
      ->type_name("HZ")
      ->check(number_range(500.0, 10000.0));
  feel.add_option("--trace", options.trace, "Write every tick")->type_name("OUT.csv");
  feel.add_option("--out", options.out, "Write what was drawn")->type_name("OUT.svg|png|pdf");
  add_fit_options(feel, options.fit);
  CLI::App& model =
      add_task(sketch, "model", "Make a design of a drawing, to be touched: a ridge for each line",
               kModelNotes, options);
  model.add_option("IN", options.in, "An SVG file, a design with a drawing, or a recording of a pen")
      ->type_name("")
      ->required();
  model.add_option("OUT", options.out, "The design")->type_name("")->required();
  model.add_option("--height", options.height_mm, "Of every line (default 0.5)")
      ->type_name("MM")
      ->check(number_range(0.05, 100.0));
  model
      .add_option("--height-by-width", options.height_by_width,
                  "More, for each mm of its greatest width (default 0)")
      ->type_name("MM")
      ->check(number_range(0.0, 10.0));
  model.add_flag("--drawing", options.as_drawing,
                 "One object that can be drawn on and extruded, not a mesh for each line");
  model.add_option("--sheet", options.sheet_mm, "Thickness of the paper below, 0 for none (default 1)")
      ->type_name("MM")
      ->check(number_range(0.0, 1000.0));
  model
      .add_option("--paper", options.paper,
                  "How the sheet feels: paper, blackboard, canvas or glass (default paper)")
      ->type_name("NAME");
  add_object_option(model, options);
  add_fit_options(model, options.fit);
  CLI::App& list = add_task(sketch, "list", "List the layers and strokes of a drawing", kListNotes, options);
  list.add_option("IN", options.in, "An SVG file, a design with a drawing, or a recording of a pen")
      ->type_name("")
      ->required();
  add_object_option(list, options);
  add_fit_options(list, options.fit);
}

}  // namespace icome::apps
