#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/design/design_options.h"
#include "base/result.h"
#include "base/vector.h"
#include "haptics/effects/surface_force.h"
#include "haptics/servo/renderer.h"

namespace icome::apps {

/// --subdivide: files are control meshes of Loop surfaces.
struct Subdivision {
  bool thesis = false;  // rendered as thesis 5.4 does, to `level`; else the limit
  int level = 0;
};

/// Coulomb coefficients: at_rest >= sliding >= 0.
struct Friction {
  double at_rest = 0.0;
  double sliding = 0.0;
};

/// The options of `icome touch`, as the command line gives them. SI units.
struct TouchOptions {
  std::vector<std::string> models;            // files or primitives; at least one, if there is no --implicit
  std::optional<std::string> implicit;        // a formula
  std::optional<base::Bounds> bounds;         // m, the box of --implicit
  std::optional<Subdivision> subdivision;     // none: meshes are touched as they are
  std::optional<double> crease_degrees;       // edges that are sharper stay sharp
  std::optional<haptics::Renderer> renderer;  // none: not named
  ReadingOptions reading;                     // of the files
  std::optional<double> fit;                  // m, longest side of each model

  std::string device = "simulated";           // or a profile's name, or the address of a real device
  std::optional<double> hand_scale;           // m that the tip moves for each m of a real hand; none: to fit
  double rate_hz = 1000.0;                    // Hz, 500 to 10,000
  std::optional<double> seconds;              // s, after which a run ends; none: see kDefaultSeconds
  std::optional<std::filesystem::path> path;  // tip positions to replay
  double radius = 0.0;                        // m, of the tip; 0 is a point
  std::vector<std::string> motions;           // of models: ModelMotion::parse
  bool still = false;                         // the motions of files are left aside

  std::optional<haptics::TouchableSides> sides;  // none: front of closed bodies, both of open ones
  std::optional<double> stiffness;     // N/m; 0: the device's nominal stiffness; none: the models' own
  std::optional<Friction> friction;    // none: the models' own
  bool smooth_shading = false;         // feel normals interpolated over the facets
  std::optional<std::string> texture;  // of all surfaces: haptics::make_texture; none: the models' own
  std::vector<std::string> effects;    // beside the surfaces: haptics::make_effect

  bool check = false;
  bool json = false;
  std::optional<std::filesystem::path> trace;
  std::optional<std::filesystem::path> picture;
};

constexpr double kDefaultSeconds = 5.0;  // s, of exploring; a path is replayed to its end

/// The renderer that follows from the options.
haptics::Renderer renderer_of(const TouchOptions& options);

/// Reads "limit" or "thesis:LEVEL".
base::Result<Subdivision> parse_subdivision(const std::string& text);

/// Reads a box from one length (a cube), three lengths (centred) or six coordinates (both corners), m.
base::Result<base::Bounds> parse_bounds(const std::string& text);

/// Fails, naming the option whose value makes no sense, or the two that contradict each other.
base::Result<void> check(const TouchOptions& options);

/// Reads "S,D" (or "S": both the same) into the two coefficients.
base::Result<void> parse_friction(const std::string& text, TouchOptions& options);

}  // namespace icome::apps
