#include "files/vrml_looks.h"

#include <fmt/format.h>

#include <algorithm>

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

}  // namespace

void VrmlLooks::name(const std::vector<MaterialId>& materials) {
  // Those that can be called what they are called come first.
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

bool VrmlLooks::needs_proto(MaterialId id, const Material& material) const {
  const bool named = material.name.empty() || material.name == found(material_names_, id);
  return !named || !(material.touch == world::TouchProperties());
}

bool VrmlLooks::need_proto() const {
  const auto& materials = world_.materials();
  return std::any_of(materials.begin(), materials.end(),
                     [&](const auto& it) { return it.second.users > 0 && needs_proto(it.first, it.second); });
}

base::Result<void> VrmlLooks::write(MaterialId id) {
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
    if (material.texture) result = write_texture(material.texture);
  } else {
    text_.open("material Material");
    text_.close();
  }
  text_.close();
  return result;
}

void VrmlLooks::write_material(MaterialId id, const Material& material) {
  const Material usual;
  const bool with_proto = needs_proto(id, material);
  text_.open(with_proto ? fmt::format("material {}", kMaterialProto.name) : "material Material");
  if (with_proto && !material.name.empty()) text_.text_field("name", material.name);
  write_part("ambientIntensity", material.ambient, usual.ambient, text_);
  write_part("diffuseColor", material.diffuse, usual.diffuse, text_);
  write_part("emissiveColor", material.emission, usual.emission, text_);
  write_part("shininess", material.shininess, usual.shininess, text_);
  write_part("specularColor", material.specular, usual.specular, text_);
  write_part("transparency", material.transparency, usual.transparency, text_);
  const world::TouchProperties& touch = material.touch;
  if (touch.stiffness) text_.field("stiffness", *touch.stiffness);
  if (touch.damping) text_.field("damping", *touch.damping);
  if (touch.static_friction != 0.0) text_.field("staticFriction", touch.static_friction);
  if (touch.dynamic_friction != 0.0) text_.field("dynamicFriction", touch.dynamic_friction);
  if (!touch.texture.empty()) text_.text_field("hapticTexture", touch.texture);
  text_.close();
}

base::Result<void> VrmlLooks::write_texture(TextureId id) {
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

}  // namespace icome::files
