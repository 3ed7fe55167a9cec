#include "apps/touch/touch_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <utility>

#include "apps/design/design_work.h"
#include "apps/interrupt.h"
#include "apps/status_line.h"
#include "apps/stopwatch.h"
#include "apps/terminal.h"
#include "apps/touch/effect_options.h"
#include "apps/touch/exact_models.h"
#include "apps/touch/exploration.h"
#include "apps/touch/tick_log.h"
#include "apps/touch/touch_figures.h"
#include "apps/touch/touch_models.h"
#include "apps/touch/touch_report.h"
#include "apps/touch/touch_run.h"
#include "apps/touch/trace_file.h"
#include "devices/catalogue.h"
#include "devices/device_profiles.h"
#include "devices/mapping_file.h"
#include "devices/path_player.h"
#include "haptics/judge/contact_judge.h"
#include "render/pictures/touch_picture.h"

namespace icome::apps {
namespace {

constexpr int kInterrupted = 130;  // what shells report for Ctrl-C

/// Everything that a run needs, prepared before it begins.
struct Prepared {
  std::vector<TouchModel> models;
  std::shared_ptr<const haptics::HapticScene> scene;
  double build_seconds = 0.0;
  devices::DeviceInfo device;
  std::unique_ptr<devices::PointerDevice> hand;  // a real one; null: simulated, or a path
  std::optional<devices::PathPlayer> player;     // none: explore
  std::optional<Exploration> exploration;        // once it is planned
  std::optional<haptics::ContactJudge> judge;
  std::optional<TraceFile> trace;
};

base::Result<devices::DeviceInfo> chosen_device(const TouchOptions& options) {
  const std::string& name = options.device;
  if (options.path && devices::is_device_address(name))
    return base::fail("--path replays without a device: leave --device out, or name a simulated one.");
  if (name == "simulated" || devices::is_device_address(name)) return devices::DeviceInfo{.name = name};
  auto profile = devices::find_device_profile(name);
  if (!profile)
    return base::fail("--device: " + profile.error().message +
                      ", or simulated, or the address of a device (icome devices lists what is there).");
  return profile;
}

/// The sphere about all models, m; empty where one has no end.
std::optional<double> radius_of(const std::vector<TouchModel>& models) {
  constexpr double kEndless = 100.0;  // m
  base::Bounds all;
  for (const TouchModel& model : models)
    if (!model.bodies.empty()) all.extend(bounds(model));
  const double radius = all.isEmpty() ? 0.0 : 0.5 * all.diagonal().norm();
  if (!(radius > 0.0 && radius < kEndless)) return std::nullopt;
  return radius;
}

base::Vector3 middle_of(const std::vector<TouchModel>& models) {
  base::Bounds all;
  for (const TouchModel& model : models)
    if (!model.bodies.empty()) all.extend(bounds(model));
  const base::Vector3 middle =
      all.isEmpty() ? base::Vector3(base::Vector3::Zero()) : base::Vector3(all.center());
  return middle.allFinite() ? middle : base::Vector3(base::Vector3::Zero());
}

/// Opens a real device, with a workspace a little larger than the models where nobody says how large.
base::Result<std::unique_ptr<devices::PointerDevice>> open_hand(const std::vector<TouchModel>& models,
                                                                const TouchOptions& options) {
  constexpr double kRoom = 1.25;
  auto mapping = devices::read_mapping(options.device);
  if (!mapping) return tl::unexpected(mapping.error());
  if (options.hand_scale) mapping->scale = *options.hand_scale;
  auto device = devices::open_device(options.device, *mapping);
  const auto radius = radius_of(models);
  if (!device || mapping->scale || !radius || (*device)->info().workspace_radius <= 0.0) return device;
  devices::DeviceMapping fit;
  fit.scale = std::clamp(kRoom * *radius / (*device)->info().workspace_radius, 0.01, 100.0);
  return std::make_unique<devices::MappedDevice>(std::move(*device), fit);
}

base::Result<void> check_picture_place(const std::filesystem::path& path) {
  if (const auto named = check_picture_name(path); !named) return named;
  std::filesystem::path folder = path.parent_path();
  if (folder.empty()) folder = ".";
  std::error_code error;
  const bool possible =
      std::filesystem::is_directory(folder, error) && ::access(folder.c_str(), W_OK) == 0 &&
      (!std::filesystem::exists(path, error) || std::filesystem::is_regular_file(path, error));
  if (possible) return {};
  return base::fail(fmt::format("{}: a picture cannot be written there.", path.string()));
}

base::Result<void> load(const TouchOptions& options, StatusLine& status, Prepared& prepared) {
  auto models = load_models(options, [&](const std::string& what) { status.say(what); });
  if (!models) return tl::unexpected(models.error());
  prepared.models = std::move(*models);
  for (const TouchModel& model : prepared.models) prepared.build_seconds += model.build_seconds;
  const Stopwatch watch;
  prepared.scene = compile_scene(prepared.models, options);
  prepared.build_seconds += watch.seconds();
  return {};
}

haptics::JudgedObject judged(const TouchModel& model, const TouchBody& body,
                             const haptics::Surface& surface) {
  haptics::JudgedObject object;
  object.world_from_object = body.world_from_body;
  if (model.motion || body.course)
    object.motion = [model = model.motion, course = body.course, first = body.world_from_body](double time) {
      return Carrier{course, model.get()}.at(first, time);
    };
  if (body.primitive) {
    object.surface = *body.primitive;
  } else if (body.membership) {
    object.surface = *body.membership;
  } else if (body.judged.mesh) {
    object.surface = body.judged.mesh;
    object.error = body.judged.error;
  } else {
    object.surface = body.eye->mesh();
  }
  object.closed = body.closed;
  object.two_sided = surface.sides == haptics::TouchableSides::Both;
  return object;
}

haptics::ContactJudge judge_for(const std::vector<TouchModel>& models, const TouchOptions& options) {
  std::vector<haptics::JudgedObject> objects;
  haptics::JudgeSettings settings;
  settings.tip_radius = options.radius;
  for (const TouchModel& model : models) {
    for (const TouchBody& body : model.bodies) {
      const haptics::Surface surface = surface_of(body, options);
      settings.static_friction = std::max(settings.static_friction, surface.static_friction);
      objects.push_back(judged(model, body, surface));
    }
  }
  return {objects, settings};
}

/// Are surfaces all that pushes the tip, each with its plain force? (Under a tip at rest, one that draws back
/// leaves no force, as damping takes it.)
bool surfaces_alone(const std::vector<TouchModel>& models, const TouchOptions& options) {
  const auto plain = [&](const TouchBody& body) { return surface_of(body, options).texture == nullptr; };
  return options.effects.empty() && std::ranges::all_of(models, [&](const TouchModel& model) {
           return !moves(model) && model.effects.empty() && std::ranges::all_of(model.bodies, plain);
         });
}

// Errors that are quick to find are looked for first; the trace is opened last, so that nothing is left
// behind when something else fails.
base::Result<Prepared> prepare(const TouchOptions& options, StatusLine& status) {
  Prepared prepared;
  auto device = chosen_device(options);
  if (!device) return tl::unexpected(device.error());
  prepared.device = std::move(*device);
  if (options.picture) {
    if (const auto checked = check_picture_place(*options.picture); !checked)
      return tl::unexpected(checked.error());
  }
  if (options.path) {
    status.say("Reading " + options.path->string());
    auto player = devices::PathPlayer::create(*options.path, prepared.device);
    if (!player) return tl::unexpected(player.error());
    prepared.player = std::move(*player);
  }
  if (const auto loaded = load(options, status, prepared); !loaded) return tl::unexpected(loaded.error());
  if (!options.path && devices::is_device_address(options.device)) {
    status.say("Opening " + options.device);
    auto hand = open_hand(prepared.models, options);
    if (!hand) return tl::unexpected(hand.error());
    prepared.hand = std::move(*hand);
  }
  if (options.check) {
    status.say("Preparing the check");
    prepared.judge = judge_for(prepared.models, options);
  }
  if (options.trace) {
    auto trace = TraceFile::create(*options.trace);
    if (!trace) return tl::unexpected(trace.error());
    prepared.trace.emplace(std::move(*trace));
  }
  status.clear();
  return prepared;
}

base::Result<RunOutcome> run(Prepared& prepared, const TouchOptions& options, TickLog& log,
                             StatusLine& status) {
  if (prepared.player) return replay(*prepared.player, prepared.scene, prepared.models, options, log, status);
  if (prepared.hand) {
    constexpr double kEndless = 86400.0;  // s
    status.say("Touching with " + prepared.hand->info().name + "; Ctrl-C ends it");
    return touch_on_clock(*prepared.hand, middle_of(prepared.models), options.seconds.value_or(kEndless),
                          prepared.scene, prepared.models, options, log, status);
  }
  status.say("Planning where to touch");
  prepared.exploration =
      Exploration::plan(prepared.models, options.radius, options.seconds.value_or(kDefaultSeconds));
  status.clear();
  return explore(*prepared.exploration, prepared.device, prepared.scene, prepared.models, options, log,
                 status);
}

void add_to(render::TouchPicture& picture, const TouchBody& body, const std::string& name) {
  if (body.csg) {
    render::TouchSolid solid{.tree = *body.csg, .name = name, .world_from_tree = body.world_from_body};
    if (body.colour) solid.colour = *body.colour;
    solid.mesh = [&body] { return body.eye ? *body.eye->mesh() : picture_mesh(*body.csg); };
    picture.solids.push_back(std::move(solid));
    return;
  }
  render::StudioBody drawn{*body.eye->mesh(), body.world_from_body};
  if (body.colour) drawn.colour = *body.colour;
  picture.bodies.push_back(drawn);
}

/// Designs have y up; primitives and formulas by themselves stand on z = 0.
base::Vector3 up(const TouchOptions& options) {
  const bool upright = std::ranges::all_of(options.models, names_primitive);
  return upright ? base::Vector3::UnitZ() : base::Vector3::UnitY();
}

base::Result<void> draw(const Prepared& prepared, const TickLog& log, const TouchFigures& figures,
                        const TouchOptions& options) {
  render::TouchPicture picture;
  for (const TouchModel& model : prepared.models) {
    const std::string name =
        model.kind == kPrimitive ? model.name : std::filesystem::path(model.name).filename().string();
    picture.title += (picture.title.empty() ? "" : ", ") + name;
    for (const TouchBody& body : model.bodies) add_to(picture, body, name);
  }
  if (figures.triangles > 0) picture.notes.push_back(grouped(figures.triangles) + " triangles");
  picture.notes.push_back(fmt::format("tick {:.2g} us median, {:.2g} us worst in 1,000",
                                      figures.tick_us.median, figures.tick_us.p999));
  picture.samples = log.samples();
  picture.rate_hz = options.rate_hz;
  picture.up = up(options);
  return render::write_touch_picture(picture, *options.picture);
}

/// Mesh files do not name their unit, and a model of 100 m is rarely meant.
void tell_odd_size(const TouchModel& model) {
  constexpr double kSmallest = 0.001;  // m
  constexpr double kLargest = 10.0;    // m
  if (model.bodies.empty()) return;
  const double size = bounds(model).sizes().maxCoeff();
  if (model.kind == kPrimitive || (size >= kSmallest && size <= kLargest)) return;
  tell(fmt::format("{} is {} large: --unit or --fit give it another size.", model.name, length_text(size)));
}

void tell_outcome(const RunOutcome& outcome) {
  if (outcome.interrupted) tell("interrupted: the report covers what was touched so far.");
  if (outcome.device_lost)
    tell("the device was not there at the end: the report covers what was touched before.");
  if (!outcome.notice.empty()) tell(outcome.notice);
  if (outcome.lost_rows > 0) {
    tell(fmt::format(
        "{} ticks are missing in trace, check and figures: they came faster than they could be taken "
        "down.",
        outcome.lost_rows));
  }
}

/// Tells the first sentences, and how many more there are; the JSON report has them all.
void tell_capped(const std::vector<std::string>& sentences) {
  constexpr std::size_t kMostTold = 5;
  const std::size_t told = std::min(sentences.size(), kMostTold);
  for (std::size_t i = 0; i < told; ++i) tell(sentences[i]);
  if (told < sentences.size())
    tell(fmt::format("{} more are felt softer than asked for; --json names them.", sentences.size() - told));
}

void tell_little_touch(const Exploration& exploration, const TouchFigures& figures) {
  if (figures.touch_fraction >= Exploration::kEnough) return;
  tell(fmt::format("the hand touched for {:.0f} % of its time: {}.", 100.0 * figures.touch_fraction,
                   exploration.why_little()));
}

/// Writes the files that were asked for; false when one failed, after telling the error.
bool write_files(Prepared& prepared, const TickLog& log, const TouchFigures& figures,
                 const TouchOptions& options, StatusLine& status) {
  bool good = true;
  const auto note = [&](const base::Result<void>& written) {
    status.clear();
    if (written) return;
    tell(written.error().message);
    good = false;
  };
  if (prepared.trace) note(prepared.trace->finish());
  if (options.picture) {
    status.say("Drawing " + options.picture->string());
    note(draw(prepared, log, figures, options));
  }
  return good;
}

std::string names_of_files(const TouchOptions& options) {
  std::string names;
  if (options.trace) names += fmt::format("  {:<14}{}\n", "trace", options.trace->string());
  if (options.picture) names += fmt::format("  {:<14}{}\n", "picture", options.picture->string());
  return names;
}

}  // namespace

int run_touch(const TouchOptions& options) {
  StatusLine status;
  auto prepared = prepare(options, status);
  if (!prepared) {
    status.clear();
    tell(prepared.error().message);
    return kFailed;
  }
  for (const TouchModel& model : prepared->models) tell_odd_size(model);
  catch_interrupts();
  TickLog log(prepared->trace ? &*prepared->trace : nullptr, prepared->judge ? &*prepared->judge : nullptr,
              surfaces_alone(prepared->models, options), options.picture.has_value());
  const auto outcome = run(*prepared, options, log, status);
  if (!outcome) {
    tell(outcome.error().message);
    return kFailed;
  }
  tell_outcome(*outcome);
  TouchFigures figures = figures_of(prepared->models, prepared->build_seconds, log, *outcome, options);
  tell_capped(figures.capped);
  const bool effects_alone = prepared->scene->objects().empty();
  if (prepared->exploration && !effects_alone) tell_little_touch(*prepared->exploration, figures);
  if (options.json) {
    print(json_report(figures) + "\n");
  } else {
    print(text_report(figures, prepared->models, *outcome, options));
  }
  std::fflush(stdout);
  const bool written = write_files(*prepared, log, figures, options, status);
  if (!options.json && written) print(names_of_files(options));
  if (!written || outcome->device_lost) return kFailed;
  return outcome->interrupted && options.path ? kInterrupted : 0;
}

}  // namespace icome::apps
