#include "apps/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>

#include "apps/help_text.h"
#include "base/version.h"

namespace icome::apps {
namespace {

constexpr int kBadUsage = 2;

/// The options as CLI11 fills them in, before they mean anything.
struct Entries {
  TouchOptions touch;
  std::string friction;
  std::string sides;
  std::string up = "z";
  std::string shading = "flat";
};

void add_model_options(CLI::App& touch, Entries& entries) {
  TouchOptions& options = entries.touch;
  touch.add_option("MODEL", options.models, kModelHelp)->required()->type_name("");
  touch
      .add_option("--unit", options.unit,
                  "Unit of the numbers in the files: m, dm, cm, mm, um or in (default m)")
      ->type_name("UNIT");
  touch
      .add_option("--up", entries.up,
                  "Axis that points up in the files; y is turned to the world's z (default z)")
      ->type_name("z|y")
      ->check(CLI::IsMember({"z", "y"}));
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

void add_feel_options(CLI::App& touch, Entries& entries) {
  TouchOptions& options = entries.touch;
  touch
      .add_option("--stiffness", options.stiffness,
                  "Of the surface, N/m (default: the device's nominal stiffness)")
      ->type_name("N_PER_M");
  touch
      .add_option("--friction", entries.friction, "Static and dynamic Coulomb coefficients, such as 0.4,0.3")
      ->type_name("S,D");
  touch
      .add_option("--shading", entries.shading,
                  "Feel facets, or normals interpolated over them (default flat)")
      ->type_name("flat|smooth")
      ->check(CLI::IsMember({"flat", "smooth"}));
  touch.add_option("--radius", options.radius, "Radius of the tip in metres (default 0: a point)")
      ->type_name("R");
}

void add_run_options(CLI::App& touch, Entries& entries) {
  TouchOptions& options = entries.touch;
  touch
      .add_option("--path", options.path,
                  "Replay tip positions from a CSV file: t,x,y,z in s and m, one row a tick")
      ->type_name("PATH.csv");
  touch.add_option("--device", options.device, kDeviceHelp)->type_name("NAME");
  touch
      .add_option("--seconds", options.seconds,
                  "When to end (default: after 5 s of exploring, at the end of a path)")
      ->type_name("S");
  touch.add_option("--rate", options.rate_hz, "Ticks a second, 500 to 10000 (default 1000)")->type_name("HZ");
}

void add_output_options(CLI::App& touch, Entries& entries) {
  TouchOptions& options = entries.touch;
  touch.add_flag("--check", options.check, "Judge every tick by an independent test: counts pops and sticks");
  touch.add_option("--trace", options.trace, "Write every tick to a CSV file (columns below)")
      ->type_name("OUT.csv");
  touch.add_option("--picture", options.picture, "Draw model, path and forces")->type_name("OUT.png");
  touch.add_flag("--json", options.json, "Print the report as JSON (fields below)");
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
  options.y_up = entries.up == "y";
  options.smooth_shading = entries.shading == "smooth";
  if (const auto checked = check(options); !checked) return tl::unexpected(checked.error());
  return options;
}

CommandLine bad_usage(const std::string& sentence, const char* help) {
  fmt::print(stderr, "icome: {}\nSee {}.\n", sentence, help);
  return {std::nullopt, kBadUsage};
}

}  // namespace

CommandLine parse_command_line(int argc, char** argv) {
  CLI::App app(kProgramHelp, "icome");
  app.footer(kProgramExamples);
  app.set_version_flag("--version", std::string("icome ") + base::kVersion, "Print the version and exit");
  app.set_help_flag("-h,--help", "Print this help and exit");
  CLI::App& touch = *app.add_subcommand("touch", kTouchSummary);
  touch.footer(kTouchExamples);
  Entries entries;
  add_model_options(touch, entries);
  add_feel_options(touch, entries);
  add_run_options(touch, entries);
  add_output_options(touch, entries);
  // CLI11 would speak of "arguments that were not expected".
  if (argc > 1 && argv[1][0] != '-' && !touch.check_name(argv[1])) {
    return bad_usage(fmt::format("there is no command \"{}\".", argv[1]), "icome --help");
  }
  const char* const help = argc > 1 && argv[1] == touch.get_name() ? "icome touch --help" : "icome --help";
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // help or version
    return {std::nullopt, app.exit(success)};
  } catch (const CLI::ParseError& error) {
    return bad_usage(error.what(), help);
  }
  if (!touch.parsed()) {
    fmt::print("{}", app.help());
    return {};
  }
  auto options = understood(std::move(entries));
  if (!options) return bad_usage(options.error().message, help);
  return {std::move(*options), 0};
}

}  // namespace icome::apps
