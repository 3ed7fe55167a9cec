#include "apps/touch_options.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>

namespace icome::apps {
namespace {

constexpr double kLongestRun = 86400.0;  // s
constexpr double kLargestRadius = 1.0;   // m

// Written so that what is not a number is refused too.
base::Result<void> check_range(const char* option, double value, double least, double most,
                               const char* unit) {
  if (value >= least && value <= most) return {};
  return base::fail(fmt::format("{} {} makes no sense: choose a value from {} to {} {}.", option, value,
                                least, most, unit));
}

bool read_number(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

}  // namespace

base::Result<void> check(const TouchOptions& options) {
  struct Range {
    const char* option;
    double value, least, most;
    const char* unit;
  };
  for (const Range& range : {Range{"--fit", options.fit.value_or(1.0), 1e-6, 1e6, "m"},
                             Range{"--rate", options.rate_hz, 500.0, 10000.0, "Hz"},
                             Range{"--seconds", options.seconds.value_or(1.0), 0.01, kLongestRun, "s"},
                             Range{"--radius", options.radius, 0.0, kLargestRadius, "m"},
                             Range{"--stiffness", options.stiffness, 0.0, 1e6, "N/m"},
                             Range{"--friction", options.static_friction, 0.0, 10.0, "(no unit)"},
                             Range{"--friction", options.dynamic_friction, 0.0, 10.0, "(no unit)"}}) {
    const auto checked = check_range(range.option, range.value, range.least, range.most, range.unit);
    if (!checked) return checked;
  }
  if (options.dynamic_friction > options.static_friction) {
    return base::fail(
        fmt::format("--friction {},{}: the first, static coefficient must not be below the second, "
                    "dynamic one.",
                    options.static_friction, options.dynamic_friction));
  }
  if (options.trace && options.trace == options.path) {
    return base::fail("--path and --trace name the same file: the trace would replace the path.");
  }
  if (options.trace && options.picture && *options.trace == *options.picture) {
    return base::fail("--trace and --picture name the same file: give each its own.");
  }
  return {};
}

base::Result<void> parse_friction(const std::string& text, TouchOptions& options) {
  const std::string_view whole = text;
  const std::size_t comma = whole.find(',');
  const std::string_view first = whole.substr(0, comma);
  const std::string_view second = comma == std::string_view::npos ? first : whole.substr(comma + 1);
  if (read_number(first, options.static_friction) && read_number(second, options.dynamic_friction)) return {};
  return base::fail(
      fmt::format("--friction \"{}\" is not two numbers: give static,dynamic such as 0.4,0.3.", text));
}

}  // namespace icome::apps
