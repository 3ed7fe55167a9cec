#include "apps/design/shot_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "apps/design/design_work.h"
#include "apps/design/shot_eyes.h"
#include "apps/interrupt.h"
#include "apps/remote/remote_design.h"
#include "apps/stopwatch.h"
#include "apps/terminal.h"
#include "apps/touch/touch_report.h"
#include "io/new_file.h"
#include "render/model/views.h"
#include "render/pictures/picture_of_scene.h"
#include "render/pictures/stereo_picture.h"
#include "session/display/display_feed.h"
#include "world/motion.h"

namespace icome::apps {
namespace {

/// The figures of a picture, for the report.
struct ShotFigures {
  std::string view;
  int width = 0, height = 0;  // pixels
  std::size_t objects = 0, triangles = 0;
  double read_seconds = 0.0, draw_seconds = 0.0;
  std::vector<std::string> remarks;
};

/// Some names in quotes, for a sentence.
template <typename Range, typename NameOf>
std::string quoted_names(const Range& range, const NameOf& name_of) {
  constexpr std::size_t kMostNames = 12;
  std::vector<std::string> names;
  for (const auto& it : range) {
    if (const std::string name = name_of(it); !name.empty()) names.push_back('"' + name + '"');
  }
  std::sort(names.begin(), names.end());
  if (names.empty()) return "none";
  const bool more = names.size() > kMostNames;
  names.resize(std::min(names.size(), kMostNames));
  return fmt::format("{}{}", fmt::join(names, ", "), more ? " and more" : "");
}

base::Result<world::SceneId> find_scene(const world::World& world, const std::string& name) {
  if (name.empty()) return world::SceneId{};
  for (const auto& [id, scene] : world.scenes()) {
    if (scene.name == name) return id;
  }
  return base::fail(fmt::format("the design has no scene \"{}\"; it has: {}.", name,
                                quoted_names(world.scenes(), [](const auto& it) { return it.second.name; })));
}

base::Result<render::Camera> choose_camera(const render::RenderScene& scene, const ShotOptions& options,
                                           std::string& view) {
  const double aspect = double(options.width) / options.height;
  if (const auto direction = render::view_direction(options.view)) {
    view = options.view;
    return render::fit_scene(scene, *direction, aspect);
  }
  for (const render::RenderViewpoint& it : scene.viewpoints()) {
    if (!options.view.empty() && it.name != options.view) continue;
    view = it.name;
    return render::look_from(it, scene.bounds(), aspect);
  }
  if (options.view.empty()) {
    view = "iso";
    return render::fit_scene(scene, *render::view_direction(view), aspect);
  }
  return base::fail(
      fmt::format("there is no view \"{}\"; there are front, back, left, right, top, bottom and iso, and of "
                  "the design's own: {}.",
                  options.view, quoted_names(scene.viewpoints(), [](const auto& it) { return it.name; })));
}

/// The scene at rest, or at a moment (s).
render::RenderScenePointer scene_of(const world::World& world, world::SceneId scene,
                                    std::optional<double> time) {
  render::ScenePublisher publisher(scene);
  if (!time) return publisher.publish(world);
  const world::PosedWorld posed(world, *time);
  const render::RenderScenePointer at_start = publisher.publish(posed.world());
  const render::RenderScenePointer changed = publisher.at_time(posed.world(), *time);
  return changed ? changed : at_start;
}

render::SceneLook look_of(const ShotOptions& options, const render::RenderScene& scene) {
  render::SceneLook look;
  look.passes = render::still_passes(scene);
  if (options.studio) look.lights = render::LightChoice::Studio;
  if (options.background) {
    const unsigned rgb = *options.background;
    look.above = {double(rgb >> 16 & 0xff) / 255.0, double(rgb >> 8 & 0xff) / 255.0,
                  double(rgb & 0xff) / 255.0};
    look.below = look.above;
  }
  if (options.clear) look.above.alpha = look.below.alpha = 0.0;
  return look;
}

base::Result<charts::Image> shot_picture(const render::RenderScene& scene, const render::Camera& camera,
                                         const ShotOptions& options) {
  const render::SceneLook look = look_of(options, scene);
  if (!has_own_eyes(options)) return render::draw_picture(scene, camera, look, options.width, options.height);
  const ShotEyes eyes = shot_eyes(camera, scene.bounds(), options);
  if (options.stereo.kind == interaction::StereoKind::Off)
    return render::draw_picture(scene, eyes.middle, look, options.width, options.height);
  return render::draw_stereo_picture(scene, eyes.eyes, session::layout_of(options.stereo.kind), look,
                                     options.width, options.height);
}

std::string shot_json(const ShotFigures& figures, const ShotOptions& options) {
  nlohmann::ordered_json report;
  report["file"] = options.out.string();
  report["width"] = figures.width;
  report["height"] = figures.height;
  report["view"] = figures.view;
  if (options.time) report["time"] = *options.time;
  if (options.stereo.kind != interaction::StereoKind::Off) {
    report["stereo"] = interaction::name_of(options.stereo.kind);
    report["eye_distance_mm"] = 1000.0 * options.stereo.eye_distance;
  }
  report["objects"] = figures.objects;
  report["triangles"] = figures.triangles;
  report["read_seconds"] = figures.read_seconds;
  report["draw_seconds"] = figures.draw_seconds;
  report["seconds"] = figures.read_seconds + figures.draw_seconds;
  report["warnings"] = figures.remarks;
  // Names may hold bytes that are not UTF-8.
  return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string shot_text(const ShotFigures& figures, const ShotOptions& options) {
  return fmt::format(
      "{}: {} x {} pixels, view {}, {} object{}, {} triangles, read in {:.2g} s, drawn in {:.2g} s\n",
      options.out.string(), figures.width, figures.height,
      figures.view.empty() ? "of the design" : figures.view, grouped(figures.objects),
      figures.objects == 1 ? "" : "s", grouped(figures.triangles), figures.read_seconds,
      figures.draw_seconds);
}

base::Result<ShotFigures> take_shot(const ShotOptions& options, StatusLine& status) {
  if (const auto png = check_picture_name(options.out); !png) return tl::unexpected(png.error());
  // An impossible path is reported before the work.
  auto out = io::NewFile::create(options.out);
  if (!out) return tl::unexpected(out.error());
  ShotFigures figures;
  const Stopwatch reading;
  auto design = read_for_person(options.file, options.reading, status);
  if (!design) return tl::unexpected(design.error());
  figures.read_seconds = reading.seconds();
  const auto id = find_scene(design->world, options.scene);
  if (!id) return tl::unexpected(id.error());
  status.say("Drawing");
  const Stopwatch drawing;
  const render::RenderScenePointer scene = scene_of(design->world, *id, options.time);
  const auto camera = choose_camera(*scene, options, figures.view);
  if (!camera) return tl::unexpected(camera.error());
  const auto image = shot_picture(*scene, *camera, options);
  if (!image) return tl::unexpected(image.error());
  figures.width = image->width;
  figures.height = image->height;
  const auto png = charts::encode_png(*image);
  if (!png) return tl::unexpected(png.error());
  if (interrupted()) return base::fail("interrupted");
  out->write(std::string_view(reinterpret_cast<const char*>(png->data()), png->size()));
  if (const auto finished = out->finish(); !finished) return tl::unexpected(finished.error());
  figures.draw_seconds = drawing.seconds();
  figures.objects = scene->object_count();
  figures.triangles = scene->triangle_count();
  figures.remarks = first_sentences(design->remarks, shown_name(options.file));
  figures.remarks.insert(figures.remarks.end(), scene->remarks().begin(), scene->remarks().end());
  if (figures.objects == 0) figures.remarks.push_back("The design has nothing to see: the picture is empty.");
  return figures;
}

}  // namespace

int run_shot(const ShotOptions& options) {
  catch_interrupts();
  StatusLine status;
  const auto figures = take_shot(options, status);
  if (!figures) return end_without_result(figures.error(), status);
  status.clear();
  for (const std::string& remark : figures->remarks) tell(remark);
  return print_answer(options.json ? shot_json(*figures, options) : shot_text(*figures, options));
}

}  // namespace icome::apps
