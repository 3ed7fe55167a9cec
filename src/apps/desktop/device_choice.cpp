#include "apps/desktop/device_choice.h"

#include <CLI/CLI.hpp>
#include <utility>

#include "apps/option_checks.h"
#include "devices/catalogue.h"
#include "devices/spacemouse/space_mouse.h"
#include "headcam/camera_head.h"
#include "interaction/head/transfer_table.h"

namespace icome::apps {
namespace {

base::Result<std::unique_ptr<devices::HeadDevice>> open_head(const std::string& name) {
  if (!headcam::is_head_camera_address(name)) return devices::open_head(name);
  auto camera = headcam::CameraHead::create(name);
  if (!camera) return tl::unexpected(camera.error());
  return std::move(*camera);
}

}  // namespace

void add_device_options(CLI::App& app, DeviceChoice& choice) {
  app.add_option(
         "--device", choice.pointers,
         "A device to touch with, as icome devices lists it; may be given several times (default: the mouse)")
      ->type_name("NAME")
      ->allow_extra_args(false);
  auto* const head =
      app.add_option(
             "--head", choice.head,
             "A tracker on the user's head, such as vrpn:Tracker0@localhost; camera or camera-marker; or "
             "trace:FILE, a recorded motion as icome head reads it")
          ->type_name("NAME");
  app.add_option("--head-table", choice.head_table,
                 "How far the view goes along with the head, as icome head --print-table prints it")
      ->type_name("FILE.toml")
      ->needs(head);
  app.add_option("--head-filter", choice.head_filter,
                 "How the tracker's noise is steadied (default mean: of five samples)")
      ->type_name("none|mean|one-euro")
      ->check(CLI::IsMember({"none", "mean", "one-euro"}))
      ->needs(head);
  app.add_option("--head-predict-ms", choice.head_predict_ms,
                 "How far ahead of the tracker the view is, at the speed that the head has (default 0)")
      ->type_name("MS")
      ->check(number_range(0.0, 1000.0 * interaction::HeadFilterSettings::kMostPredicted))
      ->needs(head);
  add_fish_tank_options(app, choice.eyes);
  add_eye_options(app, choice.eyes, "Width and height in mm of the display (default: as it tells them)");
  app.add_option(
         "--navigation", choice.navigation,
         "What moves the view: gamepad, or another one that icome devices lists (default: a 3D mouse)")
      ->type_name("NAME");
}

base::Result<session::SessionSettings> session_settings(const DeviceChoice& choice) {
  session::SessionSettings settings;
  for (const std::string& name : choice.pointers) {
    auto device = session::open_connection(name);
    if (!device) return base::fail("--device: " + device.error().message);
    settings.connections.push_back(std::move(*device));
  }
  if (!choice.head.empty()) {
    auto head = open_head(choice.head);
    if (!head) return base::fail("--head: " + head.error().message);
    settings.head = std::move(*head);
  }
  if (!choice.head_table.empty()) {
    const auto table = interaction::read_transfer_file(choice.head_table);
    if (!table) return tl::unexpected(table.error());
    settings.head_transfer = *table;
  }
  settings.head_filter = {*interaction::head_filter_of(choice.head_filter), 0.001 * choice.head_predict_ms};
  settings.stereo = stereo_settings(choice.eyes);
  settings.fish_tank = choice.eyes.fish_tank;
  if (!choice.eyes.screen.empty()) {
    const auto display = parse_screen(choice.eyes.screen);
    if (!display) return tl::unexpected(display.error());
    settings.display_size = *display;
  }
  if (!choice.navigation.empty() && choice.navigation != "spacemouse") {
    auto navigation = devices::open_navigation(choice.navigation);
    if (!navigation) return base::fail("--navigation: " + navigation.error().message);
    settings.navigation = std::move(*navigation);
  } else if (auto mouse = devices::SpaceMouse::create({.wait = true})) {
    settings.navigation = std::move(*mouse);
  }
  return settings;
}

}  // namespace icome::apps
