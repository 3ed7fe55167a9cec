#include "apps/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <sstream>
#include <string_view>

#include "apps/desktop/desktop_command.h"
#include "apps/devices/devices_command.h"
#include "apps/devices/devices_help.h"
#include "apps/eye_options.h"
#include "apps/help_text.h"
#include "apps/option_checks.h"
#include "apps/serving/serving_command.h"
#include "apps/stats/stats_command.h"
#include "apps/stats/stats_help.h"
#include "apps/study/study_command.h"
#include "apps/study/study_help.h"
#include "apps/terminal.h"
#include "apps/touch/effect_options.h"
#include "base/version.h"
#include "collab/protocol/address.h"

namespace icome::apps {
namespace {

constexpr int kBadUsage = 2;

/// The options as CLI11 fills them in, before they are understood.
struct Entries {
  CsgOptions csg;
  std::string form = "tree";
  InfoOptions info;
  ConvertOptions convert;
  EditOptions edit;
  ShotOptions shot;
  std::string shot_size;
  std::string shot_background, shot_eye;
  EyeOptions shot_eyes;
  StatsOptions stats;
  StudyOptions study;
  TechniquesOptions techniques;
  DevicesOptions devices;
  ServingOptions serving;
  KeepOptions keep;
  HeadOptions head;
  MenuOptions menu;
  SpeechOptions speech;
  SketchOptions sketch;
  TrackOptions track;
  AnimateOptions animate;
  DesktopCommandOptions desktop;
  TouchOptions touch;
  std::string friction;
  std::string sides;
  std::string shading = "flat";
  std::string renderer;
  std::string subdivision;
  std::string bounds;
};

/// Adds options that limit the trust in other people's files.
void add_trust_options(CLI::App& command, ReadingOptions& reading) {
  command
      .add_option("--memory-limit", reading.memory_mb,
                  "Memory that reading a design may take (default: 20 times the files and 256 MB)")
      ->type_name("MB")
      ->check(number_range(1.0, 1e9));
  command.add_option("--seconds-limit", reading.seconds, "Time that reading a design may take (default 300)")
      ->type_name("S")
      ->check(number_range(0.0, 1e9));
  command.add_flag("--urls-above", reading.urls_above,
                   "Take in what the design names above its folder, too (../picture.png)");
}

void add_reading_options(CLI::App& command, ReadingOptions& reading) {
  command
      .add_option("--unit", reading.unit,
                  "Unit of the numbers in OBJ, PLY, STL and OFF files: m, dm, cm, mm, um or in (default m)")
      ->type_name("UNIT")
      ->check(CLI::IsMember({"m", "dm", "cm", "mm", "um", "in"}));
  command
      .add_option("--up", reading.up, "Axis that points up in the file (default y; z in .csg and .stl files)")
      ->type_name("y|z")
      ->check(CLI::IsMember({"y", "z"}));
  add_trust_options(command, reading);
}

void add_model_options(CLI::App& touch, Entries& entries) {
  TouchOptions& options = entries.touch;
  touch.add_option("MODEL", options.models, kModelHelp)->type_name("");
  add_reading_options(touch, options.reading);
  touch
      .add_option("--fit", options.fit,
                  "Scale each model about the origin until its longest side is M metres")
      ->type_name("M");
  touch
      .add_option("--sides", entries.sides,
                  "Which sides stop the tip (default: front of closed models, both of open ones)")
      ->type_name("front|both")
      ->check(CLI::IsMember({"front", "both"}));
}

void add_exact_options(CLI::App& touch, Entries& entries) {
  TouchOptions& options = entries.touch;
  touch
      .add_option("--subdivide", entries.subdivision,
                  "Take files for control meshes of Loop surfaces: touch the limit, or as the thesis does")
      ->type_name("limit|thesis:LEVEL");
  touch
      .add_option("--crease", options.crease_degrees,
                  "Edges of a control mesh that bend by more than DEGREES stay sharp (default: none)")
      ->type_name("DEGREES");
  touch
      .add_option("--implicit", options.implicit,
                  "Touch the solid where a formula in x, y, z (m) and t (s) is negative")
      ->type_name("FORMULA");
  touch
      .add_option("--bounds", entries.bounds,
                  "Box of --implicit in m: x0,y0,z0,x1,y1,z1, or its sizes, centred: X,Y,Z or one for all")
      ->type_name("BOX");
  touch
      .add_option(
          "--renderer", entries.renderer,
          "How CSG trees and Loop surfaces are touched: exactly, or as the thesis does (default exact)")
      ->type_name("exact|thesis");
}

void add_feel_options(CLI::App& touch, Entries& entries) {
  TouchOptions& options = entries.touch;
  touch
      .add_option("--stiffness", options.stiffness,
                  "Of the surface, N/m (default: the material's, or the device's nominal stiffness)")
      ->type_name("N_PER_M");
  touch
      .add_option("--friction", entries.friction,
                  "Static and dynamic Coulomb coefficients, such as 0.4,0.3 (default: the material's)")
      ->type_name("S,D");
  touch
      .add_option("--shading", entries.shading,
                  "Feel facets, or normals interpolated over them (default flat)")
      ->type_name("flat|smooth")
      ->check(CLI::IsMember({"flat", "smooth"}));
  touch
      .add_option("--texture", options.texture,
                  "Relief on all surfaces, such as ridges:0.0005,0.002: depth and spacing in m (list below; "
                  "default: the material's)")
      ->type_name("KIND[:NUMBERS]");
  touch
      .add_option("--effect", options.effects,
                  "A force beside the surfaces, such as viscous:2 (list below); may be given several times")
      ->type_name("KIND:NUMBERS")
      ->expected(1)
      ->take_all();
  touch
      .add_option(
          "--motion", options.motions,
          "How a MODEL, numbered from 0, moves: formulas in t (s) for its way in m and, after that, for "
          "its turn about the world's origin in rad, such as \"0:0.02*sin(3*t),0,0\"; once for each")
      ->type_name("MODEL:X,Y,Z[,RX,RY,RZ]")
      ->expected(1)
      ->take_all();
  touch.add_flag("--still", options.still,
                 "Objects stay where they are at rest, whatever motions their file brings");
  touch.add_option("--radius", options.radius, "Radius of the tip in metres (default 0: a point)")
      ->type_name("R");
}

void add_run_options(CLI::App& touch, Entries& entries) {
  TouchOptions& options = entries.touch;
  touch
      .add_option("--path", options.path,
                  "Replay tip positions from a CSV file: t,x,y,z in s and m, one row a tick")
      ->type_name("PATH.csv");
  touch
      .add_option_function<std::vector<std::string>>(
          "--device",
          [&options](const std::vector<std::string>& names) {
            if (names.size() > 1)
              throw CLI::ValidationError(
                  "--device",
                  "a run touches with one device; the window takes several, as in icome "
                  "MODEL --device A --device B");
            options.device = names.front();
          },
          kDeviceHelp)
      ->type_name("NAME")
      ->allow_extra_args(false);
  touch
      .add_option(
          "--hand-scale", options.hand_scale,
          "Metres that the tip moves for each metre of a real device (default: its profile's, or so that "
          "the models fit its workspace)")
      ->type_name("S")
      ->check(number_range(0.01, 100.0));
  touch
      .add_option("--seconds", options.seconds,
                  "When to end (default: after 5 s of exploring, at the end of a path, by Ctrl-C with a real "
                  "device)")
      ->type_name("S");
  touch.add_option("--rate", options.rate_hz, "Ticks a second, 500 to 10000 (default 1000)")->type_name("HZ");
}

void add_output_options(CLI::App& touch, Entries& entries) {
  TouchOptions& options = entries.touch;
  touch.add_flag(
      "--check", options.check,
      "Judge every tick by an independent test: counts pops, sticks, silence, pulls and what it cannot tell");
  touch.add_option("--trace", options.trace, "Write every tick to a CSV file (columns below)")
      ->type_name("OUT.csv");
  touch.add_option("--picture", options.picture, "Draw model, path and forces")->type_name("OUT.png");
  touch.add_flag("--json", options.json, "Print the report as JSON (fields below)");
}

void add_csg_options(CLI::App& csg, Entries& entries) {
  CsgOptions& options = entries.csg;
  csg.add_option("FILE.csg", options.file, "A CSG tree as OpenSCAD writes it, also .csg.xz")
      ->required()
      ->type_name("");
  csg.add_option("--form", entries.form, kFormHelp)
      ->type_name("tree|normal|subnormal")
      ->check(CLI::IsMember({"tree", "normal", "subnormal"}));
  csg.add_option("--max-nodes", options.max_nodes, "Limit of the form, which can explode (default 10000000)")
      ->type_name("N");
  csg.add_option("--inside", options.inside, "Judge points from a CSV file: x,y,z in m, one a row")
      ->type_name("POINTS.csv");
  csg.add_option("--mesh", options.mesh, "Write a closed mesh of the surface: binary STL, in mm")
      ->type_name("OUT.stl");
  csg.add_option("--cell", options.cell_mm,
                 "Grid that the mesh is made with, mm (default 1/200 of the longest side)")
      ->type_name("MM");
  csg.add_flag("--json", options.json, "Print the report as JSON (fields below)");
}

void add_info_options(CLI::App& info, InfoOptions& options) {
  info.add_option("FILE", options.file, kDesignFileHelp)->required()->type_name("");
  add_reading_options(info, options.reading);
  info.add_option("--objects", options.most_objects, "Show at most N lines of the tree; 0: all (default 30)")
      ->type_name("N")
      ->check(number_range(0.0, 1e9));
  info.add_flag("--json", options.json, "Print the report as JSON (fields below)");
}

void add_convert_options(CLI::App& convert, ConvertOptions& options) {
  convert.add_option("IN", options.in, kDesignFileHelp)->required()->type_name("");
  convert
      .add_option("OUT", options.out,
                  std::string(kDesignOutHelp) +
                      "; or the link of a design on a server: IN is put into it, beside what is there")
      ->required()
      ->type_name("");
  add_reading_options(convert, options.reading);
  convert
      .add_option("--into", options.into,
                  "Where OUT is the link of a design on a server: put it under this object of that design")
      ->type_name("PARENT")
      ->check([](const std::string& name) { return name.empty() ? "the name of an object is empty" : ""; });
  convert.add_flag("--force", options.force, kForceHelp);
  convert.add_flag("--json", options.json, "Print what was done as JSON (fields below)");
}

/// Throws where options do not go with a design on a server.
void check_remote_edit(const EditOptions& options) {
  if (!options.out.empty() || !options.replay.empty())
    throw CLI::ValidationError(
        "A design on a server is changed where it is: --out and --replay are for files.");
  if (options.apply.empty() && !options.watch) throw CLI::RequiredError("--apply or --watch");
}

void add_edit_options(CLI::App& edit, EditOptions& options) {
  const CLI::Option* const in = edit.add_option("IN", options.in, kEditInHelp)->type_name("");
  const CLI::Option* const apply =
      edit.add_option("--apply", options.apply, "Operations, one JSON object a line; - is standard input")
          ->type_name("EDITS.jsonl");
  const CLI::Option* const replay =
      edit.add_option("--replay", options.replay,
                      "In their place: what Tools > Technique > Record of the window has recorded, on the "
                      "design that was kept beside it")
          ->type_name("FILE.recording");
  const CLI::Option* const out = edit.add_option("--out", options.out, kDesignOutHelp)->type_name("OUT");
  edit.add_flag("--keep-going", options.keep_going,
                "Go on after lines that are wrong, to tell of all of them; nothing is written then, too");
  const CLI::Option* const help =
      edit.add_option("--help-ops", options.operation,
                      "List every operation with its parameters, or only OP; goes without the others")
          ->type_name("[OP]")
          ->expected(0, 1);
  edit.add_flag("--watch", options.watch,
                "Where IN is a link: tell what people do to the design, a line each, until Ctrl-C");
  add_reading_options(edit, options.reading);
  edit.add_flag("--force", options.force, kForceHelp);
  edit.add_flag("--json", options.json, "Print what was done, or the operations, as JSON (fields below)");
  edit.callback([&options, help, in, apply, replay, out] {
    options.help_ops = help->count() > 0;
    if (options.help_ops) return;
    if (collab::is_design_address(options.in)) return check_remote_edit(options);
    if (options.watch)
      throw CLI::ValidationError("--watch is for a design on a server: give its link as IN.");
    if (apply->count() > 0 && replay->count() > 0) throw CLI::ExcludesError("--apply", "--replay");
    const CLI::Option* const what = replay->count() > 0 ? replay : apply;
    for (const auto& [option, name] : {std::pair(in, "IN"), {what, "--apply"}, {out, "--out"}})
      if (option->count() == 0) throw CLI::RequiredError(name);
  });
}

void add_shot_options(CLI::App& shot, Entries& entries) {
  ShotOptions& options = entries.shot;
  shot.add_option("FILE", options.file, kDesignFileHelp)->required()->type_name("");
  shot.add_option("OUT.png", options.out, "The picture to write")->required()->type_name("");
  shot.add_option("--size", entries.shot_size, "Of the picture in pixels (default 1280x960)")
      ->type_name("WxH");
  shot.add_option("--view", options.view,
                  "front, back, left, right, top, bottom, iso or the name of a viewpoint of the design "
                  "(default: its first, else iso)")
      ->type_name("NAME");
  shot.add_option("--scene", options.scene, "Draw this scene of the design only")->type_name("NAME");
  shot.add_option("--time", options.time,
                  "Of the motions in the design, s: draw it as it is then (default: at rest)")
      ->type_name("T")
      ->check(number_range(0.0, 1e9));
  shot.add_flag("--studio", options.studio,
                "Leave the design's own lights off and light it as a studio does");
  shot.add_option("--background", entries.shot_background,
                  "#rrggbb, white, black, or none for a clear one (default: a soft gradient)")
      ->type_name("COLOR");
  add_eye_options(shot, entries.shot_eyes,
                  "Width and height in mm of the screen on which the picture is to be seen (default: as the "
                  "view is wide, from 600 mm)");
  shot.add_option("--eye", entries.shot_eye,
                  "Place of the eye in mm from the middle of the screen: to the right, up and towards you "
                  "(default 0,0,600)")
      ->type_name("X,Y,Z");
  add_reading_options(shot, options.reading);
  shot.add_flag("--json", options.json, "Print what was drawn as JSON (fields below)");
}

void add_techniques_options(CLI::App& techniques, TechniquesOptions& options) {
  techniques.add_option("--users", options.bench.users, "Simulated people, 1 to 1000 (default 12)")
      ->type_name("N");
  techniques
      .add_option("--trials", options.bench.trials,
                  "Movements of each in each condition, 2 to 1000 (default 9: once round the ring)")
      ->type_name("N");
  techniques.add_option("--seed", options.seed, "Of all that is random (default 1)")->type_name("N");
  techniques.add_option("--picture", options.picture, "Draw the result into a PNG file")
      ->type_name("OUT.png");
  techniques.add_flag("--menus", options.menus, "Compare menus that are felt instead (thesis 4.4.2, 6.6)");
  techniques.add_flag("--json", options.json, "Print the result as JSON (fields below)");
}

void add_desktop_options(CLI::App& app, DesktopCommandOptions& options) {
  app.add_option("DESIGN", options.design, kDesktopDesignHelp)->type_name("");
  app.add_option("--theme", options.theme, kThemeHelp)
      ->type_name("dark|light")
      ->check(CLI::IsMember({"dark", "light"}));
  app.add_option("--menu", options.menu, "The haptic menu of the window (docs/elements.md), opened by Space")
      ->type_name("FILE.toml");
  app.add_option("--microphone", options.microphone,
                 "The microphone that voice commands come from, by name, or a recording")
      ->type_name("NAME|WAV");
  add_device_options(app, options.devices);
}

/// The picture takes the shape of the screen, which has square pixels.
base::Result<void> fit_to_screen(bool has_size, ShotOptions& options) {
  constexpr double kSlack = 0.01;
  const double height = options.width * options.screen->y() / options.screen->x();
  if (!has_size) options.height = std::clamp(int(std::lround(height)), 1, 16384);
  if (std::abs(height - options.height) <= std::max(1.0, kSlack * height)) return {};
  return base::fail(fmt::format("--size {}x{} has not the shape of --screen: leave one of them out.",
                                options.width, options.height));
}

base::Result<void> take_eyes(const Entries& entries, ShotOptions& options) {
  options.stereo = stereo_settings(entries.shot_eyes);
  if (!entries.shot_eye.empty()) {
    const auto eye = parse_eye(entries.shot_eye);
    if (!eye) return tl::unexpected(eye.error());
    options.eye = *eye;
  }
  if (entries.shot_eyes.screen.empty()) return {};
  const auto screen = parse_screen(entries.shot_eyes.screen);
  if (!screen) return tl::unexpected(screen.error());
  options.screen = *screen;
  return fit_to_screen(!entries.shot_size.empty(), options);
}

base::Result<ShotOptions> understood_shot(const Entries& entries) {
  ShotOptions options = entries.shot;
  if (!entries.shot_size.empty()) {
    if (const auto parsed = parse_size(entries.shot_size, options); !parsed)
      return tl::unexpected(parsed.error());
  }
  if (!entries.shot_background.empty()) {
    if (const auto parsed = parse_background(entries.shot_background, options); !parsed)
      return tl::unexpected(parsed.error());
  }
  if (const auto eyes = take_eyes(entries, options); !eyes) return tl::unexpected(eyes.error());
  if (options.out == options.file)
    return base::fail("the picture would replace the design; give another name.");
  return options;
}

base::Result<CsgOptions> understood_csg(const Entries& entries) {
  CsgOptions options = entries.csg;
  if (entries.form == "normal") options.form = geometry::CsgForm::Normal;
  if (entries.form == "subnormal") options.form = geometry::CsgForm::Subnormal;
  if (const auto checked = check(options); !checked) return tl::unexpected(checked.error());
  return options;
}

/// Gives the entries their meaning.
base::Result<TouchOptions> understood(Entries entries) {
  TouchOptions& options = entries.touch;
  if (!entries.friction.empty()) {
    if (const auto parsed = parse_friction(entries.friction, options); !parsed)
      return tl::unexpected(parsed.error());
  }
  if (entries.sides == "front") options.sides = haptics::TouchableSides::Front;
  if (entries.sides == "both") options.sides = haptics::TouchableSides::Both;
  options.smooth_shading = entries.shading == "smooth";
  if (!entries.renderer.empty()) {
    const auto renderer = haptics::parse_renderer(entries.renderer);
    if (!renderer) return base::fail("--renderer: " + renderer.error().message);
    options.renderer = *renderer;
  }
  if (!entries.subdivision.empty()) {
    const auto subdivision = parse_subdivision(entries.subdivision);
    if (!subdivision) return tl::unexpected(subdivision.error());
    options.subdivision = *subdivision;
  }
  if (!entries.bounds.empty()) {
    const auto bounds = parse_bounds(entries.bounds);
    if (!bounds) return tl::unexpected(bounds.error());
    options.bounds = *bounds;
  }
  if (const auto checked = check(options); !checked) return tl::unexpected(checked.error());
  return options;
}

base::Result<TechniquesOptions> understood_techniques(const Entries& entries) {
  TechniquesOptions options = entries.techniques;
  if (options.seed < 0)
    return base::fail(fmt::format("--seed is {}; choose 0 or a number above it.", options.seed));
  options.bench.seed = std::uint64_t(options.seed);
  if (const auto checked = interaction::check(options.bench); !checked)
    return tl::unexpected(checked.error());
  return options;
}

CommandLine bad_usage(const std::string& sentence, const std::string& help) {
  tell(fmt::format("{}\nSee {}.", sentence, help));
  CommandLine command_line;
  command_line.exit_code = kBadUsage;
  return command_line;
}

/// Fails when the window's options stand beside a command.
base::Result<DesktopCommandOptions> understood_desktop(const DesktopCommandOptions& options,
                                                       const CLI::App& app) {
  if (app.get_subcommands().empty()) return options;
  if (!options.devices.is_default())
    return base::fail(
        "--device, --head, --stereo and --navigation before a command are for the window; they come after "
        "study run, "
        "and --device after touch.");
  if (!options.theme.empty()) return base::fail("--theme is for the window, and no command opens it.");
  if (!options.menu.empty()) return base::fail("--menu is for the window, and no command opens it.");
  if (!options.microphone.empty())
    return base::fail("--microphone is for the window, and no command opens it.");
  if (!options.design.empty())
    return base::fail(
        fmt::format("a command comes first, and its files after it: not \"{}\".", options.design.string()));
  return options;
}

/// The subcommand that the word at `place` names; null when it names none.
const CLI::App* named_subcommand(const CLI::App& app, int place, int argc, char** argv) {
  const auto named = app.get_subcommands(
      [&](const CLI::App* command) { return argc > place && command->check_name(argv[place]); });
  return named.empty() ? nullptr : named.front();
}

/// "stats anova ": the words that name the subcommand, and its own subcommand if it has one.
std::string path_of(const CLI::App& named, int argc, char** argv) {
  const CLI::App* const within = named_subcommand(named, 2, argc, argv);
  return named.get_name() + " " + (within != nullptr ? within->get_name() + " " : "");
}

/// "choose from describe, anova, ...": why a command with commands of its own goes no further; empty if
/// one of these, or an option, is named.
std::string no_such_part(const CLI::App& named, int argc, char** argv) {
  const auto all = named.get_subcommands([](const CLI::App*) { return true; });
  if (all.empty() || named_subcommand(named, 2, argc, argv) != nullptr) return {};
  if (argc > 2 && argv[2][0] == '-') return {};
  if (argc == 2 && named.get_require_subcommand_min() == 0) return {};
  std::string names;
  for (const CLI::App* const command : all) names += (names.empty() ? "" : ", ") + command->get_name();
  const char* const part = named.get_name() == "stats" ? "test" : "command";
  return argc > 2 ? fmt::format("there is no {} \"{}\"; choose from {}.", part, argv[2], names)
                  : fmt::format("say which {}: {}.", part, names);
}

/// Breaks the descriptions beside the names of options and commands into lines of 100 characters.
std::string wrapped_help(std::string_view text) {
  constexpr std::size_t kWidth = 100, kColumn = 30;  // CLI11 lays descriptions out from there
  std::string wrapped;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    const bool beside = line.size() > kColumn && line.substr(kColumn - 2, 2) == "  " && line[kColumn] != ' ';
    while (beside && line.size() > kWidth) {
      const std::size_t at = line.rfind(' ', kWidth);
      if (at == std::string::npos || at < kColumn) break;
      wrapped += line.substr(0, at) + "\n";
      line = std::string(kColumn, ' ') + line.substr(at + 1);
    }
    wrapped += line + "\n";
  }
  return wrapped;
}

}  // namespace

CommandLine parse_command_line(int argc, char** argv) {
  CLI::App app(kProgramHelp, "icome");
  app.footer(kProgramExamples);
  app.set_version_flag("--version", std::string("icome ") + base::kVersion, "Print the version and exit");
  app.set_help_flag("-h,--help", "Print this help and exit");
  Entries entries;
  add_desktop_options(app, entries.desktop);
  CLI::App& touch = *app.add_subcommand("touch", kTouchSummary);
  touch.footer(kTouchExamples + effects_help() + kTouchFormats);
  add_model_options(touch, entries);
  add_exact_options(touch, entries);
  add_feel_options(touch, entries);
  add_run_options(touch, entries);
  add_output_options(touch, entries);
  CLI::App& csg = *app.add_subcommand("csg", kCsgSummary);
  csg.footer(kCsgExamples);
  add_csg_options(csg, entries);
  CLI::App& info = *app.add_subcommand("info", kInfoSummary);
  info.footer(kInfoExamples);
  add_info_options(info, entries.info);
  CLI::App& convert = *app.add_subcommand("convert", kConvertSummary);
  convert.footer(kConvertExamples);
  add_convert_options(convert, entries.convert);
  CLI::App& edit = *app.add_subcommand("edit", kEditSummary);
  edit.footer(kEditExamples);
  add_edit_options(edit, entries.edit);
  CLI::App& shot = *app.add_subcommand("shot", kShotSummary);
  shot.footer(kShotExamples);
  add_shot_options(shot, entries);
  CLI::App& techniques = *app.add_subcommand("techniques", kTechniquesSummary);
  techniques.footer(kTechniquesExamples);
  add_techniques_options(techniques, entries.techniques);
  CLI::App& devices = *app.add_subcommand("devices", kDevicesSummary);
  add_devices_options(devices, entries.devices);
  CLI::App& stats = *app.add_subcommand("stats", kStatsSummary);
  add_stats_options(stats, entries.stats);
  CLI::App& study = *app.add_subcommand("study", kStudySummary);
  add_study_options(study, entries.study);
  add_serving_commands(app, entries.serving);
  add_keep(app, entries.keep);
  add_head(app, entries.head);
  add_menu(app, entries.menu);
  add_speech(app, entries.speech);
  add_sketch(app, entries.sketch);
  add_track(app, entries.track);
  add_animate(app, entries.animate);
  const CLI::App* const named = named_subcommand(app, 1, argc, argv);
  // CLI11 would speak of "arguments that were not expected".
  if (argc > 1 && argv[1][0] != '-' && named == nullptr && !is_design_name(argv[1]))
    return bad_usage(fmt::format("there is no command and no file \"{}\".", argv[1]), "icome --help");
  const std::string help = fmt::format("icome {}--help", named != nullptr ? path_of(*named, argc, argv) : "");
  if (named != nullptr)
    if (const std::string why = no_such_part(*named, argc, argv); !why.empty()) return bad_usage(why, help);
  CommandLine command_line;
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // help or version
    std::ostringstream told;
    command_line.exit_code = app.exit(success, told);
    std::cout << wrapped_help(told.str());
    return command_line;
  } catch (const CLI::ParseError& error) {
    return bad_usage(error.what(), help);
  }
  const auto desktop = understood_desktop(entries.desktop, app);
  if (!desktop) return bad_usage(desktop.error().message, help);
  if (touch.parsed()) {
    auto options = understood(std::move(entries));
    if (!options) return bad_usage(options.error().message, help);
    command_line.touch = std::move(*options);
  } else if (csg.parsed()) {
    auto options = understood_csg(entries);
    if (!options) return bad_usage(options.error().message, help);
    command_line.csg = std::move(*options);
  } else if (info.parsed()) {
    command_line.info = std::move(entries.info);
  } else if (convert.parsed()) {
    command_line.convert = std::move(entries.convert);
  } else if (edit.parsed()) {
    command_line.edit = std::move(entries.edit);
  } else if (shot.parsed()) {
    auto options = understood_shot(entries);
    if (!options) return bad_usage(options.error().message, help);
    command_line.shot = std::move(*options);
  } else if (stats.parsed()) {
    if (const std::string why = misfit(entries.stats); !why.empty()) return bad_usage(why, help);
    command_line.stats = std::move(entries.stats);
  } else if (study.parsed()) {
    command_line.study = std::move(entries.study);
  } else if (devices.parsed()) {
    command_line.devices = std::move(entries.devices);
  } else if (!entries.serving.task.empty()) {
    command_line.serving = std::move(entries.serving);
  } else if (entries.keep.list || !entries.keep.address.empty()) {
    command_line.keep = std::move(entries.keep);
  } else if (entries.head.is_given()) {
    command_line.head = std::move(entries.head);
  } else if (!entries.menu.file.empty()) {
    command_line.menu = std::move(entries.menu);
  } else if (!entries.speech.task.empty()) {
    command_line.speech = std::move(entries.speech);
  } else if (!entries.sketch.task.empty()) {
    command_line.sketch = std::move(entries.sketch);
  } else if (!entries.track.task.empty()) {
    command_line.track = std::move(entries.track);
  } else if (entries.animate.is_wanted) {
    command_line.animate = std::move(entries.animate);
  } else if (techniques.parsed()) {
    auto options = understood_techniques(entries);
    if (!options) return bad_usage(options.error().message, help);
    command_line.techniques = std::move(*options);
  } else {
    command_line.desktop = *desktop;
  }
  return command_line;
}

}  // namespace icome::apps
