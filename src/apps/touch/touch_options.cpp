#include "apps/touch/touch_options.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "apps/touch/effect_options.h"
#include "apps/touch/model_motion.h"
#include "apps/touch/touch_models.h"
#include "base/parse_number.h"
#include "io/file_ending.h"

namespace icome::apps {
namespace {

constexpr double kLongestRun = 86400.0;  // s
constexpr double kLargestRadius = 1.0;   // m

// Written so that NaN is refused, too.
base::Result<void> check_range(const char* option, double value, double least, double most,
                               const char* unit) {
  if (value >= least && value <= most) return {};
  return base::fail(fmt::format("{} {} makes no sense: choose a value from {} to {} {}.", option, value,
                                least, most, unit));
}

base::Result<void> check_exact(const TouchOptions& options) {
  if (options.models.empty() && !options.implicit) return base::fail("name a MODEL to touch, or --implicit.");
  if (options.bounds && !options.implicit) return base::fail("--bounds belongs to --implicit.");
  if (options.crease_degrees && !options.subdivision)
    return base::fail("--crease belongs to --subdivide: it says which edges stay sharp.");
  if (options.subdivision && options.renderer &&
      options.subdivision->thesis != (*options.renderer == haptics::Renderer::Thesis)) {
    return base::fail("--renderer and --subdivide name different renderers: leave --renderer out.");
  }
  return {};
}

/// An option that would change nothing is a misunderstanding: better refused than ignored.
base::Result<void> check_use(const TouchOptions& options) {
  if (options.implicit && options.models.empty() && options.fit)
    return base::fail("--fit scales models: the size of --implicit is that of its formula.");
  if (options.subdivision) {
    for (const std::string& model : options.models) {
      if (names_primitive(model) || io::ending_of(model).type == ".csg")
        return base::fail(fmt::format("--subdivide takes meshes: {} has no triangles to subdivide.", model));
    }
  }
  if (renderer_of(options) != haptics::Renderer::Thesis) return {};
  if (options.friction) return base::fail("--friction: the thesis's renderers know none; leave it out.");
  if (options.sides) return base::fail("--sides: the thesis's renderers touch the front only; leave it out.");
  return {};
}

}  // namespace

haptics::Renderer renderer_of(const TouchOptions& options) {
  if (options.subdivision && options.subdivision->thesis) return haptics::Renderer::Thesis;
  return options.renderer.value_or(haptics::Renderer::Exact);
}

base::Result<Subdivision> parse_subdivision(const std::string& text) {
  constexpr std::string_view kThesis = "thesis:";
  if (text == "limit") return Subdivision{};
  if (text.starts_with(kThesis)) {
    const auto level = base::parse_number<double>(std::string_view(text).substr(kThesis.size()));
    if (level && *level >= 0.0 && *level <= 10.0 && *level == std::floor(*level))
      return Subdivision{true, int(*level)};
  }
  return base::fail(
      fmt::format("--subdivide \"{}\": say limit, or thesis:LEVEL with a level from 0 to 10.", text));
}

base::Result<base::Bounds> parse_bounds(const std::string& text) {
  std::vector<double> numbers;
  std::string_view rest = text;
  for (bool more = true; more && numbers.size() < 7;) {
    const std::size_t comma = rest.find(',');
    const auto number = base::parse_finite(rest.substr(0, comma));
    if (!number) numbers.resize(7);
    numbers.push_back(number.value_or(0.0));
    more = comma != std::string_view::npos;
    if (more) rest.remove_prefix(comma + 1);
  }
  if (numbers.size() == 1) numbers.assign(3, numbers.front());
  base::Vector3 low, high;
  if (numbers.size() == 3) {
    high = 0.5 * base::Vector3(numbers[0], numbers[1], numbers[2]);
    low = -high;
  } else if (numbers.size() == 6) {
    low = {numbers[0], numbers[1], numbers[2]};
    high = {numbers[3], numbers[4], numbers[5]};
  } else {
    return base::fail(
        fmt::format("--bounds \"{}\": give x0,y0,z0,x1,y1,z1, or three lengths or one, in metres.", text));
  }
  if ((low.array() < high.array()).all()) return base::Bounds(low, high);
  return base::fail(
      fmt::format("--bounds \"{}\" is an empty box: its second corner must lie beyond the first.", text));
}

base::Result<void> check(const TouchOptions& options) {
  struct Range {
    const char* option;
    double value, least, most;
    const char* unit;
  };
  const Friction friction = options.friction.value_or(Friction{});
  for (const Range& range : {Range{"--fit", options.fit.value_or(1.0), 1e-6, 1e6, "m"},
                             Range{"--crease", options.crease_degrees.value_or(0.0), 0.0, 180.0, "degrees"},
                             Range{"--rate", options.rate_hz, 500.0, 10000.0, "Hz"},
                             Range{"--seconds", options.seconds.value_or(1.0), 0.01, kLongestRun, "s"},
                             Range{"--radius", options.radius, 0.0, kLargestRadius, "m"},
                             Range{"--stiffness", options.stiffness.value_or(0.0), 0.0, 1e6, "N/m"},
                             Range{"--friction", friction.at_rest, 0.0, 10.0, "(no unit)"},
                             Range{"--friction", friction.sliding, 0.0, 10.0, "(no unit)"}}) {
    const auto checked = check_range(range.option, range.value, range.least, range.most, range.unit);
    if (!checked) return checked;
  }
  if (const auto checked = check_exact(options); !checked) return checked;
  if (const auto checked = check_use(options); !checked) return checked;
  if (const auto checked = check_effects(options); !checked) return checked;
  if (const auto checked = check_motions(options); !checked) return checked;
  if (friction.sliding > friction.at_rest) {
    return base::fail(
        fmt::format("--friction {},{}: the first, static coefficient must not be below the second, "
                    "dynamic one.",
                    friction.at_rest, friction.sliding));
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
  const auto at_rest = base::parse_number<double>(first);
  const auto sliding = base::parse_number<double>(second);
  if (at_rest && sliding) {
    options.friction = Friction{*at_rest, *sliding};
    return {};
  }
  return base::fail(
      fmt::format("--friction \"{}\" is not two numbers: give static,dynamic such as 0.4,0.3.", text));
}

}  // namespace icome::apps
