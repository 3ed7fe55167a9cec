#include "apps/devices/calibrate_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/design/design_work.h"
#include "apps/interrupt.h"
#include "apps/terminal.h"
#include "devices/axes.h"
#include "devices/catalogue.h"
#include "devices/mapping_file.h"
#include "session/probe/device_test.h"

namespace icome::apps {
namespace {

constexpr double kCalibrateSeconds = 10.0;
constexpr double kLeastExtent = 0.005;  // m, of each axis

/// The mapping of the device's file, with the values of the command line in place of its own.
base::Result<devices::DeviceMapping> mapping_of(const DevicesOptions& options) {
  auto mapping = devices::read_mapping(options.name);
  if (!mapping) return mapping;
  if (!options.axes.empty()) {
    const auto rotation = devices::rotation_from_axes(options.axes);
    if (!rotation) return base::fail("--axes " + rotation.error().message + ".");
    mapping->ours_from_device = devices::Quaternion(*rotation);
  }
  if (options.scale) mapping->scale = *options.scale;
  if (options.max_force) mapping->max_force = *options.max_force;
  if (options.clutch_button) mapping->clutch_button = *options.clutch_button;
  return mapping;
}

base::Result<void> check_range(const session::DeviceRange& range, const std::string& name) {
  const base::Vector3 extent = range.high - range.low;
  if (extent.minCoeff() >= kLeastExtent) return {};
  return base::fail(fmt::format(
      "{}: it moved by {:.1f} x {:.1f} x {:.1f} mm (right, up, to the user), and {:.0f} mm each are the "
      "least that tells a workspace; lead it to all corners while this runs (no profile was written)",
      name, 1e3 * extent.x(), 1e3 * extent.y(), 1e3 * extent.z(), 1e3 * kLeastExtent));
}

std::string answer(const DevicesOptions& options, const devices::DeviceMapping& mapping,
                   const session::DeviceRange& range) {
  const base::Vector3 extent = range.high - range.low;
  const std::string path = devices::mapping_path(options.name).string();
  if (options.json) {
    nlohmann::ordered_json json;
    json["device"] = options.name;
    json["profile"] = path;
    json["centre_m"] = {mapping.centre.x(), mapping.centre.y(), mapping.centre.z()};
    json["extent_m"] = {extent.x(), extent.y(), extent.z()};
    json["workspace_radius_m"] = mapping.workspace_radius;
    return json.dump(2) + "\n";
  }
  return fmt::format(
      "{}\n  extent        {:.0f} x {:.0f} x {:.0f} mm\n  centre        {:.1f}, {:.1f}, {:.1f} mm\n  profile "
      "      {}\n",
      options.name, 1e3 * extent.x(), 1e3 * extent.y(), 1e3 * extent.z(), 1e3 * mapping.centre.x(),
      1e3 * mapping.centre.y(), 1e3 * mapping.centre.z(), path);
}

base::Result<std::string> calibrate(const DevicesOptions& options, StatusLine& status) {
  auto mapping = mapping_of(options);
  if (!mapping) return tl::unexpected(mapping.error());
  // An impossible place is reported before the work.
  if (const auto checked = devices::check_mapping_place(options.name); !checked)
    return tl::unexpected(checked.error());
  // The device in its own frame, as its mapping is to be found.
  auto device = devices::open_device(options.name, {});
  if (!device) return tl::unexpected(device.error());
  tell("lead the device to all corners of its workspace.");
  const auto range =
      session::find_range(**device, options.rate_hz, options.seconds.value_or(kCalibrateSeconds),
                          [&status](double seconds, double all) {
                            status.progress("Calibrating", std::round(10.0 * seconds) / 10.0, all, "s");
                            return !interrupted();
                          });
  status.clear();
  if (!range) return tl::unexpected(range.error());
  if (interrupted()) return base::fail("interrupted: no profile was written.");
  if (const auto checked = check_range(*range, options.name); !checked)
    return tl::unexpected(checked.error());
  mapping->centre = range->centre();
  mapping->workspace_radius = std::max(0.001, 0.5 * (range->high - range->low).minCoeff());
  const auto written =
      devices::write_mapping(options.name, *mapping, "icome devices calibrate " + options.name);
  if (!written) return tl::unexpected(written.error());
  return answer(options, *mapping, *range);
}

}  // namespace

int run_calibrate(const DevicesOptions& options) {
  catch_interrupts();
  StatusLine status;
  const auto text = calibrate(options, status);
  if (!text) return end_without_result(text.error(), status);
  return print_answer(*text);
}

}  // namespace icome::apps
