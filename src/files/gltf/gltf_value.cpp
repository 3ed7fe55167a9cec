#include "files/gltf/gltf_value.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "files/gltf/gltf_looks.h"

namespace icome::files {
namespace {

using tinygltf::Value;
using world::Colour;

const Value kNoValue;

template <typename Numbers>
Value array_value(const Numbers& numbers) {
  Value::Array array;
  for (const auto number : numbers) array.emplace_back(double(number));
  return Value(std::move(array));
}

std::optional<std::array<float, 3>> three_in(const Value& object, const std::string& name) {
  const Value& array = member(object, name);
  if (array.ArrayLen() != 3) return {};
  std::array<float, 3> three{};
  for (int i = 0; i < 3; ++i) {
    if (!array.Get(i).IsNumber()) return {};
    three[std::size_t(i)] = float(array.Get(i).GetNumberAsDouble());
  }
  return three;
}

/// A number of a light: finite and not below zero.
double magnitude_in(const Value& object, const std::string& name, double otherwise) {
  const double value = number_in(object, name).value_or(otherwise);
  return std::isfinite(value) && value >= 0.0 ? value : otherwise;
}

bool all_magnitudes(const std::array<float, 3>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(),
                     [](float it) { return std::isfinite(it) && it >= 0.0F; });
}

Colour colour_of_three(const std::array<float, 3>& three) {
  return {part_of_one(three[0]), part_of_one(three[1]), part_of_one(three[2])};
}

std::optional<world::PictureFrame> frame_in(const Value& object) {
  const Value& array = member(object, "pictureFrame");
  world::PictureFrame frame{};
  if (array.ArrayLen() != frame.size()) return {};
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const Value& number = array.Get(int(i));
    if (!number.IsNumber() || !std::isfinite(number.GetNumberAsDouble())) return {};
    frame[i] = number.GetNumberAsDouble();
  }
  return frame;
}

constexpr std::array<const char*, 3> kLightKinds{"directional", "point", "spot"};

Value touch_value(const world::TouchProperties& touch) {
  Value::Object object;
  if (touch.stiffness) object["stiffness"] = Value(*touch.stiffness);
  if (touch.damping) object["damping"] = Value(*touch.damping);
  object["staticFriction"] = Value(touch.static_friction);
  object["dynamicFriction"] = Value(touch.dynamic_friction);
  if (!touch.texture.empty()) object["texture"] = Value(touch.texture);
  return Value(std::move(object));
}

std::optional<double> limited(std::optional<double> value) {
  return value && std::isfinite(*value) && *value >= 0.0 ? value : std::nullopt;
}

world::TouchProperties touch_of(const Value& value) {
  world::TouchProperties touch;
  touch.stiffness = limited(number_in(value, "stiffness"));
  touch.damping = limited(number_in(value, "damping"));
  touch.dynamic_friction = limited(number_in(value, "dynamicFriction")).value_or(0.0);
  touch.static_friction =
      std::max(touch.dynamic_friction, limited(number_in(value, "staticFriction")).value_or(0.0));
  touch.texture = text_in(value, "texture");
  return touch;
}

}  // namespace

const Value& icome_extras(const Value& extras) { return member(extras, "icome"); }

Value extras_with(Value icome) {
  Value::Object object;
  object.emplace("icome", std::move(icome));
  return Value(std::move(object));
}

const Value& member(const Value& object, const std::string& name) {
  return object.IsObject() ? object.Get(name) : kNoValue;
}

std::optional<double> number_in(const Value& object, const std::string& name) {
  const Value& value = member(object, name);
  if (!value.IsNumber()) return {};
  return value.GetNumberAsDouble();
}

std::optional<int> index_in(const Value& object, const std::string& name, std::size_t count) {
  const Value& value = member(object, name);
  if (!value.IsInt()) return {};
  const int index = value.GetNumberAsInt();
  return index >= 0 && std::size_t(index) < count ? std::optional<int>(index) : std::nullopt;
}

std::string text_in(const Value& object, const std::string& name) {
  const Value& value = member(object, name);
  return value.IsString() ? value.Get<std::string>() : std::string();
}

Value value_of(const world::Light& light) {
  Value::Object object;
  object["kind"] = Value(std::string(kLightKinds.at(std::size_t(light.kind))));
  object["on"] = Value(light.on);
  object["colour"] = array_value(light.colour);
  object["intensity"] = Value(double(light.intensity));
  object["ambient"] = Value(double(light.ambient));
  object["attenuation"] = array_value(light.attenuation);
  object["radius"] = Value(light.radius);
  object["cutOffAngle"] = Value(light.cut_off_angle);
  object["beamWidth"] = Value(light.beam_width);
  if (light.scoped) object["scoped"] = Value(true);
  return Value(std::move(object));
}

std::optional<world::Light> light_of(const Value& value) {
  const auto* const kind = std::find(kLightKinds.begin(), kLightKinds.end(), text_in(value, "kind"));
  if (kind == kLightKinds.end()) return {};
  world::Light light;
  light.kind = world::Light::Kind(kind - kLightKinds.begin());
  if (member(value, "on").IsBool()) light.on = member(value, "on").Get<bool>();
  if (member(value, "scoped").IsBool()) light.scoped = member(value, "scoped").Get<bool>();
  if (const auto colour = three_in(value, "colour"); colour && all_magnitudes(*colour))
    light.colour = *colour;
  if (const auto three = three_in(value, "attenuation"); three && all_magnitudes(*three))
    light.attenuation = *three;
  light.intensity = float(magnitude_in(value, "intensity", 1.0));
  light.ambient = float(magnitude_in(value, "ambient", 0.0));
  light.radius = magnitude_in(value, "radius", light.radius);
  light.cut_off_angle = magnitude_in(value, "cutOffAngle", light.cut_off_angle);
  light.beam_width = magnitude_in(value, "beamWidth", light.beam_width);
  return light;
}

Value value_of(const world::Material& material, const MaterialExtras& more) {
  Value::Object object;
  object["ambient"] = Value(double(material.ambient));
  object["specular"] = array_value(material.specular);
  object["shininess"] = Value(double(material.shininess));
  if (more.diffuse) object["diffuse"] = array_value(material.diffuse);
  if (more.transparency) object["transparency"] = Value(double(material.transparency));
  if (more.by_picture) object["alphaByPicture"] = Value(true);
  if (more.frame) {
    object["pictureFrame"] = array_value(material.picture_frame);
    object["pictureSet"] = Value(1);
  }
  if (!(material.touch == world::TouchProperties{})) object["touch"] = touch_value(material.touch);
  return Value(std::move(object));
}

void complete(world::Material& material, const Value& value) {
  if (const auto ambient = number_in(value, "ambient")) material.ambient = part_of_one(*ambient);
  if (const auto specular = three_in(value, "specular")) material.specular = colour_of_three(*specular);
  const auto shininess = number_in(value, "shininess");
  if (shininess) material.shininess = part_of_one(*shininess);
  if (const auto diffuse = three_in(value, "diffuse")) {
    material.diffuse = colour_of_three(*diffuse);
    material.tints = false;
  }
  if (const auto clear = number_in(value, "transparency")) material.transparency = part_of_one(*clear);
  if (const Value& flag = member(value, "alphaByPicture"); flag.IsBool() && flag.Get<bool>())
    material.alpha_mode = world::AlphaMode::ByPicture;
  if (material.texture) material.picture_frame = frame_in(value).value_or(material.picture_frame);
  // Values that were derived from the highlights add no information.
  const bool worked_out = shininess && material.metallic == 0.0F && material.roughness &&
                          std::abs(*material.roughness - roughness_of(material.shininess)) < 1e-5;
  if (worked_out) material.metallic = material.roughness = std::nullopt;
  if (const Value& touch = member(value, "touch"); touch.IsObject()) material.touch = touch_of(touch);
}

bool says_own_places(const Value& value) {
  return frame_in(value).has_value() && index_in(value, "pictureSet", 2) == 1;
}

Value value_of(const ShapeText& text) {
  Value::Object object;
  for (const auto& [name, words] : text) object[name] = Value(words);
  return Value(std::move(object));
}

ShapeText shape_text_of(const Value& value) {
  ShapeText text;
  for (const std::string& name : value.Keys()) {
    if (value.Get(name).IsString()) text[name] = value.Get(name).Get<std::string>();
  }
  return text;
}

float part_of_one(double value) { return value > 0.0 ? float(std::min(value, 1.0)) : 0.0F; }

}  // namespace icome::files
