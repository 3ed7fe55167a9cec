#include "apps/desktop/device_choice.h"

#include <CLI/CLI.hpp>
#include <utility>

#include "devices/catalogue.h"
#include "devices/spacemouse/space_mouse.h"
#include "interaction/head/transfer_table.h"

namespace icome::apps {

void add_device_options(CLI::App& app, DeviceChoice& choice) {
  app.add_option(
         "--device", choice.pointers,
         "A device to touch with, as icome devices lists it; may be given several times (default: the mouse)")
      ->type_name("NAME")
      ->allow_extra_args(false);
  auto* const head =
      app.add_option(
             "--head", choice.head,
             "A tracker on the user's head, such as vrpn:Tracker0@localhost, or trace:FILE, a recorded "
             "motion as icome head reads it")
          ->type_name("NAME");
  app.add_option("--head-table", choice.head_table,
                 "How far the view goes along with the head, as icome head --print-table prints it")
      ->type_name("FILE.toml")
      ->needs(head);
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
    auto head = devices::open_head(choice.head);
    if (!head) return base::fail("--head: " + head.error().message);
    settings.head = std::move(*head);
  }
  if (!choice.head_table.empty()) {
    const auto table = interaction::read_transfer_file(choice.head_table);
    if (!table) return tl::unexpected(table.error());
    settings.head_transfer = *table;
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
