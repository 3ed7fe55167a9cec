#include "apps/track/track_options.h"

#include <CLI/CLI.hpp>

#include "apps/option_checks.h"

namespace icome::apps {
namespace {

constexpr const char* kTrackNotes =
    "Examples:\n"
    "  icome track --sheet sheet.pdf --known mine.toml    a chessboard and the triangles, to print and cut "
    "out\n"
    "  icome track camera --calibrate view.toml           hold the chessboard up, then lay it on the red "
    "table\n"
    "  icome track camera --known mine.toml --view view.toml --tuio localhost:3333\n"
    "  icome track shot.jpg --known mine.toml --picture found.png\n"
    "  icome track 'frames/*.png' --known mine.toml --table 600x400 --json\n"
    "  icome track camera --known mine.toml --view view.toml --learn --id boat\n"
    "  icome track camera --view view.toml --colours      the table with one triangle on it, and nothing "
    "else\n"
    "  icome track --synth made --frames 100 --triangles 12 --hands --occlude 0.5\n"
    "  icome track made --known made/known.toml --view made/view.toml --truth made/truth.json\n"
    "\n"
    "SOURCE: camera or camera:2 (or /dev/video2); a picture (PNG, JPEG); a folder of pictures; a pattern\n"
    "('frames/*.jpg', shot%04d.png); a video file; rtsp://, http:// or https:// streams; udp://HOST:PORT "
    "for\n"
    "RTP/JPEG; gst:PIPELINE for anything that GStreamer knows. A camera or stream gives its newest frame; "
    "frames\n"
    "that came in between are counted as dropped and never kept. Of files, each frame is looked at. Ctrl-C "
    "ends.\n"
    "\n"
    "K.toml lists the triangles, blue and isosceles; it may be edited while the program runs:\n"
    "  [[triangle]]\n"
    "  id = \"boat\"\n"
    "  base_angle_deg = 70     # of the two equal corners; not near 60, which looks the same three ways\n"
    "  height_mm = 80          # from the middle of the base to the apex\n"
    "  cell = \"boat\"           # of an animation; may be left out\n"
    "\n"
    "Without --view the frame's corners are the table's, and its size is --table; a folder that --synth "
    "made\n"
    "brings its own view. A place is that of the triangle's centroid, in mm from the table's upper left "
    "corner,\n"
    "x to the right and y down as the camera sees it; the angle is that of the way from the middle of the "
    "base to\n"
    "the apex, in radians, counter-clockwise as seen, 0 to the right.\n"
    "\n"
    "JSON: {\"frames\": [{\"t\" (s), \"ms\" (that finding took), \"triangles\": [{\"id\", \"x_mm\", "
    "\"y_mm\", \"angle_rad\",\n"
    "  \"confidence\" (0 to 1)}]}], \"dropped\", \"damaged\" (pictures that could not be read), \"truth\" "
    "(with --truth:\n"
    "  recall, position_rms_mm, angle_rms_deg, ghosts, swaps)}. Frames are printed as they come. It goes to "
    "standard\n"
    "output, all messages to standard error.\n"
    "\n"
    "TUIO 1.1: a bundle /tuio/2Dobj a frame by UDP, class = place in K.toml counted from 0, x and y from 0 "
    "to 1.\n"
    "\n"
    "The frames of --synth are computed: they are not a camera. docs/cutout.md tells how to check a real "
    "one.\n"
    "\n"
    "Exit code: 0 done, 1 something could not be done, 2 wrong usage, 130 it was interrupted before a frame "
    "came.";

void add_tracking(CLI::App& track, TrackOptions& options) {
  track.add_option("SOURCE", options.source, "Where frames come from (see below)")->type_name("");
  track.add_option("--known", options.known, "The list of triangles")->type_name("K.toml");
  track.add_option("--pipeline", options.pipeline, "How triangles are found (default pose)")
      ->type_name("pose|thesis")
      ->check(CLI::IsMember({"pose", "thesis"}));
  track.add_flag("--cold", options.cold, "Search every frame from nothing, in place of following");
  track.add_option("--table", options.table, "Size of the table in mm (default 640x480)")
      ->type_name("WxH")
      ->delimiter('x')
      ->expected(2)
      ->check(number_range(10.0, 100'000.0));
  track.add_option("--view", options.view, "How the camera sees the table, as --calibrate made it")
      ->type_name("VIEW.toml");
  track.add_option("--size", options.camera_size, "Of a camera's or made frames, pixels")->type_name("WxH");
  track
      .add_option("--rate", options.rate, "Frames/s of a camera; that pictures were taken, or are made, with")
      ->type_name("HZ")
      ->check(number_range(0.1, 1000.0));
  track
      .add_option("--frames", options.frames, "End after N frames (--synth: how many are made, default 100)")
      ->type_name("N")
      ->check(number_range(1.0, 1e6));
  track.add_option("--seconds", options.seconds, "End after that time")
      ->type_name("S")
      ->check(number_range(0.0, 1e9));
  track.add_option("--picture", options.picture, "Draw what was found over the last frame")
      ->type_name("OUT.png");
  track.add_option("--tuio", options.tuio, "Send what is found to other programs (default port 3333)")
      ->type_name("HOST:PORT");
  track.add_option("--truth", options.truth, "Compare with the truth of made frames")
      ->type_name("TRUTH.json");
  track.add_flag("--json", options.json, "Print what is found as JSON (fields below)");
}

/// Tasks that are chosen by flags.
struct Preparing {
  bool learn = false, colours = false;
};

void add_preparing(CLI::App& track, TrackOptions& options, Preparing& preparing) {
  track
      .add_option("--sheet", options.sheet, "Draw the chessboard and the triangles of --known, at true size")
      ->type_name("OUT.pdf");
  track
      .add_option("--calibrate", options.calibrate,
                  "Find lens and table by pictures of the chessboard, the last with the sheet flat on the "
                  "table, or by "
                  "the red table's corners alone")
      ->type_name("VIEW.toml");
  track
      .add_option("--corners", options.corners,
                  "With --calibrate: the table's corners in pixels from the picture's upper left corner, "
                  "clockwise from the upper left (default: where red ends)")
      ->type_name("X,Y,X,Y,X,Y,X,Y")
      ->delimiter(',')
      ->expected(8);
  track.add_option("--thickness", options.thickness, "Of the triangles, mm (default 3)")
      ->type_name("MM")
      ->check(number_range(0.0, 50.0));
  track.add_flag("--colours", preparing.colours,
                 "Measure the colours of the table and of the one triangle on it, and keep them in --view");
  track.add_flag("--learn", preparing.learn,
                 "Measure the one triangle on the table and add it to --known as --id");
  track.add_option("--id", options.id, "With --learn: its name")->type_name("NAME");
  track.add_option("--cell", options.cell, "With --learn: the animation's cell that it moves")
      ->type_name("NAME");
}

void add_making(CLI::App& track, TrackOptions& options) {
  track.add_option("--synth", options.synth, "Make frames with their truth in a new folder")
      ->type_name("OUT");
  track
      .add_option("--triangles", options.triangles,
                  "With --synth: how many (default 6; else those of --known)")
      ->type_name("N")
      ->check(number_range(0.0, 1000.0));
  track.add_flag("--hands", options.hands, "With --synth: hands hold triangles");
  track.add_option("--photos", options.photos, "With --hands: a folder of hands, PNG with opacity")
      ->type_name("FOLDER");
  track.add_option("--occlude", options.occlude, "With --synth: cover this share of each edge")
      ->type_name("0-1")
      ->check(number_range(0.0, 1.0));
  track.add_flag("--still", options.still, "With --synth: new places in every frame, in place of motion");
  track.add_flag("--board", options.board, "With --synth: the chessboard, for --calibrate");
  track.add_option("--noise", options.noise, "With --synth: standard deviation, of 255 (default 3)")
      ->type_name("N")
      ->check(number_range(0.0, 100.0));
  track.add_option("--blur", options.blur, "With --synth: of the lens, pixels (default 0.7)")
      ->type_name("PX")
      ->check(number_range(0.0, 20.0));
  track.add_option("--light", options.light, "With --synth: exposure (default 1)")
      ->type_name("N")
      ->check(number_range(0.0, 100.0));
  track
      .add_option("--shutter", options.exposure, "With --synth: s that it is open (default 0: nothing blurs)")
      ->type_name("S")
      ->check(number_range(0.0, 1.0));
  track.add_option("--tilt", options.tilt, "With --synth: of the camera, rad (default 0.15)")
      ->type_name("RAD")
      ->check(number_range(-0.7, 0.7));
  track.add_option("--quality", options.quality, "With --synth: of JPEG, 1 to 100; 0: PNG (default 90)")
      ->type_name("N")
      ->check(number_range(0.0, 100.0));
  track.add_option("--seed", options.seed, "With --synth: of all that is random (default 1)")->type_name("N");
}

/// Chooses the task, and throws where the options of several are mixed.
void choose_task(TrackOptions& options, const Preparing& preparing) {
  const auto& [learn, colours] = preparing;
  const int named = int(!options.sheet.empty()) + int(!options.calibrate.empty()) +
                    int(!options.synth.empty()) + int(learn) + int(colours);
  if (named > 1)
    throw CLI::ValidationError("--sheet, --calibrate, --colours, --learn and --synth go one at a time.");
  options.task = !options.sheet.empty()       ? "sheet"
                 : !options.calibrate.empty() ? "calibrate"
                 : !options.synth.empty()     ? "synth"
                 : learn                      ? "learn"
                 : colours                    ? "colours"
                                              : "track";
  const bool needs_source = options.task != "sheet" && options.task != "synth";
  if (needs_source && options.source.empty()) throw CLI::RequiredError("SOURCE");
  if (!needs_source && !options.source.empty())
    throw CLI::ValidationError("--" + options.task + " takes no SOURCE.");
  if ((options.task == "track" || learn) && options.known.empty()) throw CLI::RequiredError("--known");
  if (learn && options.id.empty()) throw CLI::RequiredError("--id");
  if (colours && options.view.empty()) throw CLI::RequiredError("--view");
}

}  // namespace

void add_track(CLI::App& app, TrackOptions& options) {
  CLI::App& track = *app.add_subcommand(
      "track", "Follow blue triangles of plastic on a red table with a camera (tangible cut-out animation)");
  track.footer(kTrackNotes);
  const auto preparing = std::make_shared<Preparing>();
  add_tracking(track, options);
  add_preparing(track, options, *preparing);
  add_making(track, options);
  track.callback([&options, preparing] { choose_task(options, *preparing); });
}

}  // namespace icome::apps
