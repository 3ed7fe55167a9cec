#include "apps/devices/devices_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/design/design_work.h"
#include "apps/devices/calibrate_command.h"
#include "apps/devices/device_test_command.h"
#include "apps/devices/devices_help.h"
#include "apps/devices/serve_command.h"
#include "apps/option_checks.h"
#include "devices/axes.h"
#include "devices/catalogue.h"

namespace icome::apps {
namespace {

void add_common_options(CLI::App& command, DevicesOptions& options) {
  command.add_option("NAME", options.name, "A device's address, as icome devices lists it")
      ->required()
      ->type_name("");
  command.add_option("--rate", options.rate_hz, "Ticks a second, 500 to 10000 (default 1000)")
      ->type_name("HZ")
      ->check(number_range(500.0, 10000.0));
}

void add_test_options(CLI::App& devices, DevicesOptions& options) {
  CLI::App& test = *devices.add_subcommand("test", kDevicesTestSummary);
  test.footer(kDevicesTestNotes);
  add_common_options(test, options);
  test.add_option("--seconds", options.seconds, "Time at rest (default 2)")
      ->type_name("S")
      ->check(number_range(0.5, 300.0));
  test.add_option("--force", options.force, "The strongest force that it tries, 0 for none (default 0.5)")
      ->type_name("N")
      ->check(number_range(0.0, 5.0));
  test.add_flag("--yes", options.yes, "Give forces without asking");
  test.add_option("--picture", options.picture, "Draw the test into a PNG file")->type_name("OUT.png");
  test.add_flag("--json", options.json, "Print the result as JSON (fields below)");
  test.callback([&options] { options.task = "test"; });
}

std::string names_axes(const std::string& text) {
  const auto rotation = devices::rotation_from_axes(text);
  return rotation ? std::string() : rotation.error().message;
}

void add_calibrate_options(CLI::App& devices, DevicesOptions& options) {
  CLI::App& calibrate = *devices.add_subcommand("calibrate", kDevicesCalibrateSummary);
  calibrate.footer(kDevicesCalibrateNotes);
  add_common_options(calibrate, options);
  calibrate.add_option("--seconds", options.seconds, "Time to lead it through its workspace (default 10)")
      ->type_name("S")
      ->check(number_range(0.5, 300.0));
  calibrate
      .add_option("--axes", options.axes,
                  "Which of its axes, as ICOME shows them without a profile, point right, up and to the user "
                  "(default: x,y,z)")
      ->type_name("A,B,C")
      ->check(names_axes);
  calibrate.add_option("--scale", options.scale, "Metres that the tip moves for each metre of the hand")
      ->type_name("S")
      ->check(number_range(0.01, 100.0));
  calibrate.add_option("--max-force", options.max_force, "Never give more than this")
      ->type_name("N")
      ->check(number_range(0.01, 1000.0));
  calibrate
      .add_option("--clutch-button", options.clutch_button, "While this button is down the tip stays, from 0")
      ->type_name("B")
      ->check(CLI::Range(0, 31));
  calibrate.add_flag("--json", options.json, "Print the result as JSON (fields below)");
  calibrate.callback([&options] { options.task = "calibrate"; });
}

void add_serve_options(CLI::App& devices, DevicesOptions& options) {
  CLI::App& serve = *devices.add_subcommand("serve", kDevicesServeSummary);
  serve.footer(kDevicesServeNotes);
  serve
      .add_option("--vrpn", options.vrpn, "Where to listen; port 0 takes a free one (default 127.0.0.1:3883)")
      ->type_name("HOST:PORT")
      ->check(names_place);
  serve
      .add_option("--device", options.shared,
                  "A device's address; may be given several times (default: simulated)")
      ->type_name("NAME")
      ->allow_extra_args(false);
  serve.add_option("--rate", options.rate_hz, "Ticks a second, 500 to 10000 (default 1000)")
      ->type_name("HZ")
      ->check(number_range(500.0, 10000.0));
  serve.add_flag("--json", options.json, "Say as JSON where it listens (fields below)");
  serve.callback([&options] { options.task = "serve"; });
}

std::string list_json(const std::vector<devices::DeviceEntry>& entries) {
  nlohmann::ordered_json json;
  json["devices"] = nlohmann::ordered_json::array();
  for (const devices::DeviceEntry& it : entries)
    json["devices"].push_back({{"name", it.name},
                               {"family", it.family},
                               {"backend", it.backend},
                               {"present", it.present},
                               {"why", it.why}});
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

/// The text of a device or service, whose breaks of lines would pass for ours.
std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// Lines of words, at most 100 characters each, indented.
std::string in_lines(std::string_view words) {
  constexpr std::size_t kIndent = 6, kWidth = 100;
  std::string text;
  while (!words.empty()) {
    std::size_t end = words.size();
    if (end > kWidth - kIndent) {
      const std::size_t blank = words.rfind(' ', kWidth - kIndent);
      end = blank == std::string_view::npos || blank == 0 ? words.find(' ') : blank;
      end = std::min(end, words.size());
    }
    text += std::string(kIndent, ' ') + std::string(words.substr(0, end)) + "\n";
    words.remove_prefix(std::min(words.size(), end + 1));
  }
  return text;
}

std::string list_text(const std::vector<devices::DeviceEntry>& entries) {
  std::string text;
  for (const bool present : {true, false}) {
    text += present ? "There are:\n" : "\nNot there:\n";
    for (const devices::DeviceEntry& it : entries) {
      if (it.present != present) continue;
      text += fmt::format("  {:<28} {} ({})\n", one_line(it.name), it.family, it.backend) +
              in_lines(one_line(it.why));
    }
  }
  return text + "\nicome devices test NAME measures one; icome touch MODEL --device NAME touches with it.\n";
}

int run_list(const DevicesOptions& options) {
  StatusLine status;
  status.say("Looking for devices");
  const std::vector<devices::DeviceEntry> entries = devices::list_devices();
  status.clear();
  return print_answer(options.json ? list_json(entries) : list_text(entries));
}

}  // namespace

void add_devices_options(CLI::App& devices, DevicesOptions& options) {
  devices.footer(kDevicesExamples);
  devices.require_subcommand(0, 1);
  devices.add_flag("--json", options.json, "Print the list as JSON (fields below)");
  add_test_options(devices, options);
  add_calibrate_options(devices, options);
  add_serve_options(devices, options);
}

int run_devices(const DevicesOptions& options) {
  if (options.task == "test") return run_device_test(options);
  if (options.task == "calibrate") return run_calibrate(options);
  if (options.task == "serve") return run_serve(options);
  return run_list(options);
}

}  // namespace icome::apps
