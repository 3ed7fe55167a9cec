#include "files/vrml/write/vrml_appearances.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "files/pictures/shown_pictures.h"
#include "world/shape/picture_kind.h"

namespace icome::files {
namespace {

using world::Colour;
using world::Material;
using world::MaterialId;
using world::TextureId;

/// "DEF wood " or nothing.
std::string def(const std::string& name) { return name.empty() ? "" : fmt::format("DEF {} ", name); }

float in_range(float value) { return std::clamp(value, 0.0F, 1.0F); }

void write_part(const char* name, float value, float usual, VrmlText& text) {
  value = in_range(value);
  if (value != usual) text.field(name, std::span(&value, 1));
}
void write_part(const char* name, Colour value, const Colour& usual, VrmlText& text) {
  std::transform(value.begin(), value.end(), value.begin(), in_range);
  if (value != usual) text.field(name, value);
}

template <typename Key>
std::string found(const std::unordered_map<Key, std::string>& names, Key key) {
  const auto it = names.find(key);
  return it == names.end() ? "" : it->second;
}

constexpr FindingKind kAskew = {"Pictures that are stretched askew are written as they lie", "materials"};
constexpr FindingKind kTint = {"The tints of pictures are left out, as VRML 2.0 shows their own colours",
                               "materials"};
constexpr FindingKind kAlphaMode = {"Pictures are seen through as they are, as VRML 2.0 knows no other way",
                                    "materials"};
constexpr FindingKind kUnlitLook = {"Materials that no light changes are written as lit ones", "materials"};
constexpr FindingKind kOneSided = {"That backs are not seen is left out", "materials"};
constexpr FindingKind kMetal = {"Metal and roughness are left out, for which highlights stand", "materials"};

std::array<float, 2> pair_of(const base::Vector2& it) { return {float(it.x()), float(it.y())}; }

/// The fields of a TextureTransform about the picture's lower left.
struct VrmlTextureTransform {
  base::Vector2 translation, scale;
  double rotation = 0.0;  // rad
};

/// Tc' = S R T Tc (ISO/IEC 14772-1, 6.49). None for frames that are flat, or not turned before they are
/// stretched.
std::optional<VrmlTextureTransform> vrml_texture_transform(const world::PictureFrame& frame) {
  Eigen::Matrix2d linear;
  linear << frame[0], frame[1], frame[3], frame[4];
  const base::Vector2 rows(linear.row(0).norm(), linear.row(1).norm());
  constexpr double kRounding = 1e-9;  // of a cosine
  if (!(rows.minCoeff() > 0.0) || !rows.allFinite()) return {};
  if (std::abs(linear.row(0).dot(linear.row(1))) > kRounding * rows.x() * rows.y()) return {};
  VrmlTextureTransform it;
  it.rotation = std::atan2(-linear(0, 1), linear(0, 0));
  const base::Vector2 across(std::sin(it.rotation), std::cos(it.rotation));
  it.scale = {rows.x(), linear.row(1).dot(across)};
  it.translation = linear.inverse() * base::Vector2(frame[2], frame[5]);
  // Rounding errors become zero.
  for (double& part : it.translation)
    part = std::abs(part) < kRounding * (1.0 + it.translation.norm()) ? 0.0 : part;
  if (!it.translation.allFinite()) return {};
  return it;
}

}  // namespace

void VrmlAppearances::name(const std::vector<MaterialId>& materials) {
  // Materials whose names are valid DEF names come first.
  for (const MaterialId id : materials) {
    const std::string& own = world_.find(id)->name;
    if (names_.take(own)) material_names_[id] = own;
  }
  std::vector<TextureId> textures;
  for (const MaterialId id : materials) {
    const Material& material = *world_.find(id);
    if (material.users > 1 && !material_names_.contains(id))
      material_names_[id] = names_.take_like(material.name);
    if (!material.texture || world_.find(material.texture)->users < 2) continue;
    std::string& name = texture_names_[material.texture];
    if (name.empty()) name = names_.take_like("texture");
  }
}

bool VrmlAppearances::needs_proto(MaterialId id, const Material& material) const {
  const bool named = material.name.empty() || material.name == found(material_names_, id);
  return !named || !(material.touch == world::TouchProperties());
}

bool VrmlAppearances::need_proto() const {
  const auto& materials = world_.materials();
  return std::any_of(materials.begin(), materials.end(),
                     [&](const auto& it) { return it.second.users > 0 && needs_proto(it.first, it.second); });
}

base::Result<void> VrmlAppearances::write(MaterialId id) {
  const std::string name = id ? found(material_names_, id) : kNoMaterial;
  if (!name.empty() && !written_materials_.insert(id).second) {
    text_.add("appearance USE " + name);
    return {};
  }
  text_.open("appearance " + def(name) + "Appearance");
  base::Result<void> result;
  if (id) {
    const Material& material = *world_.find(id);
    write_material(id, material);
    if (material.texture) {
      result = write_texture(material.texture);
      write_picture_frame(material);
    }
    tell_what_is_lost(material);
  } else {
    text_.open("material Material");
    text_.close();
  }
  text_.close();
  return result;
}

void VrmlAppearances::write_material(MaterialId id, const Material& material) {
  const Material usual;
  const bool with_proto = needs_proto(id, material);
  text_.open(with_proto ? fmt::format("material {}", kMaterialProto.name) : "material Material");
  if (with_proto && !material.name.empty()) text_.text_field("name", material.name);
  write_part("ambientIntensity", material.ambient, usual.ambient, text_);
  write_part("diffuseColor", material.diffuse, usual.diffuse, text_);
  write_part("emissiveColor", material.emission, usual.emission, text_);
  write_part("shininess", material.shininess, usual.shininess, text_);
  write_part("specularColor", shown_specular(world_, material), usual.specular, text_);
  write_part("transparency", material.transparency, usual.transparency, text_);
  const world::TouchProperties& touch = material.touch;
  if (touch.stiffness) text_.field("stiffness", *touch.stiffness);
  if (touch.damping) text_.field("damping", *touch.damping);
  if (touch.static_friction != 0.0) text_.field("staticFriction", touch.static_friction);
  if (touch.dynamic_friction != 0.0) text_.field("dynamicFriction", touch.dynamic_friction);
  if (!touch.texture.empty()) text_.text_field("hapticTexture", touch.texture);
  text_.close();
}

base::Result<void> VrmlAppearances::write_texture(TextureId id) {
  const world::Texture& texture = *world_.find(id);
  const std::string name = found(texture_names_, id);
  if (!name.empty() && !written_textures_.insert(id).second) {
    text_.add("texture USE " + name);
    return {};
  }
  const auto url = pictures_.add(texture);
  if (!url) return tl::unexpected(url.error());
  if (texture.media_type != "image/png" && texture.media_type != "image/jpeg" &&
      texture.media_type != "image/gif")
    remarks_.push_back({"", 0,
                        fmt::format("The picture {} is kept as it is, but VRML 2.0 programs show PNG, JPEG "
                                    "and GIF only.",
                                    *url)});
  text_.open("texture " + def(name) + "ImageTexture");
  text_.text_field("url", *url);
  if (!texture.repeats[0]) text_.field("repeatS", false);
  if (!texture.repeats[1]) text_.field("repeatT", false);
  text_.close();
  return {};
}

void VrmlAppearances::write_picture_frame(const world::Material& material) {
  if (material.picture_frame == world::kPictureAsItLies) return;
  const auto transform = vrml_texture_transform(material.picture_frame);
  if (!transform) return losses_.add(kAskew, material.name);
  text_.open("textureTransform TextureTransform");
  if (transform->rotation != 0.0) text_.field("rotation", transform->rotation);
  if (transform->scale != base::Vector2(1.0, 1.0)) text_.field("scale", pair_of(transform->scale));
  if (!transform->translation.isZero(0.0)) text_.field("translation", pair_of(transform->translation));
  text_.close();
}

void VrmlAppearances::tell_what_is_lost(const world::Material& material) {
  const auto add = [&](bool is_lost, const FindingKind& kind) {
    if (is_lost) losses_.add(kind, material.name);
  };
  const world::Texture* const texture = world_.find(material.texture);
  const bool white = material.diffuse == world::Colour{1.0F, 1.0F, 1.0F};
  add(texture && material.tints && !white && !world::is_grey_picture(*texture->bytes), kTint);
  add(texture && material.alpha_mode != world::AlphaMode::ByPicture && world::may_be_clear(*texture->bytes),
      kAlphaMode);
  add(material.unlit, kUnlitLook);
  add(!material.double_sided, kOneSided);
  add(material.metallic || material.roughness, kMetal);
}

}  // namespace icome::files
