#include "apps/eye_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string_view>
#include <vector>

#include "apps/option_checks.h"
#include "base/parse_number.h"

namespace icome::apps {
namespace {

constexpr double kMetre = 1000.0;      // mm
constexpr double kLeastScreen = 10.0;  // mm
constexpr double kNearestEye = 50.0;   // mm, before the screen
constexpr double kFarthestMillimetre = 1e5;

/// The numbers between separators; nothing where one is none.
std::optional<std::vector<double>> numbers_of(std::string_view text, char separator) {
  std::vector<double> numbers;
  for (;;) {
    const std::size_t end = std::min(text.find(separator), text.size());
    const auto number = base::parse_finite(text.substr(0, end));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    if (end == text.size()) return numbers;
    text.remove_prefix(end + 1);
  }
}

}  // namespace

void add_eye_options(CLI::App& app, EyeOptions& options, const std::string& screen_help) {
  app.add_option("--stereo", options.stereo,
                 "A picture for each eye: red and cyan, or one beside or above the other")
      ->type_name("off|anaglyph|side-by-side|top-bottom")
      ->check(CLI::IsMember({"off", "anaglyph", "side-by-side", "top-bottom"}));
  app.add_option("--eye-distance-mm", options.eye_distance_mm, "Between the eyes, with --stereo (default 63)")
      ->type_name("MM")
      ->check(number_range(0.0, kMetre * interaction::StereoSettings::kMostEyeDistance));
  app.add_option("--screen", options.screen, screen_help)->type_name("WxH");
}

void add_fish_tank_options(CLI::App& app, EyeOptions& options) {
  app.add_flag("--fish-tank", options.fish_tank,
               "The screen is a window into the world, seen from where the head is (docs/head-tracking.md)");
  app.add_flag("--squeezed", options.squeezed,
               "With --stereo side-by-side or top-bottom: halves that a 3D display stretches");
}

interaction::StereoSettings stereo_settings(const EyeOptions& options) {
  interaction::StereoSettings settings;
  settings.kind = interaction::stereo_of(options.stereo).value_or(interaction::StereoKind::Off);
  settings.eye_distance = options.eye_distance_mm / kMetre;
  settings.squeezed = options.squeezed;
  return settings;
}

base::Result<base::Vector2> parse_screen(const std::string& text) {
  const auto sides = numbers_of(text, 'x');
  const auto is_side = [](double side) { return side >= kLeastScreen && side <= kFarthestMillimetre; };
  if (!sides || sides->size() != 2 || !is_side(sides->front()) || !is_side(sides->back()))
    return base::fail(fmt::format(
        "--screen {}: the width and height of a screen in mm are written as in 520x320, from {:g} to {:g}.",
        text, kLeastScreen, kFarthestMillimetre));
  return base::Vector2(sides->front() / kMetre, sides->back() / kMetre);
}

base::Result<base::Vector3> parse_eye(const std::string& text) {
  const auto place = numbers_of(text, ',');
  bool good = place && place->size() == 3;
  for (std::size_t i = 0; good && i < place->size(); ++i) good = std::abs((*place)[i]) <= kFarthestMillimetre;
  if (!good || (*place)[2] < kNearestEye)
    return base::fail(
        fmt::format("--eye {}: the place of the eye is written as in 100,0,600, in mm from the middle "
                    "of the screen to the right, up and towards you; at least {:g} mm towards you.",
                    text, kNearestEye));
  return base::Vector3((*place)[0], (*place)[1], (*place)[2]) / kMetre;
}

}  // namespace icome::apps
