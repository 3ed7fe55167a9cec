#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>

namespace icome::world {

/// Red, green, blue in [0, 1] as a display shows them (sRGB), which VRML, MTL, PLY and OpenSCAD mean, too.
/// Light is computed with what base::linear_from_srgb makes of them.
using Colour = std::array<float, 3>;

/// A light where its object is, shining along the object's -z. The model of VRML 2.0, 4.14.
struct Light {
  enum class Kind : std::uint8_t { Directional, Point, Spot };

  Kind kind = Kind::Directional;
  bool on = true;
  Colour colour = {1.0F, 1.0F, 1.0F};
  float intensity = 1.0F;  // in [0, 1]
  float ambient = 0.0F;    // in [0, 1]
  std::array<float, 3> attenuation = {1.0F, 0.0F,
                                      0.0F};  // by 1, the distance and its square; not directional
  double radius = 100.0;                      // m, how far it reaches; not directional
  double cut_off_angle = 0.785398;            // rad, where the cone ends; Spot
  double beam_width = 1.570796;               // rad, within which it is brightest; Spot
  bool scoped = false;  // shines only on its group, as a DirectionalLight of VRML 2.0 does; see lit_group()

  bool operator==(const Light&) const = default;
};

/// A place to look from: where its object is, along the object's -z, its y up.
struct Viewpoint {
  double field_of_view = 0.785398;  // rad, in (0, pi)

  bool operator==(const Viewpoint&) const = default;
};

/// A force on the hand that comes from no surface, where its object is and as that is turned; felt wherever
/// it reaches.
struct ForceEffect {
  std::string
      text;  // what it is, in the object's frame: as `icome touch --effect` takes it, "well:0,0,0,0.01,1.5"
  bool on = true;

  bool operator==(const ForceEffect&) const = default;
};

/// Something of a file that means nothing here, such as a script, kept for those who understand it.
struct Inert {
  std::string type;    // for people: "Script"
  std::string source;  // as it stood in a VRML 2.0 file

  bool operator==(const Inert&) const = default;
};

/// What an object is beside its shape. Its name is the object's.
using Fixture = std::variant<Light, Viewpoint, Inert, ForceEffect>;
using FixturePointer = std::shared_ptr<const Fixture>;  // null: nothing, as most objects

}  // namespace icome::world
