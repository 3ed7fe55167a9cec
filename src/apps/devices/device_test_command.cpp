#include "apps/devices/device_test_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/design/design_work.h"
#include "apps/devices/device_test_picture.h"
#include "apps/interrupt.h"
#include "apps/terminal.h"
#include "base/shown_text.h"
#include "devices/catalogue.h"
#include "devices/device_news.h"
#include "io/new_file.h"
#include "session/probe/device_test.h"

namespace icome::apps {
namespace {

constexpr double kRestSeconds = 2.0;

using session::DeviceTestResult;
using Json = nlohmann::ordered_json;

/// Has a person agreed, by --yes or at the terminal, that the device pushes?
bool may_push(const DevicesOptions& options, const devices::DeviceInfo& info) {
  if (options.force <= 0.0 || info.max_force <= 0.0) return false;
  if (options.yes) return true;
  if (::isatty(STDIN_FILENO) == 0) {
    tell("no force was tried, as nobody was there to agree; --yes says so.");
    return false;
  }
  return ask(fmt::format(
      "After {:g} s at rest {} will push with up to {:.1f} N for some seconds. Hold it loosely. Go on?",
      options.seconds.value_or(kRestSeconds), info.name, std::min(options.force, info.max_force)));
}

Json number_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

/// A result, with what keeps it from being one of a device at rest that pushes.
struct Measured {
  DeviceTestResult result;
  std::string condition;  // of the device: while it might not push, else at the end
  bool might_push = true;

  bool is_whole() const { return result.was_still && might_push && result.lost == 0; }
};

std::string result_json(const DevicesOptions& options, const devices::PointerDevice& device,
                        const Measured& measured) {
  const DeviceTestResult& result = measured.result;
  Json json;
  json["device"] = device.info().name;
  json["address"] = options.name;
  json["condition"] = devices::in_one_line(measured.condition);
  json["seconds"] = result.ticks.empty() ? 0.0 : result.ticks.back().t;
  json["readings"] = result.readings;
  json["rate_hz"] = result.rate_hz;
  json["interval_ms"] = {{"median", result.interval_ms.median},
                         {"p99", result.interval_ms.p99},
                         {"max", result.interval_ms.longest}};
  json["stalled_ticks"] = result.stalled;
  json["lost_ticks"] = result.lost;
  json["moved_at_rest_mm"] = 1e3 * result.moved;
  json["noise_um"] = nullptr;
  if (result.was_still)
    json["noise_um"] = {1e6 * result.noise.x(), 1e6 * result.noise.y(), 1e6 * result.noise.z()};
  json["force"] = nullptr;
  if (result.force && measured.might_push) {
    std::optional<double> delay = result.force->delay;
    if (delay) *delay *= 1e3;
    json["force"] = {{"strongest_n", result.force->strongest},
                     {"moved_mm", 1e3 * result.force->moved},
                     {"delay_ms", number_or_null(delay)}};
  }
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string result_text(const DevicesOptions& options, const devices::PointerDevice& device,
                        const Measured& measured) {
  const DeviceTestResult& result = measured.result;
  std::string text = fmt::format("{} ({})\n", base::shown_text(device.info().name), options.name);
  const auto row = [&text](const char* name, const std::string& value) {
    text += fmt::format("  {:<14}{}\n", name, value);
  };
  row("readings", fmt::format("{} in {:.1f} s, {:.0f} a second", result.readings,
                              result.ticks.empty() ? 0.0 : result.ticks.back().t, result.rate_hz));
  row("interval", fmt::format("{:.2f} ms median, {:.2f} ms in 99 %, {:.1f} ms at most",
                              result.interval_ms.median, result.interval_ms.p99, result.interval_ms.longest));
  row("missed",
      fmt::format("{} ticks without a new reading, {} without the device", result.stalled, result.lost));
  row("noise", result.was_still
                   ? fmt::format("{:.1f}, {:.1f}, {:.1f} um (x, y, z) at rest", 1e6 * result.noise.x(),
                                 1e6 * result.noise.y(), 1e6 * result.noise.z())
                   : fmt::format("cannot be told: it moved by {:.0f} mm", 1e3 * result.moved));
  if (result.force && measured.might_push) {
    row("force", fmt::format("up to {:.2f} N, which moved it by {:.2f} mm", result.force->strongest,
                             1e3 * result.force->moved));
    row("delay", result.force->delay
                     ? fmt::format("{:.1f} ms from a force to its motion", 1e3 * *result.force->delay)
                 : result.was_still ? "too little moved to tell"
                                    : "cannot be told: it moved");
  }
  if (!measured.condition.empty()) row("condition", devices::in_one_line(measured.condition));
  if (!options.picture.empty()) row("picture", options.picture.string());
  return text;
}

base::Result<void> write_picture_of(const DeviceTestResult& result, const std::string& title,
                                    io::NewFile& out) {
  const auto png = charts::encode_png(draw_device_test(result, title));
  if (!png) return tl::unexpected(png.error());
  out.write(std::string_view(reinterpret_cast<const char*>(png->data()), png->size()));
  return out.finish();
}

/// Says why a result is not whole, and what to do.
void tell_what_is_missing(const Measured& measured, const devices::PointerDevice& device) {
  const std::string& name = device.info().name;
  const DeviceTestResult& result = measured.result;
  if (result.lost_at_end)
    tell(devices::loss_text(name, device.condition()) + " The result covers what was measured before.");
  else if (result.lost > 0)
    tell(fmt::format("{}: it was lost and came back meanwhile ({} ticks); look at its cable, and test again.",
                     name, result.lost));
  if (!measured.might_push)
    tell(fmt::format("{}: it might not push all the time, so forces were not measured. {}", name,
                     devices::in_one_line(measured.condition)));
  if (!result.was_still)
    tell(fmt::format("{}: it moved by {:.0f} mm; hold it still, and test again.", name, 1e3 * result.moved));
}

/// The answer of a test, and whether it tells all that was to be measured.
struct Tested {
  std::string text;
  bool whole = true;
};

base::Result<Tested> test(const DevicesOptions& options, StatusLine& status) {
  // An impossible path is reported before the work.
  std::optional<io::NewFile> out;
  if (!options.picture.empty()) {
    if (const auto named = check_picture_name(options.picture); !named) return tl::unexpected(named.error());
    auto created = io::NewFile::create(options.picture);
    if (!created) return tl::unexpected(created.error());
    out.emplace(std::move(*created));
  }
  status.say("Opening " + options.name);
  auto device = devices::open_device(options.name);
  status.clear();
  if (!device) return tl::unexpected(device.error());
  session::DeviceTestSettings settings;
  settings.rate_hz = options.rate_hz;
  settings.seconds = options.seconds.value_or(kRestSeconds);
  settings.force = may_push(options, (*device)->info()) ? options.force : 0.0;
  if (interrupted()) return base::fail("interrupted: nothing was measured.");
  Measured measured;
  auto result = session::test_device(**device, settings, [&](double seconds, double all) {
    const std::string condition = (*device)->condition();
    if (measured.might_push) measured.condition = condition;
    measured.might_push = measured.might_push && !devices::gives_no_force(condition);
    status.progress(seconds < settings.seconds ? "Hold it still" : "Hold it loosely",
                    std::round(10.0 * seconds) / 10.0, all, "s");
    return !interrupted();
  });
  status.clear();
  if (!result) return tl::unexpected(result.error());
  if (interrupted()) tell("interrupted: the result covers what was measured so far.");
  if (out) {
    if (const auto drawn = write_picture_of(*result, (*device)->info().name, *out); !drawn)
      return tl::unexpected(drawn.error());
  }
  measured.result = std::move(*result);
  tell_what_is_missing(measured, **device);
  return Tested{
      options.json ? result_json(options, **device, measured) : result_text(options, **device, measured),
      measured.is_whole()};
}

}  // namespace

int run_device_test(const DevicesOptions& options) {
  catch_interrupts();
  StatusLine status;
  const auto tested = test(options, status);
  if (!tested) return end_without_result(tested.error(), status);
  const int printed = print_answer(tested->text);
  if (printed != 0) return printed;
  if (interrupted()) return kDesignInterrupted;
  return tested->whole ? 0 : kDesignFailed;
}

}  // namespace icome::apps
