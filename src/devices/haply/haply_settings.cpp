#include "devices/haply/haply_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/parse_number.h"
#include "base/shown_text.h"
#include "devices/axes.h"
#include "devices/driver/environment.h"

namespace icome::devices {
namespace {

/// Three texts with commas between them.
std::optional<std::array<std::string_view, 3>> three_of(std::string_view text) {
  std::array<std::string_view, 3> parts;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (i == 2)) return std::nullopt;
    parts[i] = text.substr(0, comma);
    text.remove_prefix(i == 2 ? text.size() : comma + 1);
  }
  return parts;
}

bool set_number(double& to, std::string_view text, double least, double most) {
  const auto number = base::parse_finite(text);
  if (!number || *number < least || *number > most) return false;
  to = *number;
  return true;
}

bool set_events(HaplySettings& settings, std::string_view text) {
  double port = 0.0;
  if (!set_number(port, text, 0.0, 65535.0) || port != std::floor(port)) return false;
  settings.events_port = std::uint16_t(port);
  return true;
}

bool set_force_field(HaplySettings& settings, std::string_view text) {
  if (text != "vector" && text != "values") return false;
  settings.force_field = text == "vector" ? ForceField::Vector : ForceField::Values;
  return true;
}

bool set_axes(HaplySettings& settings, std::string_view text) {
  const auto rotation = rotation_from_axes(text);
  if (!rotation) return false;
  settings.axes = base::Quaternion(*rotation);
  return true;
}

bool set_middle(HaplySettings& settings, std::string_view text) {
  const auto numbers = three_of(text);
  if (!numbers) return false;
  for (int i = 0; i < 3; ++i) {
    if (!set_number(settings.middle[i], (*numbers)[std::size_t(i)], -1.0, 1.0)) return false;
  }
  return true;
}

bool set_grip(HaplySettings& settings, std::string_view text) {
  settings.grip = text;
  return !text.empty();
}

constexpr std::string_view kSeparators = "; blanks separate options, as in \"rate=2000 patience=0.1\"";

struct HaplyOption {
  std::string_view name;
  bool (*set)(HaplySettings& settings, std::string_view value);
  std::string_view values;  // for people
};

constexpr std::array<HaplyOption, 8> kHaplyOptions{{
    {"events", set_events, "a port, or 0 for no events"},
    {"rate", [](HaplySettings& to, std::string_view text) { return set_number(to.rate, text, 250, 8000); },
     "250 to 8000 Hz"},
    {"patience",
     [](HaplySettings& to, std::string_view text) { return set_number(to.patience, text, 0.02, 60); },
     "0.02 to 60 s"},
    {"connect",
     [](HaplySettings& to, std::string_view text) { return set_number(to.connect_patience, text, 0.05, 60); },
     "0.05 to 60 s"},
    {"force", set_force_field, "vector or values"},
    {"grip", set_grip, "the device id of a VerseGrip"},
    {"axes", set_axes,
     "the service's axes that point right, up and to the user, right-handed, such as x,z,-y"},
    {"middle", set_middle, "three lengths in m, such as 0,-0.14,0.2"},
}};

base::Result<void> set_haply_option(HaplySettings& settings, std::string_view option) {
  const std::size_t equals = option.find('=');
  const std::string_view name = option.substr(0, equals);
  const std::string_view value = equals == std::string_view::npos ? "" : option.substr(equals + 1);
  std::string known;
  for (const HaplyOption& row : kHaplyOptions) {
    if (row.name == name) {
      if (row.set(settings, value)) return {};
      return base::fail(fmt::format("ICOME_HAPLY_OPTIONS: {} must be {}, not \"{}\"{}", name, row.values,
                                    base::shown_text(value), kSeparators));
    }
    known += fmt::format("{}{}", known.empty() ? "" : ", ", row.name);
  }
  return base::fail(fmt::format("ICOME_HAPLY_OPTIONS: no option is called \"{}\"; there are {}{}",
                                base::shown_text(name), known, kSeparators));
}

}  // namespace

base::Result<HaplySettings> parse_haply_settings(std::string_view place, std::string_view options) {
  HaplySettings settings;
  if (!place.empty()) {
    auto address = parse_service_address(place, settings.service.port);
    if (!address) return base::fail("ICOME_HAPLY: " + address.error().message);
    settings.service = std::move(*address);
  }
  while (!options.empty()) {
    const std::size_t end = std::min(options.find(' '), options.size());
    if (end > 0) {
      if (const auto set = set_haply_option(settings, options.substr(0, end)); !set)
        return tl::unexpected(set.error());
    }
    options.remove_prefix(std::min(end + 1, options.size()));
  }
  return settings;
}

base::Result<HaplySettings> haply_settings_from_environment() {
  return parse_haply_settings(environment_text("ICOME_HAPLY"), environment_text("ICOME_HAPLY_OPTIONS"));
}

}  // namespace icome::devices
