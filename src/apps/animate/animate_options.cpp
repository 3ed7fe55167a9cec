#include "apps/animate/animate_options.h"

#include <CLI/CLI.hpp>

#include "animation/project/project.h"
#include "apps/help_text.h"
#include "apps/option_checks.h"

namespace icome::apps {
namespace {

constexpr const char* kAnimateNotes =
    "Examples:\n"
    "  icome animate new --open                          the window, with an empty stage\n"
    "  icome animate boat.cutout --open\n"
    "  icome animate boat.cutout                         what is in it, and what is missing\n"
    "  icome animate boat.cutout --out boat.mp4\n"
    "  icome animate boat.cutout --out boat.png --frames 12-12\n"
    "  icome animate boat.cutout --out 'shots/%04d.png' --frames 0-47\n"
    "  icome animate new --apply edits.jsonl --save boat.cutout\n"
    "  icome animate boat.cutout --record camera --known triangles.toml --save boat.cutout\n"
    "  icome animate --help-tools                        all tools with their parameters\n"
    "  icome animate --help-tools key                    one of them\n"
    "\n"
    "PROJECT: a .cutout file, or new for an empty stage of 1280 x 720 px, 25 frames a second and 100\n"
    "frames. Names of files (pictures, sound) count from its folder, those of a new one from that of\n"
    "--save. Frames are counted from 0. Places are px of the stage, x to the right and y down; angles\n"
    "degrees, counter-clockwise as seen.\n"
    "\n"
    "OUT: .mp4, .webm, .gif and .apng (by the program ffmpeg), a folder (shots/) or a pattern\n"
    "(shot%04d.png) of .png or .svg files, or one such picture where one frame is wanted. The same\n"
    "project gives the same bytes each time.\n"
    "\n"
    "edits.jsonl may be:\n"
    "  {\"op\": \"stage\", \"width\": 640, \"height\": 360, \"rate\": 12, \"length\": 24}\n"
    "  {\"op\": \"add-cell\", \"pictures\": \"boat.svg\", \"place\": [100, 200]}\n"
    "  {\"op\": \"key\", \"cell\": \"boat\", \"frame\": 0, \"x\": 100, \"angle\": -4, \"ease\": \"eased\"}\n"
    "  {\"op\": \"key\", \"cell\": \"boat\", \"frame\": 23, \"x\": 540, \"angle\": 6}\n"
    "Empty lines and those that begin with # are skipped. undo and redo are tools, too. A line that is\n"
    "wrong ends the run with its number, and nothing is written.\n"
    "\n"
    "--record: triangles on a table (icome track --help) move the cells as the project's mapping says,\n"
    "while the frames of the source are taken down; constraints hold. A list whose triangles name cells\n"
    "(cell = \"boat\") needs no mapping.\n"
    "\n"
    "JSON: {project, width, height, rate, frames, layers: [{name, visible, locked, cells: [{number,\n"
    "name, pictures, pivot, keys}]}], constraints: [{number, kind, cells}], triangles: [{id, mode,\n"
    "cell}], sound, marks, missing: [{file, message, cells}], recovered (edits that were not saved),\n"
    "operations, errors: [{line, op, message}], notes, recorded (with --record: {frames, dropped,\n"
    "keys}), saved (null when it was not), written (with --out: {out, first, last, width, height,\n"
    "files}), hash (equal for equal projects)}.\n"
    "\n"
    "Exit code: 0 done, 1 something could not be done, 2 wrong usage, 130 it was interrupted.";

void add_changes(CLI::App& animate, AnimateOptions& options) {
  animate
      .add_option("--apply", options.apply,
                  "Change it by a script of tools, a JSON object a line; - reads "
                  "standard input")
      ->type_name("EDITS.jsonl");
  animate.add_flag("--keep-going", options.keep_going, "Skip lines that are wrong, and go on");
  animate.add_option("--save", options.save, "Write the changed project")->type_name("NEW.cutout");
  animate.add_flag("--help-tools", options.help_tools, "List the tools, or the one that is named");
}

void add_recording(CLI::App& animate, AnimateOptions& options) {
  animate
      .add_option("--record", options.record, "Let triangles on a table move the cells, from these frames")
      ->type_name("SOURCE");
  animate.add_option("--known", options.known, "The list of triangles")->type_name("K.toml");
  animate
      .add_option("--view", options.view, "How the camera sees the table, as icome track --calibrate made it")
      ->type_name("VIEW.toml");
  animate.add_option("--table", options.table, "Size of the table in mm, without --view (default 640x480)")
      ->type_name("WxH")
      ->delimiter('x')
      ->expected(2)
      ->check(number_range(10.0, 100'000.0));
  animate.add_option("--layer", options.layer, "Record cells of this layer only")->type_name("NAME");
  animate.add_option("--from", options.from, "Frame at which the recording begins (default 0)")
      ->type_name("FRAME")
      ->check(number_range(0.0, double(animation::kLongestAnimation - 1)));
  animate
      .add_option("--seconds", options.seconds, "End the recording after so long (default: with the source)")
      ->type_name("S")
      ->check(number_range(0.0, 36'000.0));
  animate
      .add_option("--thin", options.thin,
                  "Leave keys out that lie so near the way between others (px, default 0.25; 0: none)")
      ->type_name("PX")
      ->check(number_range(0.0, 1000.0));
}

}  // namespace

void add_animate(CLI::App& app, AnimateOptions& options) {
  CLI::App& animate = *app.add_subcommand("animate", "Cut-out animations: look, change, record, render");
  animate.footer(kAnimateNotes);
  animate.add_option("PROJECT", options.project, "A .cutout file, or new")->type_name("");
  animate.add_option("--out", options.out, "Render it, without a window")->type_name("OUT");
  animate.add_option("--frames", options.frames, "Only these frames, both included (default: all)")
      ->type_name("A-B");
  animate.add_option("--scale", options.scale, "Size of pictures, 1 for the stage's (default 1)")
      ->type_name("FACTOR")
      ->check(number_range(0.01, 8.0));
  animate.add_flag("--clear", options.clear, "Leave the background out, where the format can");
  animate.add_flag("--json", options.json, "Print a JSON document (fields below)");
  add_changes(animate, options);
  add_recording(animate, options);
  animate.add_flag("--open", options.open, "Open it in a window, which F1 explains");
  animate.add_option("--theme", options.theme, kThemeHelp)
      ->type_name("dark|light")
      ->check(CLI::IsMember({"dark", "light"}));
  animate.callback([&options] {
    options.is_wanted = true;
    if (options.help_tools && !options.project.empty()) options.tool = options.project.string();
    options.is_new = options.project == "new";
  });
}

}  // namespace icome::apps
