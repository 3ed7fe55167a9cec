#include "files/vrml/read/vrml_materials.h"

#include <flatbuffers/flatbuffers.h>
#include <vrml_answer_generated.h>

#include <algorithm>
#include <cmath>

#include "files/vrml/vrml_names.h"

namespace icome::files {
namespace {

constexpr FindingKind kCutOff = {"Colours and factors are cut off to lie between 0 and 1", "materials"};
constexpr FindingKind kWrongTouch = {
    "Stiffness, damping and friction that are negative or not finite are left out", "materials"};
constexpr FindingKind kLowFriction = {"Static friction is raised to the dynamic friction", "materials"};
constexpr FindingKind kWrongTransform = {"Texture transforms that make no sense are left out", "materials"};

/// Repairs numbers of a material and remembers whether that was needed.
class MaterialNumbers {
 public:
  float part(float value) {
    if (value >= 0.0F && value <= 1.0F) return value;
    cut_off_ = true;
    return value > 1.0F ? 1.0F : 0.0F;
  }
  world::Colour colour(const flat::Rgb* value, const world::Colour& otherwise) {
    return value ? world::Colour{part(value->r()), part(value->g()), part(value->b())} : otherwise;
  }
  /// None when it is negative or not finite.
  std::optional<double> touch(double value) {
    if (std::isfinite(value) && value >= 0.0) return value;
    wrong_touch_ = true;
    return std::nullopt;
  }

  void tell(const std::string& name, Findings& findings) const {
    if (cut_off_) findings.add(kCutOff, name);
    if (wrong_touch_) findings.add(kWrongTouch, name);
  }

 private:
  bool cut_off_ = false;
  bool wrong_touch_ = false;
};

}  // namespace

world::Material material_of(const flat::Appearance& appearance, world::FlatReader& reader,
                            Findings& findings) {
  world::Material material;
  MaterialNumbers numbers;
  material.name = said_by(reader.text(appearance.name()));
  if (appearance.lit()) {
    material.ambient = numbers.part(appearance.ambient());
    material.diffuse = numbers.colour(appearance.diffuse(), material.diffuse);
    material.specular = numbers.colour(appearance.specular(), material.specular);
    material.emission = numbers.colour(appearance.emission(), material.emission);
    material.shininess = numbers.part(appearance.shininess());
    material.transparency = numbers.part(appearance.transparency());
  } else {
    material.diffuse = {1.0F, 1.0F, 1.0F};
  }
  world::TouchProperties& touch = material.touch;
  if (appearance.stiffness().has_value()) touch.stiffness = numbers.touch(*appearance.stiffness());
  if (appearance.damping().has_value()) touch.damping = numbers.touch(*appearance.damping());
  touch.dynamic_friction = numbers.touch(appearance.dynamic_friction()).value_or(0.0);
  touch.static_friction = numbers.touch(appearance.static_friction()).value_or(0.0);
  if (touch.static_friction < touch.dynamic_friction) {
    findings.add(kLowFriction, material.name);
    touch.static_friction = touch.dynamic_friction;
  }
  touch.texture = reader.text(appearance.haptic_texture());
  numbers.tell(material.name, findings);
  return material;
}

world::PictureFrame picture_frame_of(const flat::Appearance& appearance, world::FlatReader& reader,
                                     Findings& findings) {
  world::PictureFrame frame = world::kPictureAsItLies;
  const auto numbers = reader.items<double>(appearance.texture_transform());
  if (numbers.empty()) return frame;
  constexpr std::size_t kNumbers = 9;  // three rows of three
  const auto finite = [](double it) { return std::isfinite(it); };
  if (numbers.size() != kNumbers || !std::all_of(numbers.begin(), numbers.end(), finite) ||
      numbers[6] != 0.0 || numbers[7] != 0.0 || numbers[8] != 1.0) {
    findings.add(kWrongTransform, "");
    return frame;
  }
  std::copy_n(numbers.begin(), frame.size(), frame.begin());
  return frame;
}

}  // namespace icome::files
