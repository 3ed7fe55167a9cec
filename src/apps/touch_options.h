#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "haptics/surface_force.h"

namespace icome::apps {

/// What a person asked `icome touch` for, as the command line says it. SI units.
struct TouchOptions {
  std::vector<std::string> models;  // files or primitives, at least one
  std::string unit = "m";           // of the files: files::parse_unit
  bool y_up = false;                // the files' y points up; else their axes are the world's
  std::optional<double> fit;        // m, longest side of each model

  std::string device = "simulated";           // or a profile's name
  double rate_hz = 1000.0;                    // Hz, 500 to 10,000
  std::optional<double> seconds;              // s, after which a run ends; none: see kDefaultSeconds
  std::optional<std::filesystem::path> path;  // tip positions to replay
  double radius = 0.0;                        // m, of the tip; 0 is a point

  std::optional<haptics::TouchableSides> sides;  // none: front of closed models, both of open ones
  double stiffness = 0.0;                        // N/m; 0: the device's nominal stiffness
  double static_friction = 0.0;                  // Coulomb coefficients, static >= dynamic
  double dynamic_friction = 0.0;
  bool smooth_shading = false;  // feel normals interpolated over the facets

  bool check = false;
  bool json = false;
  std::optional<std::filesystem::path> trace;
  std::optional<std::filesystem::path> picture;
};

constexpr double kDefaultSeconds = 5.0;  // s, of exploring; a path is replayed to its end

/// Says which option has a value that makes no sense, or which two contradict each other.
base::Result<void> check(const TouchOptions& options);

/// Reads "S,D" (or "S": both the same) into the two coefficients.
base::Result<void> parse_friction(const std::string& text, TouchOptions& options);

}  // namespace icome::apps
