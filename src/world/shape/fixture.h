#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>

namespace icome::world {

/// Red, green, blue in [0, 1] as a display shows them (sRGB), as in VRML, MTL, PLY and OpenSCAD, too.
/// Light is computed with the linear values of base::linear_from_srgb.
using Colour = std::array<float, 3>;

/// A light at its object's place, shining along the object's -z. The model of VRML 2.0, 4.14.
struct Light {
  enum class Kind : std::uint8_t { Directional, Point, Spot };

  Kind kind = Kind::Directional;
  bool on = true;
  Colour colour = {1.0F, 1.0F, 1.0F};
  float intensity = 1.0F;  // in [0, 1]
  float ambient = 0.0F;    // in [0, 1]
  std::array<float, 3> attenuation = {1.0F, 0.0F,
                                      0.0F};  // of 1, the distance and its square; not directional
  double radius = 100.0;                      // m, how far it reaches; not directional
  double cut_off_angle = 0.785398;            // rad, where the cone ends; Spot
  double beam_width = 1.570796;               // rad, within which it is brightest; Spot
  bool scoped = false;  // shines only on its group, as a DirectionalLight of VRML 2.0 does; see lit_group()

  bool operator==(const Light&) const = default;
};

/// A viewpoint at its object's place, looking along the object's -z with y up.
struct Viewpoint {
  double field_of_view = 0.785398;  // rad, in (0, pi)

  bool operator==(const Viewpoint&) const = default;
};

/// A force on the hand that comes from no surface, placed and turned with its object; felt wherever it
/// reaches.
struct ForceEffect {
  std::string
      text;  // the effect, in the object's frame; syntax of `icome touch --effect`, "well:0,0,0,0.01,1.5"
  bool on = true;

  bool operator==(const ForceEffect&) const = default;
};

/// A node of a file without a meaning here, such as a script, kept for programs that understand it.
struct Inert {
  std::string type;    // for people: "Script"
  std::string source;  // as it stood in a VRML 2.0 file

  bool operator==(const Inert&) const = default;
};

/// The role of an object beside its shape. Its name is the object's.
using Fixture = std::variant<Light, Viewpoint, Inert, ForceEffect>;
using FixturePointer = std::shared_ptr<const Fixture>;  // null: none, as for most objects

}  // namespace icome::world
